module test_section_solids
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use json_numbers, only: read_text, member, elements, numbers
  use section_data, only: section_constants_t, section_geometry_t
  use section_shapes, only: shape_dimensions_t, shape_section
  use section_solids, only: rectangle_torsion, rectangle_warping, cowper_box
  use test_section_kit, only: draw
  implicit none
  private

  public :: run_section_solids_tests

  real(wp), parameter :: pi = acos(-1.0_wp), nu = 0.3_wp

contains

  subroutine run_section_solids_tests()
    call run("section solids: torsion of rectangles", torsion)
    call run("section solids: warping of rectangles", warping)
    call run("section solids: rectangle", rectangle)
    call run("section solids: circle and tube", circles)
    call run("section solids: box", box)
    call run("section solids: shear of a box as two channels", box_shear)
    call run("section solids: warping of a box round its cell", box_warping)
    call run("section solids: finite elements", finite_elements)
  end subroutine run_section_solids_tests

  subroutine make(shape, size, c, geometry)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: size
    type(section_constants_t), intent(out) :: c
    type(section_geometry_t), intent(out) :: geometry
    type(error_t), allocatable :: error

    call shape_section(shape, size, nu, c, geometry, error)
    if (allocated(error)) call expect(.false., "no error, got "//error%message)
  end subroutine make

  !> It/(a b**3) by Timoshenko and Goodier, art. 109, table: 0.1406, 0.196, 0.229, 0.263, 0.281,
  !> 0.312 for a/b = 1, 1.5, 2, 3, 4, 10; the square to six figures, b**4 0.140577.
  subroutine torsion()
    real(wp), parameter :: ratio(6) = [1.0_wp, 1.5_wp, 2.0_wp, 3.0_wp, 4.0_wp, 10.0_wp]
    real(wp), parameter :: k(6) = [0.1406_wp, 0.196_wp, 0.229_wp, 0.263_wp, 0.281_wp, 0.312_wp]
    integer :: i

    call expect_close(rectangle_torsion(1.0_wp, 1.0_wp), 0.140577_wp, 5.0e-7_wp, "square")
    do i = 1, 6
      call expect_close(rectangle_torsion(3*ratio(i), 3.0_wp)/(81*ratio(i)), k(i), &
                        6.0e-4_wp, "table")
      call expect_close(rectangle_torsion(3.0_wp, 3*ratio(i)), &
                        rectangle_torsion(3*ratio(i), 3.0_wp), 1.0e-12_wp, "either side upright")
    end do
    call expect_close(rectangle_torsion(1.0e3_wp, 1.0_wp)*3/(1.0e3_wp - 0.630249_wp), 1.0_wp, &
                      1.0e-9_wp, "thin: (a - 0.63 b) b**3/3")
  end subroutine torsion

  !> The mean of psi**2 by a fine grid of psi itself, on the series along the longer side.
  subroutine warping()
    integer, parameter :: n = 60
    real(wp), parameter :: b = 2, h = 1.4_wp
    real(wp) :: y, z, psi, k, sum2
    integer :: i, j, m

    sum2 = 0
    do i = 1, n
      y = b*(real(i - 0.5_wp, wp)/n - 0.5_wp)
      do j = 1, n
        z = h*(real(j - 0.5_wp, wp)/n - 0.5_wp)
        psi = y*z
        do m = 0, 15
          k = (2*m + 1)*pi/b
          psi = psi - (-1)**m*8/(b*k**3)*sin(k*y)*sinh(k*z)/cosh(k*h/2)
        end do
        sum2 = sum2 + psi**2
      end do
    end do
    call expect_close(rectangle_warping(h, b)/(sum2*b*h/n**2), 1.0_wp, 5.0e-3_wp, "grid")
    call expect_close(rectangle_warping(b, h), rectangle_warping(h, b), 1.0e-12_wp, "turned")
    call expect_close(rectangle_warping(1.0e3_wp, 1.0_wp)*144/1.0e9_wp, 1.0_wp, 1.0e-5_wp, &
                      "thin: a**3 b**3/144")
  end subroutine warping

  !> b = 3 along y, h = 5 along z.
  subroutine rectangle()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    integer, parameter :: n = 300
    real(wp) :: y, z, ir
    integer :: i, j

    call make("RECT", shape_dimensions_t(h=5.0_wp, b=3.0_wp), c, geometry)
    call expect_close([c%a, c%iy, c%iz], [15.0_wp, 31.25_wp, 11.25_wp], 1.0e-12_wp, "A, Iy, Iz")
    call expect_close([c%d(1, 1), c%d(2, 2)]/c%a, spread(13.0_wp/15.3_wp, 1, 2), 1.0e-12_wp, &
                      "Cowper")
    call expect_close(c%d(3, 3), c%ip() - c%it, 1.0e-12_wp, "warping shear")
    ir = -c%ip()**2/c%a
    do i = 1, n
      y = 3*(i - 0.5_wp)/n - 1.5_wp
      do j = 1, n
        z = 5*(j - 0.5_wp)/n - 2.5_wp
        ir = ir + (y**2 + z**2)**2*c%a/n**2
      end do
    end do
    ! midpoint rule: sum of side**2/24 times the second derivative, 6e-3
    call expect_close(c%ir, ir, 6.1e-3_wp, "IR")
    call expect_close(geometry%points(:, 1), [1.5_wp, 2.5_wp], 0.0_wp, "a corner")
    call expect(.not. geometry%warping_known, "omega unknown")
  end subroutine rectangle

  subroutine circles()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry

    call make("CIRC", shape_dimensions_t(d=2.0_wp), c, geometry)
    call expect_close([c%a, c%iy, c%iz, c%it, c%iw, c%ir], [pi, pi/4, pi/4, pi/2, 0.0_wp, pi/12], &
                      1.0e-12_wp, "circle")
    call expect_close(c%d(1, 1)/c%a, 6*1.3_wp/(7 + 6*0.3_wp), 1.0e-12_wp, "Cowper, circle")
    call expect(all(c%shear_rigid .eqv. [.false., .false., .true.]), "no warping")
    call expect(c%d(3, 3) > 0, "D positive definite")

    call make("TUBE", shape_dimensions_t(d=12.0_wp, t=1.0_wp), c, geometry)
    call expect_close([c%a, c%iy, c%it], [11*pi, pi*(6.0_wp**4 - 5.0_wp**4)/4, &
                                          pi*(6.0_wp**4 - 5.0_wp**4)/2], 1.0e-9_wp, "tube")
    call make("TUBE", shape_dimensions_t(d=200.0_wp, t=0.02_wp, midline=.true.), c, geometry)
    call expect_close([c%a/(4*pi), c%it/(4.0e4_wp*pi)], [1.0_wp, 1.0_wp], 1.0e-7_wp, "thin tube")
    call expect_close(c%d(2, 2)/c%a, 2*1.3_wp/(4 + 3*0.3_wp), 1.0e-7_wp, "Cowper, thin tube")
    call expect_close(c%ir/(c%a*1.0e8_wp), 0.0_wp, 1.0e-7_wp, "IR: all fibres at one radius")
  end subroutine circles

  !> Outer sizes, and those of the midline, give one box.
  subroutine box()
    type(section_constants_t) :: c, m
    type(section_geometry_t) :: geometry

    call make("BOX", shape_dimensions_t(h=200.0_wp, b=100.0_wp, t=10.0_wp, tw=6.0_wp), c, geometry)
    call make("BOX", shape_dimensions_t(h=190.0_wp, b=94.0_wp, t=10.0_wp, tw=6.0_wp, &
                                        midline=.true.), m, geometry)
    call expect_close([c%a, c%iy, c%iz, c%it, c%iw, c%ir], [m%a, m%iy, m%iz, m%it, m%iw, m%ir], &
                      1.0e-12_wp*c%ir, "outer and midline sizes")
    call expect_close([c%a, c%iy, c%iz], [2.0e4_wp - 88.0_wp*180, &
                                          (100*200.0_wp**3 - 88*180.0_wp**3)/12, &
                                          (200*100.0_wp**3 - 180*88.0_wp**3)/12], 1.0e-6_wp, &
                      "A, Iy, Iz")
    call expect_close(cowper_box(1.0_wp, 1.0_wp, nu), 20*(1 + nu)/(48 + 39*nu), 1.0e-14_wp, &
                      "Cowper's thin-walled square tube")
    call make("BOX", shape_dimensions_t(h=50.0_wp, b=50.0_wp, t=2.0_wp, tw=2.0_wp, &
                                        midline=.true.), c, geometry)
    call expect_close([c%iw, c%it], [0.0_wp, 2*50.0_wp**3 + 4*50*8/3.0_wp], 1.0e-9_wp, "square box")
    call expect(c%shear_rigid(3) .and. c%d(3, 3) > 0, "a square box does not warp")
  end subroutine box

  !> Cut at the middle of its flanges, where the flow vanishes, a box under a force along its webs
  !> is two channels with half of it each; compliance s_zz of one from its plates.
  subroutine box_shear()
    real(wp), parameter :: b = 90, h = 160, tf = 5, tw = 3
    type(section_constants_t) :: c
    real(wp) :: minor, szz

    call draw(reshape([b/2, h, 0.0_wp, h, 0.0_wp, 0.0_wp, b/2, 0.0_wp], [2, 4]), &
              reshape([1, 2, 2, 3, 3, 4], [2, 3]), [tf, tw, tf], c)
    ! y is uncoupled, so that s_zz = D_w/(D_z D_w - D_zw**2)
    minor = c%d(2, 2)*c%d(3, 3) - c%d(2, 3)**2
    szz = c%d(3, 3)/minor
    call expect_close(2/szz/(2*c%a), cowper_box(b*tf/(h*tw), b/h, 0.0_wp), 1.0e-12_wp, "nu = 0")
  end subroutine box_shear

  !> Omega and the flow of its first moment by steps round the cell, closed by Bredt's condition.
  subroutine box_warping()
    integer, parameter :: n = 2000
    real(wp), parameter :: b = 90, h = 160, tf = 5, tw = 3, psi = 2*b*h/(2*b/tf + 2*h/tw)
    real(wp), parameter :: length(4) = [h, b, h, b], arm(4) = [b, h, b, h]/2
    real(wp), parameter :: t(4) = [tw, tf, tw, tf]
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    real(wp) :: omega(0:4*n), flow(4*n), step(4*n), wall(4*n), corner(4)
    integer :: i, k

    call make("BOX", shape_dimensions_t(h=h, b=b, t=tf, tw=tw, midline=.true.), c, geometry)
    omega(0) = 0
    do k = 1, 4
      do i = 1 + (k - 1)*n, k*n
        step(i) = length(k)/n
        wall(i) = t(k)
        omega(i) = omega(i - 1) + (arm(k) - psi/t(k))*step(i)
      end do
    end do
    call expect_close(omega(4*n), 0.0_wp, 1.0e-8_wp, "omega closes")
    omega = omega - sum((omega(1:) + omega(:4*n - 1))/2*step*wall)/sum(step*wall)
    ! the walk starts at the lower right corner, point 4, and runs counter-clockwise
    corner = omega([n, 2*n, 3*n, 4*n])
    call expect_close(geometry%omega, corner, 1.0e-8_wp*maxval(corner), "omega at the corners")
    call expect_close(sum((omega(1:)**2 + omega(:4*n - 1)**2)/2*step*wall)/c%iw, 1.0_wp, &
                      1.0e-5_wp, "Iw")
    flow(1) = 0
    do i = 2, 4*n
      flow(i) = flow(i - 1) + omega(i - 1)*(step(i - 1)*wall(i - 1) + step(i)*wall(i))/2
    end do
    flow = flow - sum(flow*step/wall)/sum(step/wall)
    call expect_close(c%d(3, 3)*sum(flow**2*step/wall)/c%iw**2, 1.0_wp, 1.0e-4_wp, "D omega")
  end subroutine box_warping

  !> It and Iw of a rectangle and a box by finite elements.
  subroutine finite_elements()
    character(len=:), allocatable :: list, text
    character(len=4), parameter :: shapes(2) = ["RECT", "BOX "]
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    type(shape_dimensions_t) :: size
    real(wp) :: s(4), wanted(1), warped(1), tolerance(1)
    integer :: i

    list = member(read_text("tests/reference/sections_fe.json"), "cells")
    do i = 1, 2
      text = elements(list, i)
      call expect(len(text) > 0, "two cells in the reference file")
      if (len(text) == 0) return
      s = numbers(member(text, "size"))
      size = shape_dimensions_t(h=s(1), b=s(2))
      if (i == 2) size = shape_dimensions_t(h=s(1), b=s(2), t=s(3), tw=s(4))
      call make(trim(shapes(i)), size, c, geometry)
      wanted = numbers(member(text, "It"))
      warped = numbers(member(text, "Iw"))
      tolerance = numbers(member(text, "tolerance"))
      call expect_close(c%it/wanted(1), 1.0_wp, tolerance(1), shapes(i)//": It")
      call expect_close(c%iw/warped(1), 1.0_wp, tolerance(1), shapes(i)//": Iw")
    end do
  end subroutine finite_elements

end module test_section_solids
