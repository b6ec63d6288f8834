!> KINEMATIC and INVERSE: a motion that INPUTE and INPUTX prescribe, at equal steps of time, and the
!> forces that drive it.
!>
!> A position where the mechanism is singular, a dead point or a change point, determines neither
!> velocities nor, to more than half the digits, the position itself. There the motion is taken
!> from its smooth continuation: the singular stretch is leapt over, and what lies within found
!> between its two banks.
module analysis_kinematic
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_solve, exit_interrupt
  use text, only: to_text
  use model_data, only: model_t, analysis_t, analysis_inverse, analysis_names
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_dynamics, only: inertia_forces
  use system_inertia, only: masses_t, new_masses
  use system_motion, only: target_rates
  use system_names, only: coordinate_name
  use system_rates, only: strain_rates
  use system_results, only: results_t
  use newton_method, only: newton_outcome_t, newton_converged
  use equilibrium_path, only: reason, check_dropped
  use generalized_alpha, only: flow_t
  use driven_motion, only: driven_t, new_driven, release_driven, find_undriven, find_motion, &
                           is_smooth
  use driven_departure, only: depart
  use singular_start, only: departure_t, find_departure
  use singular_refusal, only: refuse_unclear
  use motion_instant, only: instant_t, remember, go_back
  use time_grid, only: time_grid_t, new_time_grid
  use motion_bridge, only: bridge, increment_between
  use energy_account, only: account_t, open_account, enter_step, motion_results
  use recorder, only: recorder_t, step_t
  implicit none
  private

  public :: run_kinematic

  integer, parameter :: most_halvings = 8

  !> A leap first goes as far beyond the time as the near bank lies before it, then farther.
  integer, parameter :: most_leaps = 14
  real(wp), parameter :: leap_growth = 1.5_wp

  !> Held strains are off by less in a position between two others, as part of the length.
  real(wp), parameter :: bridge_tolerance = 1.0e-10_wp

  !> Where the analysis is.
  type :: course_t
    real(wp) :: time = 0.0_wp
    real(wp), allocatable :: level(:)
    type(instant_t) :: near, beyond        !< banks of a stretch that is leapt over
    logical :: bridged = .false.           !< `time` lies between them
    type(step_t) :: record
    type(account_t) :: account
  end type course_t

contains

  !> From `time` to the analysis' end; `flow` is left at the rates there.
  subroutine run_kinematic(model, system, analysis, time, level, iterate, flow, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: time, level(:)
    type(iterate_t), intent(inout) :: iterate
    type(flow_t), allocatable, intent(inout) :: flow
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(masses_t) :: masses
    type(driven_t) :: driven
    type(course_t) :: course

    call new_masses(model, system, masses)
    call new_driven(model, system, masses, iterate, analysis%kind == analysis_inverse, driven, &
                    error)
    course%time = time
    course%level = level
    if (.not. allocated(error)) call take_up(model, analysis, driven, course, recorder, &
                                              error)
    if (.not. allocated(error)) call march(model, analysis, driven, course, recorder, error)
    time = course%time
    level = course%level
    iterate%state = driven%motion%iterate%state
    iterate%stress = driven%motion%iterate%stress
    flow = driven%motion%flow
    call release_driven(driven)
  end subroutine run_kinematic

  !> Every motion must be prescribed or resisted.
  subroutine refuse_undriven(model, analysis, driven, level, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: level(:)
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: list
    integer, allocatable :: free(:)
    integer :: i

    call find_undriven(driven, level, free, error)
    if (allocated(error) .or. size(free) == 0) return
    list = coordinate_name(model, free(1))
    do i = 2, size(free)
      list = list//", "//coordinate_name(model, free(i))
    end do
    call fail(error, exit_deck, trim(analysis_names(analysis%kind))//": the motion of "//list// &
              " is not determined; INPUTE or INPUTX prescribes it")
  end subroutine refuse_undriven

  !> The start, then all stops.
  subroutine march(model, analysis, driven, course, recorder, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(driven_t), intent(inout) :: driven
    type(course_t), intent(inout) :: course
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(instant_t) :: before
    type(time_grid_t) :: grid
    integer :: stop

    call open_account(driven%motion, course%account)
    grid = new_time_grid(analysis, course%time)
    course%record%time = grid%start
    call keep(model, driven, course, recorder, error)
    do stop = 1, grid%stops
      if (allocated(error)) return
      call remember(course%time, course%level, driven%motion, before)
      call reach(model, driven, grid%time(stop), course, recorder, error)
      if (.not. allocated(error)) then
        call check_dropped(model, driven%motion%system, driven%motion%iterate, error)
      end if
      if (allocated(error)) return
      call enter_step(driven%motion, course%time - before%time, &
                      increment_between(before%state, driven%motion%iterate%state), course%account)
      if (.not. grid%is_regular(stop) .and. stop < grid%stops) cycle
      course%record%step = course%record%step + 1
      course%record%time = course%time
      course%record%size = grid%interval
      call keep(model, driven, course, recorder, error)
    end do
  end subroutine march

  !> The position at the start; it may be far from where the model stands, or singular.
  subroutine take_up(model, analysis, driven, course, recorder, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(driven_t), intent(inout) :: driven
    type(course_t), intent(inout) :: course
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(departure_t) :: departure
    logical :: finite

    where (driven%motion%system%timed) course%level = course%time
    call find_departure(model, driven%motion%system, driven%motion%iterate%state, course%level, &
                        departure, error)
    if (allocated(error)) return
    if (departure%singular) then
      call refuse_unclear(model, driven%motion%system, .true., &
                          trim(analysis_names(analysis%kind)), departure, error)
      if (.not. allocated(error)) call depart( &
        driven, departure, course%time, course%level, finite, outcome, error)
      if (.not. (allocated(error) .or. finite)) call recorder%remark( &
        "warning: forces would have to be infinite in the singular position of the start; "// &
        "those recorded for it mean nothing")
    else
      call refuse_undriven(model, analysis, driven, course%level, error)
      if (.not. allocated(error)) call find_motion(driven, course%level, outcome, error)
    end if
    if (allocated(error)) return
    course%record%iterations = outcome%last%iteration
    course%record%last = outcome%last
    if (outcome%status == newton_converged) return
    call fail(error, exit_solve, "the position prescribed for time "//to_text(course%time)// &
              " was not found: "//reason(model, outcome))
  end subroutine take_up

  !> To a time: within a stretch already leapt over, in one step or several, or by a leap.
  subroutine reach(model, driven, goal, course, recorder, error)
    type(model_t), intent(in) :: model
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    logical :: arrived

    course%record%iterations = 0
    course%record%cutbacks = 0
    if (recorder%interrupted()) then
      call fail(error, exit_interrupt, "interrupted at time "//to_text(course%time)// &
                "; what was written before is kept")
      return
    end if
    if (course%bridged .and. goal > course%beyond%time) then
      call go_back(course%beyond, course%time, course%level, driven%motion)
      course%bridged = .false.
    end if
    arrived = course%bridged
    if (.not. arrived) call approach(driven, goal, course, outcome, arrived, error)
    if (arrived .and. .not. course%bridged .or. allocated(error)) return
    if (.not. arrived) call leap(driven, goal, course, error)
    if (allocated(error)) return
    if (course%bridged) then
      call stand_between(driven, goal, course, arrived)
      if (arrived) return
    end if
    call insist(model, driven, goal, course, error)
  end subroutine reach

  !> Step towards the goal, half as far after each failure, until it is reached or given up.
  subroutine approach(driven, goal, course, outcome, arrived, error)
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    type(newton_outcome_t), intent(out) :: outcome
    logical, intent(out) :: arrived
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: length
    logical :: good

    length = goal - course%time
    do while (course%record%cutbacks <= most_halvings)
      arrived = course%time + 1.000001_wp*length >= goal
      if (arrived) length = goal - course%time
      call try(driven, merge(goal, course%time + length, arrived), course, outcome, good, error)
      if (allocated(error) .or. good .and. arrived) return
      if (good) cycle
      course%record%cutbacks = course%record%cutbacks + 1
      length = 0.5_wp*length
    end do
    arrived = .false.
  end subroutine approach

  !> Go to a time in one step, or stay where the position found is poor or not the continuation:
  !> velocities break off where those prescribed do not.
  subroutine try(driven, goal, course, outcome, good, error)
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    type(newton_outcome_t), intent(out) :: outcome
    logical, intent(out) :: good
    type(error_t), allocatable, intent(out) :: error
    type(instant_t) :: before

    call remember(course%time, course%level, driven%motion, before)
    call step_to(driven, goal, course, outcome, error)
    if (allocated(error)) return
    good = outcome%status == newton_converged
    if (good) good = .not. driven%poor .and. continues(driven, before, course)
    if (.not. good) call go_back(before, course%time, course%level, driven%motion)
  end subroutine try

  !> Predict, then find the motion at a time.
  subroutine step_to(driven, goal, course, outcome, error)
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: h

    h = goal - course%time
    associate (flow => driven%motion%flow)
      call driven%motion%iterate%state%move(h*flow%velocity + 0.5_wp*h**2*flow%acceleration)
    end associate
    where (driven%motion%system%timed) course%level = goal
    call find_motion(driven, course%level, outcome, error)
    course%time = goal
    course%record%iterations = course%record%iterations + outcome%last%iteration
    course%record%last = outcome%last
  end subroutine step_to

  !> Whether the velocities are the continuation of those before.
  pure logical function continues(driven, before, course)
    type(driven_t), intent(in) :: driven
    type(instant_t), intent(in) :: before
    type(course_t), intent(in) :: course
    real(wp), dimension(size(driven%strain_scale)) :: v, a, v_next, a_next
    real(wp) :: h

    h = course%time - before%time
    associate (motion => driven%motion)
      call target_rates(motion%system, before%level, v, a)
      call target_rates(motion%system, course%level, v_next, a_next)
      continues = .true.
      if (.not. is_smooth(h, v, a, v_next, a_next, driven%strain_scale)) return
      continues = is_smooth(h, before%flow%velocity, before%flow%acceleration, &
                            motion%flow%velocity, motion%flow%acceleration, motion%scale)
    end associate
  end function continues

  !> From the present time over the goal to a good position behind it; there `course%bridged`.
  subroutine leap(driven, goal, course, error)
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    real(wp) :: length
    integer :: attempt
    logical :: good

    call remember(course%time, course%level, driven%motion, course%near)
    length = goal - course%time
    do attempt = 1, most_leaps
      call try(driven, goal + length, course, outcome, good, error)
      if (allocated(error)) return
      if (good) exit
      length = leap_growth*length
    end do
    course%bridged = good
    if (good) call remember(course%time, course%level, driven%motion, course%beyond)
  end subroutine leap

  !> To a time between the banks. `found` is false if held strains are off there: then the motion
  !> does not lead over.
  subroutine stand_between(driven, goal, course, found)
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    logical, intent(out) :: found

    associate (motion => driven%motion)
      call bridge(course%near, course%beyond, goal, motion)
      course%time = goal
      where (motion%system%timed) course%level = goal
      if (driven%inertia) then
        motion%iterate%velocity = motion%flow%velocity
        call inertia_forces(motion%masses, motion%iterate%state, motion%flow%velocity, &
                            motion%flow%acceleration + motion%mass_damping*motion%flow%velocity, &
                            motion%iterate%inertial)
      end if
      call assemble(motion%system, course%level, motion%iterate)
      associate (now => motion%iterate)
        course%record%last%constraint = maxval(merge(abs(now%strain - now%target), 0.0_wp, &
                                                     motion%system%multiplier > 0)) &
                                        /motion%system%length
      end associate
      found = course%record%last%constraint <= bridge_tolerance .and. motion%iterate%invalid == 0
      if (found) return
      call go_back(course%near, course%time, course%level, motion)
      course%bridged = .false.
    end associate
  end subroutine stand_between

  !> Last resort: a poor position is better than none.
  subroutine insist(model, driven, goal, course, error)
    type(model_t), intent(in) :: model
    type(driven_t), intent(inout) :: driven
    real(wp), intent(in) :: goal
    type(course_t), intent(inout) :: course
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(instant_t) :: before
    character(len=:), allocatable :: words

    call remember(course%time, course%level, driven%motion, before)
    call step_to(driven, goal, course, outcome, error)
    if (allocated(error)) return
    words = reason(model, outcome)
    if (outcome%status == newton_converged) then
      driven%sensitivity = huge(driven%sensitivity)  ! what counts as poor from here on
      if (continues(driven, before, course) .and. &
          size(driven%motion%solver%null_pivots()) <= driven%nulls) return
      words = "the mechanism is in a singular position, or jumps"
    end if
    call fail(error, exit_solve, "no position found beyond time "//to_text(before%time)//": "// &
              words)
    call go_back(before, course%time, course%level, driven%motion)
  end subroutine insist

  !> Forces of KINEMATIC are without inertia: the balance of energies lacks the kinetic one.
  subroutine keep(model, driven, course, recorder, error)
    type(model_t), intent(in) :: model
    type(driven_t), intent(inout) :: driven
    type(course_t), intent(in) :: course
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(results_t) :: results

    associate (motion => driven%motion)
      call strain_rates(motion%system, motion%iterate, motion%flow%velocity, motion%iterate%rate)
      call motion_results(model, motion, course%account, results)
    end associate
    call recorder%step(course%record, results, error)
  end subroutine keep

end module analysis_kinematic
