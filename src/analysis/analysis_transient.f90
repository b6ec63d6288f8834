!> TRANSIENT: motion in time from the present state, with generalized-alpha steps that are fixed or
!> chosen by an estimate of their error.
module analysis_transient
  use kinds, only: wp
  use errors, only: error_t
  use model_data, only: model_t, analysis_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_inertia, only: masses_t, new_masses
  use system_results, only: results_t
  use equilibrium_path, only: check_dropped
  use generalized_alpha, only: new_scheme, flow_t
  use dynamic_equilibrium, only: new_dynamics, release_dynamics
  use dynamic_start, only: start_motion, settle_motion
  use motion_steps, only: passage_t, first_step, reach
  use energy_account, only: open_account, motion_results
  use time_grid, only: time_grid_t, new_time_grid
  use restart_point, only: point_t
  use motion_restart, only: make_point, take_up
  use recorder, only: recorder_t
  implicit none
  private

  public :: run_transient

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
    type(passage_t) :: passage
    type(time_grid_t) :: grid

    passage%time = time
    passage%level = level
    call prepare(model, system, analysis, iterate, recorder, passage, error)
    if (allocated(error)) then
    else if (present(point)) then
      grid = new_time_grid(analysis, point%start)
      call take_up(point, model, passage, error)
    else
      grid = new_time_grid(analysis, time)
      call start(model, analysis, flow, passage, recorder, error)
    end if
    if (.not. allocated(error)) then
      call march(model, analysis, grid, passage, recorder, error)
      time = passage%time
      level = passage%level
      iterate%state = passage%motion%iterate%state
      iterate%stress = passage%motion%iterate%stress
      flow = passage%motion%flow
    end if
    call release_dynamics(passage%motion)
  end subroutine run_transient

  !> The system with masses and the scheme of the analysis.
  subroutine prepare(model, system, analysis, iterate, recorder, passage, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    type(iterate_t), intent(in) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(passage_t), intent(inout) :: passage
    type(error_t), allocatable, intent(out) :: error
    type(masses_t) :: masses

    call new_masses(model, system, masses)
    call new_dynamics(system, masses, iterate, new_scheme(analysis%spectral_radius), &
                      model%rayleigh(1), passage%motion, error)
    if (analysis%iterations > 0) passage%motion%iterations = analysis%iterations
    passage%motion%stabilised = analysis%stabilised .and. system%multipliers > 0
    if (system%multipliers > 0 .and. analysis%spectral_radius >= 1 .and. &
        .not. analysis%stabilised) then
      call recorder%remark("warning: RHOINF 1 with held strains and STABILISED OFF: their "// &
                           "forces may grow, as nothing damps errors; STABILISED ON does")
    end if
  end subroutine prepare

  !> Begin, or go on with the rates of an earlier motion, and record that.
  subroutine start(model, analysis, flow, passage, recorder, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(flow_t), allocatable, intent(in) :: flow
    type(passage_t), intent(inout) :: passage
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error

    passage%step = first_step(analysis, passage%time)
    where (passage%motion%system%timed) passage%level = passage%time
    if (allocated(flow)) passage%motion%flow = flow
    call start_motion(model, passage%step, .not. allocated(flow), passage%level, passage%motion, &
                      error)
    if (allocated(error)) return
    call open_account(passage%motion, passage%account)
    passage%record%time = passage%time
    call keep(model, passage, recorder, error)
    if (.not. allocated(error)) then
      call settle_motion(passage%step, passage%level, passage%motion, error)
    end if
  end subroutine start

  !> Step until the end, recording; adaptive steps are recorded one by one unless EVERY is given.
  subroutine march(model, analysis, grid, passage, recorder, error)
    type(model_t), intent(in) :: model
    type(analysis_t), intent(in) :: analysis
    type(time_grid_t), intent(in) :: grid
    type(passage_t), intent(inout) :: passage
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(error_t), allocatable :: second
    integer :: stop
    logical :: single

    single = .not. max(analysis%time_step, analysis%every) > 0
    stop = grid%next(passage%time)
    passage%whole = .true.
    do while (stop <= grid%stops)
      if (analysis%time_step > 0) passage%step = grid%time(stop) - passage%time
      call reach(model, analysis, grid%time(stop), grid%slack(), single, passage, recorder, error)
      if (allocated(error)) exit
      associate (motion => passage%motion, record => passage%record)
        call check_dropped(model, motion%system, motion%iterate, error)
        if (allocated(error)) return
        if (grid%is_regular(stop) .or. stop == grid%stops) then
          record%step = record%step + 1
          record%time = passage%time
          call keep(model, passage, recorder, error)
          if (allocated(error)) return
        end if
        record%iterations = 0
        record%cutbacks = 0
      end associate
      if (recorder%wants_point()) call leave_point(model, grid, passage, recorder, error)
      if (allocated(error)) return
      stop = grid%next(passage%time)
    end do
    if (passage%whole) call leave_point(model, grid, passage, recorder, second)
    if (allocated(second) .and. .not. allocated(error)) call move_alloc(second, error)
  end subroutine march

  !> Hand over where the motion stands.
  subroutine leave_point(model, grid, passage, recorder, error)
    type(model_t), intent(in) :: model
    type(time_grid_t), intent(in) :: grid
    type(passage_t), intent(in) :: passage
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(point_t) :: point

    point%start = grid%start
    point%states = passage%record%step + 1
    point%regular = point%states
    if (.not. (passage%time < grid%end .or. grid%is_regular(grid%stops))) then
      point%regular = passage%record%step
    end if
    call make_point(model, passage, point)
    call recorder%keep_point(point, error)
  end subroutine leave_point

  subroutine keep(model, passage, recorder, error)
    type(model_t), intent(in) :: model
    type(passage_t), intent(in) :: passage
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(results_t) :: results

    call motion_results(model, passage%motion, passage%account, results)
    call recorder%step(passage%record, results, error)
  end subroutine keep

end module analysis_transient
