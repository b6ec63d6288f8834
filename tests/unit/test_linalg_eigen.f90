!> Eigenpairs of chains of springs and masses, whose frequencies are closed forms.
module test_linalg_eigen
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use linalg_solver, only: solver_t
  use linalg_eigen, only: pencil_t, pairs_t, find_pairs, estimate_theta
  use linalg_spectrum, only: find_spectrum, count_between
  implicit none
  private

  public :: run_linalg_eigen_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_linalg_eigen_tests()
    call run("eigen: a chain, dense and by Lanczos", one_chain)
    call run("eigen: two equal chains, every eigenvalue twice", two_chains)
    call run("eigen: theta of both signs", both_signs)
    call run("eigen: a constraint and massless coordinates", constrained)
    call run("eigen: many constraints, few degrees of freedom", few_freedoms)
    call run("eigen: more pairs wanted than there are", exhausted)
    call run("eigen: eigenvalues are counted by inertia", counted)
    call run("eigen: Lanczos repeats itself to the bit", repeated)
  end subroutine run_linalg_eigen_tests

  !> Eigenvalue k of n unit masses on n + 1 unit springs between walls.
  elemental real(wp) function chain_value(n, k)
    integer, intent(in) :: n, k

    chain_value = 4*sin(k*pi/(2*(n + 1)))**2
  end function chain_value

  !> Chains of n masses, `weights(c)` in chain c, one behind the other; the solver holds the
  !> factors. `held`: a mass that a constraint holds; 0: none.
  subroutine make_chains(n, weights, held, dense, solver, pencil)
    integer, intent(in) :: n, held
    real(wp), intent(in) :: weights(:)
    logical, intent(in) :: dense
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(out) :: pencil
    type(error_t), allocatable :: error
    integer :: c, i, m

    m = n*size(weights)
    pencil%coordinates = m
    pencil%equations = m + merge(1, 0, held > 0)
    pencil%row = [(i, i=1, m), (i, i=2, m)]
    pencil%column = [(i, i=1, m), (i, i=1, m - 1)]
    pencil%a = [spread(2.0_wp, 1, m), spread(-1.0_wp, 1, m - 1)]
    pencil%q = 0*pencil%a
    do c = 1, size(weights)
      if (c < size(weights)) pencil%a(m + c*n) = 0
      pencil%q((c - 1)*n + 1:c*n) = weights(c)
    end do
    if (held > 0) then
      pencil%row = [pencil%row, m + 1]
      pencil%column = [pencil%column, held]
      pencil%a = [pencil%a, 1.0_wp]
      pencil%q = [pencil%q, 0.0_wp]
    end if
    pencil%semidefinite = all(weights >= 0)
    pencil%dense_limit = merge(huge(1), 0, dense)
    call solver%prepare(pencil%equations, pencil%row, pencil%column, .true., error)
    if (.not. allocated(error)) call solver%factorize(pencil%a, error)
    call expect(.not. allocated(error), "factors")
  end subroutine make_chains

  !> Eigenvalues and, up to sign, vectors of unit energy: x'A x = 1.
  subroutine one_chain()
    integer, parameter :: n = 300
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs
    type(error_t), allocatable :: error
    integer :: method, i, j
    real(wp) :: exact(n)

    do method = 1, 2
      call make_chains(n, [1.0_wp], 0, method == 1, solver, pencil)
      call find_pairs(solver, pencil, [5, 0], pairs, error)
      call expect(.not. allocated(error) .and. all(pairs%found == [5, 0]), "five pairs")
      if (pairs%found(1) /= 5) cycle
      call expect_close(1/pairs%theta/chain_value(n, [1, 2, 3, 4, 5]), spread(1.0_wp, 1, 5), &
                        1.0e-10_wp, "eigenvalues over the exact ones")
      do i = 1, 5
        exact = [(sin(i*pi*j/(n + 1)), j=1, n)]
        exact = exact/sqrt(0.5_wp*(n + 1)*chain_value(n, i))
        associate (x => pairs%vector(:, i))
          call expect_close(sign(1.0_wp, dot_product(x, exact))*x/maxval(exact), &
                            exact/maxval(exact), 1.0e-7_wp, "vector")
        end associate
      end do
    end do
    call solver%free()
  end subroutine one_chain

  !> Seven wanted: the fourth eigenvalue is met twice although only one of it is wanted.
  subroutine two_chains()
    integer, parameter :: n = 200
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs
    type(error_t), allocatable :: error
    logical :: complete
    integer :: method

    do method = 1, 2
      call make_chains(n, [1.0_wp, 1.0_wp], 0, method == 1, solver, pencil)
      call find_spectrum(solver, pencil, [7, 0], [2*n, 0], pairs, complete, error)
      call expect(.not. allocated(error) .and. complete, "complete")
      call expect(pairs%found(1) >= 7, "seven pairs")
      if (pairs%found(1) < 7) cycle
      call expect_close(1/pairs%theta(:7)/chain_value(n, [1, 1, 2, 2, 3, 3, 4]), &
                        spread(1.0_wp, 1, 7), 1.0e-9_wp, "each twice")
    end do
    call solver%free()
  end subroutine two_chains

  !> Weights 1 and -2: theta = 1/value and -2/value.
  subroutine both_signs()
    integer, parameter :: n = 150
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs
    type(error_t), allocatable :: error
    integer :: method
    real(wp) :: theta

    do method = 1, 2
      call make_chains(n, [1.0_wp, -2.0_wp], 0, method == 1, solver, pencil)
      call estimate_theta(solver, pencil, theta, error)
      call expect(theta <= 2.000001_wp/chain_value(n, 1) .and. theta > 1/chain_value(n, 1), &
                  "estimate of the largest theta")
      call find_pairs(solver, pencil, [2, 3], pairs, error)
      call expect(.not. allocated(error) .and. all(pairs%found == [2, 3]), "two and three pairs")
      if (any(pairs%found /= [2, 3])) cycle
      call expect_close(1/pairs%theta/chain_value(n, [1, 2, 1, 2, 3])*[1, 1, -2, -2, -2], &
                        spread(1.0_wp, 1, 5), 1.0e-9_wp, "positive, then negative ones")
    end do
    call solver%free()
  end subroutine both_signs

  !> Held in the middle, a chain is two of half the size; every other mass zero changes it to one
  !> of half as many springs of half the stiffness.
  subroutine constrained()
    integer, parameter :: n = 299
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs
    type(error_t), allocatable :: error
    integer :: method

    do method = 1, 2
      call make_chains(n, [1.0_wp], (n + 1)/2, method == 1, solver, pencil)
      pencil%q(1:n:2) = 0
      call find_pairs(solver, pencil, [4, 0], pairs, error)
      call expect(.not. allocated(error) .and. pairs%found(1) == 4, "four pairs")
      if (pairs%found(1) /= 4) cycle
      call expect_close(2/pairs%theta/chain_value(74, [1, 1, 2, 2]), spread(1.0_wp, 1, 4), &
                        1.0e-9_wp, &
                        "half chains, with half the masses")
      call expect_close(pairs%vector((n + 1)/2, :), spread(0.0_wp, 1, 4), 1.0e-12_wp, "held mass")
      ! the multiplier is the force that holds the mass: what its two springs pull
      call expect_close(pairs%vector(n + 1, :), pairs%vector((n - 1)/2, :) + &
                        pairs%vector((n + 3)/2, :), 1.0e-8_wp, "multipliers")
    end do
    call solver%free()
  end subroutine constrained

  !> Groups of eight masses are each held together by constraints, x(i) = x(i + 1): a chain of heavy
  !> masses, with a unit spring between two.
  subroutine few_freedoms()
    integer, parameter :: n = 240, group = 8, heavy = n/group
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs
    type(error_t), allocatable :: error
    logical :: complete
    integer :: i, k, m

    call make_chains(n, [1.0_wp], 0, .true., solver, pencil)
    m = n - heavy
    k = 0
    do i = 1, n - 1
      if (modulo(i, group) == 0) cycle
      k = k + 1
      pencil%row = [pencil%row, n + k, n + k]
      pencil%column = [pencil%column, i, i + 1]
      pencil%a = [pencil%a, 1.0_wp, -1.0_wp]
      pencil%q = [pencil%q, 0.0_wp, 0.0_wp]
    end do
    pencil%equations = n + m
    pencil%dense_limit = 60
    call solver%prepare(n + m, pencil%row, pencil%column, .true., error)
    call solver%factorize(pencil%a, error)
    call find_spectrum(solver, pencil, [40, 0], [heavy, 0], pairs, complete, error)
    call expect(.not. allocated(error) .and. complete .and. pairs%found(1) == heavy, "all, no more")
    if (pairs%found(1) /= heavy) return
    call expect_close(group/pairs%theta(:heavy)/chain_value(heavy, [(i, i=1, heavy)]), &
                      spread(1.0_wp, 1, heavy), 1.0e-9_wp, "heavy masses")
    call solver%free()
  end subroutine few_freedoms

  !> Three masses and one of them held have two pairs.
  subroutine exhausted()
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs
    type(error_t), allocatable :: error
    logical :: complete

    call make_chains(3, [1.0_wp], 2, .true., solver, pencil)
    call find_spectrum(solver, pencil, [2, 0], [2, 0], pairs, complete, error)
    call expect(.not. allocated(error) .and. complete .and. pairs%found(1) == 2, "two, all")
    call expect_close(1/pairs%theta(:2), [2.0_wp, 2.0_wp], 1.0e-12_wp, "both alone")
    call solver%free()
  end subroutine exhausted

  subroutine counted()
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(error_t), allocatable :: error
    integer :: k, number

    call make_chains(40, [1.0_wp, -1.0_wp], 0, .true., solver, pencil)
    do k = 1, 39, 6
      call count_between(solver, pencil, 0.5_wp*(chain_value(40, k) + chain_value(40, k + 1)), &
                         number, error)
      call expect(number == k, "positive ones below a shift")
      call count_between(solver, pencil, -1.01_wp*chain_value(40, k), number, error)
      call expect(number == k, "negative ones above a shift")
    end do
    call solver%free()
  end subroutine counted

  subroutine repeated()
    type(solver_t) :: solver
    type(pencil_t) :: pencil
    type(pairs_t) :: pairs(2)
    type(error_t), allocatable :: error
    integer :: i

    do i = 1, 2
      call make_chains(250, [1.0_wp, -2.0_wp], 0, .false., solver, pencil)
      call find_pairs(solver, pencil, [3, 3], pairs(i), error)
    end do
    call expect(all(abs(pairs(1)%vector - pairs(2)%vector) <= 0), "vectors")
    call expect(all(abs(pairs(1)%theta - pairs(2)%theta) <= 0), "theta")
    call solver%free()
  end subroutine repeated

end module test_linalg_eigen
