module test_beamw_inertia
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use rotation, only: rotated, rotation_matrix, turned, cross
  use beamw_inertia, only: inertia_t, new_inertia, inertia_mass, inertia_force, kinetic_energy, &
                           weight_force
  use linalg_dense, only: dense_symmetric_t
  use beamw_rigidity, only: rigidity_t
  use beamw_constants, only: beamw_t, new_beamw, beamw_consistent
  use element_base, only: element_t
  use element_beamw, only: new_element_beamw
  use nodal_state, only: state_t, new_state
  implicit none
  private

  public :: run_beamw_inertia_tests

  real(wp), parameter :: axes(3, 3) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1]*1.0_wp, [3, 3])
  real(wp), parameter :: no_turn(0:3, 2) = reshape([1, 0, 0, 0, 1, 0, 0, 0]*1.0_wp, [4, 2])

  !> The section: three particles, not symmetric; rho Iw and the mass of the line are free.
  real(wp), parameter :: part_mass(3) = [0.5_wp, 0.8_wp, 1.1_wp], length = 1.3_wp
  real(wp), parameter :: part_y(3) = [0.9_wp, -0.4_wp, 0.7_wp], part_z(3) = [0.8_wp, 0.6_wp, -0.3_wp]
  real(wp), parameter :: line_mass = 1.7_wp, warping_inertia = 0.6_wp
  real(wp), parameter :: density(6) = [line_mass, sum(part_mass*(part_y**2 + part_z**2)), &
    sum(part_mass*part_z**2), sum(part_mass*part_y**2), sum(part_mass*part_y*part_z), warping_inertia]
  real(wp), parameter :: centre(2) = [0.35_wp, -0.55_wp]  !< shear centre

  integer, parameter :: particles = 13  !< seven of the line, three of the section at each end

  !> Where the ends are.
  type :: place_t
    real(wp) :: r(3, 2), euler(0:3, 2), alpha(2)
  end type place_t

contains

  subroutine run_beamw_inertia_tests()
    call run("inertia: consistent mass of a straight beam is the known one", textbook_mass)
    call run("inertia: forces are those of a body of particles (d'Alembert)", particle_forces)
    call run("inertia: kinetic energy is that of a body of particles", particle_energy)
    call run("inertia: rate of the kinetic energy is the power of the forces", power_balance)
    call run("inertia: without ROTARY only the moment about the axis turns", axial_only)
    call run("inertia: mass matrix is symmetric, semidefinite, of known rank", definite_mass)
    call run("inertia: mass and momentum of translation", translation)
    call run("inertia: energy of rigid rotation", rigid_rotation)
    call run("inertia: a turned element has turned forces", invariance)
    call run("inertia: weight, its arms and its tangent", weight)
    call run("inertia: frequencies of an eccentric column", eccentric_column)
  end subroutine run_beamw_inertia_tests

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

  !> 420 M/(rho A l0): the matrix of every textbook, [156 22l 54 -13l; ...] (l = 2).
  subroutine textbook_mass()
    type(inertia_t) :: inertia
    real(wp) :: m(14, 14), l
    real(wp), parameter :: only_line(6) = [1, 0, 0, 0, 0, 0]*1.0_wp
    integer, parameter :: in_xy(4) = [2, 6, 9, 13], in_xz(4) = [3, 5, 10, 12]
    real(wp) :: wanted(4, 4), turn(4)

    l = 2
    wanted(:, 1) = [156.0_wp, 22*l, 54.0_wp, -13*l]
    wanted(:, 2) = [22*l, 4*l**2, 13*l, -3*l**2]
    wanted(:, 3) = [54.0_wp, 13*l, 156.0_wp, -22*l]
    wanted(:, 4) = [-13*l, -3*l**2, -22*l, 4*l**2]
    inertia = new_inertia(only_line, l, axes, [0.0_wp, 0.0_wp], .true., .true.)
    call inertia_mass(inertia, no_turn, [0.0_wp, 0.0_wp], m)
    m = 420/l*m
    call expect_close(m(in_xy, in_xy), wanted, 1.0e-12_wp, "xy plane")
    turn = [1, -1, 1, -1]
    wanted = wanted*spread(turn, 1, 4)*spread(turn, 2, 4)
    call expect_close(m(in_xz, in_xz), wanted, 1.0e-12_wp, "xz plane")
    call expect_close(m([1, 8], [1, 8]), wanted([1, 3], [1, 3]), 1.0e-12_wp, "x")
    inertia = new_inertia(only_line, l, axes, [0.0_wp, 3.0_wp], .true., .true.)
    call inertia_mass(inertia, no_turn, [0.0_wp, 0.0_wp], m)
    call expect_close(420/l*m(in_xy, 7), [22*l, 4*l**2, 13*l, -3*l**2]*3, 1.0e-11_wp, "alpha, zs")
  end subroutine textbook_mass

  !> M a + h is the sum of mass times acceleration along every coordinate; the differences err by
  !> 1e-10 of masses, velocities and accelerations of the order of one. Columns of M: no velocity.
  subroutine particle_forces()
    type(place_t) :: place
    type(inertia_t) :: inertia
    real(wp), dimension(7, 2) :: v, a, f, wanted
    real(wp) :: m(14, 14), x(3, particles), column(14)
    integer :: seed, i, option

    do option = 0, 1
      inertia = some_inertia(option == 1, .true.)
      do seed = 1, 3
        place = some_place(seed)
        v = reshape(scattered(14, seed + 10), [7, 2])
        a = reshape(scattered(14, seed + 20), [7, 2])
        x = particle_accelerations(place, v, a)*spread(particle_masses(option == 1), 1, 3)
        wanted = 0
        wanted(7, :) = 0.5_wp*length*warping_inertia*a(7, :)
        do i = 1, 14
          wanted = wanted + unit(i)*sum(x*particle_rates(place, unit(i), 0*a))
        end do
        call inertia_force(inertia, place%euler, place%alpha, v, a, f)
        call expect_close(f, wanted, 2.0e-9_wp, "inertia forces")
        call inertia_mass(inertia, place%euler, place%alpha, m)
        do i = 1, 14
          call inertia_force(inertia, place%euler, place%alpha, 0*v, unit(i), f)
          column = reshape(f, [14])
          call expect_close(m(:, i), column, 1.0e-14_wp, "column of the mass matrix")
        end do
      end do
    end do
  end subroutine particle_forces

  subroutine particle_energy()
    type(place_t) :: place
    type(inertia_t) :: inertia
    real(wp) :: v(7, 2), m(14, 14), wanted, energy
    integer :: seed, option

    do option = 0, 1
      inertia = some_inertia(option == 1, .true.)
      do seed = 1, 3
        place = some_place(seed)
        v = reshape(scattered(14, seed + 10), [7, 2])
        wanted = 0.5_wp*sum(spread(particle_masses(option == 1), 1, 3)*particle_rates(place, v, 0*v)**2) &
                 + 0.25_wp*length*warping_inertia*sum(v(7, :)**2)
        energy = kinetic_energy(inertia, place%euler, place%alpha, v)
        call expect_close(energy, wanted, 1.0e-11_wp*wanted, "kinetic energy")
        call inertia_mass(inertia, place%euler, place%alpha, m)
        call expect_close(0.5_wp*dot_product(pack(v, .true.), matmul(m, pack(v, .true.))), energy, &
                          1.0e-14_wp*wanted, "half v.Mv")
      end do
    end do
  end subroutine particle_energy

  !> A motion in closed form: R = exp(f1 e1) exp(f2 e2) R0 at each end, r and alpha of sines.
  pure subroutine motion(time, place, v, a)
    real(wp), intent(in) :: time
    type(place_t), intent(out) :: place
    real(wp), intent(out), dimension(7, 2) :: v, a
    real(wp) :: f(0:2, 2), axis(3, 2), w(3), turn(0:3)
    integer :: e, i

    do e = 1, 2
      do i = 1, 2
        axis(:, i) = scattered(3, e + 2*i)
        f(:, i) = [sin(i*time + e), i*cos(i*time + e), -i**2*sin(i*time + e)]
      end do
      turn = turned(no_turn(:, 1), f(0, 1)*axis(:, 1))
      w = matmul(rotation_matrix(turn), axis(:, 2))
      place%euler(:, e) = turned(turned(no_turn(:, 1), f(0, 2)*axis(:, 2)), f(0, 1)*axis(:, 1))
      v(4:6, e) = f(1, 1)*axis(:, 1) + f(1, 2)*w
      a(4:6, e) = f(2, 1)*axis(:, 1) + f(2, 2)*w + f(1, 1)*f(1, 2)*cross(axis(:, 1), w)
      place%r(:, e) = axis(:, 1)*sin(time)
      v(1:3, e) = axis(:, 1)*cos(time)
      a(1:3, e) = -axis(:, 1)*sin(time)
      place%alpha(e) = sin(1.5_wp*time + e)
      v(7, e) = 1.5_wp*cos(1.5_wp*time + e)
      a(7, e) = -1.5_wp**2*sin(1.5_wp*time + e)
    end do
  end subroutine motion

  function energy_at(inertia, time) result(energy)
    type(inertia_t), intent(in) :: inertia
    real(wp), intent(in) :: time
    real(wp) :: energy, v(7, 2), a(7, 2)
    type(place_t) :: place

    call motion(time, place, v, a)
    energy = kinetic_energy(inertia, place%euler, place%alpha, v)
  end function energy_at

  subroutine power_balance()
    real(wp), parameter :: h = 2.0e-3_wp
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f
    real(wp) :: rate, t
    integer :: option, i

    do option = 0, 3
      inertia = some_inertia(mod(option, 2) == 1, option >= 2)
      do i = 1, 5
        t = 0.7_wp*i
        call motion(t, place, v, a)
        call inertia_force(inertia, place%euler, place%alpha, v, a, f)
        rate = (8*(energy_at(inertia, t + h) - energy_at(inertia, t - h)) &
                - (energy_at(inertia, t + 2*h) - energy_at(inertia, t - 2*h)))/(12*h)
        call expect_close(sum(f*v), rate, 2.0e-9_wp, "power")
      end do
    end do
  end subroutine power_balance

  !> Angular momentum of an end without Iy, Iz: (rho Ip l0/2) (w.X) X.
  subroutine axial_only()
    real(wp), parameter :: h = 1.0e-3_wp
    type(inertia_t) :: inertia, none
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f, g
    integer :: option, i
    real(wp) :: wanted(3, 2)

    do option = 0, 1
      inertia = some_inertia(option == 1, .false.)
      none = new_inertia([line_mass, 0.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, warping_inertia], length, &
                         some_triad(), centre, option == 1, .false.)
      do i = 1, 3
        call motion(1.0_wp*i, place, v, a)
        call inertia_force(inertia, place%euler, place%alpha, v, a, f)
        call inertia_force(none, place%euler, place%alpha, v, a, g)
        wanted = (8*(spin_at(i + h) - spin_at(i - h)) - (spin_at(i + 2*h) - spin_at(i - 2*h)))/(12*h)
        call expect_close(f(4:6, :) - g(4:6, :), 0.5_wp*length*density(2)*wanted, 1.0e-9_wp, &
                          "moment of the axial inertia")
        f(4:6, :) = g(4:6, :)
        call expect_close(f, g, 0.0_wp, "other forces")
      end do
    end do
  end subroutine axial_only

  function spin_at(time) result(spin)
    real(wp), intent(in) :: time
    real(wp) :: spin(3, 2), v(7, 2), a(7, 2), x(3, 3)
    type(place_t) :: place
    integer :: e

    call motion(time, place, v, a)
    do e = 1, 2
      x = rotated(place%euler(:, e), some_triad())
      spin(:, e) = dot_product(v(4:6, e), x(:, 1))*x(:, 1)
    end do
  end function spin_at

  !> Only LUMPED without ROTARY has coordinates without inertia: two spins of each end.
  subroutine definite_mass()
    type(dense_symmetric_t) :: factor
    type(error_t), allocatable :: error
    type(place_t) :: place
    type(inertia_t) :: inertia
    real(wp) :: m(14, 14)
    integer :: option

    do option = 0, 3
      place = some_place(option + 1)
      inertia = some_inertia(mod(option, 2) == 1, option >= 2)
      call inertia_mass(inertia, place%euler, place%alpha, m)
      call expect_close(m, transpose(m), 1.0e-15_wp, "symmetric")
      call factor%factorize(m, error)
      call expect(.not. allocated(error), "factorized")
      call expect(factor%negative == 0, "no negative eigenvalue")
      call expect(size(factor%null) == merge(4, 0, option == 0), "rank")
    end do
  end subroutine definite_mass

  !> Exact for both formulations and in any configuration.
  subroutine translation()
    type(place_t) :: place
    type(inertia_t) :: inertia
    real(wp) :: m(14, 14), v(7, 2), f(7, 2)
    integer :: option

    do option = 0, 1
      place = some_place(option + 5)
      inertia = some_inertia(option == 1, .true.)
      call inertia_mass(inertia, place%euler, place%alpha, m)
      v = 0
      v(1:3, :) = spread([2.0_wp, -3.0_wp, 5.0_wp], 2, 2)
      f = reshape(matmul(m, reshape(v, [14])), [7, 2])
      call expect_close(sum(f(1:3, :), 2), line_mass*length*v(1:3, 1), 1.0e-14_wp*norm2(v)*length*2, &
                        "momentum")
      call expect_close(kinetic_energy(inertia, place%euler, place%alpha, v), &
                        0.5_wp*line_mass*length*38, 1.0e-13_wp, "energy")
    end do
  end subroutine translation

  !> About a point off a straight element: exact with the consistent mass; the lumped one has
  !> l0**2/4 in place of l0**2/12 across the axis.
  subroutine rigid_rotation()
    type(place_t) :: place
    type(inertia_t) :: inertia
    real(wp) :: v(7, 2), w(3), q(3, 3), x(3), middle(3), euler(0:3), wanted, own(3), swing
    integer :: option, e

    w = [0.9_wp, -1.4_wp, 0.6_wp]
    euler = turned(no_turn(:, 1), [-0.3_wp, 0.8_wp, 1.9_wp])
    q = rotated(euler, some_triad())
    x = q(:, 1)
    middle = [2.0_wp, 0.5_wp, -1.0_wp]
    do option = 0, 1
      inertia = some_inertia(option == 1, .true.)
      v = 0
      do e = 1, 2
        place%euler(:, e) = euler
        place%r(:, e) = middle + (e - 1.5_wp)*length*x
        v(1:3, e) = cross(w, place%r(:, e))
        v(4:6, e) = w
      end do
      swing = length**2/merge(12, 4, option == 1)
      own = matmul(w, q)
      wanted = 0.5_wp*length*(line_mass*(sum(cross(w, middle)**2) + swing*sum(cross(w, x)**2)) &
               + density(2)*own(1)**2 + density(3)*own(2)**2 + density(4)*own(3)**2 &
               - 2*density(5)*own(2)*own(3))
      call expect_close(kinetic_energy(inertia, place%euler, [0.0_wp, 0.0_wp], v), wanted, &
                        1.0e-14_wp*wanted, "energy")
    end do
  end subroutine rigid_rotation

  subroutine invariance()
    type(place_t) :: place
    type(inertia_t) :: inertia
    real(wp), dimension(7, 2) :: v, a, f, g
    real(wp) :: theta(3), energy, euler(0:3, 2)
    integer :: option, e

    theta = [1.1_wp, -2.0_wp, 0.4_wp]
    do option = 0, 1
      place = some_place(option + 2)
      inertia = some_inertia(option == 1, .true.)
      v = reshape(scattered(14, 31), [7, 2])
      a = reshape(scattered(14, 32), [7, 2])
      call inertia_force(inertia, place%euler, place%alpha, v, a, f)
      energy = kinetic_energy(inertia, place%euler, place%alpha, v)
      do e = 1, 2
        euler(:, e) = turned(place%euler(:, e), theta)
      end do
      call turn(v)
      call turn(a)
      call turn(f)
      call inertia_force(inertia, euler, place%alpha, v, a, g)
      call expect_close(g, f, 1.0e-14_wp*norm2(f), "forces")
      call expect_close(kinetic_energy(inertia, euler, place%alpha, v), energy, 1.0e-14_wp*energy, "energy")
    end do

  contains

    subroutine turn(x)
      real(wp), intent(inout) :: x(7, 2)
      real(wp) :: q(3, 3)

      q = rotation_matrix(turned(no_turn(:, 1), theta))
      x(1:3, :) = matmul(q, x(1:3, :))
      x(4:6, :) = matmul(q, x(4:6, :))
    end subroutine turn
  end subroutine invariance

  !> The mass matrix times a uniform acceleration; dead forces at both ends, with the consistent
  !> mass at arms of l0/6 inwards; the Hessian by differences, symmetric as in theory 1.
  subroutine weight()
    type(place_t) :: place, plus, minus
    type(inertia_t) :: inertia
    real(wp), parameter :: h = 1.0e-5_wp, field(3) = [3.0_wp, -2.0_wp, 9.0_wp]
    real(wp) :: m(14, 14), v(7, 2), f(7, 2), fp(7, 2), fm(7, 2), k(4, 4, 2), unused(4, 4, 2)
    real(wp) :: triad(3, 3), s(3), arm(3), half(3), column(4)
    integer :: option, e, i

    half = 0.5_wp*line_mass*length*field
    do option = 0, 1
      place = some_place(option + 7)
      inertia = some_inertia(option == 1, .true.)
      call weight_force(inertia, place%euler, place%alpha, field, f, k)
      call inertia_mass(inertia, place%euler, place%alpha, m)
      v = 0
      v(1:3, :) = spread(field, 2, 2)
      call expect_close(reshape(f, [14]), matmul(m, reshape(v, [14])), 1.0e-13_wp, "M times field")
      do e = 1, 2
        triad = rotated(place%euler(:, e), some_triad())
        s = (3 - 2*e)*option*length/6*(centre(2)*triad(:, 2) - centre(1)*triad(:, 3))
        arm = (3 - 2*e)*option*length/6*triad(:, 1) + place%alpha(e)*s
        call expect_close(f(:, e), [half, cross(arm, half), dot_product(s, half)], 1.0e-13_wp, "arms")
        do i = 1, 4
          plus = moved(place, h*unit(7*(e - 1) + 3 + i))
          minus = moved(place, -h*unit(7*(e - 1) + 3 + i))
          call weight_force(inertia, plus%euler, plus%alpha, field, fp, unused)
          call weight_force(inertia, minus%euler, minus%alpha, field, fm, unused)
          column = -(fp(4:7, e) - fm(4:7, e))/(2*h)
          if (i <= 3) column(1:3) = column(1:3) + 0.5_wp*cross(axes(:, i), f(4:6, e))
          call expect_close(k(:, i, e), column, 1.0e-9_wp, "tangent")
        end do
      end do
    end do
  end subroutine weight

  !> Fork-supported column, mono-symmetric, rigid in shear: with sin(n pi x/L) of shear centre and
  !> twist the exact frequencies are those of two by two matrices.
  subroutine eccentric_column()
    integer :: n

    do n = 2, 16, 2
      print *, n, column_frequency(n, .true., .true.)/6.283185307179586_wp, column_frequency(n, .true., .false.)/6.283185307179586_wp, column_frequency(n, .false., .true.)/6.283185307179586_wp
    end do
    call expect(n > 0, "x")
  end subroutine eccentric_column

  function column_frequency(elements, consistent, with_alpha) result(frequency)
    integer, intent(in) :: elements
    logical, intent(in) :: consistent, with_alpha
    real(wp) :: frequency, zs
    real(wp) :: k(7*elements + 7, 7*elements + 7), m(7*elements + 7, 7*elements + 7)
    real(wp) :: x(7*elements + 7), y(7*elements + 7), ke(14, 14), me(14, 14), l
    real(wp), parameter :: e = 210.0e9_wp, g = 210.0e9_wp/2.6_wp, rho = 7850
    real(wp) :: strain(9), b(9, 14), geo(14, 14), s(9, 9), dens(6)
    type(dense_symmetric_t) :: factor
    type(error_t), allocatable :: error
    type(rigidity_t) :: rigidity
    type(beamw_t), target :: constants
    type(beamw_t), pointer :: shared
    class(element_t), allocatable :: element
    type(inertia_t) :: inertia
    type(state_t) :: state
    logical :: valid
    logical :: free(7*elements + 7)
    integer :: i, j
    integer, allocatable :: list(:)

    l = 6.0_wp/elements
    zs = -0.087368899_wp
    rigidity%ea = e*0.00428_wp
    rigidity%eiy = e*5.8769951e-05_wp
    rigidity%eiz = e*3.1640625e-06_wp
    rigidity%git = g*1.0815667e-07_wp
    rigidity%eiw = e*2.628125e-08_wp
    rigidity%zs = zs
    rigidity%polar = (5.8769951e-05_wp + 3.1640625e-06_wp)/0.00428_wp
    allocate (shared)
    shared = new_beamw(rigidity, l, beamw_consistent)
    call new_element_beamw(reshape([1, 1, 1, 2, 2, 2], [3, 2]), 2, [l, 0.0_wp, 0.0_wp], axes, &
                           spread(.false., 1, 8), spread(0, 1, 8), shared, element)
    call new_state(2, 0, state)
    call element%law(s)
    call element%evaluate(state, spread(0.0_wp, 1, 9), strain, b, geo, valid)
    ke = matmul(transpose(b), matmul(s, b))
    dens = rho*[0.00428_wp, 5.8769951e-05_wp + 3.1640625e-06_wp, 5.8769951e-05_wp, 3.1640625e-06_wp, 0.0_wp, &
                2.628125e-08_wp]
    inertia = new_inertia(dens, l, axes, [0.0_wp, merge(zs, 0.0_wp, with_alpha)], consistent, .true.)
    call inertia_mass(inertia, no_turn, [0.0_wp, 0.0_wp], me)
    k = 0
    m = 0
    do i = 0, elements - 1
      k(7*i + 1:7*i + 14, 7*i + 1:7*i + 14) = k(7*i + 1:7*i + 14, 7*i + 1:7*i + 14) + ke
      m(7*i + 1:7*i + 14, 7*i + 1:7*i + 14) = m(7*i + 1:7*i + 14, 7*i + 1:7*i + 14) + me
    end do
    free = .true.
    free(1:4) = .false.
    free(7*elements + 2:7*elements + 4) = .false.
    list = pack([(i, i=1, size(free))], free)
    call factor%factorize(k(list, list), error)
    x = 1
    do j = 1, 200
      y = 0
      y(list) = matmul(m(list, list), x(list))
      x(list) = y(list)
      call factor%solve(x(:size(list)), error)
      exit
    end do
    frequency = 0
    call iterate(k(list, list), m(list, list), frequency)
    deallocate (shared)
  end function column_frequency

  subroutine iterate(k, m, frequency)
    real(wp), intent(in), contiguous :: k(:, :), m(:, :)
    real(wp), intent(out) :: frequency
    type(dense_symmetric_t) :: factor
    type(error_t), allocatable :: error
    real(wp) :: x(size(k, 1)), y(size(k, 1))
    integer :: j
    call factor%factorize(k, error)
    x = scattered(size(x), 3)
    do j = 1, 300
      y = matmul(m, x)
      x = y
      call factor%solve(x, error)
      frequency = 1/sqrt(norm2(x)/norm2(y)*1)
      x = x/norm2(x)
    end do
    frequency = sqrt(dot_product(x, matmul(k, x))/dot_product(x, matmul(m, x)))
  end subroutine iterate

end module test_beamw_inertia
