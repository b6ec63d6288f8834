!> STATIC with CONTROL ARC: follow the equilibrium path by its arc length (see `path_control`).
!>
!> The first increment is one of the load factor; its arc is the first arc length. Then the length
!> follows the iteration count, and a step that fails or turns back is repeated with half of it.
module analysis_arc
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve, exit_interrupt
  use text, only: to_text
  use model_data, only: model_t, analysis_t, control_load, control_displacement, control_arc
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_results, only: results_t, get_results
  use system_measure, only: measure_t, new_measure
  use newton_method, only: newton_outcome_t, find_equilibrium, newton_converged, newton_interrupted
  use path_control, only: control_t, arc_product
  use stability_watch, only: watch_t, start_watch, watch_step
  use branch_switch, only: lean_into_mode
  use equilibrium_path, only: safe_t, keep_safe, go_back, newton_options, check_dropped, &
                              check_angles, failure
  use analysis_compliance, only: add_compliance
  use recorder, only: recorder_t, step_t, iteration_t
  implicit none
  private

  public :: run_arc

  real(wp), parameter :: aim = 4.5_wp                !< iterations a step should take
  real(wp), parameter :: most_growth = 2.0_wp        !< of the arc length from step to step
  real(wp), parameter :: shortest = 1.0e-6_wp        !< of the first arc, before giving up
  real(wp), parameter :: longest = 0.15_wp           !< arc of one step: mean motion
  real(wp), parameter :: branch_arc = 0.05_wp        !< at least, of the first step on a branch
  real(wp), parameter :: sharpest = 0.5_wp           !< cosine of the angle between two steps

  !> Where the path is and how it goes on.
  type :: path_t
    type(control_t) :: control
    type(watch_t) :: watch
    type(measure_t) :: stop
    real(wp) :: first_arc = 0.0_wp
    real(wp) :: goal = 0.0_wp          !< load factor at the end
    real(wp) :: first_rise = 0.0_wp    !< first increment of the factor
    logical :: ended = .false.
  end type path_t

contains

  !> Follow the path to the factor TO, the displacement STOP or MAXSTEPS, recording every point.
  subroutine run_arc(model, system, solver, analysis, level, iterate, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(path_t) :: path
    type(results_t) :: results
    type(step_t) :: record
    integer :: step

    call start_path(model, system, analysis, level, path)
    call start_watch(system, solver, analysis%stability, level, iterate, path%watch, error)
    if (allocated(error)) return
    path%watch%branch = analysis%branch
    do step = 1, analysis%most_steps
      record = step_t(step=step)
      call take_step(model, system, solver, analysis, path, level, iterate, recorder, record, error)
      if (.not. allocated(error)) call check_angles(model, system, level, error)
      if (.not. allocated(error)) call check_dropped(model, system, iterate, error)
      if (.not. allocated(error)) call add_compliance(model, system, solver, analysis, level, &
                                                      iterate, record, error)
      if (allocated(error)) return
      record%factor = level(analysis%pattern)
      record%unstable = path%watch%unstable
      call get_results(model, system, iterate, results)
      call recorder%step(record, results, error)
      if (allocated(error) .or. path%ended) return
    end do
    call recorder%remark("ended by MAXSTEPS at load factor "//to_text(level(analysis%pattern)))
  end subroutine run_arc

  pure subroutine start_path(model, system, analysis, level, path)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(path_t), intent(out) :: path

    path%control%kind = control_load
    path%control%pattern = analysis%pattern
    allocate (path%control%total(system%coordinates), path%control%heading(system%coordinates))
    path%control%total = 0
    path%control%heading = 0
    path%goal = analysis%factor
    path%first_rise = (path%goal - level(analysis%pattern))/20
    if (analysis%first_increment > 0) then
      path%first_rise = sign(analysis%first_increment, path%first_rise)
    end if
    if (analysis%stops) path%stop = new_measure(model, analysis%stop)
  end subroutine start_path

  !> One converged point further, however often the length must be cut.
  subroutine take_step(model, system, solver, analysis, path, level, iterate, recorder, record, &
                       error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    type(path_t), intent(inout) :: path
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(safe_t) :: safe

    call keep_safe(iterate, level, safe)
    do
      path%control%total = 0
      if (path%watch%at_branch) then
        call lean_into_mode(system, path%watch%point, path%control%arc, level, iterate, &
                            path%control)
      else if (path%control%kind == control_load) then
        level(analysis%pattern) = safe%level(analysis%pattern) + path%first_rise
      end if
      call find_equilibrium(system, solver, newton_options(analysis), path%control, level, &
                            iteration_t(step=record%step, factor=level(analysis%pattern)), &
                            iterate, recorder, outcome, error)
      if (allocated(error)) return
      record%iterations = record%iterations + outcome%last%iteration
      record%last = outcome%last
      if (outcome%status == newton_converged) then
        if (is_forward(system, path)) exit
      end if
      call go_back(safe, iterate, level)
      if (outcome%status == newton_interrupted) then
        call fail(error, exit_interrupt, "interrupted in step "//to_text(record%step)// &
                  "; steps that converged before are kept")
        return
      end if
      call shorten(model, system, analysis, path, level, outcome, recorder, record, error)
      if (allocated(error)) return
    end do
    record%arc = sqrt(arc_product(system, path%control%total, path%control%total))
    path%control%target = level(analysis%pattern)
    call end_exactly(system, solver, analysis, path, safe, level, iterate, recorder, record, error)
    if (allocated(error)) return
    call watch_step(system, solver, newton_options(analysis), path%control, safe, record%step, &
                    path%watch, level, iterate, recorder, error)
    if (.not. path%ended) call lengthen(system, path, outcome%last%iteration)
    if (path%watch%at_branch) path%control%arc = max(path%control%arc, branch_arc)
  end subroutine take_step

  !> Whether a step goes on about where the one before led; one that turns sharply has jumped to
  !> another branch or runs back.
  pure logical function is_forward(system, path)
    type(system_t), intent(in) :: system
    type(path_t), intent(in) :: path

    is_forward = .true.
    if (path%control%kind /= control_arc) return
    associate (a => path%control%heading, b => path%control%total)
      is_forward = arc_product(system, a, b) >= &
                   sharpest*sqrt(arc_product(system, a, a)*arc_product(system, b, b))
    end associate
  end function is_forward

  !> The next arc from the iterations of this one; the first one is measured.
  subroutine lengthen(system, path, iterations)
    type(system_t), intent(in) :: system
    type(path_t), intent(inout) :: path
    integer, intent(in) :: iterations
    real(wp) :: arc

    arc = sqrt(arc_product(system, path%control%total, path%control%total))
    if (path%control%kind == control_load) path%first_arc = arc
    arc = arc*min(most_growth, max(1/most_growth, sqrt(aim/iterations)))
    path%control%kind = control_arc
    path%control%arc = min(arc, longest)
    path%control%heading = path%control%total
  end subroutine lengthen

  !> Half the length after a failure, or the end.
  subroutine shorten(model, system, analysis, path, level, outcome, recorder, record, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    type(path_t), intent(inout) :: path
    real(wp), intent(in) :: level(:)
    type(newton_outcome_t), intent(in) :: outcome
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error

    record%cutbacks = record%cutbacks + 1
    if (path%control%kind == control_load) then
      path%first_rise = path%first_rise/2
    else
      path%control%arc = path%control%arc/2
    end if
    if (record%cutbacks > 20 .or. (path%control%kind == control_arc .and. &
                                   path%control%arc < shortest*path%first_arc)) then
      call fail(error, exit_solve, failure(model, system, analysis, level(analysis%pattern), &
                                           record, outcome))
    else
      call recorder%remark("step "//to_text(record%step)//": arc halved at load factor "// &
                           to_text(level(analysis%pattern)))
    end if
  end subroutine shorten

  !> A step beyond TO or STOP is corrected to end there exactly.
  subroutine end_exactly(system, solver, analysis, path, safe, level, iterate, recorder, record, &
                         error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    type(path_t), intent(inout) :: path
    type(safe_t), intent(in) :: safe
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(control_t) :: control
    type(safe_t) :: beyond
    real(wp) :: before, now

    control%pattern = analysis%pattern
    before = safe%level(analysis%pattern) - path%goal
    now = level(analysis%pattern) - path%goal
    path%ended = now*before <= 0 .and. abs(before) > 0
    if (path%ended) control%kind = control_load
    if (analysis%stops) then
      before = path%stop%value(safe%state) - analysis%stop%value
      now = path%stop%value(iterate%state) - analysis%stop%value
      if (now*before <= 0 .and. abs(before) > 0) then
        path%ended = .true.
        control%kind = control_displacement
        control%measure = path%stop
        control%target = analysis%stop%value
      end if
    end if
    if (.not. path%ended) return
    call keep_safe(iterate, level, beyond)
    if (control%kind == control_load) level(analysis%pattern) = path%goal
    call find_equilibrium(system, solver, newton_options(analysis), control, level, &
                          iteration_t(step=record%step, factor=level(analysis%pattern)), iterate, &
                          recorder, outcome, error)
    if (allocated(error)) return
    record%iterations = record%iterations + outcome%last%iteration
    record%last = outcome%last
    if (outcome%status == newton_converged) return
    call go_back(beyond, iterate, level)
    call recorder%remark("step "//to_text(record%step)//" ends beyond the value asked for")
  end subroutine end_exactly

end module analysis_arc
