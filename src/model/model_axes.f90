!> The axes of beams: from chord, orientation and section to the element triad.
module model_axes
  use kinds, only: wp
  use text, only: to_text
  use diagnostics, only: report_t
  use model_data, only: model_t, member_t, translational
  implicit none
  private

  public :: orient_members, default_orientation

  real(wp), parameter :: tie = 1.0e-6_wp       !< of direction cosines; also: parallel
  real(wp), parameter :: no_length = 1.0e-12_wp !< relative to the positions

contains

  !> Set the triads; errors: no length, orientation parallel to the axis. Elements whose nodes
  !> have no position are passed over.
  subroutine orient_members(model, report)
    type(model_t), intent(inout) :: model
    type(report_t), intent(inout) :: report
    integer :: m

    do m = 1, size(model%member)
      associate (member => model%member(m))
        if (.not. all(model%node(member%node(translational, :))%placed)) cycle
        if (member%part > 1) then
          member%triad = model%member(m - 1)%triad
        else
          call orient(model, member, report)
        end if
      end associate
    end do
  end subroutine orient_members

  subroutine orient(model, member, report)
    type(model_t), intent(in) :: model
    type(member_t), intent(inout) :: member
    type(report_t), intent(inout) :: report
    real(wp) :: ex(3), ey(3), length, scale

    scale = maxval(abs(model%node(member%node(translational, 1))%position)) &
            + maxval(abs(member%chord))
    length = norm2(member%chord)
    if (length <= no_length*scale) then
      call report%add_error(member%place, "element "//to_text(member%id)// &
                            " has no length: its nodes are at the same place")
      return
    end if
    ex = member%chord/length
    ey = member%orientation
    if (.not. any(abs(ey) > 0)) ey = default_orientation(ex)
    ey = ey/maxval(abs(ey))
    ey = ey/norm2(ey)
    ey = ey - dot_product(ey, ex)*ex
    if (norm2(ey) <= tie) then
      call report%add_error(member%place, "the orientation of element "//to_text(member%id)// &
                            " is parallel to the beam", &
                            "o is the direction of the section's y axis")
      return
    end if
    ey = ey/norm2(ey)
    ey = ey - dot_product(ey, ex)*ex
    ey = ey/norm2(ey)
    call turn(model, member, ex, ey)
  end subroutine orient

  !> From the user's section axes to the principal ones: by theta about eX.
  subroutine turn(model, member, ex, ey)
    type(model_t), intent(in) :: model
    type(member_t), intent(inout) :: member
    real(wp), intent(in) :: ex(3), ey(3)
    real(wp) :: ez(3), theta

    ez = [ex(2)*ey(3) - ex(3)*ey(2), ex(3)*ey(1) - ex(1)*ey(3), ex(1)*ey(2) - ex(2)*ey(1)]
    theta = 0.0_wp
    if (member%section > 0) theta = model%section(member%section)%geometry%theta
    member%triad(:, 1) = ex
    member%triad(:, 2) = cos(theta)*ey + sin(theta)*ez
    member%triad(:, 3) = cos(theta)*ez - sin(theta)*ey
  end subroutine turn

  !> The global axis with the smallest component along the beam, ties in the order x y z.
  pure function default_orientation(ex) result(o)
    real(wp), intent(in) :: ex(3)  !< unit vector along the beam
    real(wp) :: o(3)
    integer :: i

    o = 0.0_wp
    do i = 1, 3
      if (abs(ex(i)) > minval(abs(ex)) + tie) cycle
      o(i) = 1.0_wp
      return
    end do
  end function default_orientation

end module model_axes
