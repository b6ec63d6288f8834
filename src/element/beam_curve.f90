!> A beam between its ends, for drawings: where a section is and how it is turned.
module beam_curve
  use kinds, only: wp
  use rotation, only: rotated, turned, rotation_vector, cross
  implicit none
  private

  public :: beam_shape_t, beam_ends_t, station_t, beam_station, relative_rotation

  !> An undeformed beam.
  type :: beam_shape_t
    real(wp) :: chord(3) = 0.0_wp           !< initial vector from p to q [L]
    real(wp) :: triad(3, 3) = 0.0_wp        !< initial axes
    real(wp) :: shear_centre(2) = 0.0_wp    !< y, z from the centroid [L]
    logical :: warps = .false.              !< carries a bimoment
    real(wp) :: shear = 0.0_wp              !< share of warping shear, Phi/(1 + Phi), theory 4
  end type beam_shape_t

  !> A beam and where its ends are now.
  type, extends(beam_shape_t) :: beam_ends_t
    real(wp) :: displacement(3, 2) = 0.0_wp !< of p and q [L]
    real(wp) :: euler(0:3, 2) = 0.0_wp      !< Euler parameters
    real(wp) :: warping(2) = 0.0_wp         !< alpha [L^-1]
  end type beam_ends_t

  !> A section between the ends.
  type :: station_t
    real(wp) :: displacement(3) = 0.0_wp    !< of the centroid [L]
    real(wp) :: euler(0:3) = 0.0_wp         !< of the section
    real(wp) :: warping = 0.0_wp            !< alpha [L^-1]
  end type station_t

contains

  !> The section at xi = x/l0. The line of centroids is the cubic of theory 9 with end slopes
  !> R (eX + alpha s), s = zs eY - ys eZ. The section turns evenly from end to end, is tilted until
  !> it is normal to the cubic of the shear centres, whose slopes are R eX, and twisted to the cubic
  !> twist of theory 5 c with the mean shear strain of warping. At the ends it is the nodes'.
  pure function beam_station(ends, xi) result(station)
    type(beam_ends_t), intent(in) :: ends
    real(wp), intent(in) :: xi
    type(station_t) :: station
    real(wp) :: triad(3, 3, 2), now(3, 3), slope(3, 2), s(2), length, h(2:4), d(2:4), turn(3)
    real(wp) :: tangent(3)
    integer :: e

    if (xi <= 0 .or. xi >= 1) then
      e = merge(1, 2, xi <= 0)
      station = station_t(ends%displacement(:, e), ends%euler(:, e), 0.0_wp)
      if (ends%warps) station%warping = ends%warping(e)
      return
    end if
    length = norm2(ends%chord)
    h = [xi*(1 - xi)**2, xi**2*(3 - 2*xi), xi**2*(xi - 1)]
    d = [(1 - xi)*(1 - 3*xi), 6*xi*(1 - xi), xi*(3*xi - 2)]
    s = [ends%shear_centre(2), -ends%shear_centre(1)]
    do e = 1, 2
      triad(:, :, e) = rotated(ends%euler(:, e), ends%triad)
      slope(:, e) = triad(:, 1, e) - ends%triad(:, 1) &
                    + ends%warping(e)*matmul(triad(:, 2:3, e), s)
    end do
    associate (p => ends%displacement(:, 1), q => ends%displacement(:, 2))
      station%displacement = p + h(3)*(q - p) + length*(h(2)*slope(:, 1) + h(4)*slope(:, 2))
      turn = matmul(triad(:, 2:3, 2) - triad(:, 2:3, 1), ends%shear_centre)
      tangent = d(3)*(ends%chord + q - p + turn)/length + d(2)*triad(:, 1, 1) &
                + d(4)*triad(:, 1, 2)
    end associate
    tangent = tangent/norm2(tangent)
    station%euler = turned(ends%euler(:, 1), &
                           xi*relative_rotation(ends%euler(:, 1), ends%euler(:, 2)))
    now = rotated(station%euler, ends%triad)
    station%euler = turned(station%euler, tilt(now(:, 1), tangent))
    if (ends%warps) call add_twist(ends, triad, xi, tangent, station)
  end function beam_station

  !> The rotation vector that turns Euler parameters `p` into `q`.
  pure function relative_rotation(p, q) result(theta)
    real(wp), intent(in) :: p(0:3), q(0:3)
    real(wp) :: theta(3), r(0:3)

    r(0) = dot_product(p, q)
    r(1:3) = p(0)*q(1:3) - q(0)*p(1:3) - cross(q(1:3), p(1:3))
    theta = rotation_vector(r)
  end function relative_rotation

  !> The smallest rotation of a unit vector to another.
  pure function tilt(from, to) result(theta)
    real(wp), intent(in) :: from(3), to(3)
    real(wp) :: theta(3), sine

    theta = cross(from, to)
    sine = norm2(theta)
    if (sine > 0) theta = theta*(atan2(sine, dot_product(from, to))/sine)
  end function tilt

  !> The twist that follows from the warping of the ends, beyond an even one, and its rate.
  pure subroutine add_twist(ends, triad, xi, axis, station)
    type(beam_ends_t), intent(in) :: ends
    real(wp), intent(in) :: triad(3, 3, 2)   !< of the ends now
    real(wp), intent(in) :: xi, axis(3)
    type(station_t), intent(inout) :: station
    real(wp) :: twist, length, shear, rate(2), more

    length = norm2(ends%chord)
    associate (yp => triad(:, 2, 1), zp => triad(:, 3, 1), yq => triad(:, 2, 2), &
               zq => triad(:, 3, 2))
      twist = atan2(dot_product(zp, yq) - dot_product(yp, zq), &
                    dot_product(yp, yq) + dot_product(zp, zq))
    end associate
    shear = ends%shear*(twist/length - 0.5_wp*sum(ends%warping))
    rate = ends%warping + shear
    more = twist*(3*xi**2 - 2*xi**3 - xi) &
           + length*(rate(1)*xi*(1 - xi)**2 + rate(2)*xi**2*(xi - 1))
    station%warping = 6*twist/length*xi*(1 - xi) + rate(1)*(1 - xi)*(1 - 3*xi) &
                      + rate(2)*xi*(3*xi - 2) - shear
    station%euler = turned(station%euler, more*axis)
  end subroutine add_twist

end module beam_curve
