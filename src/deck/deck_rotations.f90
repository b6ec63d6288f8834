!> ROTATION cards to patterns, and what a model that turns allows.
module deck_rotations
  use kinds, only: wp
  use diagnostics, only: report_t
  use model_data, only: model_t, analysis_t, rotation_t, analysis_names, analysis_static, &
                        analysis_buckling, static_analyses, time_analyses, control_load
  use deck_draft, only: record_t
  implicit none
  private

  public :: set_rotation, check_rotations

  !> How far axes may be apart, relative to one and to lengths.
  real(wp), parameter :: same = 1.0e-9_wp

contains

  !> A card to its pattern, which takes one.
  subroutine set_rotation(report, record, rotation)
    type(report_t), intent(inout) :: report
    type(record_t), intent(in) :: record
    type(rotation_t), intent(inout) :: rotation

    if (rotation%place%line > 0) then
      call report%add_error(record%place, "ROTATION is given twice before a STATIONARY", &
                            "first at "//report%location(rotation%place))
      return
    end if
    rotation%rate = record%value(1)
    rotation%axis = record%value(2:4)/maxval(abs(record%value(2:4)))
    rotation%axis = rotation%axis/norm2(rotation%axis)
    rotation%origin = record%value(5:7)
    rotation%place = record%place
  end subroutine set_rotation

  !> All turns are about one axis, and every analysis knows what to do with them: only STATIONARY
  !> ramps them, and motions in time have no turning frame.
  subroutine check_rotations(model, report)
    type(model_t), intent(in) :: model
    type(report_t), intent(inout) :: report
    integer :: p, first, i
    logical :: turns

    first = 0
    do p = 1, size(model%pattern)
      if (model%pattern(p)%rotation%place%line == 0) cycle
      if (first == 0) first = p
      if (is_same_axis(model%pattern(first)%rotation, model%pattern(p)%rotation)) cycle
      call report%add_error(model%pattern(p)%rotation%place, &
                            "this ROTATION is about another axis than the first one", &
                            "at "//report%location(model%pattern(first)%rotation%place))
    end do
    if (first == 0) return
    turns = .false.
    do i = 1, size(model%analysis)
      associate (analysis => model%analysis(i))
        if (analysis%pattern > 0) call check_ramp(model, analysis, report)
        if (any(static_analyses == analysis%kind)) turns = turns .or. analysis%pattern >= first
        if (any(time_analyses == analysis%kind) .and. (turns .or. analysis%pattern >= first)) then
          call report%add_error(analysis%place, trim(analysis_names(analysis%kind))// &
                                " does not know of the turning frame of ROTATION", &
                                "turn the model by INPUTE of a HINGE, or start it by STARTDX")
        end if
      end associate
    end do
  end subroutine check_rotations

  !> An analysis that ramps, or scales, a pattern with a ROTATION.
  subroutine check_ramp(model, analysis, report)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(report_t), intent(inout) :: report

    associate (rotation => model%pattern(analysis%pattern)%rotation)
      if (rotation%place%line == 0) return
      if (analysis%kind == analysis_static) then
        call report%add_error(analysis%place, "the model turns: its ROTATION asks for STATIONARY", &
                              "at "//report%location(rotation%place))
      else if (analysis%kind == analysis_buckling) then
        call report%add_error(analysis%place, "BUCKLING cannot scale a ROTATION: its forces "// &
          "are not in proportion to the load factor", "STATIONARY before it, then the loads")
      else if (analysis%control /= control_load .and. any(static_analyses == analysis%kind)) then
        call report%add_error(analysis%place, "CONTROL ARC and DISPLACEMENT cannot find the "// &
          "rate of a ROTATION: its forces are not in proportion to the load factor", &
          "a STATIONARY of its own before, then the loads")
      end if
    end associate
  end subroutine check_ramp

  pure logical function is_same_axis(a, b)
    type(rotation_t), intent(in) :: a, b
    real(wp) :: apart(3)

    apart = b%origin - a%origin
    apart = apart - dot_product(apart, a%axis)*a%axis
    is_same_axis = abs(abs(dot_product(a%axis, b%axis)) - 1) <= same .and. &
                   norm2(apart) <= same*max(norm2(a%origin), norm2(b%origin))
  end function is_same_axis

end module deck_rotations
