!> Factorization of an unsymmetric matrix whose entries lie close to the diagonal in a suitable
!> order of the unknowns: that of a chain of beams. Of regular matrices only, see `regular`.
!> Matrices are to be equilibrated first (linalg_scaling).
module linalg_band
  use kinds, only: wp
  use linalg_order, only: narrow_order
  implicit none
  private

  !> Rows are exchanged only for a pivot this many times as large: fewer exchanges, fewer entries.
  real(wp), parameter :: worth_exchange = 10.0_wp

  !> A pivot of this size or less may be null; whether it is, is for others to find out.
  real(wp), parameter :: doubtful = 1.0e-10_wp

  !> P A = L U. Row i is column i of `factor`, its diagonal the entry `width`, counted from 0; there
  !> is room for `width` entries of L and two times as many of U.
  type, public :: band_t
    private
    integer :: width = 0                   !< largest distance of an entry from the diagonal
    integer, allocatable :: order(:)       !< the unknown at each place
    integer, allocatable :: at(:)          !< by entry of the matrix: where it is in `factor`
    real(wp), allocatable :: factor(:)     !< (0:3 width, n)
    integer, allocatable :: pivot(:)       !< the row each one was exchanged with
    integer, allocatable :: reach(:)       !< entries of U right of the diagonal, by row
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
      allocate (self%at(size(row)), self%factor(n*(3*w + 1)), self%pivot(n), self%reach(n))
      self%at = (place(row) - 1)*(3*w + 1) + place(column) - place(row) + w + 1
    end associate
    self%ready = .true.
  end subroutine prepare

  !> Factors of the matrix with the entries `values`, unless a pivot is doubtful.
  pure subroutine factorize(self, values)
    class(band_t), intent(inout) :: self
    real(wp), intent(in), contiguous :: values(:)
    integer :: k

    self%factor = 0
    do k = 1, size(values)
      self%factor(self%at(k)) = values(k)
    end do
    call eliminate(size(self%order), self%width, self%factor, self%pivot, self%reach, &
                   self%regular, self%determinant_sign)
  end subroutine factorize

  pure subroutine eliminate(n, w, a, pivot, reach, regular, determinant_sign)
    integer, intent(in) :: n, w
    real(wp), intent(inout) :: a(0:3*w, n)
    integer, intent(out) :: pivot(n), reach(n), determinant_sign
    logical, intent(out) :: regular
    real(wp) :: multiplier
    integer :: i, k, m, bottom

    reach = [(min(w, n - k), k=1, n)]
    determinant_sign = 1
    regular = .false.
    do k = 1, n
      bottom = min(n, k + w)
      pivot(k) = pivot_row(n, w, a, k, bottom)
      if (pivot(k) /= k) call exchange(n, w, a, k, pivot(k), reach)
      if (.not. abs(a(w, k)) > doubtful) return
      if (a(w, k) < 0 .neqv. pivot(k) /= k) determinant_sign = -determinant_sign
      m = reach(k)
      do i = k + 1, bottom
        associate (left => a(w + k - i, i))
          if (.not. abs(left) > 0) cycle
          left = left/a(w, k)
          multiplier = left
        end associate
        reach(i) = max(reach(i), m + k - i)
        a(w + k - i + 1:w + k - i + m, i) = a(w + k - i + 1:w + k - i + m, i) &
                                            - multiplier*a(w + 1:w + m, k)
      end do
    end do
    regular = .true.
  end subroutine eliminate

  !> The row of the pivot in column k: the k-th if that is not much smaller than the largest.
  pure integer function pivot_row(n, w, a, k, bottom) result(row)
    integer, intent(in) :: n, w, k, bottom
    real(wp), intent(in) :: a(0:3*w, n)
    real(wp) :: largest
    integer :: i

    row = k
    largest = worth_exchange*abs(a(w, k))
    do i = k + 1, bottom
      if (.not. abs(a(w + k - i, i)) > largest) cycle
      row = i
      largest = abs(a(w + k - i, i))
    end do
  end function pivot_row

  !> Exchange rows k and p > k from column k on.
  pure subroutine exchange(n, w, a, k, p, reach)
    integer, intent(in) :: n, w, k, p
    real(wp), intent(inout) :: a(0:3*w, n)
    integer, intent(inout) :: reach(n)
    real(wp) :: entry
    integer :: j, m

    do j = 0, max(reach(k), reach(p) + p - k)
      entry = a(w + j, k)
      a(w + j, k) = a(w + k - p + j, p)
      a(w + k - p + j, p) = entry
    end do
    m = reach(k)
    reach(k) = reach(p) + p - k
    reach(p) = m + k - p
  end subroutine exchange

  !> Right-hand side in, solution out.
  pure subroutine solve(self, x)
    class(band_t), intent(in) :: self
    real(wp), intent(inout), contiguous :: x(:)
    real(wp) :: y(size(x))

    y = x(self%order)
    call substitute(size(x), self%width, self%factor, self%pivot, self%reach, y)
    x(self%order) = y
  end subroutine solve

  pure subroutine substitute(n, w, a, pivot, reach, y)
    integer, intent(in) :: n, w, pivot(n), reach(n)
    real(wp), intent(in) :: a(0:3*w, n)
    real(wp), intent(inout) :: y(n)
    real(wp) :: swapped
    integer :: i, k

    do k = 1, n
      swapped = y(k)
      y(k) = y(pivot(k))
      y(pivot(k)) = swapped
      do i = k + 1, min(n, k + w)
        y(i) = y(i) - a(w + k - i, i)*y(k)
      end do
    end do
    do k = n, 1, -1
      y(k) = (y(k) - dot_product(a(w + 1:w + reach(k), k), y(k + 1:k + reach(k))))/a(w, k)
    end do
  end subroutine substitute

  !> Give back all memory; harmless when there is none.
  pure subroutine free(self)
    class(band_t), intent(inout) :: self

    self%ready = .false.
    self%regular = .false.
    if (allocated(self%order)) deallocate (self%order)
    if (allocated(self%factor)) deallocate (self%at, self%factor, self%pivot, self%reach)
  end subroutine free

end module linalg_band
