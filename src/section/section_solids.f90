!> Constants of solid and closed sections with two axes of symmetry, by formulas.
!>
!> Shear centre and Wagner's beta vanish, `d` is diagonal, IR = int r**4 dA - Ip**2/A.
!> Sources: torsion and warping of the rectangle, St. Venant's series (Timoshenko and Goodier,
!> Theory of Elasticity, art. 109); Bredt's formula for cells; shear coefficients, Cowper, J. Appl.
!> Mech. 33 (1966) 335; warping shear of the solid, Ip - It (Reissner, J. Math. Phys. 31 (1952)
!> 214; Benscoter, J. Appl. Mech. 21 (1954) 25); that of the box, from the shear flow about the
!> cell, in the way of the open sections.
module section_solids
  use kinds, only: wp
  use section_data, only: section_constants_t, section_geometry_t, section_solid, section_closed
  implicit none
  private

  public :: rectangle_section, box_section, round_section, rectangle_torsion, rectangle_warping
  public :: cowper_box

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  !> Solid rectangle.
  pure subroutine rectangle_section(h, b, poisson, self, geometry)
    real(wp), intent(in) :: h, b     !< sides along z and y [L]
    real(wp), intent(in) :: poisson  !< Poisson's ratio
    type(section_constants_t), intent(out) :: self
    type(section_geometry_t), intent(out) :: geometry

    self%a = b*h
    self%iy = b*h**3/12.0_wp
    self%iz = h*b**3/12.0_wp
    self%it = rectangle_torsion(h, b)
    self%iw = rectangle_warping(h, b)
    self%d(1, 1) = 10.0_wp*(1.0_wp + poisson)/(12.0_wp + 11.0_wp*poisson)*self%a
    self%d(2, 2) = self%d(1, 1)
    self%d(3, 3) = self%ip() - self%it
    self%ir = rectangle_r4(h, b) - self%ip()**2/self%a
    self%shear_given = .true.
    geometry%kind = section_solid
    call set_points(geometry, corners(h, b))
    call set_outline(geometry, corners(h, b))
  end subroutine rectangle_section

  !> Torsion constant of a rectangle [L^4]: the series in odd n of tanh(n pi a/2b)/n**5, a >= b,
  !> summed as that of 1/n**5, 31/32 zeta(5), less a remainder that falls off exponentially.
  pure function rectangle_torsion(h, b) result(it)
    real(wp), intent(in) :: h, b
    real(wp) :: it
    real(wp), parameter :: zeta5 = 1.0369277551433699263_wp
    real(wp) :: long, short, series
    integer :: n

    long = max(h, b)
    short = min(h, b)
    series = 31.0_wp/32.0_wp*zeta5
    do n = 1, 15, 2
      series = series - (1.0_wp - tanh(0.5_wp*n*pi*long/short))/real(n, wp)**5
    end do
    it = long*short**3*(1.0_wp/3.0_wp - 64.0_wp/pi**5*short/long*series)
  end function rectangle_torsion

  !> Integral of the square of the rectangle's warping function [L^6]: with half sides a <= c and
  !> k = n pi/2a, n odd, psi = y z + sum of A_n sin(k y) sinh(k z), A_n = -4 sin(k a)/(a k**3
  !> cosh(k c)), so that d psi/dn is that of a body twisting rigidly.
  pure function rectangle_warping(h, b) result(iw)
    real(wp), intent(in) :: h, b
    real(wp) :: iw
    real(wp) :: a, c, k, bent
    integer :: n

    a = 0.5_wp*min(h, b)
    c = 0.5_wp*max(h, b)
    iw = 4.0_wp/9.0_wp*(a*c)**3
    do n = 399, 1, -2
      k = 0.5_wp*n*pi/a
      bent = tanh(k*c)
      iw = iw + 16.0_wp/(a*k**6)*(3.0_wp*bent/k - 2.0_wp*c - c*(1.0_wp - bent**2))
    end do
  end function rectangle_warping

  !> Rectangular box; Bredt's torsion constant with the walls' own added.
  pure subroutine box_section(h, b, t, tw, poisson, self, geometry)
    real(wp), intent(in) :: h, b     !< midline, along z and y [L]
    real(wp), intent(in) :: t, tw    !< thickness of flanges (along y) and webs [L]
    real(wp), intent(in) :: poisson
    type(section_constants_t), intent(out) :: self
    type(section_geometry_t), intent(out) :: geometry
    real(wp) :: out(2), in(2), corner

    out = [h + t, b + tw]
    in = [h - t, b - tw]
    self%a = out(1)*out(2) - in(1)*in(2)
    self%iy = (out(2)*out(1)**3 - in(2)*in(1)**3)/12.0_wp
    self%iz = (out(1)*out(2)**3 - in(1)*in(2)**3)/12.0_wp
    self%it = 2.0_wp*(h*b)**2/(b/t + h/tw) + 2.0_wp*(b*t**3 + h*tw**3)/3.0_wp
    self%d(1, 1) = cowper_box(h*tw/(b*t), h/b, poisson)*self%a
    self%d(2, 2) = cowper_box(b*t/(h*tw), b/h, poisson)*self%a
    self%ir = rectangle_r4(out(1), out(2)) - rectangle_r4(in(1), in(2)) - self%ip()**2/self%a
    self%shear_given = .true.

    corner = 0.25_wp*h*b*(b/t - h/tw)/(b/t + h/tw)
    self%iw = corner**2*self%a/3.0_wp
    geometry%kind = section_closed
    call set_points(geometry, corners(h, b))
    geometry%plates = reshape([1, 2, 2, 3, 3, 4, 4, 1], [2, 4])
    geometry%thickness = [t, tw, t, tw]
    geometry%omega = corner*[1.0_wp, -1.0_wp, 1.0_wp, -1.0_wp]
    geometry%warping_known = .true.
    call settle_warping(self, 1.0e-12_wp)
    if (.not. self%shear_rigid(3)) then
      self%d(3, 3) = (self%iw/corner)**2*box_warping_shear(h, b, t, tw)
    end if
    call set_outline(geometry, corners(out(1), out(2)), corners(in(1), in(2)))
  end subroutine box_section

  !> Cowper's shear coefficient of a thin-walled box; m = area of a flange over that of a web,
  !> n = width over height, webs along the force.
  pure function cowper_box(m, n, poisson) result(k)
    real(wp), intent(in) :: m, n, poisson
    real(wp) :: k

    k = 10.0_wp*(1.0_wp + poisson)*(1.0_wp + 3.0_wp*m)**2 &
        /(12.0_wp + 72.0_wp*m + 150.0_wp*m**2 + 90.0_wp*m**3 &
          + poisson*(11.0_wp + 66.0_wp*m + 135.0_wp*m**2 + 90.0_wp*m**3) &
          + 10.0_wp*n**2*((3.0_wp + poisson)*m + 3.0_wp*m**2))
  end function cowper_box

  !> Inverse of int S**2/t ds round the cell for a unit omega at the corners: S is a parabola about
  !> the middle of each wall, where omega is zero, plus the constant that keeps the cell closed,
  !> that is, which makes int S/t ds vanish.
  pure function box_warping_shear(h, b, t, tw) result(d)
    real(wp), intent(in) :: h, b, t, tw
    real(wp) :: d, flange, web, mean(2), square(2), length(2)

    ! S on a half wall, x = 0 at its middle, 1 at the corner: flange t b/4 x**2,
    ! web t b/4 + tw h/4 (1 - x**2)
    flange = 0.25_wp*t*b
    web = 0.25_wp*tw*h
    length = [b/t, h/tw]
    mean = [flange/3.0_wp, flange + web*2.0_wp/3.0_wp]
    square = [flange**2/5.0_wp, flange**2 + flange*web*4.0_wp/3.0_wp + web**2*8.0_wp/15.0_wp]
    d = 2.0_wp*(sum(length*square) - sum(length*mean)**2/sum(length))
    d = 1.0_wp/d
  end function box_warping_shear

  !> Solid circle or tube.
  pure subroutine round_section(outer, inner, poisson, self, geometry)
    real(wp), intent(in) :: outer, inner  !< diameters; no hole: 0 [L]
    real(wp), intent(in) :: poisson
    type(section_constants_t), intent(out) :: self
    type(section_geometry_t), intent(out) :: geometry
    real(wp) :: q, r, hole, k

    r = 0.5_wp*outer
    hole = 0.5_wp*inner
    self%a = pi*(r**2 - hole**2)
    self%iy = 0.25_wp*pi*(r**4 - hole**4)
    self%iz = self%iy
    self%it = self%ip()
    q = (1.0_wp + (hole/r)**2)**2
    k = 6.0_wp*(1.0_wp + poisson)*q &
        /((7.0_wp + 6.0_wp*poisson)*q + (20.0_wp + 12.0_wp*poisson)*(hole/r)**2)
    self%d(1, 1) = k*self%a
    self%d(2, 2) = k*self%a
    self%ir = pi/3.0_wp*(r**6 - hole**6) - self%ip()**2/self%a
    self%shear_given = .true.
    call settle_warping(self, 0.0_wp)
    geometry%kind = merge(section_closed, section_solid, inner > 0.0_wp)
    call set_points(geometry, reshape([r, 0.0_wp, 0.0_wp, r, -r, 0.0_wp, 0.0_wp, -r], [2, 4]))
    geometry%omega = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
    geometry%warping_known = .true.
    if (inner > 0.0_wp) then
      call set_outline(geometry, circle(r), circle(hole))
    else
      call set_outline(geometry, circle(r))
    end if
  end subroutine round_section

  !> A section that does not warp (Iw within `small` of Ip**2/A): the row of `d` means nothing
  !> then and holds a positive number, 5/6 Ip.
  pure subroutine settle_warping(self, small)
    type(section_constants_t), intent(inout) :: self
    real(wp), intent(in) :: small

    self%shear_rigid(3) = self%iw <= small*self%ip()**2/self%a
    if (.not. self%shear_rigid(3)) return
    self%iw = 0.0_wp
    self%d(3, 3) = self%ip()/1.2_wp
  end subroutine settle_warping

  !> Integral of r**4 over a rectangle about its centre [L^6].
  pure function rectangle_r4(h, b) result(r4)
    real(wp), intent(in) :: h, b
    real(wp) :: r4

    r4 = h*b*((b**4 + h**4)/80.0_wp + (b*h)**2/72.0_wp)
  end function rectangle_r4

  !> Corners of a rectangle, counter-clockwise from y, z > 0.
  pure function corners(h, b)
    real(wp), intent(in) :: h, b
    real(wp) :: corners(2, 4)

    corners = 0.5_wp*reshape([b, h, -b, h, -b, -h, b, -h], [2, 4])
  end function corners

  !> A polygon for a circle.
  pure function circle(r)
    real(wp), intent(in) :: r
    real(wp) :: circle(2, 32)
    integer :: i

    do i = 1, 32
      circle(:, i) = r*[cos(i*pi/16.0_wp), sin(i*pi/16.0_wp)]
    end do
  end function circle

  !> Points of a drawing whose axes are principal already.
  pure subroutine set_points(geometry, points)
    type(section_geometry_t), intent(inout) :: geometry
    real(wp), intent(in) :: points(:, :)
    integer :: i

    geometry%points = points
    geometry%principal = points
    geometry%number = [(i, i=1, size(points, 2))]
  end subroutine set_points

  !> One polygon, or two with a hole between.
  pure subroutine set_outline(geometry, polygon, hole)
    type(section_geometry_t), intent(inout) :: geometry
    real(wp), intent(in) :: polygon(:, :)
    real(wp), intent(in), optional :: hole(:, :)

    geometry%outline = polygon
    geometry%outline_last = [size(polygon, 2)]
    if (.not. present(hole)) return
    geometry%outline = reshape([polygon, hole], [2, size(polygon, 2) + size(hole, 2)])
    geometry%outline_last = [size(polygon, 2), size(geometry%outline, 2)]
  end subroutine set_outline

end module section_solids
