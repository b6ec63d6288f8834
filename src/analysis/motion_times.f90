!> Where an analysis in time stops, what it keeps, and instants to come back to.
module motion_times
  use kinds, only: wp
  use model_data, only: analysis_t
  use nodal_state, only: state_t
  use generalized_alpha, only: flow_t
  use dynamic_equilibrium, only: dynamics_t
  implicit none
  private

  public :: number_of_stops, is_output, instant_t, remember, go_back

  !> A motion at one time.
  type :: instant_t
    real(wp) :: time = 0.0_wp
    type(state_t) :: state
    type(flow_t) :: flow
    real(wp), allocatable :: stress(:), level(:)
  end type instant_t

contains

  !> Equal steps, or intervals of the output.
  pure integer function number_of_stops(analysis, span) result(stops)
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: span
    real(wp) :: interval

    interval = span
    if (analysis%time_step > 0) then
      interval = analysis%time_step
    else if (analysis%every > 0) then
      interval = analysis%every
    end if
    stops = max(1, ceiling(span/interval - 1.0e-6_wp))
  end function number_of_stops

  !> With a fixed step, the steps nearest to multiples of EVERY are kept, and the last.
  pure logical function is_output(analysis, stop, stops, span)
    type(analysis_t), intent(in) :: analysis
    integer, intent(in) :: stop, stops
    real(wp), intent(in) :: span
    real(wp) :: h

    is_output = .true.
    if (.not. analysis%time_step > 0 .or. .not. analysis%every > 0 .or. stop == stops) return
    h = span/stops
    is_output = floor((stop + 0.5_wp)*h/analysis%every) > floor((stop - 0.5_wp)*h/analysis%every)
  end function is_output

  pure subroutine remember(time, level, motion, instant)
    real(wp), intent(in) :: time, level(:)
    type(dynamics_t), intent(in) :: motion
    type(instant_t), intent(inout) :: instant

    instant%time = time
    instant%level = level
    instant%state = motion%iterate%state
    instant%stress = motion%iterate%stress
    instant%flow = motion%flow
  end subroutine remember

  !> Back to what `remember` noted; the motion is not assembled there.
  pure subroutine go_back(instant, time, level, motion)
    type(instant_t), intent(in) :: instant
    real(wp), intent(out) :: time, level(:)
    type(dynamics_t), intent(inout) :: motion

    time = instant%time
    level = instant%level
    motion%iterate%state = instant%state
    motion%iterate%stress = instant%stress
    motion%flow = instant%flow
  end subroutine go_back

end module motion_times
