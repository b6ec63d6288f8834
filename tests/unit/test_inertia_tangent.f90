module test_inertia_tangent
  use kinds, only: wp
  use check, only: run, expect_close
  use rotation, only: rotation_matrix, turned, cross
  use beamw_inertia, only: inertia_t, new_inertia, inertia_mass, inertia_force
  use beamw_inertia_tangent, only: inertia_force_and_tangents, inertia_step_tangent
  use node_inertia, only: node_inertia_t, node_inertia_forces, node_momentum, node_kinetic_energy
  use truss_inertia, only: truss_mass
  use particle_body, only: place_t, no_turn, scattered, unit, some_inertia, some_place, moved
  implicit none
  private

  public :: run_inertia_tangent_tests

contains

  subroutine run_inertia_tangent_tests()
    call run("inertia tangent: forces and mass of a beam are those without tangents", same_forces)
    call run("inertia tangent: derivatives to the velocity of a beam", beam_rate)
    call run("inertia tangent: derivatives to the place of a beam", beam_place)
    call run("inertia tangent: turned forces are the derivative to a turn of all", turned_beam)
    call run("inertia tangent: that of a step is the sum of its parts", step_of_beam)
    call run("inertia tangent: derivatives of a node", node_tangents)
    call run("inertia tangent: a node's momentum and energy change by force and power", node_power)
    call run("inertia tangent: a free symmetric top precesses", free_top)
    call run("inertia tangent: mass of a truss", truss)
  end subroutine run_inertia_tangent_tests

  !> Lumped or consistent, without and with rotary inertia; the last without mass of the line.
  pure function sample(option) result(inertia)
    integer, intent(in) :: option  !< 0 to 4
    type(inertia_t) :: inertia
    real(wp), parameter :: only_section(6) = [0.0_wp, 2.2_wp, 1.3_wp, 0.9_wp, 0.4_wp, 0.7_wp]

    inertia = some_inertia(mod(option, 2) == 1, option >= 2)
    if (option == 4) inertia = new_inertia(only_section, 1.3_wp, rotation_matrix(no_turn(:, 1)), &
                                           [0.3_wp, 0.2_wp], .true., .true.)
  end function sample

  pure subroutine sample_motion(seed, place, v, a)
    integer, intent(in) :: seed
    type(place_t), intent(out) :: place
    real(wp), intent(out), dimension(7, 2) :: v, a

    place = some_place(seed)
    v = 3*reshape(scattered(14, seed + 10), [7, 2])
    a = 5*reshape(scattered(14, seed + 20), [7, 2])
  end subroutine sample_motion

  subroutine same_forces()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f, wanted
    real(wp), dimension(14, 14) :: m, rate, k, wanted_mass
    integer :: option

    do option = 0, 4
      inertia = sample(option)
      call sample_motion(option + 1, place, v, a)
      call inertia_force_and_tangents(inertia, place%euler, place%alpha, v, a, f, m, rate, k)
      call inertia_force(inertia, place%euler, place%alpha, v, a, wanted)
      call inertia_mass(inertia, place%euler, place%alpha, wanted_mass)
      call expect_close(f, wanted, 1.0e-14_wp*norm2(wanted), "force")
      call expect_close(m, wanted_mass, 1.0e-15_wp*norm2(wanted_mass), "mass")
      call expect_close(m, transpose(m), 1.0e-15_wp*norm2(wanted_mass), "symmetric mass")
    end do
  end subroutine same_forces

  !> The forces are quadratic in the velocity: differences are exact but for round-off.
  subroutine beam_rate()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f, plus, minus
    real(wp), dimension(14, 14) :: m, rate, k
    integer :: option, i

    do option = 0, 4
      inertia = sample(option)
      call sample_motion(option + 1, place, v, a)
      call inertia_force_and_tangents(inertia, place%euler, place%alpha, v, a, f, m, rate, k)
      do i = 1, 14
        call inertia_force(inertia, place%euler, place%alpha, v + unit(i), a, plus)
        call inertia_force(inertia, place%euler, place%alpha, v - unit(i), a, minus)
        call expect_close(rate(:, i), reshape(plus - minus, [14])/2, 1.0e-13_wp*norm2(rate), &
                          "column of the velocity")
      end do
    end do
  end subroutine beam_rate

  !> Differences of fourth order, err by h**4/30 of fifth derivatives: 1e-12, round-off likewise.
  subroutine beam_place()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f
    real(wp), dimension(14, 14) :: m, rate, k
    real(wp), parameter :: h = 1.0e-3_wp
    real(wp) :: column(14)
    integer :: option, i

    do option = 0, 4
      inertia = sample(option)
      call sample_motion(option + 1, place, v, a)
      call inertia_force_and_tangents(inertia, place%euler, place%alpha, v, a, f, m, rate, k)
      do i = 1, 14
        column = reshape(8*(at(h) - at(-h)) - (at(2*h) - at(-2*h)), [14])/(12*h)
        call expect_close(k(:, i), column, 1.0e-11_wp*norm2(k), "column of the place")
      end do
    end do

  contains

    function at(step) result(force)
      real(wp), intent(in) :: step
      real(wp) :: force(7, 2)
      type(place_t) :: new

      new = moved(place, step*unit(i))
      call inertia_force(inertia, new%euler, new%alpha, v, a, force)
    end function at
  end subroutine beam_place

  !> Turning ends, velocities and accelerations together turns the forces: an identity between
  !> all of the tangents, without differences.
  subroutine turned_beam()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f, turn
    real(wp), dimension(14, 14) :: m, rate, k
    real(wp) :: theta(3), change(14)
    integer :: option

    theta = [0.4_wp, -1.2_wp, 0.7_wp]
    do option = 0, 4
      inertia = sample(option)
      call sample_motion(option + 3, place, v, a)
      call inertia_force_and_tangents(inertia, place%euler, place%alpha, v, a, f, m, rate, k)
      turn = 0
      turn(4:6, :) = spread(theta, 2, 2)
      change = matmul(k, reshape(turn, [14])) + matmul(rate, reshape(turn_of(v), [14])) &
               + matmul(m, reshape(turn_of(a), [14]))
      call expect_close(change, reshape(turn_of(f), [14]), 1.0e-13_wp*norm2(k), "turned forces")
    end do

  contains

    function turn_of(x) result(y)
      real(wp), intent(in) :: x(7, 2)
      real(wp) :: y(7, 2)
      integer :: e

      do e = 1, 2
        y(:, e) = [cross(theta, x(1:3, e)), cross(theta, x(4:6, e)), 0.0_wp]
      end do
    end function turn_of
  end subroutine turned_beam

  pure function some_node() result(node)
    type(node_inertia_t) :: node

    node%mass = 2.5_wp
    node%tensor = reshape([1.9_wp, 0.3_wp, -0.2_wp, 0.3_wp, 1.1_wp, 0.4_wp, -0.2_wp, 0.4_wp, &
                           2.3_wp], [3, 3])
  end function some_node

  !> place + (3 rate + 7 mass) T with any T of the spins; to round-off of the sums.
  subroutine step_of_beam()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp), dimension(7, 2) :: v, a, f, wanted
    real(wp), dimension(14, 14) :: m, rate, k, t, tangent, terms
    real(wp) :: turn(3, 3, 2)
    integer :: option, i, e

    do option = 0, 4
      inertia = sample(option)
      call sample_motion(option + 1, place, v, a)
      turn = reshape(scattered(18, option + 40), [3, 3, 2])
      t = 0
      do i = 1, 14
        t(i, i) = 1
      end do
      do e = 1, 2
        t(7*e - 3:7*e - 1, 7*e - 3:7*e - 1) = turn(:, :, e)
      end do
      call inertia_force_and_tangents(inertia, place%euler, place%alpha, v, a, wanted, m, rate, k)
      call inertia_step_tangent(inertia, place%euler, place%alpha, v, a, [3.0_wp, 7.0_wp], turn, &
                                f, tangent)
      terms = abs(k) + matmul(3*abs(rate) + 7*abs(m), abs(t))
      call expect_close(f, wanted, 1.0e-14_wp*maxval(abs(wanted)), "forces")
      call expect_close(tangent, k + matmul(3*rate + 7*m, t), 1.0e-14_wp*maxval(terms), "tangent")
    end do
  end subroutine step_of_beam

  !> As for the beam.
  subroutine node_tangents()
    type(node_inertia_t) :: node
    real(wp), dimension(6) :: v, a, f, plus, minus, unit6, column
    real(wp), dimension(6, 6) :: m, rate, k, x, y, z
    real(wp), parameter :: h = 1.0e-3_wp
    real(wp) :: euler(0:3)
    integer :: i

    node = some_node()
    euler = turned(no_turn(:, 1), [0.9_wp, -1.4_wp, 0.5_wp])
    v = 2*scattered(6, 4)
    a = 3*scattered(6, 5)
    call node_inertia_forces(node, euler, v, a, f, m, rate, k)
    do i = 1, 6
      unit6 = 0
      unit6(i) = 1
      call node_inertia_forces(node, euler, v, a + unit6, plus, x, y, z)
      call expect_close(m(:, i), plus - f, 1.0e-13_wp, "column of the acceleration")
      call node_inertia_forces(node, euler, v + unit6, a, plus, x, y, z)
      call node_inertia_forces(node, euler, v - unit6, a, minus, x, y, z)
      call expect_close(rate(:, i), (plus - minus)/2, 1.0e-13_wp, "column of the velocity")
      column = (8*(at(h) - at(-h)) - (at(2*h) - at(-2*h)))/(12*h)
      call expect_close(k(:, i), column, 1.0e-10_wp, "column of the place")
    end do
    call expect_close(m, transpose(m), 1.0e-15_wp, "symmetric mass")

  contains

    function at(step) result(force)
      real(wp), intent(in) :: step
      real(wp) :: force(6)

      call node_inertia_forces(node, turned(euler, step*unit6(4:6)), v, a, force, x, y, z)
    end function at
  end subroutine node_tangents

  !> A motion in closed form: R = exp(f1 e1) exp(f2 e2), r = sin(t) e1.
  pure subroutine node_motion(t, euler, v, a)
    real(wp), intent(in) :: t
    real(wp), intent(out) :: euler(0:3), v(6), a(6)
    real(wp) :: e1(3), e2(3), f1(0:2), f2(0:2), w(3)

    e1 = scattered(3, 1)
    e2 = scattered(3, 2)
    f1 = [sin(t), cos(t), -sin(t)]
    f2 = [sin(2*t + 1), 2*cos(2*t + 1), -4*sin(2*t + 1)]
    w = matmul(rotation_matrix(turned(no_turn(:, 1), f1(0)*e1)), e2)
    euler = turned(turned(no_turn(:, 1), f2(0)*e2), f1(0)*e1)
    v = [f1(1)*e1, f1(1)*e1 + f2(1)*w]
    a = [f1(2)*e1, f1(2)*e1 + f2(2)*w + f1(1)*f2(1)*cross(e1, w)]
  end subroutine node_motion

  !> Differences of fourth order: h**4 (2 w)**5/30 = 1e-10 of the momenta and energies.
  subroutine node_power()
    type(node_inertia_t) :: node
    real(wp), dimension(6) :: v, a, f
    real(wp), dimension(6, 6) :: m, rate, k
    real(wp), parameter :: h = 5.0e-4_wp
    real(wp) :: euler(0:3), t
    integer :: i

    node = some_node()
    do i = 1, 5
      t = 0.7_wp*i
      call node_motion(t, euler, v, a)
      call node_inertia_forces(node, euler, v, a, f, m, rate, k)
      call expect_close([f, dot_product(f, v)], &
                        (8*(at(t + h) - at(t - h)) - (at(t + 2*h) - at(t - 2*h)))/(12*h), &
                        1.0e-9_wp, "force and power")
      call expect_close(node_momentum(node, euler, v), matmul(m, v), 1.0e-13_wp, "M v")
    end do

  contains

    !> Momentum and energy.
    function at(time) result(x)
      real(wp), intent(in) :: time
      real(wp) :: x(7), p(0:3), u(6), unused(6)

      call node_motion(time, p, u, unused)
      x = [node_momentum(node, p, u), node_kinetic_energy(node, p, u)]
    end function at
  end subroutine node_power

  !> Of momentum H and transverse inertia I it turns by H/I besides its spin about its own axis e,
  !> w = H/I + spin e, and e itself turns by H/I; its inertia needs no moment.
  subroutine free_top()
    type(node_inertia_t) :: node
    real(wp), parameter :: across = 1.6_wp, along = 0.7_wp
    real(wp) :: w(3), wander(3), axis(3), euler(0:3), v(6), a(6), f(6), h(6), t, spin
    real(wp), dimension(6, 6) :: m, rate, k
    integer :: i

    node%tensor = reshape([along, 0.0_wp, 0.0_wp, 0.0_wp, across, 0.0_wp, 0.0_wp, 0.0_wp, across], &
                          [3, 3])
    w = [2.0_wp, -1.5_wp, 0.8_wp]
    wander = [along/across*w(1), w(2), w(3)]
    spin = (1 - along/across)*w(1)
    do i = 0, 4
      t = 0.6_wp*i
      axis = matmul(rotation_matrix(turned(no_turn(:, 1), t*wander)), [1.0_wp, 0.0_wp, 0.0_wp])
      euler = turned(turned(no_turn(:, 1), [t*spin, 0.0_wp, 0.0_wp]), t*wander)
      v = [0.0_wp, 0.0_wp, 0.0_wp, wander + spin*axis]
      a = [0.0_wp, 0.0_wp, 0.0_wp, spin*cross(wander, axis)]
      call node_inertia_forces(node, euler, v, a, f, m, rate, k)
      h = node_momentum(node, euler, v)
      call expect_close(f, 0*f, 1.0e-14_wp, "no moment")
      call expect_close(h(4:6), across*wander, 1.0e-14_wp, "momentum")
    end do
  end subroutine free_top

  !> Momentum of translation and energy of a rigid turn about the middle: rho A l**3 w**2/24, three
  !> times as much with half of the mass at each end.
  subroutine truss()
    real(wp), parameter :: density = 1.7_wp, length = 2.4_wp
    real(wp) :: m(6, 6), v(3), w(3), axis(3), x(3), momentum(6)
    integer :: option

    v = [2.0_wp, -3.0_wp, 5.0_wp]
    axis = [2, 3, 6]/7.0_wp
    w = [3, -6, 2]/7.0_wp
    x = 0.5_wp*length*cross(w, axis)
    do option = 0, 1
      m = truss_mass(density, length, option == 1)
      momentum = matmul(m, [v, v])
      call expect_close(momentum, 0.5_wp*density*length*[v, v], 1.0e-14_wp, "momentum")
      call expect_close(0.5_wp*dot_product([-x, x], matmul(m, [-x, x])), &
                        density*length**3/merge(24, 8, option == 1), 1.0e-14_wp, "energy")
      call expect_close(m, transpose(m), 0.0_wp, "symmetric")
    end do
  end subroutine truss

end module test_inertia_tangent
