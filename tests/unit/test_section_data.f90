module test_section_data
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use section_data, only: section_constants_t, section_geometry_t, principal_point, warping_at, &
    axial_stress
  use section_shapes, only: shape_dimensions_t, shape_section
  use test_section_kit, only: draw, zed_points, zed_plates, zed_thickness
  implicit none
  private

  public :: run_section_data_tests

contains

  subroutine run_section_data_tests()
    call run("section data: places in the user's axes", places)
    call run("section data: warping coordinate along the walls", warping)
    call run("section data: stress adds up to the section forces", stress)
  end subroutine run_section_data_tests

  !> A drawing counts from its origin, a shape from its centroid, both in the user's axes.
  subroutine places()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    type(shape_dimensions_t) :: size
    type(error_t), allocatable :: error
    real(wp), parameter :: root = sqrt(0.5_wp)

    call draw(zed_points, zed_plates, zed_thickness, c, geometry)
    ! nodes_principal of beamw_element.json
    call expect_close(principal_point(geometry, [-80.0_wp, 100.0_wp]), &
                      [-47.55637371326382_wp, 115.43201875455199_wp], 1.0e-10_wp, "PLATES")
    size%h = 50
    size%b = 50
    size%t = 5
    call shape_section("L", size, 0.3_wp, c, geometry, error)
    call expect(.not. allocated(error), "an angle")
    call expect_close(principal_point(geometry, [0.0_wp, 0.0_wp]), [0.0_wp, 0.0_wp], 1.0e-12_wp, &
                      "the centroid of a shape")
    ! principal axes at 45 degrees: the user's y is at y = root, z = -root
    call expect_close(principal_point(geometry, [2.0_wp, 0.0_wp]), [2*root, -2*root], 1.0e-12_wp, &
                      "shape, turned")
  end subroutine places

  !> Linear on the midline, the same within the wall, unknown off it or without walls.
  subroutine warping()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    type(shape_dimensions_t) :: size
    type(error_t), allocatable :: error
    real(wp) :: omega
    logical :: known

    call draw(zed_points, zed_plates, zed_thickness, c, geometry)
    call warping_at(geometry, principal_point(geometry, [2.9_wp, -50.0_wp]), omega, known)
    call expect(known, "within the web")
    call expect_close(omega, 0.25_wp*geometry%omega(2) + 0.75_wp*geometry%omega(3), 1.0e-9_wp, &
                      "a quarter up the web")
    call warping_at(geometry, principal_point(geometry, zed_points(:, 4)), omega, known)
    call expect_close(omega, geometry%omega(4), 1.0e-9_wp, "at the tip")
    call warping_at(geometry, principal_point(geometry, [3.1_wp, -50.0_wp]), omega, known)
    call expect(.not. known, "beside the web")
    call expect_close(omega, 0.0_wp, 0.0_wp, "nothing assumed there")
    call warping_at(section_geometry_t(), [0.0_wp, 0.0_wp], omega, known)
    call expect(.not. known, "constants only")
    size%h = 2
    size%b = 1
    call shape_section("RECT", size, 0.3_wp, c, geometry, error)
    call warping_at(geometry, [0.5_wp, 1.0_wp], omega, known)
    call expect(.not. known, "solid rectangle")
    size = shape_dimensions_t(d=2.0_wp)
    call shape_section("CIRC", size, 0.3_wp, c, geometry, error)
    call warping_at(geometry, [0.5_wp, 0.5_wp], omega, known)
    call expect(known, "a circle does not warp")
  end subroutine warping

  !> Simpson's rule along each plate, exact for products of two linear functions.
  subroutine stress()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    real(wp), parameter :: forces(4) = [1.0e3_wp, -2.0e5_wp, 3.0e4_wp, 4.0e6_wp]
    real(wp), parameter :: weight(3) = [1.0_wp, 4.0_wp, 1.0_wp]/6
    real(wp) :: point(2), omega, sigma, area, sums(4)
    integer :: i, k

    call draw(zed_points, zed_plates, zed_thickness, c, geometry)
    sums = 0
    do i = 1, 3
      associate (j => zed_plates(:, i))
        area = norm2(zed_points(:, j(2)) - zed_points(:, j(1)))*zed_thickness(i)
        do k = 0, 2
          point = geometry%principal(:, j(1))*(2 - k)/2 + geometry%principal(:, j(2))*k/2
          omega = geometry%omega(j(1))*(2 - k)/2 + geometry%omega(j(2))*k/2
          sigma = axial_stress(c, point, omega, forces)
          sums = sums + weight(k + 1)*area*sigma*[1.0_wp, point(2), -point(1), -omega]
        end do
      end associate
    end do
    call expect_close(sums/forces, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], 1.0e-11_wp, "N, My, Mz, B")
  end subroutine stress

end module test_section_data
