!> TRANSIENT: motion in time from the present state, with generalized-alpha steps that are fixed or
!> chosen by an estimate of their error.
module analysis_transient
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve, exit_interrupt
  use text, only: to_text
  use model_data, only: model_t, analysis_t
  use model_functions, only: next_jump
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_inertia, only: masses_t, new_masses
  use system_results, only: results_t
  use equilibrium_path, only: reason, check_dropped, check_angles
  use newton_method, only: newton_outcome_t, newton_converged
  use generalized_alpha, only: new_scheme, flow_t
  use dynamic_equilibrium, only: dynamics_t, new_dynamics, take_step, release_dynamics
  use dynamic_start, only: start_motion, restart_motion, settle_motion, part_of_step
  use motion_instant, only: instant_t, remember, go_back
  use energy_account, only: account_t, open_account, reopen_account, enter_step, &
                            motion_results
  use time_grid, only: time_grid_t, new_time_grid
  use restart_point, only: point_t
  use motion_restart, only: make_point, take_up
  use recorder, only: recorder_t, step_t, iteration_t
  implicit none
  private

  public :: run_transient

  !> Of a step that Newton does not solve: on the way to one stop, or in a row if adaptive.
  integer, parameter :: most_halvings = 10

  !> A step may grow and shrink by these factors, and aims at this part of the tolerance.
  real(wp), parameter :: most_growth = 2.0_wp, most_shrinking = 0.2_wp, safety = 0.8_wp

contains

  !> Integrate from `time` to the analysis' end. `flow` holds the rates of an earlier motion that
  !> goes on, and is left at those of the end; not allocated: the motion starts here. With a `point`
  !> the analysis goes on from there.
  subroutine run_transient(model, system, analysis, time, level, iterate, flow, recorder, error, &
                           point)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: time, level(:)
    type(iterate_t), intent(inout) :: iterate
    type(flow_t), allocatable, intent(inout) :: flow
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(point_t), intent(in), optional :: point
    type(masses_t) :: masses
    type(dynamics_t) :: motion
    type(account_t) :: account
    type(step_t) :: record
    type(time_grid_t) :: grid
    real(wp) :: h

    call new_masses(model, system, masses)
    call new_dynamics(system, masses, iterate, new_scheme(analysis%spectral_radius), &
                      model%rayleigh(1), motion, error)
    if (analysis%iterations > 0) motion%iterations = analysis%iterations
    motion%stabilised = analysis%stabilised
    if (system%multipliers > 0 .and. analysis%spectral_radius >= 1 .and. &
        .not. motion%stabilised) then
      call recorder%remark("warning: RHOINF 1 with held strains and STABILISED OFF: their "// &
                           "forces may grow, as nothing damps errors; STABILISED ON does")
    end if
    if (allocated(error)) then
    else if (present(point)) then
      grid = new_time_grid(analysis, point%start)
      record%step = point%states - 1
      call take_up(point, model, motion, account, record, time, level, h, error)
    else
      grid = new_time_grid(analysis, time)
      h = first_step(analysis, time)
      where (motion%system%timed) level = time
      if (allocated(flow)) motion%flow = flow
      call start_motion(model, h, .not. allocated(flow), level, motion, error)
      if (.not. allocated(error)) call open_account(motion, account)
      record%time = time
      if (.not. allocated(error)) call keep(model, motion, account, recorder, record, error)
      if (.not. allocated(error)) call settle_motion(h, level, motion, error)
    end if
    if (.not. allocated(error)) then
      call march(model, analysis, grid, h, time, level, motion, account, recorder, record, error)
      iterate%state = motion%iterate%state
      iterate%stress = motion%iterate%stress
      flow = motion%flow
    end if
    call release_dynamics(motion)
  end subroutine run_transient

  !> Length of the first step: as given, or a guess that the error will correct.
  pure real(wp) function first_step(analysis, time) result(h)
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: time

    h = analysis%time_step
    if (h > 0) return
    h = 1.0e-4_wp*(analysis%end_time - time)
    if (analysis%every > 0) h = 1.0e-2_wp*analysis%every
  end function first_step

  !> Step until the end, recording; adaptive steps are recorded one by one unless EVERY is given.
  subroutine march(model, analysis, grid, h, time, level, motion, account, recorder, record, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(time_grid_t), intent(in) :: grid
    real(wp), intent(inout) :: h, time, level(:)
    type(dynamics_t), intent(inout) :: motion
    type(account_t), intent(inout) :: account
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error
    type(error_t), allocatable :: second
    integer :: stop
    logical :: single, whole

    single = .not. max(analysis%time_step, analysis%every) > 0
    stop = grid%next(time)
    whole = .true.
    do while (stop <= grid%stops)
      associate (goal => grid%time(stop))
        if (analysis%time_step > 0) h = goal - time
        call reach(model, analysis, goal, grid%slack(), single, h, time, level, motion, account, &
                   recorder, record, whole, error)
      end associate
      if (allocated(error)) exit
      call check_dropped(model, motion%system, motion%iterate, error)
      if (allocated(error)) return
      if (grid%is_regular(stop) .or. stop == grid%stops) then
        record%step = record%step + 1
        record%time = time
        call keep(model, motion, account, recorder, record, error)
        if (allocated(error)) return
      end if
      record%iterations = 0
      record%cutbacks = 0
      if (recorder%wants_point()) call leave_point(error)
      if (allocated(error)) return
      stop = grid%next(time)
    end do
    if (whole) call leave_point(second)
    if (allocated(second) .and. .not. allocated(error)) call move_alloc(second, error)

  contains

    !> Hand over where the motion stands.
    subroutine leave_point(error)
      type(error_t), allocatable, intent(out) :: error
      type(point_t) :: point

      point%start = grid%start
      point%states = record%step + 1
      point%regular = point%states
      if (.not. (time < grid%end .or. grid%is_regular(grid%stops))) point%regular = record%step
      call make_point(model, motion, account, record, time, level, h, point)
      call recorder%keep_point(point, error)
    end subroutine leave_point

  end subroutine march

  !> To a time, in one step or several: halved where Newton fails, and in adaptive steps chosen by
  !> their error; `h` is the length to try next.
  subroutine reach(model, analysis, goal, slack, single, h, time, level, motion, account, &
                   recorder, record, whole, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: goal, slack    !< times that are no further apart are the same [T]
    logical, intent(in) :: single          !< one step will do
    real(wp), intent(inout) :: h, time, level(:)
    type(dynamics_t), intent(inout) :: motion
    type(account_t), intent(inout) :: account
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    logical, intent(out) :: whole          !< the motion is at the end of a step, error or not
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(instant_t) :: before
    real(wp), dimension(motion%system%coordinates) :: increment, predicted
    real(wp) :: length, ratio
    real(wp) :: jump
    integer :: halvings
    logical :: last, jumps

    halvings = 0
    do
      whole = .true.
      if (recorder%interrupted()) then
        call fail(error, exit_interrupt, "interrupted at time "//to_text(time)//"; what was "// &
                  "written before is kept")
        return
      end if
      jump = first_jump(motion%system, time)
      jumps = jump <= goal + slack
      if (.not. jumps) jump = goal
      last = time + 1.000001_wp*h >= jump
      length = h
      if (last) length = jump - time
      jumps = jumps .and. last
      call remember(time, level, motion, before)
      where (motion%system%timed) level = merge(nearest(jump, -1.0_wp), time + length, jumps)
      call check_angles(model, motion%system, level, error)
      if (allocated(error)) return
      whole = .false.
      call take_step(motion, level, length, increment, predicted, outcome, error)
      record%iterations = record%iterations + outcome%last%iteration
      if (allocated(error)) return
      ratio = 0
      if (outcome%status == newton_converged .and. .not. analysis%time_step > 0) then
        ratio = step_error(motion, increment, predicted)/analysis%tolerance
      end if
      if (outcome%status /= newton_converged .or. ratio > 1) then
        call go_back(before, time, level, motion)
        h = length*0.5_wp
        if (ratio > 1) h = length*max(most_shrinking, safety*ratio**(-1.0_wp/3))
        record%cutbacks = record%cutbacks + 1
        if (.not. ratio > 1) halvings = halvings + 1
        if (halvings > most_halvings) then
          whole = .true.
          record%cutbacks = 0
          call fail(error, exit_solve, "no solution found beyond time "//to_text(time)// &
                    " with a step of "//to_text(length)//": "//reason(model, outcome))
          return
        end if
        cycle
      end if
      if (.not. analysis%time_step > 0) halvings = 0
      call enter_step(motion, length, increment, account)
      time = time + length
      if (last) time = jump
      record%size = length
      record%last = outcome%last
      if (.not. analysis%time_step > 0) then
        length = length*min(most_growth, safety*max(ratio, 1.0e-3_wp)**(-1.0_wp/3))
        if (.not. last .or. ratio > safety**3) h = length
        h = max(h, length)
      end if
      if (jumps) then
        where (motion%system%timed) level = time
        call restart_motion(part_of_step*record%size, level, motion, error)
        if (allocated(error)) return
        call reopen_account(motion, account)
        call settle_motion(merge(analysis%time_step, h, analysis%time_step > 0), level, motion, &
                           error)
        if (allocated(error)) return
      end if
      whole = .true.
      if (single .or. time >= goal - slack) return
      if (analysis%time_step > 0) h = goal - time
    end do
  end subroutine reach

  !> When a function of a timed pattern next jumps: the step ends there with the value before the
  !> jump, and the next one starts with the one behind it.
  pure real(wp) function first_jump(system, time) result(jump)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: time
    integer :: i

    jump = huge(jump)
    do i = 1, size(system%load)
      associate (load => system%load(i))
        if (load%function == 0 .or. .not. system%timed(load%pattern)) cycle
        jump = min(jump, next_jump(system%function(load%function), time))
      end associate
    end do
  end function first_jump

  !> Estimate of the error of a step: a part of the difference between the increment and its
  !> prediction with the old acceleration, in lengths of the model and radians.
  pure real(wp) function step_error(motion, increment, predicted)
    type(dynamics_t), intent(in) :: motion
    real(wp), intent(in) :: increment(:), predicted(:)

    step_error = abs(motion%scheme%beta - 1.0_wp/6)/motion%scheme%beta &
                 *maxval(abs(increment - predicted)/motion%scale)
  end function step_error

  subroutine keep(model, motion, account, recorder, record, error)
    type(model_t), intent(in) :: model
    type(dynamics_t), intent(in) :: motion
    type(account_t), intent(in) :: account
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(in) :: record
    type(error_t), allocatable, intent(out) :: error
    type(results_t) :: results

    call motion_results(model, motion, account, results)
    call recorder%step(record, results, error)
  end subroutine keep

end module analysis_transient
