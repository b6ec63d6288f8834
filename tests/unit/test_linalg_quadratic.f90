!> Quadratic eigenvalues of random matrices with constraints: residuals, and all eigenvalues
!> against those nearest zero by iteration.
module test_linalg_quadratic
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use linalg_solver, only: solver_t
  use linalg_quadratic, only: quadratic_t, spectrum_t, find_complex
  use linalg_lanczos, only: start_vector
  implicit none
  private

  public :: run_linalg_quadratic_tests

  integer, parameter :: n = 40, held = 3, massless = 6

contains

  subroutine run_linalg_quadratic_tests()
    call run("quadratic: dense and by iteration", both_ways)
    call run("quadratic: singular stiffness", singular)
    call run("quadratic: identical to the bit", repeated)
  end subroutine run_linalg_quadratic_tests

  !> K positive plus an unsymmetric part, G of any kind, M without the last coordinates, where a few
  !> have resistance; `held` random constraints. `free`: K is zero on the first coordinates.
  subroutine make_problem(free, problem, k, g, m)
    integer, intent(in) :: free
    type(quadratic_t), intent(out) :: problem
    real(wp), intent(out) :: k(n + held, n + held), g(n, n), m(n, n)
    real(wp) :: a(n, n)
    integer :: i, j

    a = square( 1)
    k = 0
    k(:n, :n) = matmul(a, transpose(a)) + 0.2_wp*square( 2)
    k(:free, :) = 0
    k(:, :free) = 0
    a = square( 3)
    m = matmul(a, transpose(a))
    m(n - massless + 1:, :) = 0
    m(:, n - massless + 1:) = 0
    g = 0.3_wp*square( 4)
    g(n - 1:, :) = 0
    g(:, n - 1:) = 0
    a = square( 5)
    k(n + 1:, :n) = a(:held, :)
    k(n + 1:, :free) = 0
    k(:n, n + 1:) = transpose(k(n + 1:, :n))
    problem%coordinates = n
    problem%equations = n + held
    problem%row = [((i, i=1, n + held), j=1, n + held)]
    problem%column = [((j, i=1, n + held), j=1, n + held)]
    problem%k = reshape(k, [(n + held)**2])
    problem%m = 0*problem%k
    problem%g = 0*problem%k
    do j = 1, n
      problem%m((j - 1)*(n + held) + 1:(j - 1)*(n + held) + n) = m(:, j)
      problem%g((j - 1)*(n + held) + 1:(j - 1)*(n + held) + n) = g(:, j)
    end do
  end subroutine make_problem

  !> Entries between -1 and 1.
  function square(seed) result(a)
    integer, intent(in) :: seed
    real(wp) :: a(n, n)

    a = reshape(start_vector(n**2, seed), [n, n])
  end function square

  subroutine solve(problem, wanted, spectrum)
    type(quadratic_t), intent(in) :: problem
    integer, intent(in) :: wanted
    type(spectrum_t), intent(out) :: spectrum
    type(solver_t) :: solver
    type(error_t), allocatable :: error

    call solver%prepare(problem%equations, problem%row, problem%column, .false., error)
    call find_complex(solver, problem, wanted, spectrum, error)
    call expect(.not. allocated(error), "no error")
    call solver%free()
  end subroutine solve

  !> (lambda**2 M + lambda G + K) x + C' mu = 0 and C x = 0.
  subroutine expect_modes(spectrum, k, g, m)
    type(spectrum_t), intent(in) :: spectrum
    real(wp), intent(in) :: k(:, :), g(:, :), m(:, :)
    complex(wp) :: r(n + held)
    real(wp) :: size_of
    integer :: i

    do i = 1, spectrum%found
      associate (s => spectrum%lambda(i), x => spectrum%vector(:, i))
        r = matmul(k, x)
        r(:n) = r(:n) + matmul(s**2*m + s*g, x(:n))
        size_of = maxval(matmul(abs(k) + sum(abs(k))/size(k), abs(x))) &
                  + maxval(abs(s)**2*matmul(abs(m), abs(x(:n))))
        call expect_close(maxval(abs(r))/size_of, 0.0_wp, 1.0e-8_wp, "residual")
        if (i > 1) call expect(abs(s) >= 0.999999_wp*abs(spectrum%lambda(i - 1)), "in order")
        call expect(aimag(s) >= 0, "one of a pair")
      end associate
    end do
  end subroutine expect_modes

  subroutine both_ways()
    type(quadratic_t) :: problem
    type(spectrum_t) :: all, some
    real(wp) :: k(n + held, n + held), g(n, n), m(n, n)

    call make_problem(0, problem, k, g, m)
    call solve(problem, 8, all)
    call expect(all%found == 8 .and. all%complete, "eight, dense")
    call expect_modes(all, k, g, m)
    problem%dense_limit = 0
    call solve(problem, 8, some)
    call expect(some%found == 8 .and. .not. some%complete, "eight, by iteration")
    if (all%found /= 8 .or. some%found /= 8) return
    call expect_modes(some, k, g, m)
    call expect_close(maxval(abs(some%lambda - all%lambda)/abs(all%lambda)), 0.0_wp, 1.0e-9_wp, &
                      "eigenvalues")
  end subroutine both_ways

  !> Two coordinates without stiffness: lambda = 0 twice, each simple where they have resistance,
  !> double where they have none.
  subroutine singular()
    type(quadratic_t) :: problem
    type(spectrum_t) :: all
    real(wp) :: k(n + held, n + held), g(n, n), m(n, n)

    integer :: i

    do i = 1, 2
      call make_problem(2, problem, k, g, m)
      if (i == 2) then
        g = 0
        problem%g = 0
      end if
      call solve(problem, 6, all)
      call expect(all%found == 6, "six")
      if (all%found /= 6) return
      call expect_close(abs(all%lambda(1:2)), [0, 0]*1.0_wp, 0.0_wp, "zero")
      call expect(abs(all%lambda(3)) > 1.0e-3_wp, "not more")
      call expect_modes(all, k, g, m)
    end do
  end subroutine singular

  subroutine repeated()
    type(quadratic_t) :: problem
    type(spectrum_t) :: first, second
    real(wp) :: k(n + held, n + held), g(n, n), m(n, n)

    call make_problem(0, problem, k, g, m)
    problem%dense_limit = 0
    call solve(problem, 5, first)
    call solve(problem, 5, second)
    call expect(first%found == 5 .and. second%found == 5, "five")
    if (first%found /= 5 .or. second%found /= 5) return
    call expect_close(maxval(abs(first%vector - second%vector)), 0.0_wp, 0.0_wp, "vectors")
  end subroutine repeated

end module test_linalg_quadratic
