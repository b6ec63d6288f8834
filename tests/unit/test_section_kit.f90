!> What the tests of sections share: a drawing as constants, constants as comparable numbers.
module test_section_kit
  use kinds, only: wp
  use check, only: expect, expect_close
  use errors, only: error_t
  use section_data, only: section_constants_t, section_geometry_t
  use section_topology, only: plate_fault_t
  use section_plates, only: plates_section
  implicit none
  private

  public :: draw, expect_same, scaled, zed_points, zed_plates, zed_thickness

  !> The Z section of beamw_element.json: no symmetry, so nothing vanishes.
  real(wp), parameter :: zed_points(2, 4) = reshape([-80.0_wp, 100.0_wp, 0.0_wp, 100.0_wp, 0.0_wp, &
                                                     -100.0_wp, 60.0_wp, -100.0_wp], [2, 4])
  integer, parameter :: zed_plates(2, 3) = reshape([1, 2, 2, 3, 3, 4], [2, 3])
  real(wp), parameter :: zed_thickness(3) = [8.0_wp, 6.0_wp, 10.0_wp]

contains

  !> Constants of a drawing that has to be without fault.
  subroutine draw(points, plates, thickness, constants, geometry)
    real(wp), intent(in) :: points(:, :), thickness(:)
    integer, intent(in) :: plates(:, :)
    type(section_constants_t), intent(out) :: constants
    type(section_geometry_t), intent(out), optional :: geometry
    type(section_geometry_t) :: own
    type(plate_fault_t) :: fault
    type(error_t), allocatable :: error

    call plates_section(points, plates, thickness, constants, own, fault, error)
    if (allocated(error)) call expect(.false., "no error, got "//error%message)
    if (present(geometry)) geometry = own
  end subroutine draw

  !> All constants agree, in parts of their natural size.
  subroutine expect_same(actual, wanted, tol, what)
    type(section_constants_t), intent(in) :: actual, wanted
    real(wp), intent(in) :: tol
    character(len=*), intent(in) :: what

    call expect_close(scaled(actual, wanted), scaled(wanted, wanted), tol, what)
    call expect_close(actual%d, transpose(actual%d), 1.0e-9_wp*maxval(actual%d), &
                      what//", D symmetric")
    call expect(actual%shear_given .eqv. wanted%shear_given, what//", shear given")
    call expect(all(actual%shear_rigid .eqv. wanted%shear_rigid), what//", shear rigid")
  end subroutine expect_same

  !> The constants without dimension: area and polar radius of `like` are one.
  pure function scaled(self, like) result(x)
    type(section_constants_t), intent(in) :: self, like
    real(wp) :: x(17), a, r

    a = like%a
    r = sqrt(like%ip()/a)
    x(1:5) = [self%a/a, self%iy/(a*r**2), self%iz/(a*r**2), self%it/(a*r**2), self%iw/(a*r**4)]
    x(6:7) = [self%ys, self%zs]/r
    x(8:10) = [self%d(1, 1), self%d(2, 2), self%d(1, 2)]/a
    x(11:13) = [self%d(1, 3)/r, self%d(2, 3)/r, self%d(3, 3)/r**2]/a
    x(14:17) = [self%by/r, self%bz/r, self%bw, self%ir/(a*r**4)]
  end function scaled

end module test_section_kit
