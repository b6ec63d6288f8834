!> Linear solver in a band: narrow orders, regular matrices, and singular ones, which have to come
!> out as without the band.
module test_linalg_band
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use linalg_order, only: narrow_order
  use linalg_band, only: band_t
  use linalg_solver, only: solver_t
  use linalg_samples, only: coordinates, known, mixed_units, random_matrix, mix_units
  implicit none
  private

  public :: run_linalg_band_tests

  integer, parameter :: never = -1, always = 1000  !< band_limit

contains

  subroutine run_linalg_band_tests()
    integer :: i, n

    call random_seed(size=n)
    call random_seed(put=[(20261130 + 7*i, i=1, n)])
    call run("linalg: narrow order of chains", test_order)
    call run("linalg: solutions in a band", test_solutions)
    call run("linalg: row exchanges in a band", test_exchanges)
    call run("linalg: singular matrices in a band", test_singular)
    call run("linalg: free-floating chain in a band", test_free_chain)
  end subroutine run_linalg_band_tests

  !> Blocks of `size` unknowns that overlap by half, in the order of the chain.
  subroutine chain(blocks, half, a)
    integer, intent(in) :: blocks, half
    real(wp), intent(out) :: a((blocks + 1)*half, (blocks + 1)*half)
    integer :: b, i

    a = 0
    do b = 1, blocks
      i = (b - 1)*half
      a(i + 1:i + 2*half, i + 1:i + 2*half) = random_matrix(2*half, 2*half)
    end do
  end subroutine chain

  !> Any order of n unknowns.
  function scrambled(n) result(order)
    integer, intent(in) :: n
    integer :: order(n), i

    order = [(1 + modulo(37*i, n), i=1, n)]  ! n not a multiple of 37
  end function scrambled

  !> A chain of blocks of 7 in any order has width 13; two that do not hang together as well. A
  !> branch in the middle costs one block.
  subroutine test_order()
    real(wp), allocatable :: a(:, :), b(:, :)
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: values(:)
    integer :: order(140), width, i

    allocate (a(70, 70), b(140, 140))
    call chain(9, 7, a)
    associate (mix => scrambled(70))
      call coordinates(a(mix, mix), .false., row, column, values)
    end associate
    call narrow_order(70, row, column, order(:70), width)
    call expect(width == 13, "one chain")
    call expect(all([(any(order(:70) == i), i=1, 70)]), "every unknown")
    b = 0
    b(:70, :70) = a
    b(71:, 71:) = a
    associate (mix => scrambled(140))
      call coordinates(b(mix, mix), .false., row, column, values)
    end associate
    call narrow_order(140, row, column, order, width)
    call expect(width == 13, "two chains")
    call expect(all([(any(order == i), i=1, 140)]), "every unknown of both")
    b(29:42, 71:77) = 1
    b(71:77, 29:42) = 1
    call coordinates(b, .false., row, column, values)
    call narrow_order(140, row, column, order, width)
    call expect(width > 13 .and. width <= 27, "a branch")
  end subroutine test_order

  !> Factors in a band, without a limit to its width, or by the others.
  subroutine factorize(a, band_limit, solver)
    real(wp), intent(in) :: a(:, :)
    integer, intent(in) :: band_limit
    type(solver_t), intent(inout) :: solver
    type(error_t), allocatable :: error
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: values(:)

    call coordinates(a, .false., row, column, values)
    call solver%prepare(size(a, 1), row, column, .false., error, band_limit=band_limit)
    if (.not. allocated(error)) call solver%factorize(values, error)
    call expect(.not. allocated(error), "no error")
  end subroutine factorize

  !> Known solutions of scrambled chains with units apart; the residual of each equation is
  !> round-off of its terms, and the determinant has the sign that the dense factors give it.
  subroutine test_solutions()
    type(solver_t) :: solver
    type(error_t), allocatable :: error
    real(wp), allocatable :: a(:, :), x(:), wanted(:), terms(:)
    integer :: blocks, sign_of, n, i

    do blocks = 3, 40, 9
      n = 5*(blocks + 1)
      if (allocated(a)) deallocate (a)
      allocate (a(n, n))
      call chain(blocks, 5, a)
      associate (mix => scrambled(n))
        a = a(mix, mix)
      end associate
      call mix_units(a, mixed_units(n))
      wanted = known(n)/mixed_units(n)
      call factorize(a, never, solver)
      sign_of = solver%determinant_sign()
      call factorize(a, always, solver)
      call expect(abs(sign_of) == 1, "a determinant")
      call expect(solver%determinant_sign() == sign_of, "its sign")
      x = matmul(a, wanted)
      call solver%solve(x, error)
      terms = [(dot_product(abs(a(i, :)), abs(wanted)), i=1, n)]
      call expect(all(abs(matmul(a, x) - matmul(a, wanted)) <= 1.0e-12_wp*terms), "residual")
      call expect(size(solver%null_pivots()) == 0, "no null pivots")
    end do
    call solver%free()
  end subroutine test_solutions

  !> [1e-3, C'; C, 0]: every pivot has to be looked for below the diagonal. The factors solve the
  !> system of the band alone, whatever the solver would do with it.
  subroutine test_exchanges()
    type(band_t) :: band
    type(error_t), allocatable :: error
    integer, parameter :: n = 40
    real(wp) :: a(n, n), x(n)
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: values(:)
    integer :: i

    a = 0
    do i = 1, n - 1
      a(i, i) = merge(1.0e-3_wp, 0.0_wp, modulo(i, 2) == 1)
      a(i, i + 1) = merge(1.0_wp, 0.5_wp, modulo(i, 2) == 1)
      a(i + 1, i) = a(i, i + 1)
    end do
    call coordinates(a, .false., row, column, values)
    call band%prepare(n, row, column, always)
    call band%factorize(values, error)
    call expect(.not. allocated(error) .and. band%regular, "regular")
    x = matmul(a, known(n))
    call band%solve(x, error)
    call expect(.not. allocated(error), "solved")
    call expect_close(x, known(n), 1.0e-12_wp, "solution")
    call band%free()
  end subroutine test_exchanges

  !> An empty column, and one that depends on its neighbours: the null unknowns and the solution
  !> are those of the other factorizations, dense and sparse; a regular matrix afterwards is solved.
  subroutine test_singular()
    type(solver_t) :: solver, judge
    type(error_t), allocatable :: error
    real(wp), allocatable :: a(:, :), b(:), x(:), y(:)
    integer :: i, n

    do i = 1, 2
      n = merge(60, 200, i == 1)  ! dense, sparse
      allocate (a(n, n))
      call chain(n/5 - 1, 5, a)
      a(:, 17) = 0
      a(:, 33) = 2*a(:, 32) - a(:, 31)
      b = matmul(a, known(n))
      call factorize(a, never, judge)
      call factorize(a, always, solver)
      call expect(size(solver%null_pivots()) == 2, "two null pivots")
      call expect(any(solver%null_pivots() == 17), "the empty column is one")
      call expect(all(solver%null_pivots() == judge%null_pivots()), "the same two")
      call expect(solver%determinant_sign() == 0, "no determinant")
      x = b
      y = b
      call solver%solve(x, error)
      call judge%solve(y, error)
      call expect_close(x, y, 0.0_wp, "the same solution")
      call expect_close(matmul(a, x), b, 1.0e-8_wp, "residual")
      deallocate (a)
    end do
    call solver%free()
    call judge%free()
  end subroutine test_singular

  !> A free chain of beams in bending, unequal so that round-off hides the zeros, of ten to a
  !> thousand elements: null pivots are found, and are those found without a band; the same chain on
  !> a soft ground is regular.
  subroutine test_free_chain()
    type(solver_t) :: solver, judge
    type(error_t), allocatable :: error
    integer, parameter :: elements(4) = [10, 30, 100, 1000]
    real(wp) :: k(4, 4)
    real(wp), allocatable :: values(:), x(:)
    integer, allocatable :: row(:), column(:)
    integer :: c, i, n

    k = reshape([12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4]*1.0_wp, [4, 4])
    do c = 1, size(elements)
      n = 2*elements(c) + 2
      call beam_entries(elements(c), k, row, column, values)
      call solver%prepare(n, row, column, .false., error)
      call solver%factorize(values, error)
      call judge%prepare(n, row, column, .false., error, band_limit=never)
      call judge%factorize(values, error)
      call expect(size(solver%null_pivots()) > 0, "null pivots")
      call expect_close(1.0_wp*solver%null_pivots(), 1.0_wp*judge%null_pivots(), 0.0_wp, "the same")
      values = values + merge(1.0e-2_wp, 0.0_wp, row == column)
      call solver%factorize(values, error)
      call expect(size(solver%null_pivots()) == 0, "none on the ground")
      x = [(dot_product(pack(values, row == i), known_at(pack(column, row == i), n)), i=1, n)]
      call solver%solve(x, error)
      call expect_close(x, known(n), 1.0e-9_wp, "on the ground")
    end do
    call solver%free()
    call judge%free()
  end subroutine test_free_chain

  pure function known_at(place, n) result(x)
    integer, intent(in) :: place(:), n
    real(wp) :: x(size(place)), all_of(n)

    all_of = known(n)
    x = all_of(place)
  end function known_at

  !> Entries of a chain of elements with the matrix k; two unknowns at each node.
  subroutine beam_entries(elements, k, row, column, values)
    integer, intent(in) :: elements
    real(wp), intent(in) :: k(4, 4)
    integer, allocatable, intent(out) :: row(:), column(:)
    real(wp), allocatable, intent(out) :: values(:)
    real(wp) :: stiffness(elements)
    integer :: i, j, e, node, filled

    stiffness = known(elements)
    allocate (row(12*elements + 4), column(12*elements + 4), values(12*elements + 4))
    filled = 0
    do i = 1, 2*elements + 2
      node = (i + 1)/2
      do j = max(1, 2*node - 3), min(2*elements + 2, 2*node + 2)
        filled = filled + 1
        row(filled) = i
        column(filled) = j
        values(filled) = 0
        do e = max(1, node - 1), min(elements, node)
          if (j < 2*e - 1 .or. j > 2*e + 2) cycle
          values(filled) = values(filled) + stiffness(e)*k(i - 2*e + 2, j - 2*e + 2)
        end do
      end do
    end do
  end subroutine beam_entries

end module test_linalg_band
