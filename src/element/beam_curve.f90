!> A beam between its ends, for drawings: where a section is and how it is turned.
module beam_curve
  use kinds, only: wp
  use rotation, only: rotation_matrix, rotated, turned, rotation_vector, cross
  implicit none
  private

  public :: beam_shape_t, beam_ends_t, beam_curve_t, station_t, new_curve, beam_station
  public :: relative_rotation

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

  !> What all sections of such a beam have in common.
  type, extends(beam_ends_t) :: beam_curve_t
    real(wp) :: length = 0.0_wp             !< initial [L]
    real(wp) :: now(3, 3, 2) = 0.0_wp       !< axes of the ends
    real(wp) :: slope(3, 2) = 0.0_wp        !< of the line of centroids there, less the initial one
    real(wp) :: mean(3) = 0.0_wp            !< mean slope of the line of shear centres
    real(wp) :: turn(3) = 0.0_wp            !< rotation vector from p to q
    real(wp) :: twist = 0.0_wp              !< its part about the axis
  end type beam_curve_t

  !> A section between the ends.
  type :: station_t
    real(wp) :: displacement(3) = 0.0_wp    !< of the centroid [L]
    real(wp) :: euler(0:3) = 0.0_wp         !< of the section
    real(wp) :: warping = 0.0_wp            !< alpha [L^-1]
  end type station_t

contains

  !> The line of centroids is the cubic of theory 9 with end slopes R (eX + alpha s),
  !> s = zs eY - ys eZ; the slopes of the line of shear centres are R eX.
  pure function new_curve(ends) result(curve)
    type(beam_ends_t), intent(in) :: ends
    type(beam_curve_t) :: curve
    real(wp) :: s(2)
    integer :: e

    curve%beam_ends_t = ends
    curve%length = norm2(ends%chord)
    s = [ends%shear_centre(2), -ends%shear_centre(1)]
    do e = 1, 2
      curve%now(:, :, e) = rotated(ends%euler(:, e), ends%triad)
      curve%slope(:, e) = curve%now(:, 1, e) - ends%triad(:, 1) &
                          + ends%warping(e)*matmul(curve%now(:, 2:3, e), s)
    end do
    curve%mean = (ends%chord + ends%displacement(:, 2) - ends%displacement(:, 1) &
                  + matmul(curve%now(:, 2:3, 2) - curve%now(:, 2:3, 1), ends%shear_centre)) &
                 /curve%length
    curve%turn = relative_rotation(ends%euler(:, 1), ends%euler(:, 2))
    associate (yp => curve%now(:, 2, 1), zp => curve%now(:, 3, 1), yq => curve%now(:, 2, 2), &
               zq => curve%now(:, 3, 2))
      curve%twist = atan2(dot_product(zp, yq) - dot_product(yp, zq), &
                          dot_product(yp, yq) + dot_product(zp, zq))
    end associate
  end function new_curve

  !> The section at xi = x/l0. It turns evenly from end to end, is tilted until it is normal to the
  !> line of shear centres, and twisted to the cubic twist of theory 5 c with the mean shear strain
  !> of warping. At the ends it is the nodes'.
  pure function beam_station(curve, xi) result(station)
    type(beam_curve_t), intent(in) :: curve
    real(wp), intent(in) :: xi
    type(station_t) :: station
    real(wp) :: h(2:4), d(2:4), tangent(3), axis(3)
    integer :: e

    if (xi <= 0 .or. xi >= 1) then
      e = merge(1, 2, xi <= 0)
      station = station_t(curve%displacement(:, e), curve%euler(:, e), 0.0_wp)
      if (curve%warps) station%warping = curve%warping(e)
      return
    end if
    h = [xi*(1 - xi)**2, xi**2*(3 - 2*xi), xi**2*(xi - 1)]
    d = [(1 - xi)*(1 - 3*xi), 6*xi*(1 - xi), xi*(3*xi - 2)]
    associate (p => curve%displacement(:, 1), q => curve%displacement(:, 2), c => curve)
      station%displacement = p + h(3)*(q - p) + c%length*(h(2)*c%slope(:, 1) + h(4)*c%slope(:, 2))
      tangent = d(3)*c%mean + d(2)*c%now(:, 1, 1) + d(4)*c%now(:, 1, 2)
    end associate
    tangent = tangent/norm2(tangent)
    station%euler = turned(curve%euler(:, 1), xi*curve%turn)
    axis = matmul(rotation_matrix(station%euler), curve%triad(:, 1))
    station%euler = turned(station%euler, tilt(axis, tangent))
    if (curve%warps) call add_twist(curve, xi, tangent, station)
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
  pure subroutine add_twist(curve, xi, axis, station)
    type(beam_curve_t), intent(in) :: curve
    real(wp), intent(in) :: xi, axis(3)
    type(station_t), intent(inout) :: station
    real(wp) :: shear, rate(2), more

    associate (twist => curve%twist, length => curve%length)
      shear = curve%shear*(twist/length - 0.5_wp*sum(curve%warping))
      rate = curve%warping + shear
      more = twist*(3*xi**2 - 2*xi**3 - xi) &
             + length*(rate(1)*xi*(1 - xi)**2 + rate(2)*xi**2*(xi - 1))
      station%warping = 6*twist/length*xi*(1 - xi) + rate(1)*(1 - xi)*(1 - 3*xi) &
                        + rate(2)*xi*(3*xi - 2) - shear
    end associate
    station%euler = turned(station%euler, more*axis)
  end subroutine add_twist

end module beam_curve
