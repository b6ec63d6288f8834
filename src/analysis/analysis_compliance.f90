!> COMPLIANCE: displacement and rotation of nodes by unit forces and moments on them, small beside
!> the present state; as an analysis, or of each step of STATIC.
module analysis_compliance
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use model_data, only: model_t, analysis_t
  use nodal_state, only: coordinate_number
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_constraints, only: free_motions
  use system_names, only: coordinate_name
  use recorder, only: recorder_t, step_t
  implicit none
  private

  public :: run_compliance, add_compliance

  integer, parameter :: directions = 6

contains

  !> The analysis: of the present state.
  subroutine run_compliance(model, system, solver, analysis, level, iterate, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: matrix(directions, directions, size(analysis%node))

    call find_compliance(model, system, solver, analysis%node, level, iterate, matrix, error)
    if (.not. allocated(error)) call recorder%compliance(analysis%node, matrix, error)
  end subroutine run_compliance

  !> What a step of STATIC records of it, if the analysis asks for it.
  subroutine add_compliance(model, system, solver, analysis, level, iterate, record, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    type(step_t), intent(inout) :: record
    type(error_t), allocatable, intent(out) :: error

    if (.not. allocated(analysis%node)) return
    allocate (record%compliance(directions, directions, size(analysis%node)))
    call find_compliance(model, system, solver, analysis%node, level, iterate, record%compliance, &
                         error)
  end subroutine add_compliance

  !> Rows and columns of coordinates that are held, or that the node does not have, are zero.
  subroutine find_compliance(model, system, solver, node, level, iterate, matrix, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    real(wp), intent(out) :: matrix(:, :, :)
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    matrix = 0
    call assemble(system, level, iterate)
    call solver%factorize(iterate%values, error)
    if (allocated(error)) return
    call refuse_singular(model, system, solver, iterate, error)
    do i = 1, size(node)
      if (allocated(error)) return
      call node_compliance(system, solver, node(i), matrix(:, :, i), error)
    end do
  end subroutine find_compliance

  !> An unlimited motion has no compliance.
  subroutine refuse_singular(model, system, solver, iterate, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(in) :: iterate
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: free(:)
    character(len=*), parameter :: what = "COMPLIANCE: the present state is singular"

    if (size(solver%null_pivots()) == 0) return
    call free_motions(system, iterate, solver, free, error)
    if (allocated(error)) return
    if (size(free) > 0) then
      call fail(error, exit_solve, what//", "//coordinate_name(model, free(1))//" can move freely")
    else
      call fail(error, exit_solve, what//", nothing resists its critical mode")
    end if
  end subroutine refuse_singular

  subroutine node_compliance(system, solver, node, matrix, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: node
    real(wp), intent(out) :: matrix(directions, directions)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(system%equations())
    integer :: unknown(directions), i, j

    unknown = system%unknown(coordinate_number(node, [(i, i=1, directions)]))
    matrix = 0
    do j = 1, directions
      if (unknown(j) == 0) cycle
      solution = 0
      solution(unknown(j)) = 1
      call solver%solve(solution, error)
      if (allocated(error)) return
      do i = 1, directions
        if (unknown(i) > 0) matrix(i, j) = solution(unknown(i))
      end do
    end do
  end subroutine node_compliance

end module analysis_compliance
