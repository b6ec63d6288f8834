!> Run the analyses of a model, in their order.
module analysis_run
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_io
  use text, only: to_text
  use model_data, only: model_t, analysis_t, control_arc, static_analyses, analysis_buckling, &
                        analysis_eigen, analysis_transient, analysis_compliance, analysis_names
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: drop_redundant, free_motions
  use system_names, only: coordinate_name, strain_name
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

    call check_memory(size(model%member), error)
    if (allocated(error)) return
    call build_system(model, system)
    call warn_of_redundant(model, system, recorder, error)
    if (allocated(error)) return
    call find_system_pattern(system)
    call new_iterate(system, iterate)
    call solver%prepare(system%equations(), system%pattern%row, system%pattern%column, &
                        system%pattern%symmetric, error)
    if (allocated(error) .or. .not. needs_structure(model)) return
    call refuse_free_motion(model, system, solver, iterate, error)
    if (.not. all_static(model)) return
    deallocate (system%pattern%row, system%pattern%column)  ! the solver has its own
  end subroutine set_up

  !> Whether all analyses follow equilibria.
  pure logical function all_static(model)
    type(model_t), intent(in) :: model
    integer :: i

    all_static = .true.
    do i = 1, size(model%analysis)
      all_static = all_static .and. any(model%analysis(i)%kind == static_analyses)
    end do
  end function all_static

  !> Whether an analysis needs a structure: EIGEN and motions in time do not.
  pure logical function needs_structure(model)
    type(model_t), intent(in) :: model
    integer :: i

    needs_structure = .false.
    do i = 1, size(model%analysis)
      needs_structure = needs_structure .or. any(model%analysis(i)%kind == &
        [static_analyses, analysis_buckling, analysis_compliance])
    end do
  end function needs_structure

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

  !> Redundant constraints that agree are left out, with a warning for each.
  subroutine warn_of_redundant(model, system, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: dropped(:)
    integer :: i

    call drop_redundant(system, dropped, error)
    if (allocated(error)) return
    do i = 1, size(dropped)
      call recorder%remark("warning: "//strain_name(model, system, dropped(i))// &
                           " is fixed, but other constraints already see to that;"// &
                           " the model is overconstrained")
    end do
  end subroutine warn_of_redundant

  !> A structure must resist every motion: free ones are named by node and coordinate.
  subroutine refuse_free_motion(model, system, solver, iterate, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(inout) :: iterate
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: free(:)
    character(len=:), allocatable :: list
    real(wp) :: level(size(model%pattern))
    integer :: i

    if (system%unknowns == 0) then
      call fail(error, exit_deck, "nothing can move: every coordinate is fixed")
      return
    end if
    level = 0
    call assemble(system, level, iterate)
    call solver%factorize(iterate%values, error)
    if (allocated(error)) return
    if (size(solver%null_pivots()) == 0) return
    call free_motions(system, iterate, solver, free, error)
    if (allocated(error) .or. size(free) == 0) return
    list = coordinate_name(model, free(1))
    do i = 2, size(free)
      list = list//", "//coordinate_name(model, free(i))
    end do
    call fail(error, exit_deck, "the model can move freely: "//list// &
              "; FIX it or connect it, STATIC needs a structure")
  end subroutine refuse_free_motion

end module analysis_run
