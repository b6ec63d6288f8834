module test_section_check
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use section_data, only: section_constants_t
  use section_check, only: check_constants, check_product, settle_shear
  use test_section_kit, only: draw, zed_points, zed_plates, zed_thickness
  implicit none
  private

  public :: run_section_check_tests

contains

  subroutine run_section_check_tests()
    call run("section check: sound constants", sound)
    call run("section check: values that no body has", impossible)
    call run("section check: shear rigidities", shear)
    call run("section check: flags of what a user gave", flags)
    call run("section check: product of inertia", product_of_inertia)
  end subroutine run_section_check_tests

  function zed() result(c)
    type(section_constants_t) :: c

    call draw(zed_points, zed_plates, zed_thickness, c)
  end function zed

  subroutine accepted(c, what)
    type(section_constants_t), intent(in) :: c
    character(len=*), intent(in) :: what
    type(error_t), allocatable :: error

    call check_constants(c, error)
    if (allocated(error)) call expect(.false., what//": no error, got "//error%message)
  end subroutine accepted

  subroutine refused(c, words)
    type(section_constants_t), intent(in) :: c
    character(len=*), intent(in) :: words
    type(error_t), allocatable :: error

    call check_constants(c, error)
    call expect(allocated(error), "an error: "//words)
    if (.not. allocated(error)) return
    call expect(error%status == exit_deck, words//": status of a deck error")
    call expect(index(error%message, words) == 1, "'"//words//"', got '"//error%message//"'")
  end subroutine refused

  subroutine sound()
    type(section_constants_t) :: c

    call accepted(zed(), "zed")
    call draw(zed_points(:, 1:3), zed_plates(:, 1:2), [1.0_wp, 1.0_wp], c)
    call accepted(c, "angle")
    call draw(zed_points(:, 1:2), zed_plates(:, 1:1), [1.0_wp], c)
    call accepted(c, "strip")
    c = section_constants_t(a=1.0_wp, iy=1.0_wp, iz=2.0_wp, it=0.1_wp)
    call accepted(c, "no shear rigidities")
  end subroutine sound

  subroutine impossible()
    type(section_constants_t) :: c

    c = zed()
    c%a = 0
    call refused(c, "A has to be positive")
    c = zed()
    c%iy = -1
    call refused(c, "IY has to be positive")
    c = zed()
    c%iz = 0
    call refused(c, "IZ has to be positive")
    c = zed()
    c%it = 0
    call refused(c, "IT has to be positive")
    c = zed()
    c%iw = -1
    call refused(c, "IW has to be not negative")
    c = zed()
    c%ir = -1
    call refused(c, "IR has to be not negative")
  end subroutine impossible

  subroutine shear()
    type(section_constants_t) :: c

    c = zed()
    c%d(2, 2) = -c%d(2, 2)
    call refused(c, "DZ has to be positive")
    c = zed()
    c%d(1, 3) = 1.1_wp*c%d(1, 3)
    call refused(c, "the shear rigidities are not symmetric")
    c = zed()
    c%d(1, 2) = 1.01_wp*sqrt(c%d(1, 1)*c%d(2, 2))
    c%d(2, 1) = c%d(1, 2)
    call refused(c, "the shear rigidities are not positive definite")
    ! every pair of strains is sound, the three together are not
    c%d = -0.6_wp
    c%d(1, 1) = 1
    c%d(2, 2) = 1
    c%d(3, 3) = 1
    call refused(c, "the shear rigidities are not positive definite")
    c%d = abs(c%d) + 0.1_wp  ! 0.7/1.1: sound, by virtue of all three products
    call accepted(c, "strong coupling")
    c = zed()
    c%shear_rigid(3) = .true.
    call refused(c, "the beam is rigid in shear W")
    c%shear_given = .false.
    call accepted(c, "not looked at where not given")
  end subroutine shear

  subroutine flags()
    type(section_constants_t) :: c

    c%iw = 1
    call settle_shear(c)
    call expect(.not. c%shear_given, "nothing given")
    c%d(1, 1) = 2
    call settle_shear(c)
    call expect(c%shear_given .and. all(c%shear_rigid .eqv. [.false., .true., .true.]), "DY alone")
    c%d(3, 3) = 2
    call settle_shear(c)
    call expect(all(c%shear_rigid .eqv. [.false., .true., .false.]), "DY and DW")
    c%iw = 0
    call settle_shear(c)
    call expect(all(c%shear_rigid .eqv. [.false., .true., .true.]), "DW without IW")
  end subroutine flags

  subroutine product_of_inertia()
    type(error_t), allocatable :: error

    call check_product(2.0_wp, 8.0_wp, -4.0_wp, error)
    call expect(.not. allocated(error), "the limit is allowed")
    call check_product(2.0_wp, 8.0_wp, 4.01_wp, error)
    call expect(allocated(error), "beyond it is not")
  end subroutine product_of_inertia

end module test_section_check
