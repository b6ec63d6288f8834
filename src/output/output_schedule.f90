!> How much an analysis is going to record, how often that is written and drawn: all known when it
!> begins, so that files do not depend on the clock.
module output_schedule
  use kinds, only: wp, i8
  use model_data, only: analysis_t, static_analyses, time_analyses, control_arc
  implicit none
  private

  public :: in_time, has_steps, expected_steps, block_size, drawing_rule_t, new_rule

  !> Steps and bytes written together in analyses in time, at most.
  integer, parameter :: most_together = 256
  integer(i8), parameter :: most_bytes = 2_i8**21

  !> Steps that are drawn of an analysis in time: one for each of so many intervals.
  integer, parameter, public :: drawn_intervals = 200

  integer(i8), parameter :: guess = 1000, most_steps = 10_i8**8   !< steps, where they are adaptive

  !> Which recorded steps are drawn: the first of each interval of time, and the last.
  type :: drawing_rule_t
    private
    logical :: always = .true.
    real(wp) :: start = 0.0_wp, end = 0.0_wp, interval = 0.0_wp   !< [T]
    real(wp) :: slack = 1.0e-6_wp   !< of an interval: a state so little before it belongs to it
    real(wp) :: next = 0.0_wp       !< interval to be drawn
  contains
    procedure :: draws
  end type drawing_rule_t

contains

  !> Whether analyses of a kind are motions in time.
  pure logical function in_time(kind)
    integer, intent(in) :: kind

    in_time = any(kind == time_analyses)
  end function in_time

  !> Whether they record steps.
  pure logical function has_steps(kind)
    integer, intent(in) :: kind

    has_steps = any(kind == static_analyses) .or. in_time(kind)
  end function has_steps

  !> How many steps an analysis records, about; in time it goes from `start` [T].
  pure integer(i8) function expected_steps(analysis, start) result(steps)
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: start
    real(wp) :: interval

    if (in_time(analysis%kind)) then
      interval = recording_interval(analysis)
      steps = guess
      if (interval > 0) steps = max(1_i8, nint(min((analysis%end_time - start)/interval, &
                                                   real(most_steps, wp)), i8))
    else
      steps = merge(analysis%most_steps, analysis%steps, analysis%control == control_arc)
    end if
  end function expected_steps

  !> From one recorded state to the next [T]; 0: not known beforehand.
  pure real(wp) function recording_interval(analysis)
    type(analysis_t), intent(in) :: analysis

    recording_interval = max(analysis%every, analysis%time_step)
  end function recording_interval

  !> How many steps of so many bytes are written together: it takes about as long to compute them,
  !> whatever the size of the model.
  pure integer function block_size(bytes)
    integer(i8), intent(in) :: bytes

    block_size = int(max(1_i8, min(int(most_together, i8), most_bytes/max(1_i8, bytes))))
  end function block_size

  !> The rule of an analysis that starts at `start` [T].
  pure function new_rule(analysis, start) result(rule)
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: start
    type(drawing_rule_t) :: rule
    real(wp) :: step
    integer(i8) :: together

    rule%always = .not. in_time(analysis%kind)
    rule%start = start
    rule%end = analysis%end_time
    rule%interval = (rule%end - start)/drawn_intervals
    step = recording_interval(analysis)
    if (step > 0) then
      together = (expected_steps(analysis, start) + drawn_intervals - 1)/drawn_intervals
      rule%interval = together*step
      rule%slack = 0.5_wp/together
    end if
  end function new_rule

  !> Whether the state recorded at a time is drawn.
  logical function draws(self, time)
    class(drawing_rule_t), intent(inout) :: self
    real(wp), intent(in) :: time   !< [T]
    real(wp) :: at

    draws = .true.
    if (self%always .or. .not. self%interval > 0) return
    at = (time - self%start)/self%interval + self%slack
    draws = at >= self%next .or. time >= self%end
    self%next = max(self%next, real(floor(at, i8) + 1, wp))
  end function draws

end module output_schedule
