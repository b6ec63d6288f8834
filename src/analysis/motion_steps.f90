!> Steps of a motion in time: their length, fixed or chosen by an estimate of their error, what is
!> done with those that fail, and the new start where loads jump or drives kink.
module motion_steps
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve, exit_interrupt
  use text, only: to_text
  use model_data, only: model_t, analysis_t
  use system_breaks, only: next_break
  use equilibrium_path, only: reason, check_angles
  use newton_method, only: newton_outcome_t, newton_converged
  use dynamic_equilibrium, only: dynamics_t
  use dynamic_step, only: take_step
  use dynamic_start, only: restart_motion, settle_motion, part_of_step
  use motion_instant, only: instant_t, remember, go_back
  use energy_account, only: account_t, reopen_account, enter_step, motion_energy
  use recorder, only: recorder_t, step_t
  implicit none
  private

  public :: passage_t, first_step, reach

  !> Of a step that Newton does not solve: on the way to one stop, or in a row if adaptive.
  integer, parameter :: most_halvings = 10

  !> A step may grow and shrink by these factors, and aims at this part of the tolerance.
  real(wp), parameter :: most_growth = 2.0_wp, most_shrinking = 0.2_wp, safety = 0.8_wp

  !> A step that would end this close, in its length, before a time ends there.
  real(wp), parameter :: close = 1.0e-6_wp

  !> A motion on its way.
  type :: passage_t
    type(dynamics_t) :: motion
    type(account_t) :: account
    type(step_t) :: record
    real(wp) :: time = 0.0_wp, step = 0.0_wp  !< present time, length of the step to try next [T]
    real(wp), allocatable :: level(:)         !< of the patterns
    logical :: whole = .true.                 !< the motion is at the end of a step
  end type passage_t

  !> A step to try.
  type :: stretch_t
    real(wp) :: length = 0.0_wp, end = 0.0_wp !< [T]
    logical :: last = .false.                 !< it ends at the goal or at a break
    logical :: breaks = .false.               !< at a break: with what is just before it
    real(wp) :: ratio = 0.0_wp                !< its error over the tolerance
  end type stretch_t

contains

  !> Length of the first step: as given, or a guess that the error will correct.
  pure real(wp) function first_step(analysis, time) result(h)
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: time

    h = analysis%time_step
    if (h > 0) return
    h = 1.0e-4_wp*(analysis%end_time - time)
    if (analysis%every > 0) h = 1.0e-2_wp*analysis%every
  end function first_step

  !> To a time, in one step or several: halved where Newton fails, and in adaptive steps chosen by
  !> their error.
  subroutine reach(model, analysis, goal, slack, single, self, recorder, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: goal, slack    !< times that are no further apart are the same [T]
    logical, intent(in) :: single          !< one step will do
    type(passage_t), intent(inout) :: self
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(stretch_t) :: stretch
    integer :: halvings
    logical :: fixed

    fixed = analysis%time_step > 0
    halvings = 0
    do
      if (recorder%interrupted()) then
        call fail(error, exit_interrupt, "interrupted at time "//to_text(self%time)// &
                  "; what was written before is kept")
        return
      end if
      stretch = next_stretch(self, goal, slack)
      call try_stretch(model, analysis, self, stretch, outcome, error)
      if (allocated(error)) return
      if (outcome%status /= newton_converged .or. stretch%ratio > 1) then
        if (.not. stretch%ratio > 1) halvings = halvings + 1
        call shorten(self, stretch)
        if (halvings <= most_halvings) cycle
        self%record%cutbacks = 0
        call fail(error, exit_solve, "no solution found beyond time "//to_text(self%time)// &
                  " with a step of "//to_text(stretch%length)//": "//reason(model, outcome))
        return
      end if
      if (.not. fixed) halvings = 0
      if (.not. fixed) call choose_step(stretch, self%step)
      if (stretch%breaks) call start_anew(merge(analysis%time_step, self%step, fixed), self, error)
      if (allocated(error)) return
      self%whole = .true.
      if (single .or. self%time >= goal - slack) return
      if (fixed) self%step = goal - self%time
    end do
  end subroutine reach

  !> The step to the goal or to a break before it, or as far as the present length goes.
  pure function next_stretch(self, goal, slack) result(stretch)
    type(passage_t), intent(in) :: self
    real(wp), intent(in) :: goal, slack
    type(stretch_t) :: stretch

    stretch%end = next_break(self%motion%system, self%time)
    stretch%breaks = stretch%end <= goal + slack
    if (.not. stretch%breaks) stretch%end = goal
    stretch%last = self%time + (1 + close)*self%step >= stretch%end
    stretch%breaks = stretch%breaks .and. stretch%last
    stretch%length = stretch%end - self%time
    if (stretch%last) return
    stretch%length = self%step
    stretch%end = self%time + self%step
  end function next_stretch

  !> Take a step and, if it is good, enter it; else the motion stays where it is.
  subroutine try_stretch(model, analysis, self, stretch, outcome, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(passage_t), intent(inout) :: self
    type(stretch_t), intent(inout) :: stretch
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    type(instant_t) :: before
    real(wp), dimension(self%motion%system%coordinates) :: increment, predicted
    real(wp) :: end

    call remember(self%time, self%level, self%motion, before)
    end = stretch%end
    if (stretch%breaks) end = nearest(end, -1.0_wp)
    where (self%motion%system%timed) self%level = end
    call check_angles(model, self%motion%system, self%level, error)
    if (allocated(error)) return
    self%whole = .false.
    call take_step(self%motion, self%level, stretch%length, increment, predicted, outcome, error)
    self%record%iterations = self%record%iterations + outcome%last%iteration
    if (allocated(error)) return
    if (outcome%status == newton_converged .and. .not. analysis%time_step > 0) then
      stretch%ratio = step_error(self%motion, increment, predicted)/analysis%tolerance
    end if
    if (outcome%status /= newton_converged .or. stretch%ratio > 1) then
      call go_back(before, self%time, self%level, self%motion)
      self%whole = .true.
      return
    end if
    call enter_step(self%motion, stretch%length, increment, self%account)
    self%time = stretch%end
    self%record%size = stretch%length
    self%record%last = outcome%last
  end subroutine try_stretch

  !> After a step that was refused.
  pure subroutine shorten(self, stretch)
    type(passage_t), intent(inout) :: self
    type(stretch_t), intent(in) :: stretch

    self%step = 0.5_wp*stretch%length
    if (stretch%ratio > 1) self%step = stretch%length &
      *max(most_shrinking, safety*stretch%ratio**(-1.0_wp/3))
    self%record%cutbacks = self%record%cutbacks + 1
  end subroutine shorten

  !> After a good one: the next length, by the error; one that a stop cut short says little.
  pure subroutine choose_step(stretch, step)
    type(stretch_t), intent(in) :: stretch
    real(wp), intent(inout) :: step
    real(wp) :: length

    length = stretch%length*min(most_growth, safety*max(stretch%ratio, 1.0e-3_wp)**(-1.0_wp/3))
    if (.not. stretch%last .or. stretch%ratio > safety**3) step = length
    step = max(step, length)
  end subroutine choose_step

  !> Behind a break: new accelerations, and where drives change their rate at once new velocities,
  !> whose energy is work of the drives.
  subroutine start_anew(h, self, error)
    real(wp), intent(in) :: h              !< length of the steps to come [T]
    type(passage_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: kinetic

    where (self%motion%system%timed) self%level = self%time
    kinetic = motion_energy(self%motion)
    call restart_motion(part_of_step*self%record%size, self%level, self%motion, error)
    if (allocated(error)) return
    if (size(self%motion%system%drive) > 0) then
      call reopen_account(self%motion, self%account, kinetic)
    else
      call reopen_account(self%motion, self%account)
    end if
    call settle_motion(h, self%level, self%motion, error)
  end subroutine start_anew

  !> Estimate of the error of a step: a part of the difference between the increment and its
  !> prediction with the old acceleration, in lengths of the model and radians.
  pure real(wp) function step_error(motion, increment, predicted)
    type(dynamics_t), intent(in) :: motion
    real(wp), intent(in) :: increment(:), predicted(:)

    step_error = abs(motion%scheme%beta - 1.0_wp/6)/motion%scheme%beta &
                 *maxval(abs(increment - predicted)/motion%scale)
  end function step_error

end module motion_steps
