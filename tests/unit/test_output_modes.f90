!> Joints in the modes of result files: their strains and stresses, and how they are drawn.
module test_output_modes
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  use result_reader, only: get_reals, get_integers
  implicit none
  private

  public :: run_output_modes_tests

  character(len=*), parameter :: break = new_line("a")
  real(wp), parameter :: spring = 40.0_wp, ea = 90.0_wp, mass = 5.0_wp, arm = 2.0_wp, rod = 3.0_wp
  real(wp), parameter :: u0 = 1/sqrt(mass)   !< modes have the modal mass 1

contains

  subroutine run_output_modes_tests()
    call run("modes: joints in the file", test_joints)
    call run("modes: joints in the drawing", test_drawing)
    call run("modes: damped joints", test_damped)
  end subroutine run_output_modes_tests

  !> A mass on a rigid arm that turns on a sprung hinge, held by an elastic truss across the arm:
  !> for a displacement u the hinge turns by u/arm, the truss is shortened by u.
  subroutine solve(name, analysis, path)
    character(len=*), intent(in) :: name, analysis
    character(len=:), allocatable, intent(out) :: path
    type(outcome_t) :: outcome

    call make_file(scratch(name//".deck"), "NODE 1 0 0 0"//break//"NODE 2 2 0 0"//break// &
      "NODE 4 2 3 0"//break//"BEAM 1 1 2 0 1 0"//break//"HINGE 5 3 1 0 0 1"//break// &
      "TRUSS 7 2 4"//break//"DYNE 5 1"//break//"DYNE 7 1"//break//"ESTIFF 5 40"//break// &
      "ESTIFF 7 90"//break//"EDAMP 5 2"//break//"XM 2 5"//break//"FIX 1 X Y Z"//break// &
      "FIX 3"//break//"FIX 4"//break//analysis)
    path = scratch(name//".h5")
    call run_spar("run "//scratch(name//".deck")//" --quiet -o "//path, outcome)
    call expect(outcome%status == 0, "it runs: "//outcome%errors)
  end subroutine solve

  !> The only mode, by displacement, and its frequency.
  subroutine test_joints()
    character(len=:), allocatable :: path
    real(wp), allocatable :: square(:), u(:), strain(:), stress(:)
    integer, allocatable :: extents(:)
    real(wp) :: wanted(12)

    call solve("joint_modes", "EIGEN MODES 1", path)
    call get_reals(path, "analysis/01_eigen/eigenvalue", square, extents)
    call expect_close(square, [(spring/arm**2 + ea/rod)/mass], 1.0e-12_wp*square(1), &
                      "omega squared")
    call get_reals(path, "analysis/01_eigen/modes/nodes/displacement", u, extents)
    call expect_close(u(5), u0, 1.0e-14_wp, "node 2 moves across")
    call get_reals(path, "analysis/01_eigen/modes/joints/strain", strain, extents)
    call expect(all(extents == [2, 6]), "two joints, six strains")
    wanted = 0
    wanted([1, 7]) = [u0/arm, -u0]
    call expect_close(strain, wanted, 1.0e-12_wp, "angle and shortening")
    call get_reals(path, "analysis/01_eigen/modes/joints/stress", stress, extents)
    call expect_close(stress([1, 7]), u0*[spring/arm, -ea/rod], 1.0e-11_wp, "moment and force")
  end subroutine test_joints

  !> Five points of the arm, two of the truss, and the node of the hinge that has a place.
  subroutine test_drawing()
    character(len=:), allocatable :: path
    real(wp), allocatable :: points(:), motion(:), turn(:), force(:)
    integer, allocatable :: kinds(:), corners(:), extents(:)

    call solve("joint_drawing", "EIGEN MODES 1", path)
    call get_integers(path, "VTKHDF/Types", kinds, extents)
    call expect(size(kinds) == 6, "four lines, a truss, a dot")
    if (size(kinds) /= 6) return
    call expect(all(kinds == [3, 3, 3, 3, 3, 1]), "types")
    call get_integers(path, "VTKHDF/Connectivity", corners, extents)
    call expect(all(corners(9:) == [5, 6, 7]), "truss and dot have points of their own")
    call get_reals(path, "VTKHDF/Points", points, extents)
    call expect(size(points) == 24, "eight points")
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call get_reals(path, "VTKHDF/PointData/rotation", turn, extents)
    call get_reals(path, "VTKHDF/CellData/section_force", force, extents)
    if (any([size(points), size(motion), size(turn)] /= 24) .or. size(force) /= 42) return
    call expect_close(points(22:), [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, "the dot is at the hinge")
    call expect_close(motion(22:), [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, "which stays")
    call expect_close(turn(22:), [0.0_wp, 0.0_wp, u0/arm], 1.0e-6_wp, "and turns")
    call expect_close(motion(16:18), [0.0_wp, u0, 0.0_wp], 1.0e-7_wp, "the truss follows")
    call expect_close(force(29:35), [-u0*ea/rod, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
                      2.0e-6_wp, "its force")
    call expect_close(force(36:), [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], &
                      0.0_wp, "the dot has none")
  end subroutine test_drawing

  !> Complex modes: angle and displacement stay in phase, so do imaginary parts.
  subroutine test_damped()
    character(len=:), allocatable :: path
    real(wp), allocatable :: u(:), v(:), re(:), im(:)
    integer, allocatable :: extents(:)

    call solve("joint_damped", "EIGEN MODES 1 DAMPED", path)
    call get_reals(path, "analysis/01_eigen/modes/nodes/displacement", u, extents)
    call get_reals(path, "analysis/01_eigen/modes/nodes/displacement_imaginary", v, extents)
    call get_reals(path, "analysis/01_eigen/modes/joints/strain", re, extents)
    call get_reals(path, "analysis/01_eigen/modes/joints/strain_imaginary", im, extents)
    call expect(size(re) >= 12 .and. size(im) == size(re), "both parts")
    if (size(re) < 12 .or. size(im) /= size(re)) return
    call expect_close([re(1), im(1)], [u(5), v(5)]/arm, 1.0e-12_wp, "the angle")
    call expect_close([re(7), im(7)], -[u(5), v(5)], 1.0e-12_wp, "the shortening")
    call get_reals(path, "analysis/01_eigen/modes/joints/stress_imaginary", im, extents)
    call expect_close(im([1, 7]), [spring*v(5)/arm, -ea/rod*v(5)], 1.0e-10_wp, "elastic stresses")
  end subroutine test_damped

end module test_output_modes
