!> IMPERFECTION: modes of the last BUCKLING added to the undeformed shape.
module geometric_imperfection
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use text, only: to_text, plural
  use model_data, only: model_t, member_t
  use mode_results, only: modes_t
  use rotation, only: cross, skew, identity3, rotation_matrix, turned, no_rotation
  implicit none
  private

  public :: add_imperfections

contains

  !> Move the nodes of a model by the modes that stand before an analysis, each times its scale, and
  !> turn the members with them: along their new chords, and about these by the mode's twist.
  !> Modes have a largest displacement of one. The new shape is free of stress.
  subroutine add_imperfections(analysis, modes, model, error)
    integer, intent(in) :: analysis           !< index of the analysis they stand before
    type(modes_t), intent(in) :: modes        !< of the last BUCKLING
    type(model_t), intent(inout) :: model
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(3, size(model%node)) :: shift, turn
    integer :: i, k

    shift = 0
    turn = 0
    do i = 1, size(model%imperfection)
      if (model%imperfection(i)%analysis /= analysis) cycle
      k = model%imperfection(i)%mode
      if (k > modes%modes) then
        call fail(error, exit_deck, "IMPERFECTION "//to_text(k)//": BUCKLING found "// &
                  plural(modes%modes, "mode"))
        return
      end if
      shift = shift + model%imperfection(i)%scale*modes%displacement(:, :, k)
      turn = turn + model%imperfection(i)%scale*modes%rotation(:, :, k)
    end do
    do i = 1, size(model%node)
      model%node(i)%position = model%node(i)%position + shift(:, i)
    end do
    do i = 1, size(model%member)
      call reshape_member(shift, turn, model%member(i))
    end do
  end subroutine add_imperfections

  !> New chord, and axes turned by the smallest rotation onto it and by the mean twist of the ends.
  pure subroutine reshape_member(shift, turn, member)
    real(wp), intent(in) :: shift(:, :), turn(:, :)
    type(member_t), intent(inout) :: member
    real(wp) :: old(3), new(3), v(3), r(3, 3), twist

    old = member%chord/norm2(member%chord)
    member%chord = member%chord + shift(:, member%node(1, 2)) - shift(:, member%node(1, 1))
    new = member%chord/norm2(member%chord)
    v = cross(old, new)
    r = skew(v)
    r = identity3 + r + matmul(r, r)/(1 + dot_product(old, new))
    member%triad = matmul(r, member%triad)
    twist = 0.5_wp*dot_product(turn(:, member%node(2, 1)) + turn(:, member%node(2, 2)), old)
    r = rotation_matrix(turned(no_rotation, twist*new))
    member%triad = matmul(r, member%triad)
  end subroutine reshape_member

end module geometric_imperfection
