!> The matrices of small motions about a state: those in the result file, and the tangent of the
!> centrifugal forces.
module test_linear_matrices
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use diagnostics, only: report_t
  use deck_reader, only: read_deck
  use model_data, only: model_t, setting_t
  use nodal_state, only: state_t, new_state, coordinate_number
  use rotation, only: cross, skew
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_inertia, only: mass_centre
  use system_rotation, only: add_rotation, spin_at
  use program_runs, only: outcome_t, run_spar, scratch
  use result_reader, only: get_reals, get_integers
  implicit none
  private

  public :: run_linear_matrices_tests

contains

  subroutine run_linear_matrices_tests()
    call run("turning: centrifugal forces and their tangent by differences", tangent)
    call run("matrices: they have the modes found", matrices)
  end subroutine run_linear_matrices_tests

  !> About an axis beside the origin, of a deformed model: the forces are those of the mass at its
  !> centre, the tangent is their derivative and half the skew of the moments (theory 1).
  subroutine tangent()
    type(model_t) :: model
    type(report_t) :: report
    type(error_t), allocatable :: error
    type(system_t) :: system
    type(state_t) :: state
    type(setting_t) :: setting(1)
    real(wp), allocatable :: total(:), values(:), found(:, :), wanted(:, :), move(:)
    real(wp), allocatable :: column(:)
    real(wp) :: spin(3), level(1), sums(3), arm(3)
    real(wp), parameter :: h = 1.0e-4_wp
    integer :: i, k, at(3)

    setting(1) = setting_t("rate", "3")
    call read_deck("tests/cases/rotating/proportional.deck", setting, model, report, error)
    call build_system(model, system)
    call find_system_pattern(system, unsymmetric=.true.)
    call new_state(system%nodes, 0, 0, state)
    call state%move([(0.3_wp*sin(1.7_wp*k), k=1, system%coordinates)])
    level = 0.7_wp
    spin = spin_at(system, level)
    call expect_close(spin, 0.7_wp*3*[0.0_wp, 0.6_wp, 0.8_wp], 1.0e-14_wp, "rate")
    allocate (values(size(system%pattern%row)), wanted(system%unknowns, system%unknowns))
    allocate (found, mold=wanted)
    call forces(state, total, values)
    sums = [(sum(total(i::7)), i=1, 3)]
    arm = mass_centre(system%masses, state) - [-1.0_wp, 0.0_wp, 0.0_wp]
    call expect_close(sums, -system%masses%total*cross(spin, cross(spin, arm)), 1.0e-10_wp, &
                      "forces")
    found = 0
    do i = 1, size(values)
      if (max(system%pattern%row(i), system%pattern%column(i)) > system%unknowns) cycle
      found(system%pattern%row(i), system%pattern%column(i)) = values(i)
    end do
    do k = 1, system%coordinates
      if (system%unknown(k) == 0) cycle
      move = 0*total
      move(k) = h
      column = (change(2*move) - 8*change(move))/(12*h)
      wanted(:, system%unknown(k)) = pack(column, system%unknown > 0)
    end do
    do i = 1, system%nodes
      at = system%unknown(coordinate_number(i, [4, 5, 6]))
      if (any(at == 0)) cycle
      wanted(at, at) = wanted(at, at) - 0.5_wp*skew(total(coordinate_number(i, [4, 5, 6])))
    end do
    call expect_close(found, wanted, 1.0e-9_wp, "tangent")
    call expect_close(found, transpose(found), 1.0e-12_wp, "a Hessian")
    call expect(maxval(abs(total(4::7))) > 1.0e-4_wp, "with moments")
    call system%free()

  contains

    subroutine forces(place, total, values)
      type(state_t), intent(in) :: place
      real(wp), allocatable, intent(out) :: total(:)
      real(wp), intent(out) :: values(:)

      allocate (total(system%coordinates))
      total = 0
      values = 0
      call add_rotation(system, place, spin, total, values)
    end subroutine forces

    function change(move)
      real(wp), intent(in) :: move(:)
      real(wp) :: change(size(move)), unused(size(values))
      real(wp), allocatable :: ahead(:), behind(:)
      type(state_t) :: place

      place = state
      call place%move(move)
      call forces(place, ahead, unused)
      place = state
      call place%move(-move)
      call forces(place, behind, unused)
      change = ahead - behind
    end function change
  end subroutine tangent

  !> (lambda**2 M + lambda C + K + G - N) x = 0 from the file, of a turning, damped, loaded beam.
  subroutine matrices()
    character(len=:), allocatable :: path
    character(len=*), parameter :: group = "analysis/02_eigen/"
    type(outcome_t) :: outcome
    real(wp), allocatable :: lambda(:), re(:, :), im(:, :)
    real(wp), allocatable, dimension(:, :) :: k, g, n, c, m
    complex(wp), allocatable :: x(:)
    complex(wp) :: s
    integer, allocatable :: coordinate(:), extents(:)
    integer :: i

    path = scratch("matrices.h5")
    call run_spar("run tests/cases/rotating/proportional.deck -D rate=3 --quiet -o "//path, outcome)
    call expect(outcome%status == 0, "it runs")
    call get_reals(path, group//"complex_eigenvalue", lambda, extents)
    call get_integers(path, group//"matrices/coordinate", coordinate, extents)
    call read_motion(path, "", re)
    call read_motion(path, "_imaginary", im)
    call read_matrix("K", k)
    call read_matrix("G", g)
    call read_matrix("N", n)
    call read_matrix("C", c)
    call read_matrix("M", m)
    call expect(size(lambda) == 12 .and. size(k, 1) > 40, "all there")
    if (size(lambda) /= 12) return
    call expect_close(k, transpose(k), 1.0e-9_wp*maxval(abs(k)), "K is symmetric")
    call expect_close(m, transpose(m), 1.0e-12_wp*maxval(abs(m)), "M is symmetric")
    call expect(maxval(abs(c - transpose(c))) > 0.1_wp*maxval(abs(m)), "C is not")
    call expect(maxval(abs(g)) > 0 .and. maxval(abs(n)) > 0, "G and N are there")
    do i = 1, 6
      s = cmplx(lambda(2*i - 1), lambda(2*i), wp)
      x = [cmplx(re(coordinate_row(), i), im(coordinate_row(), i), wp)]
      call expect_close(maxval(abs(matmul(s**2*m + s*c + k + g - n, x))) &
                        /maxval(abs(matmul(abs(k), abs(x)))), 0.0_wp, 1.0e-10_wp, "a mode")
    end do

  contains

    !> Rows of the coordinates in a mode's motion, seven for each node.
    pure function coordinate_row() result(row)
      integer :: row(size(coordinate)/2)

      row = 7*coordinate(1::2) + coordinate(2::2)
    end function coordinate_row

    subroutine read_matrix(name, matrix)
      character(len=*), intent(in) :: name
      real(wp), allocatable, intent(out) :: matrix(:, :)
      real(wp), allocatable :: value(:)
      integer, allocatable :: start(:), column(:), extents(:)
      integer :: i, j

      call get_integers(path, group//"matrices/"//name//"/row_start", start, extents)
      call get_integers(path, group//"matrices/"//name//"/column", column, extents)
      call get_reals(path, group//"matrices/"//name//"/value", value, extents)
      allocate (matrix(size(start) - 1, size(start) - 1))
      matrix = 0
      do i = 1, size(start) - 1
        do j = start(i) + 1, start(i + 1)
          matrix(i, column(j) + 1) = value(j)
        end do
      end do
    end subroutine read_matrix
  end subroutine matrices

  !> Motion of the modes, (7 nodes, modes).
  subroutine read_motion(path, suffix, motion)
    character(len=*), intent(in) :: path, suffix
    real(wp), allocatable, intent(out) :: motion(:, :)
    character(len=*), parameter :: nodes = "analysis/02_eigen/modes/nodes/"
    real(wp), allocatable :: u(:), r(:), w(:)
    integer, allocatable :: extents(:)
    real(wp), allocatable :: all(:, :)

    call get_reals(path, nodes//"displacement"//suffix, u, extents)
    call get_reals(path, nodes//"rotation"//suffix, r, extents)
    call get_reals(path, nodes//"warping"//suffix, w, extents)
    allocate (all(7, size(w)))
    all(1:3, :) = reshape(u, [3, size(w)])
    all(4:6, :) = reshape(r, [3, size(w)])
    all(7, :) = w
    motion = reshape(all, [7*size(w)/6, 6])
  end subroutine read_motion

end module test_linear_matrices
