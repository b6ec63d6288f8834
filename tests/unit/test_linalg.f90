!> Linear solver: every case by the dense factorization and by the sparse one.
module test_linalg
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use linalg_scaling, only: scale_symmetric, scale_general
  use linalg_dense, only: rank_revealing
  use linalg_solver, only: solver_t
  use linalg_samples, only: solve_known, solve_matrix, factorize_matrix, saddle_point, &
                            mix_units, coordinates, negative_eigenvalues, known, mixed_units, &
                            random_matrix
  implicit none
  private

  public :: run_linalg_tests

  integer, parameter :: limits(2) = [1000, 0]  !< dense_limit: all dense, all sparse

contains

  subroutine run_linalg_tests()
    integer :: i, n

    call random_seed(size=n)
    call random_seed(put=[(20221123 + 7*i, i=1, n)])  ! the same matrices in every run
    call run("linalg: equilibration is exact and complete", test_scaling)
    call run("linalg: solutions of saddle point systems", test_saddle_point)
    call run("linalg: badly scaled systems", test_bad_scales)
    call run("linalg: negative pivots are negative eigenvalues", test_inertia)
    call run("linalg: inertia of saddle point systems", test_saddle_inertia)
    call run("linalg: sign of the determinant", test_determinant)
    call run("linalg: free-floating bar", test_free_bar)
    call run("linalg: free-floating beam of many elements", test_free_beam)
    call run("linalg: redundant and empty constraints", test_redundant)
    call run("linalg: singular unsymmetric systems", test_singular_unsymmetric)
    call run("linalg: refactorize and prepare again", test_reuse)
    call run("linalg: delayed pivots enlarge the workspace", test_delayed_pivots)
    call run("linalg: empty system", test_empty)
    call run("linalg: misuse is an error", test_misuse)
    call run("linalg: dependent rows", test_rank)
  end subroutine run_linalg_tests

  subroutine test_scaling()
    real(wp), allocatable :: values(:), scaled(:)
    real(wp) :: a(15, 15), s(15), c(15), in_row(15), in_column(15)
    integer, allocatable :: row(:), column(:)
    integer :: i

    call saddle_point(12, 3, a)
    call mix_units(a, mixed_units(15))
    call coordinates(a, .true., row, column, values)
    allocate (scaled(size(values)))
    s = 1.0_wp
    call scale_symmetric(row, column, values, s, scaled)
    in_row = [(maxval(abs(scaled), mask=row == i .or. column == i), i=1, 15)]
    call expect(all(in_row >= 0.25_wp .and. in_row < 2.0_wp), "rows of about one, symmetric")
    call expect(all(abs(fraction(s) - 0.5_wp) <= 0.0_wp), "powers of two")
    call expect(all(abs(scaled - s(row)*values*s(column)) <= 0.0_wp), "S A S")

    a(2, :) = 1.0e9_wp*a(2, :)
    call coordinates(a, .false., row, column, values)
    deallocate (scaled)
    allocate (scaled(size(values)))
    s = 1.0_wp
    c = 1.0_wp
    call scale_general(row, column, values, s, c, scaled)
    in_row = [(maxval(abs(scaled), mask=row == i), i=1, 15)]
    in_column = [(maxval(abs(scaled), mask=column == i), i=1, 15)]
    call expect(all(in_row >= 0.25_wp .and. in_row < 2.0_wp), "rows of about one, general")
    call expect(all(in_column >= 0.25_wp .and. in_column < 2.0_wp), "columns of about one")
    call expect(all(abs(scaled - s(row)*values*c(column)) <= 0.0_wp), "R A C")
  end subroutine test_scaling

  subroutine test_saddle_point()
    real(wp) :: a(88, 88), x(88)
    integer :: i

    do i = 1, size(limits)
      call saddle_point(72, 16, a)
      call solve_known(a, .true., limits(i), x)
      call expect_close(x, known(88), 1.0e-8_wp, "symmetric")
      a(:72, :72) = a(:72, :72) + 0.3_wp*random_matrix(72, 72)
      call solve_known(a, .false., limits(i), x)
      call expect_close(x, known(88), 1.0e-8_wp, "unsymmetric")
    end do
  end subroutine test_saddle_point

  !> Units apart by powers of ten; the solution without them is known.
  subroutine test_bad_scales()
    real(wp) :: a(60, 60), x(60), units(60)
    integer :: i

    units = mixed_units(60)
    do i = 1, size(limits)
      call saddle_point(50, 10, a)
      call mix_units(a, units)
      call solve_known(a, .true., limits(i), x, known(60)/units)
      call expect_close(x*units, known(60), 1.0e-8_wp, "x of the symmetric system")
      a = random_matrix(60, 60)
      call mix_units(a, units)
      a(:, 5) = 1.0e8_wp*a(:, 5)
      units(5) = 1.0e8_wp*units(5)
      call solve_known(a, .false., limits(i), x, known(60)/units)
      call expect_close(x*units, known(60), 1.0e-8_wp, "x of the general system")
      units(5) = 1.0e-8_wp*units(5)
    end do
  end subroutine test_bad_scales

  subroutine test_inertia()
    type(solver_t) :: solver
    real(wp) :: a(41, 41)
    integer :: n, i, negative

    do n = 1, 41, 5
      a = random_matrix(41, 41)
      a = a + transpose(a)
      negative = negative_eigenvalues(a(:n, :n))
      do i = 1, size(limits)
        call factorize_matrix(solver, a(:n, :n), .true., limits(i))
        call expect(solver%negative_pivots() == negative, "inertia")
        call expect(size(solver%null_pivots()) == 0, "no null pivot")
        call expect(solver%determinant_sign() == (-1)**negative, "sign")
      end do
    end do
    call factorize_matrix(solver, a, .false., 1000)
    call expect(solver%negative_pivots() == -1, "no inertia of unsymmetric systems")
    call solver%free()
  end subroutine test_inertia

  !> Positive definite K and independent constraints: one negative eigenvalue each; a congruence
  !> keeps the number. An unstable coordinate adds one.
  subroutine test_saddle_inertia()
    type(solver_t) :: solver
    real(wp), allocatable :: a(:, :)
    integer :: i

    allocate (a(180, 180))
    call saddle_point(150, 30, a)
    call mix_units(a, mixed_units(180))
    do i = 1, size(limits)
      call factorize_matrix(solver, a, .true., limits(i))
      call expect(solver%negative_pivots() == 30, "as many as constraints")
    end do
    a(40, :) = 0.0_wp
    a(:, 40) = 0.0_wp
    a(40, 40) = -1.0e-3_wp
    do i = 1, size(limits)
      call factorize_matrix(solver, a, .true., limits(i))
      call expect(solver%negative_pivots() == 31, "one more")
    end do
    call solver%free()
  end subroutine test_saddle_inertia

  !> The sign of a product L U with unit L is that of the diagonal of U; a row swap turns it.
  subroutine test_determinant()
    type(solver_t) :: solver
    real(wp) :: a(30, 30), l(30, 30), u(30, 30)
    integer :: i, j, k

    l = 0.2_wp*random_matrix(30, 30)
    u = 0.2_wp*random_matrix(30, 30)
    do j = 1, 30
      l(:j, j) = 0.0_wp
      l(j, j) = 1.0_wp
      u(j:, j) = 0.0_wp
      u(j, j) = merge(-1.0_wp, 1.5_wp, modulo(j, 4) == 1)  ! 8 negative
    end do
    a = matmul(l, u)
    do k = 1, 2
      do i = 1, size(limits)
        call factorize_matrix(solver, a, .false., limits(i))
        call expect(solver%determinant_sign() == (-1)**(k - 1), "sign")
      end do
      a([3, 17], :) = a([17, 3], :)
    end do
    call solver%free()
  end subroutine test_determinant

  !> A chain of springs that nothing holds: one null pivot, and forces in balance are carried.
  subroutine test_free_bar()
    type(solver_t) :: solver
    integer, parameter :: n = 30
    real(wp) :: a(n, n), x(n), b(n)
    integer :: i, e

    a = 0.0_wp
    do e = 1, n - 1
      a(e:e + 1, e:e + 1) = a(e:e + 1, e:e + 1) &
                            + 2.1e8_wp/e*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
    end do
    b = 0.0_wp
    b([4, n]) = [-1.0e3_wp, 1.0e3_wp]
    do i = 1, size(limits)
      call solve_matrix(solver, a, .true., limits(i), b, x)
      call expect(size(solver%null_pivots()) == 1, "one null pivot")
      call expect(solver%negative_pivots() == 0, "no negative pivot")
      call expect(solver%determinant_sign() == 0, "no determinant")
      call expect_close(x(solver%null_pivots()), [0.0_wp], 0.0_wp, "null unknown")
      call expect_close(x(n) - x(4), 1.0e3_wp*sum([(e, e=4, n - 1)])/2.1e8_wp, 1.0e-14_wp, &
                        "elongation")
      call expect_close(matmul(a, x), b, 1.0e-8_wp, "forces")
    end do
    call solver%free()
  end subroutine test_free_bar

  !> Bending of a beam of equal elements: free (two null pivots), then clamped by two constraint
  !> rows, loaded at the tip: deflection F L^3 / (3 E I).
  subroutine test_free_beam()
    type(solver_t) :: solver
    integer, parameter :: elements = 97, n = 2*elements + 2
    real(wp), allocatable :: a(:, :)
    real(wp) :: x(n + 2), b(n + 2), k(4, 4), h
    integer :: i, e
    real(wp), parameter :: ei = 2.1e5_wp, length = 3.7_wp

    h = length/elements
    k = ei/h**3*reshape([12.0_wp, 6*h, -12.0_wp, 6*h, 6*h, 4*h*h, -6*h, 2*h*h, &
                         -12.0_wp, -6*h, 12.0_wp, -6*h, 6*h, 2*h*h, -6*h, 4*h*h], [4, 4])
    allocate (a(n + 2, n + 2))
    a = 0.0_wp
    do e = 1, elements
      a(2*e - 1:2*e + 2, 2*e - 1:2*e + 2) = a(2*e - 1:2*e + 2, 2*e - 1:2*e + 2) + k
    end do
    a(n + 1, 1) = 1.0_wp
    a(1, n + 1) = 1.0_wp
    a(n + 2, 2) = 1.0_wp
    a(2, n + 2) = 1.0_wp
    b = 0.0_wp
    b(n - 1) = 1.0_wp
    do i = 1, size(limits)
      call factorize_matrix(solver, a(:n, :n), .true., limits(i))
      call expect(size(solver%null_pivots()) == 2, "free: two null pivots")
      call solve_matrix(solver, a, .true., limits(i), b, x)
      call expect(size(solver%null_pivots()) == 0, "clamped: no null pivot")
      call expect(solver%negative_pivots() == 2, "clamped: two negative pivots")
      call expect_close(x(n - 1)*3*ei/length**3, 1.0_wp, 1.0e-7_wp, "tip deflection")
      call expect_close(x(n + 1:), [1.0_wp, length], 1.0e-7_wp, "clamping force and moment")
    end do
    call solver%free()
  end subroutine test_free_beam

  !> A repeated constraint row and an empty one: two null pivots among the multipliers, the
  !> coordinates as without them.
  subroutine test_redundant()
    type(solver_t) :: solver
    real(wp) :: a(48, 48), x(48), b(48), wanted(48)
    integer, allocatable :: found(:)
    integer :: i

    call saddle_point(40, 8, a)
    a(46, :) = 1.0e3_wp*a(43, :)   ! units differ
    a(:, 46) = 1.0e3_wp*a(:, 43)
    a(48, :) = 0.0_wp
    a(:, 48) = 0.0_wp
    wanted = known(48)
    b = matmul(a, wanted)
    do i = 1, size(limits)
      call solve_matrix(solver, a, .true., limits(i), b, x)
      found = solver%null_pivots()
      call expect(size(found) == 2, "two null pivots")
      if (size(found) /= 2) cycle
      call expect((found(1) == 43 .or. found(1) == 46) .and. found(2) == 48, "their names")
      call expect(solver%negative_pivots() == 6, "independent constraints")
      call expect_close(x(:40), wanted(:40), 1.0e-10_wp, "coordinates")
      call expect_close(matmul(a, x), b, 1.0e-9_wp, "residual")
    end do
    call solver%free()
  end subroutine test_redundant

  !> Consistent systems of rank n-2 with an empty column, a dependent row and no symmetry.
  subroutine test_singular_unsymmetric()
    type(solver_t) :: solver
    real(wp) :: a(30, 30), x(30), b(30)
    integer :: i

    a = random_matrix(30, 30)
    a(:, 1) = 0.0_wp
    a(:, 9) = a(:, 12) - 2*a(:, 17)
    b = matmul(a, known(30))
    do i = 1, size(limits)
      call solve_matrix(solver, a, .false., limits(i), b, x)
      call expect(size(solver%null_pivots()) == 2, "two null pivots")
      call expect(any(solver%null_pivots() == 1), "the empty column is one")
      call expect(solver%determinant_sign() == 0, "no determinant")
      call expect_close(matmul(a, x), b, 1.0e-10_wp, "residual")
    end do
    call solver%free()
  end subroutine test_singular_unsymmetric

  subroutine test_reuse()
    type(solver_t) :: solver
    type(error_t), allocatable :: error
    real(wp), allocatable :: values(:)
    real(wp) :: a(60, 60), x(60)
    integer, allocatable :: row(:), column(:)
    integer :: i, k

    do i = 1, size(limits)
      call saddle_point(50, 10, a)
      call coordinates(a, .true., row, column, values)
      call solver%prepare(60, row, column, .true., error, dense_limit=limits(i))
      do k = 1, 3
        call solver%factorize(values*10.0_wp**(3*k), error)
        x = matmul(a, known(60))
        call solver%solve(x, error)
        call solver%solve(x, error)
        x = matmul(a, x)*10.0_wp**(6*k)
        call expect_close(x, known(60), 1.0e-9_wp, "solved twice, multiplied once")
      end do
      call solver%free()
      call solver%free()
      call solve_matrix(solver, a(:7, :7), .false., limits(i), matmul(a(:7, :7), known(7)), x(:7))
      call expect_close(x(:7), known(7), 1.0e-10_wp, "another pattern")
      call solver%free()
    end do
  end subroutine test_reuse

  !> A full K and constraints on two coordinates each: the ordering eliminates the constraints
  !> first, their zero pivots are all put off to the last front, four times as large as foreseen.
  subroutine test_delayed_pivots()
    integer, parameter :: n = 200, m = n - 1
    real(wp), allocatable :: a(:, :)
    real(wp) :: x(n + m)
    integer :: i

    allocate (a(n + m, n + m))
    a = 0.0_wp
    a(:n, :n) = random_matrix(n, n)
    a(:n, :n) = a(:n, :n) + transpose(a(:n, :n))
    do i = 1, m
      a(i, i) = 40.0_wp
      a(n + i, i:i + 1) = [2.0_wp, 1.0_wp]
      a(i:i + 1, n + i) = [2.0_wp, 1.0_wp]
    end do
    call solve_known(a, .true., 0, x)
    call expect_close(x, known(n + m), 1.0e-8_wp, "x")
  end subroutine test_delayed_pivots

  !> No unknowns, then three unknowns without entries.
  subroutine test_empty()
    type(solver_t) :: solver
    type(error_t), allocatable :: error
    real(wp) :: x(3)
    real(wp), allocatable :: nothing(:)

    allocate (nothing(0))
    call solver%prepare(0, [integer ::], [integer ::], .true., error)
    call solver%factorize(nothing, error)
    call expect(solver%negative_pivots() == 0, "no unknowns: no pivots")
    call solver%prepare(3, [integer ::], [integer ::], .true., error, dense_limit=0)
    call solver%factorize(nothing, error)
    x = 1.0_wp
    call solver%solve(x, error)
    call expect(all(solver%null_pivots() == [1, 2, 3]), "no entries: all null")
    call expect_close(x, [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "no entries: zero")
    call solver%free()
  end subroutine test_empty

  subroutine test_misuse()
    type(solver_t) :: solver
    type(error_t), allocatable :: error
    real(wp) :: x(2)

    x = 1.0_wp
    call solver%factorize(x, error)
    call expect(allocated(error), "factorize without pattern")
    call expect(size(solver%null_pivots()) == 0, "no pivots without factors")
    call solver%solve(x, error)
    call expect(allocated(error), "solve without factors")
    call solver%prepare(2, [1, 3], [1, 1], .true., error)
    call expect(allocated(error), "row 3 of 2")
    call solver%prepare(2, [1, 2], [1, 2], .true., error)
    call solver%factorize([1.0_wp], error)
    call expect(allocated(error), "too few values")
    call solver%factorize([1.0_wp, ieee_value(1.0_wp, ieee_quiet_nan)], error)
    call expect(allocated(error), "NaN")
    if (allocated(error)) call expect(index(error%message, "row 2") > 0, "its place")
    call solver%factorize([1.0_wp, 2.0_wp], error)
    call solver%solve(x(:1), error)
    call expect(allocated(error), "short right-hand side")
    call solver%free()
  end subroutine test_misuse

  subroutine test_rank()
    real(wp) :: a(12, 20)
    integer, allocatable :: dependent(:)

    a = random_matrix(12, 20)
    a(4, :) = a(1, :) - 3*a(2, :)
    a(7, :) = 0.0_wp
    a(9, :) = 1.0e9_wp*a(8, :)
    a(12, :) = a(11, :) + 1.0e-6_wp*a(12, :)   ! nearly, not quite
    a(3, :) = 1.0e-9_wp*a(3, :)
    a(:, 5) = 1.0e12_wp*a(:, 5)
    call rank_revealing(a, 1.0e-10_wp, dependent)
    call expect(size(dependent) == 3, "three rows")
    if (size(dependent) == 3) call expect(all(dependent == [4, 7, 9]), "which")
    call rank_revealing(random_matrix(5, 3), 1.0e-10_wp, dependent)
    call expect(size(dependent) == 2, "more rows than unknowns")
    if (size(dependent) == 2) call expect(all(dependent == [4, 5]), "the last two")
  end subroutine test_rank

end module test_linalg
