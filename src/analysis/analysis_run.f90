!> Run the analyses of a model, in their order.
module analysis_run
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_io
  use text, only: to_text
  use model_data, only: model_t, analysis_t, control_arc, analysis_static, analysis_buckling, &
                        analysis_eigen, analysis_transient, analysis_names
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_assembly, only: iterate_t, new_iterate
  use nodal_state, only: state_t, new_state, node_coordinates
  use model_soundness, only: warn_of_redundant, refuse_free_motion, needs_structure
  use analysis_static, only: run_static
  use analysis_arc, only: run_arc
  use mode_results, only: modes_t
  use geometric_imperfection, only: add_imperfections
  use analysis_buckling, only: run_buckling
  use analysis_eigen, only: run_eigen
  use analysis_transient, only: run_transient
  use generalized_alpha, only: flow_t
  use recorder, only: recorder_t
  implicit none
  private

  public :: run_analyses

  !> What an analysis leaves to the next besides the state.
  type :: course_t
    type(modes_t) :: modes               !< of the last BUCKLING
    real(wp) :: time = 0.0_wp
    type(flow_t), allocatable :: flow    !< rates of a motion, which the next one takes up
  end type course_t

contains

  !> Build the system, check that it can stand, run all analyses.
  subroutine run_analyses(model, recorder, error)
    type(model_t), intent(in) :: model
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(system_t) :: system
    type(solver_t) :: solver
    type(iterate_t) :: iterate

    call set_up(model, system, solver, iterate, recorder, error)
    if (.not. allocated(error)) call run_in_order(model, system, solver, iterate, recorder, error)
    call solver%free()
    call system%free()
  end subroutine run_analyses

  !> The system of a model, ready for its first analysis.
  subroutine set_up(model, system, solver, iterate, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(out) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(out) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(state_t) :: state

    call check_memory(size(model%member), error)
    if (allocated(error)) return
    call build_system(model, system)
    call new_state(system%nodes, system%coordinates - node_coordinates*system%nodes, &
                   system%angles, state)
    call warn_of_redundant(model, system, state, recorder, error)
    if (allocated(error)) return
    call find_system_pattern(system)
    call new_iterate(system, iterate)
    iterate%state = state
    call solver%prepare(system%equations(), system%pattern%row, system%pattern%column, &
                        system%pattern%symmetric, error)
    if (allocated(error) .or. .not. needs_structure(model)) return
    call refuse_free_motion(model, system, solver, iterate, error)
    if (any(model%analysis%kind /= analysis_static)) return
    deallocate (system%pattern%row, system%pattern%column)  ! the solver has its own
  end subroutine set_up

  subroutine run_in_order(model, system, solver, iterate, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(error_t), allocatable :: second
    type(model_t) :: shaped
    type(course_t) :: course
    real(wp) :: level(size(model%pattern))
    integer :: i

    level = 0
    if (size(model%imperfection) > 0) shaped = model
    do i = 1, size(model%analysis)
      if (any(model%imperfection%analysis == i)) then
        call add_imperfections(i, course%modes, shaped, error)
        if (allocated(error)) return
        call solver%free()
        call system%free()
        call set_up(shaped, system, solver, iterate, recorder, error)
        if (allocated(error)) return
        level = 0
      end if
      call recorder%begin(i, model%analysis(i), error)
      if (allocated(error)) return
      if (size(model%imperfection) > 0) then
        call run_one(shaped, system, solver, model%analysis(i), level, iterate, recorder, course, &
                     error)
      else
        call run_one(model, system, solver, model%analysis(i), level, iterate, recorder, course, &
                     error)
      end if
      call recorder%finish(.not. allocated(error), second)
      if (.not. allocated(error) .and. allocated(second)) call move_alloc(second, error)
      if (allocated(error)) return
    end do
  end subroutine run_in_order

  !> Run one analysis.
  subroutine run_one(model, system, solver, analysis, level, iterate, recorder, course, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(course_t), intent(inout) :: course
    type(error_t), allocatable, intent(out) :: error

    select case (analysis%kind)
    case (analysis_buckling)
      call run_buckling(model, system, solver, analysis, level, iterate, recorder, course%modes, &
                        error)
    case (analysis_eigen)
      call run_eigen(model, system, solver, analysis, level, iterate, recorder, error)
    case (analysis_transient)
      if (analysis%pattern > 0) system%timed(analysis%pattern) = .true.
      call run_transient(model, system, analysis, course%time, level, iterate, course%flow, &
                         recorder, error)
    case (analysis_static)
      if (allocated(course%flow)) deallocate (course%flow)
      if (analysis%control == control_arc) then
        call run_arc(model, system, solver, analysis, level, iterate, recorder, error)
      else
        call run_static(model, system, solver, analysis, level, iterate, recorder, error)
      end if
    case default
      call fail(error, exit_deck, trim(analysis_names(analysis%kind))//" is not available yet")
    end select
  end subroutine run_one

  !> Ask at once for the least that so many elements will need, 4 kB each: where memory ends in
  !> small steps the Fortran library cannot even say so.
  subroutine check_memory(elements, error)
    integer, intent(in) :: elements
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: block(:, :)
    integer :: status

    allocate (block(512, elements), stat=status)
    if (status /= 0) call fail(error, exit_io, "there is not enough memory for "// &
                               to_text(elements)//" elements")
  end subroutine check_memory

end module analysis_run
