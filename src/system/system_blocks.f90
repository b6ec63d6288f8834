!> The symmetric part of a matrix in a square sparsity.
module system_blocks
  use kinds, only: wp
  use system_data, only: pattern_t
  implicit none
  private

  public :: half_t, new_half, fold

  !> Lower triangle of a square sparsity: entry k of it is the mean of two entries of the square.
  type :: half_t
    integer, allocatable :: row(:), column(:)
    integer, allocatable :: lower(:), upper(:)
  end type half_t

contains

  !> The lower triangle, with the entries that mirror each other, in linear time. Rows of a
  !> pattern come in order; every entry has its mirror.
  pure subroutine new_half(n, pattern, half)
    integer, intent(in) :: n                    !< number of unknowns
    type(pattern_t), intent(in) :: pattern
    type(half_t), intent(out) :: half
    integer, allocatable :: row_start(:), column_start(:), in_column(:)
    integer :: mark(n), i, k

    half%lower = [(k, k=1, size(pattern%row))]
    if (.not. pattern%symmetric) half%lower = pack(half%lower, pattern%row >= pattern%column)
    half%row = pattern%row(half%lower)
    half%column = pattern%column(half%lower)
    half%upper = half%lower
    if (pattern%symmetric) return
    call sort_by(n, pattern%row, row_start, in_column)
    call sort_by(n, half%column, column_start, in_column)
    do i = 1, n
      do k = row_start(i), row_start(i + 1) - 1
        mark(pattern%column(k)) = k
      end do
      do k = column_start(i), column_start(i + 1) - 1
        half%upper(in_column(k)) = mark(half%row(in_column(k)))
      end do
    end do
  end subroutine new_half

  !> Positions of keys 1..n, those of key i in `order(start(i):start(i + 1) - 1)`.
  pure subroutine sort_by(n, key, start, order)
    integer, intent(in) :: n, key(:)
    integer, allocatable, intent(out) :: start(:), order(:)
    integer :: next(n), k

    allocate (start(n + 1), order(size(key)))
    start = 0
    do k = 1, size(key)
      start(key(k) + 1) = start(key(k) + 1) + 1
    end do
    start(1) = 1
    do k = 1, n
      start(k + 1) = start(k) + start(k + 1)
    end do
    next = start(:n)
    do k = 1, size(key)
      order(next(key(k))) = k
      next(key(k)) = next(key(k)) + 1
    end do
  end subroutine sort_by

  !> The symmetric part of a matrix, by entry of the lower triangle.
  pure function fold(half, values) result(symmetric)
    type(half_t), intent(in) :: half
    real(wp), intent(in) :: values(:)
    real(wp) :: symmetric(size(half%lower))
    integer :: k

    do k = 1, size(half%lower)
      symmetric(k) = 0.5_wp*(values(half%lower(k)) + values(half%upper(k)))
    end do
  end function fold

end module system_blocks
