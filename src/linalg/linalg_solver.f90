!> Solve a sparse linear system, symmetric indefinite or general, regular or singular:
!> equilibration, then a dense factorization for few unknowns, MUMPS for many; of general matrices
!> one in a band where the unknowns have an order that makes it narrow, as in chains of beams.
!> Should the matrix prove singular there, the other two look at it again: they name null pivots.
!>
!> Call `prepare` once per pattern, `factorize` once per matrix, `solve` once per right-hand side,
!> `free` at the end. A singular matrix is no error: see `null_pivots`.
module linalg_solver
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use linalg_scaling, only: scale_symmetric, scale_general
  use linalg_dense, only: dense_symmetric_t, dense_general_t
  use linalg_sparse, only: sparse_t
  use linalg_band, only: band_t
  implicit none
  private

  integer, parameter, public :: default_dense_limit = 150  !< unknowns up to which dense is faster
  integer, parameter, public :: default_band_limit = 40    !< width up to which a band is faster

  !> Fewer unknowns than this are dense: there the exchange of more rows costs nothing, and leaves
  !> more digits where a mechanism passes a singular position.
  integer, parameter :: fewest_in_band = 60

  integer, parameter :: dense_symmetric = 1, dense_general = 2, sparse = 3, banded = 4

  type, public :: solver_t
    private
    integer :: method = 0                        !< one of the four above
    integer :: other = 0                         !< the one that takes singular matrices
    logical :: has_room = .false.                !< and is prepared
    logical :: symmetric = .false.
    logical :: factorized = .false.
    integer, allocatable :: row(:), column(:)    !< pattern
    real(wp), allocatable :: scaled(:)           !< equilibrated entries
    real(wp), allocatable :: left(:), right(:)   !< scales; right of general only
    real(wp), allocatable :: matrix(:, :)        !< the dense matrix, n x n
    type(dense_symmetric_t) :: ldl
    type(dense_general_t) :: lu
    type(sparse_t) :: mumps
    type(band_t) :: band
  contains
    procedure :: prepare
    procedure :: factorize
    procedure :: solve
    procedure :: negative_pivots
    procedure :: determinant_sign
    procedure :: null_pivots
    procedure :: scales
    procedure :: set_scales
    procedure :: free
  end type solver_t

contains

  !> Set the pattern: entry k is in `row(k)`, `column(k)`; no place twice.
  subroutine prepare(self, n, row, column, symmetric, error, dense_limit, band_limit)
    class(solver_t), intent(inout) :: self
    integer, intent(in) :: n                       !< number of unknowns
    integer, intent(in) :: row(:), column(:)       !< entries; if symmetric with row >= column only
    logical, intent(in) :: symmetric
    type(error_t), allocatable, intent(out) :: error
    integer, intent(in), optional :: dense_limit   !< most unknowns for a dense factorization
    integer, intent(in), optional :: band_limit    !< largest width of a band, see `linalg_order`
    integer :: most, widest

    call self%free()
    most = default_dense_limit
    if (present(dense_limit)) most = dense_limit
    widest = merge(min(default_band_limit, n/4), -1, n >= fewest_in_band)
    if (present(band_limit)) widest = band_limit
    if (size(row) /= size(column) .or. any(min(row, column) < 1 .or. max(row, column) > n)) then
      call fail(error, exit_solve, "solver: entries outside a matrix of "//to_text(n)//" unknowns")
      return
    end if
    self%row = row
    self%column = column
    self%symmetric = symmetric
    allocate (self%scaled(size(row)), self%left(n), self%right(merge(0, n, symmetric)))
    self%left = 1.0_wp
    self%right = 1.0_wp
    self%other = sparse
    if (n <= most .or. size(row) == 0) self%other = merge(dense_symmetric, dense_general, symmetric)
    self%method = self%other
    if (.not. symmetric .and. size(row) > 0) then
      call self%band%prepare(n, self%row, self%column, widest)
      if (self%band%ready) self%method = banded
    end if
    if (self%method /= banded) call make_room(self, error)
  end subroutine prepare

  !> Prepare the method that also takes singular matrices.
  subroutine make_room(self, error)
    class(solver_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: n

    n = size(self%left)
    if (self%other == sparse) then
      call self%mumps%prepare(n, self%row, self%column, self%symmetric, error)
    else
      allocate (self%matrix(n, n))
    end if
    self%has_room = .true.
  end subroutine make_room

  !> Factorize the matrix with the entries `values` in the order of the pattern.
  subroutine factorize(self, values, error)
    class(solver_t), intent(inout) :: self
    real(wp), intent(in), contiguous :: values(:)
    type(error_t), allocatable, intent(out) :: error

    self%factorized = .false.
    call check_values(self, values, error)
    if (allocated(error)) return
    if (self%symmetric) then
      call scale_symmetric(self%row, self%column, values, self%left, self%scaled)
    else
      call scale_general(self%row, self%column, values, self%left, self%right, self%scaled)
    end if
    if (self%band%ready) then
      call self%band%factorize(self%scaled, error)
      if (allocated(error)) return
      self%method = merge(banded, self%other, self%band%regular)
      if (.not. self%has_room .and. .not. self%band%regular) call make_room(self, error)
      if (allocated(error)) return
    end if
    select case (self%method)
    case (banded)
    case (dense_symmetric)
      call fill(self%row, self%column, self%scaled, self%matrix)
      call self%ldl%factorize(self%matrix, error)
    case (dense_general)
      call fill(self%row, self%column, self%scaled, self%matrix)
      call self%lu%factorize(self%matrix, error)
    case default
      call self%mumps%factorize(self%row, self%column, self%scaled, error)
    end select
    self%factorized = .not. allocated(error)
  end subroutine factorize

  !> A pattern must be there, and the entries fit it and be finite.
  subroutine check_values(self, values, error)
    class(solver_t), intent(in) :: self
    real(wp), intent(in), contiguous :: values(:)
    type(error_t), allocatable, intent(out) :: error
    integer :: k

    if (self%method == 0) then
      call fail(error, exit_solve, "solver: factorize called before prepare")
      return
    else if (size(values) /= size(self%row)) then
      call fail(error, exit_solve, "solver: "//to_text(size(values))// &
                " values for a pattern of "//to_text(size(self%row)))
      return
    end if
    do k = 1, size(values)
      if (ieee_is_finite(values(k))) cycle
      call fail(error, exit_solve, "solver: the matrix entry in row "//to_text(self%row(k))// &
                ", column "//to_text(self%column(k))//" is not a finite number")
      return
    end do
  end subroutine check_values

  pure subroutine fill(row, column, values, matrix)
    integer, intent(in), contiguous :: row(:), column(:)
    real(wp), intent(in), contiguous :: values(:)
    real(wp), intent(out), contiguous :: matrix(:, :)
    integer :: k

    matrix = 0.0_wp
    do k = 1, size(values)
      matrix(row(k), column(k)) = values(k)
    end do
  end subroutine fill

  !> Right-hand side in, solution out. Unknowns of null pivots are zero; the result solves the
  !> system if the system is consistent.
  subroutine solve(self, x, error)
    class(solver_t), intent(inout) :: self
    real(wp), intent(inout), contiguous :: x(:)
    type(error_t), allocatable, intent(out) :: error

    if (.not. self%factorized) then
      call fail(error, exit_solve, "solver: solve called without factors")
      return
    else if (size(x) /= size(self%left)) then
      call fail(error, exit_solve, "solver: "//to_text(size(x))//" right-hand side entries for "// &
                to_text(size(self%left))//" unknowns")
      return
    end if
    x = self%left*x
    select case (self%method)
    case (dense_symmetric)
      call self%ldl%solve(x, error)
    case (dense_general)
      call self%lu%solve(x, error)
    case (banded)
      call self%band%solve(x, error)
    case default
      call self%mumps%solve(x, error)
    end select
    if (self%symmetric) then
      x = self%left*x
    else
      x = self%right*x
    end if
  end subroutine solve

  !> Number of negative eigenvalues of the factorized symmetric matrix; -1 if not symmetric.
  integer function negative_pivots(self)
    class(solver_t), intent(in) :: self

    negative_pivots = -1
    if (self%method == dense_symmetric) negative_pivots = self%ldl%negative
    if (self%method == sparse .and. self%symmetric) negative_pivots = self%mumps%negative
  end function negative_pivots

  !> Sign of the determinant of the factorized matrix; 0 if there are null pivots.
  integer function determinant_sign(self)
    class(solver_t), intent(in) :: self

    if (size(self%null_pivots()) > 0) then
      determinant_sign = 0
    else if (self%symmetric) then
      determinant_sign = 1 - 2*modulo(self%negative_pivots(), 2)
    else if (self%method == dense_general) then
      determinant_sign = self%lu%determinant_sign
    else if (self%method == banded) then
      determinant_sign = self%band%determinant_sign
    else
      determinant_sign = self%mumps%determinant_sign
    end if
  end function determinant_sign

  !> Unknowns that the factorized matrix leaves undetermined, ascending; usually none.
  function null_pivots(self)
    class(solver_t), intent(in) :: self
    integer, allocatable :: null_pivots(:)

    null_pivots = [integer ::]
    if (.not. self%factorized .or. self%method == banded) return
    select case (self%method)
    case (dense_symmetric)
      null_pivots = self%ldl%null
    case (dense_general)
      null_pivots = self%lu%null
    case default
      null_pivots = self%mumps%null
    end select
  end function null_pivots

  !> Scales of rows and, if general, columns, with which the next factorization begins: what a
  !> solver has to know of earlier matrices to round as if it had seen them.
  pure function scales(self)
    class(solver_t), intent(in) :: self
    real(wp) :: scales(size(self%left) + size(self%right))

    scales = [self%left, self%right]
  end function scales

  !> Begin the next factorization with the scales of another solver of the same pattern.
  pure subroutine set_scales(self, scales)
    class(solver_t), intent(inout) :: self
    real(wp), intent(in) :: scales(:)   !< as `scales` gave them

    self%left = scales(:size(self%left))
    self%right = scales(size(self%left) + 1:)
  end subroutine set_scales

  !> Give back all memory; harmless when there is none.
  subroutine free(self)
    class(solver_t), intent(inout) :: self

    call self%mumps%free()
    call self%band%free()
    self%method = 0
    self%has_room = .false.
    self%factorized = .false.
    if (allocated(self%row)) deallocate (self%row, self%column, self%scaled, self%left, self%right)
    if (allocated(self%matrix)) deallocate (self%matrix)
  end subroutine free

end module linalg_solver
