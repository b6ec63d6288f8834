!> STATIC with CONTROL LOAD: equilibrium at equal steps of the load factor.
!>
!> Between two recorded steps the increment of the factor is halved where Newton fails and doubled
!> where it was easy.
module analysis_static
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve, exit_interrupt
  use text, only: to_text, plural
  use model_data, only: model_t, analysis_t
  use nodal_state, only: state_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_names, only: coordinate_name, strain_name, member_name
  use system_results, only: results_t, get_results
  use newton_method, only: newton_t, newton_outcome_t, find_equilibrium, newton_converged, &
                           newton_slow, newton_distorted, newton_interrupted
  use recorder, only: recorder_t, step_t, iteration_t
  implicit none
  private

  public :: run_static

  integer, parameter :: most_halvings = 10  !< of a step before it is given up
  integer, parameter :: easy = 6            !< iterations up to which an increment was easy

  !> A state to come back to.
  type :: safe_t
    type(state_t) :: state
    real(wp), allocatable :: stress(:)
    real(wp) :: factor = 0.0_wp
  end type safe_t

contains

  !> Ramp the analysis' pattern from where its factor stands; `level` holds the factors of all
  !> patterns and is left at what was reached.
  subroutine run_static(model, system, solver, analysis, level, iterate, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(results_t) :: results
    type(step_t) :: record
    real(wp) :: start
    integer :: step

    start = 0
    if (analysis%pattern > 0) start = level(analysis%pattern)
    do step = 1, analysis%steps
      record = step_t(step=step)
      record%factor = start + (analysis%factor - start)*step/analysis%steps
      call reach(model, system, solver, analysis, level, iterate, recorder, record, error)
      if (.not. allocated(error)) call check_dropped(model, system, iterate, error)
      if (allocated(error)) return
      call get_results(model, system, iterate, results)
      call recorder%step(record, results, error)
      if (allocated(error)) return
    end do
  end subroutine run_static

  !> Go to the factor of a record, in one increment or several.
  subroutine reach(model, system, solver, analysis, level, iterate, recorder, record, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(safe_t) :: safe
    real(wp) :: whole, share
    integer :: left

    allocate (safe%stress(size(iterate%stress)))
    safe%factor = record%factor
    if (analysis%pattern > 0) safe%factor = level(analysis%pattern)
    whole = record%factor - safe%factor
    left = 2**most_halvings  ! of the whole step, in its smallest parts
    share = 1
    do while (left > 0)
      safe%state = iterate%state
      safe%stress = iterate%stress
      associate (target => record%factor - whole*(left - nint(share*2**most_halvings))/2**most_halvings)
        if (analysis%pattern > 0) level(analysis%pattern) = target
        call find_equilibrium(system, solver, newton_options(analysis), level, &
                              iteration_t(step=record%step, factor=target), iterate, recorder, &
                              outcome, error)
      end associate
      record%iterations = record%iterations + outcome%last%iteration
      if (allocated(error)) return
      if (outcome%status == newton_converged) then
        left = left - nint(share*2**most_halvings)
        if (outcome%last%iteration <= easy) share = 2*share
        share = min(share, real(left, wp)/2**most_halvings)
        cycle
      end if
      call give_way(model, system, analysis, level, iterate, safe, left, whole, record, outcome, &
                    recorder, share, error)
      if (allocated(error)) return
    end do
    record%last = outcome%last
  end subroutine reach

  !> After a failure: back to the safe state with half the increment, or the end.
  subroutine give_way(model, system, analysis, level, iterate, safe, left, whole, record, outcome, &
                      recorder, share, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    type(safe_t), intent(in) :: safe
    integer, intent(in) :: left
    real(wp), intent(in) :: whole
    type(step_t), intent(inout) :: record
    type(newton_outcome_t), intent(in) :: outcome
    class(recorder_t), intent(inout) :: recorder
    real(wp), intent(inout) :: share
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: reached

    iterate%state = safe%state
    iterate%stress = safe%stress
    reached = record%factor - whole*left/2**most_halvings
    if (analysis%pattern > 0) level(analysis%pattern) = reached
    if (outcome%status == newton_interrupted) then
      call fail(error, exit_interrupt, "interrupted in step "//to_text(record%step)//" of "// &
                to_text(analysis%steps)//"; the converged steps are kept")
    else if (share*2**most_halvings < 1.5_wp .or. analysis%pattern == 0) then
      call fail(error, exit_solve, failure(model, system, analysis, reached, record, outcome))
    else
      record%cutbacks = record%cutbacks + 1
      share = share/2
      call recorder%remark("step "//to_text(record%step)//": increment of the load factor halved to "// &
                           to_text(share*whole)//" at "//to_text(reached)//", "// &
                           reason(model, outcome))
    end if
  end subroutine give_way

  !> What went wrong, in one sentence: step, iteration, residual and where it is worst.
  function failure(model, system, analysis, reached, record, outcome) result(message)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: reached
    type(step_t), intent(in) :: record
    type(newton_outcome_t), intent(in) :: outcome
    character(len=:), allocatable :: message

    message = "no equilibrium found in step "//to_text(record%step)//" of "// &
              to_text(analysis%steps)//" beyond load factor "//to_text(reached)//" ("// &
              plural(record%cutbacks, "cut-back")//"): "//reason(model, outcome)
    if (outcome%worst > 0) message = message//"; iteration "//to_text(outcome%last%iteration)// &
      ": largest unbalanced force "//to_text(outcome%last%residual, 3)//" of the loads at "// &
      coordinate_name(model, outcome%worst)
    if (outcome%last%constraint > 1.0e-9_wp) message = message//", a fixed strain is off by "// &
      to_text(outcome%last%constraint*system%length, 3)
  end function failure

  function reason(model, outcome) result(words)
    type(model_t), intent(in) :: model
    type(newton_outcome_t), intent(in) :: outcome
    character(len=:), allocatable :: words

    select case (outcome%status)
    case (newton_slow)
      words = "not converged after "//plural(outcome%last%iteration, "iteration")
    case (newton_distorted)
      words = member_name(model, outcome%element)//" turns too far within itself: divide it"
    case default
      words = "the iteration diverged"
    end select
  end function reason

  pure function newton_options(analysis) result(options)
    type(analysis_t), intent(in) :: analysis
    type(newton_t) :: options

    if (analysis%tolerance > 0) options%tolerance = analysis%tolerance
    if (analysis%iterations > 0) options%iterations = analysis%iterations
  end function newton_options

  !> A fixed strain that was left out because others imply it must have stayed zero.
  subroutine check_dropped(model, system, iterate, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(error_t), allocatable, intent(out) :: error
    integer :: k

    do k = 1, size(system%dropped)
      if (.not. system%dropped(k)) cycle
      if (abs(iterate%strain(k)) <= 1.0e-8_wp*system%length) cycle
      call fail(error, exit_solve, "the constraints contradict each other: "// &
                strain_name(model, system, k)//", redundant at the start, is off by "// &
                to_text(iterate%strain(k), 3))
      return
    end do
  end subroutine check_dropped

end module analysis_static
