!> A system without loads and stress, and what moves freely there.
module system_unstressed
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: state_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: coordinate_scale, null_vector, is_rigid
  implicit none
  private

  public :: unstressed_t, new_unstressed

  !> A system without loads and stress at a state, factorized, and what moves freely there.
  type :: unstressed_t
    type(system_t) :: system
    type(iterate_t) :: iterate
    type(solver_t) :: solver
    real(wp), allocatable :: scale(:)    !< by coordinate
    real(wp), allocatable :: free(:, :)  !< motions by coordinate, the largest entry of each 1
  end type unstressed_t

contains

  !> Without loads, factorized at a state without stress.
  subroutine new_unstressed(system, state, self, error)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(unstressed_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: motion(:)
    real(wp) :: level(size(system%timed))
    integer, allocatable :: null(:)
    integer :: i, k, n

    self%system = system
    deallocate (self%system%load)
    allocate (self%system%load(0))
    call find_system_pattern(self%system)
    call new_iterate(self%system, self%iterate)
    self%iterate%state = state
    level = 0
    call assemble(self%system, level, self%iterate)
    associate (p => self%system%pattern)
      call self%solver%prepare(self%system%equations(), p%row, p%column, p%symmetric, error)
    end associate
    if (.not. allocated(error)) call self%solver%factorize(self%iterate%values, error)
    if (allocated(error)) return
    allocate (null, source=self%solver%null_pivots())
    self%scale = [(coordinate_scale(system, k), k=1, system%coordinates)]
    allocate (self%free(system%coordinates, size(null)))
    n = 0
    do i = 1, size(null)
      call null_vector(self%system, self%iterate, self%solver, null(i), motion, error)
      if (allocated(error)) return
      if (.not. is_rigid(self%system, self%iterate, motion/self%scale)) cycle
      n = n + 1
      self%free(:, n) = motion/maxval(abs(motion/self%scale))
    end do
    self%free = self%free(:, :n)
  end subroutine new_unstressed

end module system_unstressed
