!> Matrices for the tests of the linear solver, and how to put them through it.
module linalg_samples
  use kinds, only: wp
  use errors, only: error_t
  use check, only: expect
  use lapack_interfaces, only: dsyev
  use linalg_solver, only: solver_t
  implicit none
  private

  public :: solve_known, solve_matrix, factorize_matrix, saddle_point, mix_units, coordinates, &
            negative_eigenvalues, known, mixed_units, random_matrix

contains

  !> Solve A x = b with a known x and check that the backward error is round-off: every equation
  !> to 1e-12 of the terms in it.
  subroutine solve_known(a, symmetric, dense_limit, x, wanted)
    real(wp), intent(in) :: a(:, :)
    logical, intent(in) :: symmetric
    integer, intent(in) :: dense_limit
    real(wp), intent(out), contiguous :: x(:)
    real(wp), intent(in), optional :: wanted(:)   !< `known` if absent
    type(solver_t) :: solver
    real(wp) :: b(size(x)), terms(size(x))
    integer :: i

    x = known(size(x))
    if (present(wanted)) x = wanted
    b = matmul(a, x)
    call solve_matrix(solver, a, symmetric, dense_limit, b, x)
    call expect(size(solver%null_pivots()) == 0, "no null pivots")
    do i = 1, size(x)
      terms(i) = dot_product(abs(a(i, :)), abs(x))
    end do
    call expect(all(abs(matmul(a, x) - b) <= 1.0e-12_wp*terms), "residual")
    call solver%free()
  end subroutine solve_known

  !> Factors of A, and x in A x = b.
  subroutine solve_matrix(solver, a, symmetric, dense_limit, b, x)
    type(solver_t), intent(inout) :: solver
    real(wp), intent(in) :: a(:, :), b(:)
    logical, intent(in) :: symmetric
    integer, intent(in) :: dense_limit
    real(wp), intent(out), contiguous :: x(:)
    type(error_t), allocatable :: error

    call factorize_matrix(solver, a, symmetric, dense_limit)
    x = b
    call solver%solve(x, error)
    call expect(.not. allocated(error), "no error in solve")
  end subroutine solve_matrix

  !> Pattern and factors of a dense matrix.
  subroutine factorize_matrix(solver, a, symmetric, dense_limit)
    type(solver_t), intent(inout) :: solver
    real(wp), intent(in) :: a(:, :)
    logical, intent(in) :: symmetric
    integer, intent(in) :: dense_limit
    type(error_t), allocatable :: error
    real(wp), allocatable :: values(:)
    integer, allocatable :: row(:), column(:)

    call coordinates(a, symmetric, row, column, values)
    call solver%prepare(size(a, 1), row, column, symmetric, error, dense_limit)
    if (.not. allocated(error)) call solver%factorize(values, error)
    call expect(.not. allocated(error), "no error")
    if (allocated(error)) call expect(.false., error%message)
  end subroutine factorize_matrix

  !> [K, C^T; C, 0] with K = B B^T + 1 positive definite, tridiagonal in pairs, and random C;
  !> 4 m <= n.
  subroutine saddle_point(n, m, a)
    integer, intent(in) :: n, m
    real(wp), intent(out) :: a(n + m, n + m)
    real(wp) :: b(4, 4)
    integer :: i

    a = 0.0_wp
    do i = 1, n - 3, 2
      b = random_matrix(4, 4)
      a(i:i + 3, i:i + 3) = a(i:i + 3, i:i + 3) + matmul(b, transpose(b))
    end do
    do i = 1, n
      a(i, i) = a(i, i) + 1.0_wp
    end do
    do i = 1, m
      a(n + i, 4*i - 3:4*i) = [random_matrix(4, 1)]
      a(n + i, 4*i) = a(n + i, 4*i) + 2.0_wp
      a(:n, n + i) = a(n + i, :n)
    end do
  end subroutine saddle_point

  !> Multiply each row and column by its unit.
  subroutine mix_units(a, units)
    real(wp), intent(inout) :: a(:, :)
    real(wp), intent(in) :: units(:)
    integer :: i, j

    do j = 1, size(units)
      do i = 1, size(units)
        a(i, j) = a(i, j)*units(i)*units(j)
      end do
    end do
  end subroutine mix_units

  !> The non-zero entries of a matrix, of its lower triangle if symmetric.
  subroutine coordinates(a, symmetric, row, column, values)
    real(wp), intent(in) :: a(:, :)
    logical, intent(in) :: symmetric
    integer, allocatable, intent(out) :: row(:), column(:)
    real(wp), allocatable, intent(out) :: values(:)
    logical :: wanted(size(a, 1), size(a, 2))
    integer :: i, j, n

    n = size(a, 1)
    wanted = abs(a) > 0.0_wp
    if (symmetric) wanted = wanted .and. reshape([((i >= j, i=1, n), j=1, n)], [n, n])
    row = pack(spread([(i, i=1, n)], 2, n), wanted)
    column = pack(spread([(j, j=1, n)], 1, n), wanted)
    values = pack(a, wanted)
  end subroutine coordinates

  !> Number of negative eigenvalues by LAPACK.
  integer function negative_eigenvalues(a)
    real(wp), intent(in) :: a(:, :)
    real(wp) :: copy(size(a, 1), size(a, 1)), w(size(a, 1)), work(3*size(a, 1))
    integer :: info, n

    n = size(a, 1)
    copy = a
    call dsyev("N", "L", n, copy, n, w, work, size(work), info)
    call expect(info == 0, "dsyev")
    negative_eigenvalues = count(w < 0.0_wp)
  end function negative_eigenvalues

  !> A solution without accidental symmetry.
  pure function known(n) result(x)
    integer, intent(in) :: n
    real(wp) :: x(n)
    integer :: i

    x = [(1.0_wp + modulo(37*i, 101)/101.0_wp, i=1, n)]
  end function known

  !> Units from 1e-6 to 1e12.
  pure function mixed_units(n) result(units)
    integer, intent(in) :: n
    real(wp) :: units(n)
    integer :: i

    units = [(10.0_wp**(modulo(7*i, 19) - 6), i=1, n)]
  end function mixed_units

  !> Entries between -1 and 1, different at every call.
  function random_matrix(m, n) result(a)
    integer, intent(in) :: m, n
    real(wp) :: a(m, n)

    call random_number(a)
    a = 2*a - 1.0_wp
  end function random_matrix

end module linalg_samples
