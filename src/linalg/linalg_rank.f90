!> Rows of a large sparse matrix that depend on others.
!>
!> The null vectors of [1, C'; C, 0] are (0, y) with y'C = 0. Most show as null pivots; some hide
!> behind pivots that round-off made larger. Those are the vectors by which the inverse of the
!> matrix without the rows found so far grows beyond all others: subspace iteration brings them
!> out, and |y'C| tells them from rows that only almost depend.
module linalg_rank
  use kinds, only: wp
  use errors, only: error_t
  use linalg_solver, only: solver_t
  implicit none
  private

  public :: dependent_rows

  integer, parameter :: block = 8        !< vectors iterated together
  integer, parameter :: iterations = 3

contains

  !> Fewest rows, ascending, without which the others are independent.
  subroutine dependent_rows(rows, columns, row, column, values, tolerance, dependent, error)
    integer, intent(in) :: rows, columns
    integer, intent(in) :: row(:), column(:)     !< of each entry; no place twice
    real(wp), intent(in) :: values(:)            !< rows of about the same size
    real(wp), intent(in) :: tolerance            !< of |y'C|/|y|, about 1e-10
    integer, allocatable, intent(out) :: dependent(:)
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver
    logical :: left_out(rows)
    real(wp), allocatable :: y(:, :)
    integer :: found, k

    left_out = .false.
    dependent = [integer ::]
    do
      call factorize(columns, row, column, values, left_out, solver, error)
      if (allocated(error)) exit
      associate (null => solver%null_pivots() - columns)
        left_out(pack(null, null > 0)) = .true.
        if (any(null > 0)) cycle
      end associate
      if (all(left_out)) exit
      call hidden_vectors(columns, row, column, values, left_out, tolerance, solver, y, found, &
                          error)
      if (allocated(error) .or. found == 0) exit
      call leave_out(y(:, :found), left_out)
    end do
    call solver%free()
    dependent = pack([(k, k=1, rows)], left_out)
  end subroutine dependent_rows

  !> [1, C'; C, 0]; a row left out has a 1 on the diagonal instead.
  subroutine factorize(columns, row, column, values, left_out, solver, error)
    integer, intent(in) :: columns, row(:), column(:)
    real(wp), intent(in) :: values(:)
    logical, intent(in) :: left_out(:)
    type(solver_t), intent(inout) :: solver
    type(error_t), allocatable, intent(out) :: error
    integer :: i, all

    all = columns + size(left_out)
    associate (counts => .not. left_out(row))
      associate (out => pack([(columns + i, i=1, size(left_out))], left_out))
        call solver%prepare(all, [(i, i=1, columns), out, pack(row, counts) + columns], &
                            [(i, i=1, columns), out, pack(column, counts)], .true., error)
        if (allocated(error)) return
        call solver%factorize([(1.0_wp, i=1, columns + size(out)), pack(values, counts)], error)
      end associate
    end associate
  end subroutine factorize

  !> Null vectors behind the pivots, in the first `found` columns of y; as many as `block` at once.
  subroutine hidden_vectors(columns, row, column, values, left_out, tolerance, solver, y, found, &
                            error)
    integer, intent(in) :: columns, row(:), column(:)
    real(wp), intent(in) :: values(:), tolerance
    logical, intent(in) :: left_out(:)
    type(solver_t), intent(inout) :: solver
    real(wp), allocatable, intent(out) :: y(:, :)
    integer, intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: x(columns + size(left_out))
    integer :: i, j, pass

    found = 0
    allocate (y(size(left_out), min(block, count(.not. left_out))))
    do j = 1, size(y, 2)
      y(:, j) = [(sin(real(i*(2*j + 1), wp) + 0.1_wp*i*i), i=1, size(left_out))]
    end do
    do pass = 1, iterations
      do j = 1, size(y, 2)
        x(:columns) = 0
        x(columns + 1:) = merge(0.0_wp, y(:, j), left_out)
        call solver%solve(x, error)
        if (allocated(error)) return
        y(:, j) = x(columns + 1:)
        y(:, j) = y(:, j)/norm2(y(:, j))
        do i = 1, j - 1
          y(:, j) = y(:, j) - dot_product(y(:, i), y(:, j))*y(:, i)
        end do
        y(:, j) = y(:, j)/norm2(y(:, j))
        do i = 1, j - 1
          y(:, j) = y(:, j) - dot_product(y(:, i), y(:, j))*y(:, i)
        end do
      end do
    end do
    do j = 1, size(y, 2)
      if (norm2(product_with_rows(columns, row, column, values, y(:, j))) > tolerance) cycle
      found = found + 1
      y(:, found) = y(:, j)
    end do
  end subroutine hidden_vectors

  !> C'y.
  pure function product_with_rows(columns, row, column, values, y) result(z)
    integer, intent(in) :: columns, row(:), column(:)
    real(wp), intent(in) :: values(:), y(:)
    real(wp) :: z(columns)
    integer :: k

    z = 0
    do k = 1, size(row)
      z(column(k)) = z(column(k)) + values(k)*y(row(k))
    end do
  end function product_with_rows

  !> A row for each null vector: where it is largest, by elimination from the others.
  pure subroutine leave_out(y, left_out)
    real(wp), intent(inout) :: y(:, :)
    logical, intent(inout) :: left_out(:)
    integer :: j, k, at

    do j = 1, size(y, 2)
      at = maxloc(abs(y(:, j)), 1, back=.true.)
      left_out(at) = .true.
      do k = j + 1, size(y, 2)
        y(:, k) = y(:, k) - (y(at, k)/y(at, j))*y(:, j)
      end do
    end do
  end subroutine leave_out

end module linalg_rank
