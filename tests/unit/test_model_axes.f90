!> Beam axes: given, default, turned by the section; and the checks of a section.
module test_model_axes
  use check, only: run, expect, expect_close
  use kinds, only: wp
  use diagnostics, only: report_t
  use model_data, only: model_t
  use model_axes, only: orient_members, default_orientation
  implicit none
  private

  public :: run_model_axes_tests

contains

  subroutine run_model_axes_tests()
    call run("axes: the default orientation", default_rule)
    call run("axes: orthonormal, o in the plane of eX and eY", triads)
    call run("axes: turned with the section", turned)
    call run("axes: no length, parallel orientation", refused)
  end subroutine run_model_axes_tests

  subroutine default_rule()
    real(wp), parameter :: x(3) = [1.0_wp, 0.0_wp, 0.0_wp], y(3) = [0.0_wp, 1.0_wp, 0.0_wp], &
                           z(3) = [0.0_wp, 0.0_wp, 1.0_wp]

    call expect_close(default_orientation(x), y, 0.0_wp, "along x")
    call expect_close(default_orientation(z), x, 0.0_wp, "along z")
    call expect_close(default_orientation([0.6_wp, 0.64_wp, 0.48_wp]), z, 0.0_wp, "oblique")
    call expect_close(default_orientation([0.577350_wp, 0.5773502_wp, 0.5773498_wp]), x, 0.0_wp, &
                      "a tie within 1e-6")
    call expect_close(default_orientation([0.5774_wp, 0.57735_wp, 0.5773_wp]), z, 0.0_wp, "no tie")
  end subroutine default_rule

  subroutine triads()
    type(model_t) :: model
    type(report_t) :: report
    real(wp) :: o(3), identity(3, 3)
    integer :: i

    o = [0.3_wp, -2.0_wp, 5.0_wp]
    identity = 0.0_wp
    do i = 1, 3
      identity(i, i) = 1.0_wp
    end do
    call one_beam([1.0_wp, 2.0_wp, -3.0_wp], o, 0.0_wp, model)
    call orient_members(model, report)
    associate (r => model%member(1)%triad)
      call expect_close(matmul(transpose(r), r), identity, 1.0e-15_wp, "orthonormal")
      call expect_close(r(:, 1), [1.0_wp, 2.0_wp, -3.0_wp]/sqrt(14.0_wp), 1.0e-15_wp, "eX")
      call expect_close(dot_product(r(:, 3), o), 0.0_wp, 1.0e-14_wp, "o has no part along eZ")
      call expect(dot_product(r(:, 2), o) > 0.0_wp, "o points to +eY")
      call expect_close(determinant(r), 1.0_wp, 1.0e-15_wp, "right-handed")
    end associate
  end subroutine triads

  pure real(wp) function determinant(r)
    real(wp), intent(in) :: r(3, 3)

    determinant = r(1, 1)*(r(2, 2)*r(3, 3) - r(2, 3)*r(3, 2)) &
                  - r(1, 2)*(r(2, 1)*r(3, 3) - r(2, 3)*r(3, 1)) &
                  + r(1, 3)*(r(2, 1)*r(3, 2) - r(2, 2)*r(3, 1))
  end function determinant

  !> Along x with y as orientation, a section turned by theta has eY = (0, cos, sin).
  subroutine turned()
    type(model_t) :: model
    type(report_t) :: report

    call one_beam([2.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 1.0_wp, 0.0_wp], 0.3_wp, model)
    call orient_members(model, report)
    call expect_close(model%member(1)%triad(:, 2), [0.0_wp, cos(0.3_wp), sin(0.3_wp)], 1.0e-15_wp, &
                      "eY")
    call expect_close(model%member(1)%triad(:, 3), [0.0_wp, -sin(0.3_wp), cos(0.3_wp)], &
        1.0e-15_wp, &
                      "eZ")
  end subroutine turned

  subroutine refused()
    type(model_t) :: model
    type(report_t) :: report

    call one_beam([0.0_wp, 0.0_wp, 0.0_wp], [0.0_wp, 1.0_wp, 0.0_wp], 0.0_wp, model)
    call orient_members(model, report)
    call expect(report%errors() == 1, "no length")
    call one_beam([0.0_wp, 1.0_wp, 0.0_wp], [0.0_wp, -7.0_wp, 0.0_wp], 0.0_wp, model)
    call orient_members(model, report)
    call expect(report%errors() == 2, "parallel")
  end subroutine refused

  subroutine one_beam(chord, orientation, theta, model)
    real(wp), intent(in) :: chord(3), orientation(3), theta
    type(model_t), intent(out) :: model

    allocate (model%node(2), model%member(1), model%section(1))
    model%node%placed = .true.
    model%node(1)%position = [5.0_wp, 6.0_wp, 7.0_wp]
    model%node(2)%position = model%node(1)%position + chord
    model%member(1)%node(:, 1) = 1
    model%member(1)%node(:, 2) = 2
    model%member(1)%chord = chord
    model%member(1)%orientation = orientation
    model%member(1)%section = 1
    model%section(1)%geometry%theta = theta
  end subroutine one_beam

end module test_model_axes
