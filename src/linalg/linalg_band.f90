!> Factorization of an unsymmetric matrix whose entries lie close to the diagonal in a suitable
!> order of the unknowns: that of a chain of beams. Of regular matrices only, see `regular`.
!> Matrices are to be equilibrated first (linalg_scaling).
module linalg_band
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use lapack_interfaces, only: dgbtrf, dgbtrs
  use linalg_order, only: narrow_order
  implicit none
  private

  !> A pivot of this size or less may be null; whether it is, is for others to find out.
  real(wp), parameter :: doubtful = 1.0e-10_wp

  !> Entry (i, j) stands in row 2 width + 1 + i - j, column j of `factor`, as dgbtrf wants it.
  type, public :: band_t
    private
    integer :: width = 0                   !< largest distance of an entry from the diagonal
    integer, allocatable :: order(:)       !< the unknown at each place
    integer, allocatable :: at(:)          !< by entry of the matrix: where it is in `factor`
    real(wp), allocatable :: factor(:)     !< (3 width + 1, n)
    integer, allocatable :: pivot(:)       !< the row each one was exchanged with
    logical, public :: ready = .false.     !< the pattern is narrow, there is room for factors
    logical, public :: regular = .false.   !< no pivot is null or doubtful
    integer, public :: determinant_sign = 0
  contains
    procedure :: prepare
    procedure :: factorize
    procedure :: solve
    procedure :: free
  end type band_t

contains

  !> Order a pattern; there is room for factors only if its width does not exceed `limit`.
  pure subroutine prepare(self, n, row, column, limit)
    class(band_t), intent(inout) :: self
    integer, intent(in) :: n                              !< number of unknowns
    integer, intent(in), contiguous :: row(:), column(:)  !< entries
    integer, intent(in) :: limit
    integer :: place(n), i

    call self%free()
    allocate (self%order(n))
    call narrow_order(n, row, column, self%order, self%width)
    if (self%width > limit) return
    place(self%order) = [(i, i=1, n)]
    associate (w => self%width)
      allocate (self%at(size(row)), self%factor(n*(3*w + 1)), self%pivot(n))
      self%at = (place(column) - 1)*(3*w + 1) + 2*w + 1 + place(row) - place(column)
    end associate
    self%ready = .true.
  end subroutine prepare

  !> Factors of the matrix with the entries `values`; `regular` unless a pivot is doubtful.
  subroutine factorize(self, values, error)
    class(band_t), intent(inout) :: self
    real(wp), intent(in), contiguous :: values(:)
    type(error_t), allocatable, intent(out) :: error
    integer :: n, info, k

    n = size(self%order)
    associate (w => self%width)
      self%factor = 0
      self%factor(self%at) = values
      call dgbtrf(n, n, w, w, self%factor, 3*w + 1, self%pivot, info)
      if (info < 0) call fail(error, exit_solve, "dgbtrf: info = "//to_text(info))
      self%regular = info == 0
      self%determinant_sign = 1
      do k = 1, n
        associate (pivot => self%factor((k - 1)*(3*w + 1) + 2*w + 1))
          if (.not. abs(pivot) > doubtful) self%regular = .false.
          if (pivot < 0 .neqv. self%pivot(k) /= k) self%determinant_sign = -self%determinant_sign
        end associate
      end do
    end associate
  end subroutine factorize

  !> Right-hand side in, solution out.
  subroutine solve(self, x, error)
    class(band_t), intent(in) :: self
    real(wp), intent(inout), contiguous :: x(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: y(size(x), 1)
    integer :: info

    y(:, 1) = x(self%order)
    associate (w => self%width)
      call dgbtrs("N", size(x), w, w, 1, self%factor, 3*w + 1, self%pivot, y, size(x), info)
    end associate
    if (info /= 0) call fail(error, exit_solve, "dgbtrs: info = "//to_text(info))
    x(self%order) = y(:, 1)
  end subroutine solve

  !> Give back all memory; harmless when there is none.
  pure subroutine free(self)
    class(band_t), intent(inout) :: self

    self%ready = .false.
    self%regular = .false.
    if (allocated(self%order)) deallocate (self%order)
    if (allocated(self%factor)) deallocate (self%at, self%factor, self%pivot)
  end subroutine free

end module linalg_band
