!> Run the analyses of a model, in their order.
module analysis_run
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_io
  use text, only: to_text
  use model_data, only: model_t, analysis_t, control_arc, static_analyses, analysis_buckling, &
                        analysis_eigen, analysis_transient, analysis_kinematic, analysis_inverse, &
                        analysis_compliance, analysis_names
  use linalg_solver, only: solver_t
  use nodal_state, only: state_t
  use system_data, only: system_t
  use system_motion, only: mark_timed
  use system_names, only: node_name
  use system_build, only: build_system, find_system_pattern
  use system_assembly, only: iterate_t, new_iterate
  use start_assembly, only: assemble_start
  use model_soundness, only: warn_of_redundant, refuse_free_motion, needs_structure, &
                             begins_with_motion
  use analysis_static, only: run_static
  use analysis_arc, only: run_arc
  use mode_results, only: modes_t
  use geometric_imperfection, only: add_imperfections
  use analysis_buckling, only: run_buckling
  use analysis_eigen, only: run_eigen
  use analysis_transient, only: run_transient
  use analysis_kinematic, only: run_kinematic
  use drive_jumps, only: warn_of_jumps
  use analysis_compliance, only: run_compliance
  use generalized_alpha, only: flow_t
  use restart_point, only: point_t
  use motion_restart, only: restore_shape
  use recorder, only: recorder_t
  implicit none
  private

  public :: run_analyses

  !> What an analysis leaves to the next besides the state.
  type :: course_t
    type(modes_t) :: modes               !< of the last BUCKLING
    real(wp) :: time = 0.0_wp
    type(flow_t), allocatable :: flow    !< rates of a motion, which the next one takes up
    type(point_t), allocatable :: point  !< where the next analysis is to go on
  end type course_t

contains

  !> Build the system, check that it can stand, run all analyses; from a restart `point`, if there
  !> is one, those that are left.
  subroutine run_analyses(model, recorder, error, point)
    type(model_t), intent(in) :: model
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(point_t), intent(in), optional :: point
    type(system_t) :: system
    type(solver_t) :: solver
    type(iterate_t) :: iterate

    call set_up(model, system, solver, iterate, recorder, error)
    if (.not. allocated(error)) call run_in_order(model, system, solver, iterate, recorder, error, &
                                                  point)
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
    type(state_t), allocatable :: beside

    call check_memory(size(model%member), error)
    if (allocated(error)) return
    call build_system(model, system)
    call assemble_start(model, system, state, error)
    if (.not. allocated(error)) call tell_of_gaps(model, system, state, recorder)
    if (.not. allocated(error)) call warn_of_redundant(model, system, state, recorder, beside, &
                                                         error)
    if (allocated(error)) return
    call find_system_pattern(system)
    call new_iterate(system, iterate)
    iterate%state = state
    call solver%prepare(system%equations(), system%pattern%row, system%pattern%column, &
                        system%pattern%symmetric, error)
    if (allocated(error) .or. .not. needs_structure(model)) return
    if (allocated(beside) .and. begins_with_motion(model)) iterate%state = beside
    call refuse_free_motion(model, system, solver, iterate, error)
    iterate%state = state
    if (.not. all_static(model)) return
    deallocate (system%pattern%row, system%pattern%column)  ! the solver has its own
  end subroutine set_up

  !> Say how far a model moves, before its first analysis, to where everything holds.
  subroutine tell_of_gaps(model, system, state, recorder)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    class(recorder_t), intent(inout) :: recorder
    real(wp), parameter :: seen = 1.0e-6_wp    !< of the model's length
    real(wp) :: distance(size(state%displacement, 2))
    integer :: i

    distance = norm2(state%displacement, 1)
    i = maxloc(distance, 1)
    if (distance(i) > seen*system%length) call recorder%remark( &
      "starts off the drawing, as constraints, drives or STARTX ask: "//node_name(model, i)// &
      " by "//to_text(distance(i), 4))
  end subroutine tell_of_gaps

  !> Whether all analyses follow equilibria.
  pure logical function all_static(model)
    type(model_t), intent(in) :: model
    integer :: i

    all_static = .true.
    do i = 1, size(model%analysis)
      all_static = all_static .and. any(model%analysis(i)%kind == static_analyses)
    end do
  end function all_static

  subroutine run_in_order(model, system, solver, iterate, recorder, error, point)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(point_t), intent(in), optional :: point
    type(error_t), allocatable :: second
    type(model_t) :: shaped
    type(course_t) :: course
    real(wp) :: level(size(model%pattern))
    integer :: first, i
    logical :: reshaped

    level = 0
    first = 1
    if (size(model%imperfection) > 0) shaped = model
    if (present(point)) then
      first = point%analysis
      allocate (course%point, source=point)
    end if
    do i = first, size(model%analysis)
      reshaped = any(model%imperfection%analysis == i)
      if (allocated(course%point)) reshaped = any(model%imperfection%analysis <= i)
      if (reshaped) then
        if (allocated(course%point)) then
          call restore_shape(point, shaped)
        else
          call add_imperfections(i, course%modes, shaped, error)
          if (allocated(error)) return
        end if
        if (allocated(course%flow)) deallocate (course%flow)
        call solver%free()
        call system%free()
        call set_up(shaped, system, solver, iterate, recorder, error)
        if (allocated(error)) return
        level = 0
      end if
      if (i == first) call mark_earlier(model, first, system)
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
      if (allocated(course%point)) deallocate (course%point)
    end do
  end subroutine run_in_order

  !> Patterns that motions in time before analysis number `first` have applied, since the last
  !> imperfection: of a run that goes on.
  pure subroutine mark_earlier(model, first, system)
    type(model_t), intent(in) :: model
    integer, intent(in) :: first
    type(system_t), intent(inout) :: system
    integer :: from

    from = 1
    if (any(model%imperfection%analysis <= first)) then
      from = maxval(model%imperfection%analysis, model%imperfection%analysis <= first)
      system%timed = .false.
    end if
    call mark_timed(model, from, first - 1, system%timed)
  end subroutine mark_earlier

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
      call warn_of_jumps(model, system, analysis, course%time, recorder)
      call run_transient(model, system, analysis, course%time, level, iterate, course%flow, &
                         recorder, error, course%point)
    case (analysis_kinematic, analysis_inverse)
      if (analysis%pattern > 0) system%timed(analysis%pattern) = .true.
      call warn_of_jumps(model, system, analysis, course%time, recorder)
      call run_kinematic(model, system, analysis, course%time, level, iterate, course%flow, &
                         recorder, error)
    case (analysis_compliance)
      call run_compliance(model, system, solver, analysis, level, iterate, recorder, error)
    case (static_analyses(1), static_analyses(2))
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
