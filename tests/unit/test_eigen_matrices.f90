!> The matrices that EIGEN MATRICES ON leaves in the result file.
module test_eigen_matrices
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use program_runs, only: outcome_t, run_spar, scratch
  use result_reader, only: get_reals, get_integers
  implicit none
  private

  public :: run_eigen_matrices_tests

contains

  subroutine run_eigen_matrices_tests()
    call run("matrices: they have the modes found", matrices)
  end subroutine run_eigen_matrices_tests

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

end module test_eigen_matrices
