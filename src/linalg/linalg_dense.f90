!> Dense factorizations for small systems, symmetric indefinite and general, which survive
!> singular matrices, and the search for dependent constraint rows.
!> Matrices are to be equilibrated first (linalg_scaling).
module linalg_dense
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use linalg_scaling, only: null_tolerance
  use lapack_interfaces, only: dsytrf_rook, dsytrs_rook, dgetrf, dgetrs, dgeqp3, dormqr, dtrtrs
  implicit none
  private

  public :: rank_revealing

  !> Stands for an infinite pivot: the unknown of a null pivot becomes zero.
  real(wp), parameter :: infinite = 1.0e200_wp

  !> P A P^T = L D L^T, D of 1x1 and 2x2 blocks. Rook pivoting, because with the partial
  !> pivoting of dsytrf round-off in a null column can be taken for a 2x2 pivot.
  type, public :: dense_symmetric_t
    private
    real(wp), allocatable :: factor(:, :)         !< L and D
    integer, allocatable :: pivot(:)              !< as LAPACK returns it
    integer, allocatable, public :: null(:)       !< unknowns of the null pivots, ascending
    integer, public :: negative = 0               !< number of negative eigenvalues
  contains
    procedure :: factorize => factorize_symmetric
    procedure :: solve => solve_symmetric
  end type dense_symmetric_t

  !> P A = L U, or Q R with pivoted columns where a pivot of U is null.
  type, public :: dense_general_t
    private
    real(wp), allocatable :: factor(:, :)         !< L and U, or Q and R
    integer, allocatable :: pivot(:)              !< as LAPACK returns it: rows, or columns for QR
    real(wp), allocatable :: tau(:)               !< reflectors of Q
    logical :: orthogonal = .false.               !< QR, not LU
    integer, allocatable, public :: null(:)       !< unknowns of the null pivots, ascending
    integer, public :: determinant_sign = 0       !< 0 with null pivots
  contains
    procedure :: factorize => factorize_general
    procedure :: solve => solve_general
  end type dense_general_t

contains

  !> Factorize; a singular matrix is not an error.
  subroutine factorize_symmetric(self, matrix, error)
    class(dense_symmetric_t), intent(inout) :: self
    real(wp), intent(in), contiguous :: matrix(:, :)  !< n x n, lower triangle used
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: work(max(1, 32*size(matrix, 1)))
    logical :: is_null(size(matrix, 1))
    integer :: n, info

    n = size(matrix, 1)
    self%factor = matrix
    if (allocated(self%pivot)) deallocate (self%pivot)
    allocate (self%pivot(n))
    call dsytrf_rook("L", n, self%factor, max(1, n), self%pivot, work, size(work), info)
    if (info < 0) then
      call fail(error, exit_solve, "dsytrf_rook: info = "//to_text(info))
      return
    end if
    call inspect_pivots(self%factor, self%pivot, self%negative, is_null)
    self%null = indices(is_null)
  end subroutine factorize_symmetric

  !> Count the negative pivots and make the null ones harmless: their columns of L are cleared,
  !> a perturbation of A not larger than the tolerance.
  pure subroutine inspect_pivots(factor, pivot, negative, is_null)
    real(wp), intent(inout) :: factor(:, :)
    integer, intent(inout) :: pivot(:)
    integer, intent(out) :: negative
    logical, intent(out) :: is_null(:)  !< by original number of the unknown
    integer :: original(size(pivot)), k, width, i

    original = [(i, i=1, size(pivot))]
    is_null = .false.
    negative = 0
    k = 1
    do while (k <= size(pivot))
      width = merge(1, 2, pivot(k) > 0)
      do i = k, k + width - 1
        original([i, abs(pivot(i))]) = original([abs(pivot(i)), i])
      end do
      if (all(abs(factor(k:k + width - 1, k:k + width - 1)) <= null_tolerance .or. &
              above_diagonal(width))) then
        do i = k, k + width - 1
          is_null(original(i)) = .true.
          pivot(i) = abs(pivot(i))
          factor(i, i) = infinite
          factor(i + 1:, i) = 0.0_wp
        end do
      else if (width == 2 .or. factor(k, k) < 0.0_wp) then
        negative = negative + 1  ! the choice of pivots makes a 2x2 block indefinite
      end if
      k = k + width
    end do
  end subroutine inspect_pivots

  !> Mask of the entries of a small square block that are not stored.
  pure function above_diagonal(n) result(mask)
    integer, intent(in) :: n
    logical :: mask(n, n)
    integer :: i, j

    mask = reshape([((i < j, i=1, n), j=1, n)], [n, n])
  end function above_diagonal

  !> Right-hand side in, solution out; zero for the unknowns of null pivots.
  subroutine solve_symmetric(self, x, error)
    class(dense_symmetric_t), intent(in) :: self
    real(wp), intent(inout), contiguous :: x(:)
    type(error_t), allocatable, intent(out) :: error
    integer :: n, info

    n = size(x)
    call dsytrs_rook("L", n, 1, self%factor, max(1, n), self%pivot, x, max(1, n), info)
    if (info /= 0) call fail(error, exit_solve, "dsytrs_rook: info = "//to_text(info))
    x(self%null) = 0.0_wp
  end subroutine solve_symmetric

  !> Factorize; a singular matrix is not an error.
  subroutine factorize_general(self, matrix, error)
    class(dense_general_t), intent(inout) :: self
    real(wp), intent(in), contiguous :: matrix(:, :)  !< n x n
    type(error_t), allocatable, intent(out) :: error
    integer :: n, info, k

    n = size(matrix, 1)
    self%factor = matrix
    self%orthogonal = .false.
    self%null = [integer ::]
    if (allocated(self%pivot)) deallocate (self%pivot)
    allocate (self%pivot(n))
    call dgetrf(n, n, self%factor, max(1, n), self%pivot, info)
    if (info < 0) then
      call fail(error, exit_solve, "dgetrf: info = "//to_text(info))
      return
    end if
    self%determinant_sign = 1
    do k = 1, n
      if (abs(self%factor(k, k)) <= null_tolerance) self%orthogonal = .true.
      if (self%factor(k, k) < 0.0_wp .neqv. self%pivot(k) /= k) then
        self%determinant_sign = -self%determinant_sign
      end if
    end do
    if (self%orthogonal) call factorize_singular(self, matrix, error)
  end subroutine factorize_general

  !> QR with column pivoting: the last columns are the null ones.
  subroutine factorize_singular(self, matrix, error)
    class(dense_general_t), intent(inout) :: self
    real(wp), intent(in), contiguous :: matrix(:, :)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: work(36*size(matrix, 1) + 32)
    logical :: is_null(size(matrix, 1))
    integer :: n, info, k

    n = size(matrix, 1)
    self%factor = matrix
    self%pivot = 0
    if (allocated(self%tau)) deallocate (self%tau)
    allocate (self%tau(n))
    call dgeqp3(n, n, self%factor, n, self%pivot, self%tau, work, size(work), info)
    if (info /= 0) then
      call fail(error, exit_solve, "dgeqp3: info = "//to_text(info))
      return
    end if
    do k = 1, n
      is_null(self%pivot(k)) = abs(self%factor(k, k)) <= null_tolerance
    end do
    self%null = indices(is_null)
    if (size(self%null) > 0) self%determinant_sign = 0
  end subroutine factorize_singular

  !> Right-hand side in, solution out; zero for the unknowns of null pivots.
  subroutine solve_general(self, x, error)
    class(dense_general_t), intent(in) :: self
    real(wp), intent(inout), contiguous :: x(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: work(max(1, size(x))), y(size(x))
    integer :: n, rank, info

    n = size(x)
    if (.not. self%orthogonal) then
      call dgetrs("N", n, 1, self%factor, max(1, n), self%pivot, x, max(1, n), info)
      if (info /= 0) call fail(error, exit_solve, "dgetrs: info = "//to_text(info))
      return
    end if
    rank = n - size(self%null)
    y = x
    call dormqr("L", "T", n, 1, n, self%factor, n, self%tau, y, n, work, size(work), info)
    if (info == 0) call dtrtrs("U", "N", "N", rank, 1, self%factor, n, y, n, info)
    if (info /= 0) call fail(error, exit_solve, "dormqr, dtrtrs: info = "//to_text(info))
    x = 0.0_wp
    x(self%pivot(:rank)) = y(:rank)
  end subroutine solve_general

  !> Rows of A that depend on earlier rows: their part orthogonal to the earlier ones is
  !> `tolerance` of their length or less. Rows and columns are scaled first, zero rows depend.
  !> Modified Gram-Schmidt, done twice.
  pure subroutine rank_revealing(a, tolerance, dependent)
    real(wp), intent(in) :: a(:, :)                      !< rows x columns
    real(wp), intent(in) :: tolerance                    !< about 1e-10
    integer, allocatable, intent(out) :: dependent(:)    !< ascending
    real(wp) :: q(size(a, 2), size(a, 1)), length
    logical :: is_dependent(size(a, 1))
    integer :: i, j, pass, rank

    q = balanced_transpose(a)
    rank = 0
    do i = 1, size(a, 1)
      length = norm2(q(:, i))
      do pass = 1, 2
        do j = 1, rank
          q(:, i) = q(:, i) - dot_product(q(:, j), q(:, i))*q(:, j)
        end do
      end do
      is_dependent(i) = .not. norm2(q(:, i)) > tolerance*length
      if (is_dependent(i)) cycle
      rank = rank + 1
      q(:, rank) = q(:, i)/norm2(q(:, i))
    end do
    dependent = indices(is_dependent)
  end subroutine rank_revealing

  !> A^T with the largest entry of each column (unknown), then of each row made 1.
  pure function balanced_transpose(a) result(b)
    real(wp), intent(in) :: a(:, :)
    real(wp) :: b(size(a, 2), size(a, 1)), largest
    integer :: i, j

    b = transpose(a)
    do i = 1, size(a, 1)
      largest = maxval(abs(b(:, i)))
      if (largest > 0.0_wp) b(:, i) = b(:, i)/largest
    end do
    do j = 1, size(a, 2)
      largest = maxval(abs(b(j, :)))
      if (largest > 0.0_wp) b(j, :) = b(j, :)/largest
    end do
    do i = 1, size(a, 1)
      largest = maxval(abs(b(:, i)))
      if (largest > 0.0_wp) b(:, i) = b(:, i)/largest
    end do
  end function balanced_transpose

  !> Where a mask is true.
  pure function indices(mask)
    logical, intent(in) :: mask(:)
    integer, allocatable :: indices(:)
    integer :: i

    indices = pack([(i, i=1, size(mask))], mask)
  end function indices

end module linalg_dense
