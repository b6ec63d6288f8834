!> Sparse direct factorization: the only user of MUMPS. Nothing is ever printed.
!> Matrices are to be equilibrated first (linalg_scaling); MUMPS' own scaling is off.
module linalg_sparse
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_solve, exit_io
  use text, only: to_text
  use linalg_scaling, only: null_tolerance
  implicit none
  private

  include 'dmumps_struc.h'

  integer, parameter :: most_spare = 10000  !< per cent of spare workspace, then give up

  !> One pattern and its latest factors. Free it before it goes out of scope.
  type, public :: sparse_t
    private
    type(dmumps_struc), allocatable :: id
    integer, allocatable, public :: null(:)    !< unknowns of the null pivots, ascending
    integer, public :: negative = 0            !< symmetric only: number of negative eigenvalues
    integer, public :: determinant_sign = 0    !< unsymmetric only; 0 with null pivots
  contains
    procedure :: prepare
    procedure :: factorize
    procedure :: solve
    procedure :: free
  end type sparse_t

  interface
    subroutine dmumps(id)
      import :: dmumps_struc
      implicit none
      type(dmumps_struc), intent(inout), target :: id
    end subroutine dmumps
  end interface

contains

  !> Ordering and symbolic factorization of a pattern.
  subroutine prepare(self, n, row, column, symmetric, error)
    class(sparse_t), intent(inout), target :: self
    integer, intent(in) :: n                                 !< number of unknowns
    integer, intent(inout), target, contiguous :: row(:)     !< unchanged
    integer, intent(inout), target, contiguous :: column(:)  !< unchanged
    logical, intent(in) :: symmetric                         !< one triangle is given
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: first(:)
    integer :: i

    call self%free()
    allocate (self%id)
    self%id%comm = 0
    self%id%par = 1
    self%id%sym = merge(2, 0, symmetric)
    call run_job(self%id, -1, error)
    if (allocated(error)) return
    call set_options(self%id, symmetric)
    self%id%n = n
    self%id%nnz = int(size(row), i8)
    call attach(self%id, row, column)
    call find_blocks(n, row, column, first)
    self%id%nblk = size(first) - 1
    allocate (self%id%blkptr(size(first)), source=first)
    allocate (self%id%blkvar(n), source=[(i, i=1, n)])
    call run_job(self%id, 1, error)
    deallocate (self%id%blkptr, self%id%blkvar)
    nullify (self%id%irn, self%id%jcn)
  end subroutine prepare

  subroutine set_options(id, symmetric)
    type(dmumps_struc), intent(inout) :: id
    logical, intent(in) :: symmetric

    id%icntl(1:4) = 0              ! silence
    id%icntl(6) = 0                ! no permutation by values: the analysis sees the pattern only
    id%icntl(7) = 2                ! ordering AMF
    id%icntl(8) = 0                ! no scaling
    id%icntl(9) = 0                ! unsymmetric: solve with the transpose (see `attach`)
    id%icntl(10) = 0               ! no refinement: equilibrated pivoting leaves round-off only
    id%icntl(12) = 1               ! no ordering by values
    id%icntl(14) = 100             ! per cent of spare workspace; untouched pages cost nothing
    id%icntl(15) = 1               ! analysis by blocks of unknowns
    id%icntl(24) = 1               ! look for null pivots
    if (.not. symmetric) id%cntl(1) = 0.1_wp  ! 0.01 lets round-off hide null pivots
    id%cntl(3) = -null_tolerance   ! negative: absolute size
    id%cntl(5) = 0.0_wp            ! the unknown of a null pivot becomes zero
    id%icntl(33) = merge(0, 1, symmetric)  ! determinant
  end subroutine set_options

  !> Point to the pattern, transposed: MUMPS finds null rows, and wanted are null unknowns.
  subroutine attach(id, row, column)
    type(dmumps_struc), intent(inout) :: id
    integer, intent(inout), target, contiguous :: row(:), column(:)

    id%irn => column
    id%jcn => row
  end subroutine attach

  !> Consecutive unknowns with the same neighbours form a block `first(b) : first(b+1)-1`.
  !> Neighbours are compared by a sum of pseudo-random numbers; should two sums agree by accident,
  !> the blocks are merely less apt, for the analysis takes the union of their patterns.
  pure subroutine find_blocks(n, row, column, first)
    integer, intent(in) :: n
    integer, intent(in), contiguous :: row(:), column(:)
    integer, allocatable, intent(out) :: first(:)
    integer(i8), parameter :: prime = 2147483647_i8
    integer(i8), allocatable :: code(:), neighbours(:)
    integer :: k

    allocate (code(n))
    do k = 1, n
      code(k) = modulo(int(k, i8)**2, prime)
    end do
    neighbours = code
    do k = 1, size(row)
      if (row(k) == column(k)) cycle
      neighbours(row(k)) = neighbours(row(k)) + code(column(k))
      neighbours(column(k)) = neighbours(column(k)) + code(row(k))
    end do
    first = [1, pack([(k, k=2, n)], neighbours(2:) /= neighbours(:n - 1)), n + 1]
  end subroutine find_blocks

  !> Numerical factorization of a matrix with the prepared pattern; singular is not an error.
  subroutine factorize(self, row, column, values, error)
    class(sparse_t), intent(inout), target :: self
    integer, intent(inout), target, contiguous :: row(:)     !< unchanged
    integer, intent(inout), target, contiguous :: column(:)  !< unchanged
    real(wp), intent(inout), target, contiguous :: values(:) !< unchanged
    type(error_t), allocatable, intent(out) :: error
    integer, parameter :: int_space = -8, real_space = -9

    call attach(self%id, row, column)
    self%id%a => values
    do
      call run_job(self%id, 2, error)
      if (all(self%id%infog(1) /= [int_space, real_space])) exit
      if (self%id%icntl(14) > most_spare) exit
      self%id%icntl(14) = 2*self%id%icntl(14)
    end do
    nullify (self%id%irn, self%id%jcn, self%id%a)
    if (allocated(error)) return
    self%negative = self%id%infog(12)
    self%null = [integer ::]
    if (self%id%infog(28) > 0) call sort(self%id%pivnul_list(:self%id%infog(28)), self%null)
    self%determinant_sign = 0
    if (size(self%null) == 0) self%determinant_sign = nint(sign(1.0_wp, self%id%rinfog(12)))
  end subroutine factorize

  !> Right-hand side in, solution out; zero for the unknowns of null pivots.
  subroutine solve(self, x, error)
    class(sparse_t), intent(inout), target :: self
    real(wp), intent(inout), target, contiguous :: x(:)
    type(error_t), allocatable, intent(out) :: error

    self%id%rhs => x
    call run_job(self%id, 3, error)
    nullify (self%id%rhs)
    x(self%null) = 0.0_wp
  end subroutine solve

  !> Give back all memory.
  subroutine free(self)
    class(sparse_t), intent(inout) :: self
    type(error_t), allocatable :: ignored

    if (.not. allocated(self%id)) return
    call run_job(self%id, -2, ignored)
    deallocate (self%id)
  end subroutine free

  !> One step of MUMPS, its status made an error.
  subroutine run_job(id, job, error)
    type(dmumps_struc), intent(inout), target :: id
    integer, intent(in) :: job
    type(error_t), allocatable, intent(out) :: error
    integer, parameter :: no_memory(4) = [-5, -7, -13, -19]

    id%job = job
    call dmumps(id)
    if (id%infog(1) >= 0) return
    call fail(error, merge(exit_io, exit_solve, any(id%infog(1) == no_memory)), &
              "dmumps: job = "//to_text(job)//", infog(1) = "//to_text(id%infog(1))// &
              ", infog(2) = "//to_text(id%infog(2)))
    if (any(id%infog(1) == no_memory)) error%message = "out of memory: "//error%message
  end subroutine run_job

  !> Ascending copy of a short list.
  pure subroutine sort(list, sorted)
    integer, intent(in) :: list(:)
    integer, allocatable, intent(out) :: sorted(:)
    integer :: i, at

    sorted = list
    do i = 2, size(sorted)
      at = count(sorted(:i - 1) <= sorted(i))
      sorted(at + 1:i) = cshift(sorted(at + 1:i), -1)
    end do
  end subroutine sort

end module linalg_sparse
