!> Sparse matrices by their entries, of symmetric ones those of the lower triangle, for products.
module linalg_symmetric
  use kinds, only: wp
  implicit none
  private

  public :: entries_t, compress, multiply, multiply_general

  !> Entries that are not zero.
  type :: entries_t
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: value(:)
  end type entries_t

contains

  !> The entries of a matrix that are not zero, among coordinates.
  pure subroutine compress(row, column, values, coordinates, matrix)
    integer, intent(in) :: row(:), column(:)     !< if symmetric, row >= column
    real(wp), intent(in) :: values(:)
    integer, intent(in) :: coordinates           !< rows and columns from 1 to this count
    type(entries_t), intent(out) :: matrix
    integer :: k, n

    n = count(abs(values) > 0 .and. max(row, column) <= coordinates)
    allocate (matrix%row(n), matrix%column(n), matrix%value(n))
    n = 0
    do k = 1, size(values)
      if (.not. abs(values(k)) > 0 .or. max(row(k), column(k)) > coordinates) cycle
      n = n + 1
      matrix%row(n) = row(k)
      matrix%column(n) = column(k)
      matrix%value(n) = values(k)
    end do
  end subroutine compress

  !> y = B x with a symmetric matrix given by its lower triangle.
  pure subroutine multiply(b, x, y)
    type(entries_t), intent(in) :: b
    real(wp), intent(in), contiguous :: x(:)
    real(wp), intent(out), contiguous :: y(:)
    integer :: k

    y = 0
    do k = 1, size(b%value)
      associate (i => b%row(k), j => b%column(k))
        y(i) = y(i) + b%value(k)*x(j)
        if (i /= j) y(j) = y(j) + b%value(k)*x(i)
      end associate
    end do
  end subroutine multiply

  !> y = B x with all entries given.
  pure subroutine multiply_general(b, x, y)
    type(entries_t), intent(in) :: b
    real(wp), intent(in), contiguous :: x(:)
    real(wp), intent(out), contiguous :: y(:)
    integer :: k

    y = 0
    do k = 1, size(b%value)
      y(b%row(k)) = y(b%row(k)) + b%value(k)*x(b%column(k))
    end do
  end subroutine multiply_general

end module linalg_symmetric
