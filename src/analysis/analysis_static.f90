!> STATIC with CONTROL LOAD or DISPLACEMENT: equilibrium at equal steps of the load factor or of a
!> displacement.
!>
!> Between two recorded steps the increment is halved where Newton fails and doubled where it was
!> easy.
module analysis_static
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve, exit_interrupt
  use text, only: to_text
  use model_data, only: model_t, analysis_t, control_load, control_displacement, stability_off
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_results, only: results_t, get_results
  use newton_method, only: newton_outcome_t, find_equilibrium, newton_converged, newton_interrupted
  use equilibrium_path, only: safe_t, keep_safe, go_back, newton_options, check_dropped, &
                              check_angles, failure, reason, parameter_name
  use path_control, only: control_t
  use stability_watch, only: watch_t, start_watch, watch_step, warn_of_unstable
  use system_measure, only: new_measure
  use analysis_compliance, only: add_compliance
  use recorder, only: recorder_t, step_t, iteration_t
  implicit none
  private

  public :: run_static

  integer, parameter :: finest = 2**10      !< parts a step is cut into before it is given up
  integer, parameter :: easy = 6            !< iterations up to which an increment was easy

contains

  !> Take the analysis' load factor, or the displacement it controls, from where it stands to its
  !> end in equal steps; `level` holds the factors of all patterns and is left at what was reached.
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
    type(control_t) :: control
    type(step_t) :: record
    type(watch_t) :: watch
    real(wp) :: start, end
    integer :: step

    call start_watch(system, solver, analysis%stability, level, iterate, watch, error)
    if (allocated(error)) return
    control = new_control(model, analysis)
    start = parameter_value(control, level, iterate)
    end = analysis%factor
    if (control%kind == control_displacement) end = analysis%controlled%value
    do step = 1, analysis%steps
      record = step_t(step=step)
      call reach(model, system, solver, analysis, control, &
                 start + (end - start)*step/analysis%steps, watch, level, iterate, recorder, &
                 record, error)
      if (.not. allocated(error)) call check_angles(model, system, level, error)
      if (.not. allocated(error)) call check_dropped(model, system, iterate, error)
      if (.not. allocated(error)) call add_compliance(model, system, solver, analysis, level, &
                                                      iterate, record, error)
      if (allocated(error)) return
      if (analysis%pattern > 0) record%factor = level(analysis%pattern)
      record%unstable = watch%unstable
      call get_results(model, system, iterate, results)
      call recorder%step(record, results, error)
      if (allocated(error)) return
    end do
    if (analysis%stability == stability_off) call warn_of_unstable(system, solver, iterate, &
                                                                   recorder, error)
  end subroutine run_static

  pure function new_control(model, analysis) result(control)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(control_t) :: control

    control%kind = analysis%control
    control%pattern = analysis%pattern
    if (control%kind == control_displacement) then
      control%measure = new_measure(model, analysis%controlled)
    end if
  end function new_control

  !> What the steps count: the load factor or the controlled displacement.
  pure function parameter_value(control, level, iterate) result(value)
    type(control_t), intent(in) :: control
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(in) :: iterate
    real(wp) :: value

    value = 0
    if (control%kind == control_displacement) then
      value = control%measure%value(iterate%state)
    else if (control%pattern > 0) then
      value = level(control%pattern)
    end if
  end function parameter_value

  !> Go to a value of the parameter, in one increment or several.
  subroutine reach(model, system, solver, analysis, control, goal, watch, level, iterate, &
                   recorder, record, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    type(control_t), intent(inout) :: control
    real(wp), intent(in) :: goal
    type(watch_t), intent(inout) :: watch
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(safe_t) :: safe
    real(wp) :: whole
    integer :: left, share

    whole = goal - parameter_value(control, level, iterate)
    left = finest
    share = finest
    do while (left > 0)
      call keep_safe(iterate, level, safe)
      control%target = goal - whole*(left - share)/finest
      if (control%kind == control_load .and. control%pattern > 0) then
        level(control%pattern) = control%target
      end if
      call check_angles(model, system, level, error)
      if (allocated(error)) return
      call find_equilibrium(system, solver, newton_options(analysis), control, level, &
                            iteration_t(step=record%step, factor=control%target), iterate, &
                            recorder, outcome, error)
      record%iterations = record%iterations + outcome%last%iteration
      if (allocated(error)) return
      if (outcome%status == newton_converged) then
        call watch_step(system, solver, newton_options(analysis), control, safe, record%step, &
                        watch, level, iterate, recorder, error)
        if (allocated(error)) return
        left = left - share
        if (outcome%last%iteration <= easy) share = 2*share
        share = min(share, left)
        cycle
      end if
      call go_back(safe, iterate, level)
      call give_way(model, system, analysis, goal - whole*left/finest, whole/finest, record, &
                    outcome, recorder, share, error)
      if (allocated(error)) return
    end do
    record%last = outcome%last
  end subroutine reach

  !> After a failure: half the increment, or the end.
  subroutine give_way(model, system, analysis, reached, unit, record, outcome, recorder, share, &
                      error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: reached, unit
    type(step_t), intent(inout) :: record
    type(newton_outcome_t), intent(in) :: outcome
    class(recorder_t), intent(inout) :: recorder
    integer, intent(inout) :: share
    type(error_t), allocatable, intent(out) :: error

    if (outcome%status == newton_interrupted) then
      call fail(error, exit_interrupt, "interrupted in step "//to_text(record%step)//" of "// &
                to_text(analysis%steps)//"; steps that converged before are kept")
    else if (share == 1 .or. analysis%pattern == 0) then
      call fail(error, exit_solve, failure(model, system, analysis, reached, record, outcome))
    else
      record%cutbacks = record%cutbacks + 1
      share = share/2
      call recorder%remark("step "//to_text(record%step)//": increment halved to "// &
                           to_text(share*unit)//" at "//parameter_name(analysis)//" "// &
                           to_text(reached)//", "//reason(model, outcome))
    end if
  end subroutine give_way

end module analysis_static
