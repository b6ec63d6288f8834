!> A body of particles that does what a BEAMW element does: what its inertia is tested against.
module particle_body
  use kinds, only: wp
  use rotation, only: rotated, rotation_matrix, turned
  use beamw_inertia, only: inertia_t, new_inertia
  implicit none
  private

  public :: scattered, unit, some_triad, some_inertia, some_place, moved
  public :: particle_masses, particle_rates, particle_accelerations

  real(wp), parameter, public :: no_turn(0:3, 2) = reshape([1, 0, 0, 0, 1, 0, 0, 0]*1.0_wp, [4, 2])

  !> The section: three particles, not symmetric; rho Iw and the mass of the line are free.
  real(wp), parameter :: part_mass(3) = [0.5_wp, 0.8_wp, 1.1_wp]
  real(wp), parameter :: part_y(3) = [0.9_wp, -0.4_wp, 0.7_wp]
  real(wp), parameter :: part_z(3) = [0.8_wp, 0.6_wp, -0.3_wp]
  real(wp), parameter, public :: length = 1.3_wp, line_mass = 1.7_wp, warping_inertia = 0.6_wp
  real(wp), parameter, public :: density(6) = &
    [line_mass, sum(part_mass*(part_y**2 + part_z**2)), sum(part_mass*part_z**2), &
     sum(part_mass*part_y**2), sum(part_mass*part_y*part_z), warping_inertia]
  real(wp), parameter, public :: centre(2) = [0.35_wp, -0.55_wp]  !< shear centre

  integer, parameter, public :: particles = 13  !< seven of the line, three of each end

  !> Where the ends are.
  type, public :: place_t
    real(wp) :: r(3, 2), euler(0:3, 2), alpha(2)
  end type place_t

contains

  !> Numbers between -1 and 1, different for every seed.
  pure function scattered(n, seed) result(x)
    integer, intent(in) :: n, seed
    real(wp) :: x(n)
    integer :: i

    x = [(sin(12.9898_wp*i + 4.1414_wp*seed*i + 0.7_wp*seed), i=1, n)]
  end function scattered

  pure function some_triad() result(triad)
    real(wp) :: triad(3, 3)

    triad = rotation_matrix(turned(no_turn(:, 1), [0.8_wp, -0.5_wp, 1.1_wp]))
  end function some_triad

  pure function some_inertia(consistent, rotary) result(inertia)
    logical, intent(in) :: consistent, rotary
    type(inertia_t) :: inertia

    inertia = new_inertia(density, length, some_triad(), centre, consistent, rotary)
  end function some_inertia

  pure function some_place(seed) result(place)
    integer, intent(in) :: seed
    type(place_t) :: place

    place = moved(place_t(reshape([0, 0, 0, 1, 1, 0]*1.0_wp, [3, 2]), no_turn, [0.0_wp, 0.0_wp]), &
                  reshape(scattered(14, seed), [7, 2]))
  end function some_place

  pure function moved(place, increment) result(new)
    type(place_t), intent(in) :: place
    real(wp), intent(in) :: increment(7, 2)
    type(place_t) :: new
    integer :: e

    do e = 1, 2
      new%r(:, e) = place%r(:, e) + increment(1:3, e)
      new%euler(:, e) = turned(place%euler(:, e), increment(4:6, e))
      new%alpha(e) = place%alpha(e) + increment(7, e)
    end do
  end function moved

  !> Masses of the particles: on the line weights of Newton and Cotes, exact to degree seven.
  pure function particle_masses(consistent) result(m)
    logical, intent(in) :: consistent
    real(wp) :: m(particles)
    integer, parameter :: cotes(7) = [41, 216, 27, 272, 27, 216, 41]

    m = 0
    m([1, 7]) = 0.5_wp*line_mass*length
    if (consistent) m(1:7) = line_mass*length*cotes/840
    m(8:10) = 0.5_wp*length*part_mass
    m(11:13) = 0.5_wp*length*part_mass
  end function particle_masses

  !> Where they are: at xi = 0, 1/6, ..., 1 of the line, then those of the sections from its ends.
  pure function particle_places(place) result(x)
    type(place_t), intent(in) :: place
    real(wp) :: x(3, particles), triad(3, 3), d(3, 2), xi
    integer :: e, i

    do e = 1, 2
      triad = rotated(place%euler(:, e), some_triad())
      d(:, e) = triad(:, 1) + place%alpha(e)*(centre(2)*triad(:, 2) - centre(1)*triad(:, 3))
      do i = 1, 3
        x(:, 4 + 3*e + i) = part_y(i)*triad(:, 2) + part_z(i)*triad(:, 3)
      end do
    end do
    do i = 1, 7
      xi = (i - 1)/6.0_wp
      x(:, i) = place%r(:, 1)*(1 - xi)**2*(1 + 2*xi) + place%r(:, 2)*xi**2*(3 - 2*xi) &
                + length*(d(:, 1)*xi*(1 - xi)**2 - d(:, 2)*xi**2*(1 - xi))
    end do
  end function particle_places

  !> A motion with given velocities and accelerations at time zero, of the particles.
  pure function particles_at(place, velocity, acceleration, time) result(x)
    type(place_t), intent(in) :: place
    real(wp), intent(in) :: velocity(7, 2), acceleration(7, 2), time
    real(wp) :: x(3, particles)

    x = particle_places(moved(place, time*velocity + 0.5_wp*time**2*acceleration))
  end function particles_at

  !> First derivative of the particles' places to the motion's parameter, of fourth order.
  pure function particle_rates(place, velocity, acceleration) result(rate)
    type(place_t), intent(in) :: place
    real(wp), intent(in) :: velocity(7, 2), acceleration(7, 2)
    real(wp), parameter :: h = 1.0e-3_wp
    real(wp) :: rate(3, particles)

    rate = (8*(particles_at(place, velocity, acceleration, h) &
               - particles_at(place, velocity, acceleration, -h)) &
            - (particles_at(place, velocity, acceleration, 2*h) &
               - particles_at(place, velocity, acceleration, -2*h)))/(12*h)
  end function particle_rates

  !> Second derivative, of fourth order.
  pure function particle_accelerations(place, velocity, acceleration) result(rate)
    type(place_t), intent(in) :: place
    real(wp), intent(in) :: velocity(7, 2), acceleration(7, 2)
    real(wp), parameter :: h = 4.0e-3_wp
    real(wp) :: rate(3, particles)

    rate = (16*(particles_at(place, velocity, acceleration, h) &
                + particles_at(place, velocity, acceleration, -h)) &
            - (particles_at(place, velocity, acceleration, 2*h) &
               + particles_at(place, velocity, acceleration, -2*h)) &
            - 30*particle_places(place))/(12*h**2)
  end function particle_accelerations

  pure function unit(i) result(e)
    integer, intent(in) :: i
    real(wp) :: e(7, 2)

    e = 0
    e(merge(i, i - 7, i <= 7), merge(1, 2, i <= 7)) = 1
  end function unit

end module particle_body
