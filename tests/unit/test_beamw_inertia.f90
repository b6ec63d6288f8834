module test_beamw_inertia
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use rotation, only: rotated, rotation_matrix, turned, cross, identity3
  use beamw_inertia, only: inertia_t, new_inertia, inertia_mass, inertia_force, kinetic_energy, &
                           weight_force
  use particle_body, only: place_t, particles, length, line_mass, warping_inertia, density, &
                           centre, no_turn, scattered, unit, some_triad, some_inertia, some_place, &
                           moved, particle_masses, particle_rates, particle_accelerations
  use linalg_dense, only: dense_symmetric_t
  implicit none
  private

  public :: run_beamw_inertia_tests

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
  end subroutine run_beamw_inertia_tests

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
    inertia = new_inertia(only_line, l, identity3, [0.0_wp, 0.0_wp], .true., .true.)
    call inertia_mass(inertia, no_turn, [0.0_wp, 0.0_wp], m)
    m = 420/l*m
    call expect_close(m(in_xy, in_xy), wanted, 1.0e-12_wp, "xy plane")
    turn = [1, -1, 1, -1]
    wanted = wanted*spread(turn, 1, 4)*spread(turn, 2, 4)
    call expect_close(m(in_xz, in_xz), wanted, 1.0e-12_wp, "xz plane")
    call expect_close(m([1, 8], [1, 8]), wanted([1, 3], [1, 3]), 1.0e-12_wp, "x")
    inertia = new_inertia(only_line, l, identity3, [0.0_wp, 3.0_wp], .true., .true.)
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
        wanted = 0.5_wp*sum(particle_masses(option == 1)*sum(particle_rates(place, v, 0*v)**2, 1)) &
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

  !> Differences of fourth order: errors of about h**4 (2 w)**5/30 = 1e-10 and of round-off, 1e-11.
  subroutine power_balance()
    real(wp), parameter :: h = 5.0e-4_wp
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
        call expect_close(sum(f*v), rate, 1.0e-9_wp, "power")
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
        wanted = (8*(spin_at(i + h) - spin_at(i - h)) &
                  - (spin_at(i + 2*h) - spin_at(i - 2*h)))/(12*h)
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
      call expect_close(sum(f(1:3, :), 2), line_mass*length*v(1:3, 1), 1.0e-13_wp, "momentum")
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
      call expect_close(kinetic_energy(inertia, euler, place%alpha, v), energy, 1.0e-14_wp*energy, &
                        "energy")
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
        call expect_close(f(:, e), [half, cross(arm, half), dot_product(s, half)], 1.0e-13_wp, &
                          "arms")
        do i = 1, 4
          plus = moved(place, h*unit(7*(e - 1) + 3 + i))
          minus = moved(place, -h*unit(7*(e - 1) + 3 + i))
          call weight_force(inertia, plus%euler, plus%alpha, field, fp, unused)
          call weight_force(inertia, minus%euler, minus%alpha, field, fm, unused)
          column = -(fp(4:7, e) - fm(4:7, e))/(2*h)
          if (i <= 3) column(1:3) = column(1:3) + 0.5_wp*cross(identity3(:, i), f(4:6, e))
          call expect_close(k(:, i, e), column, 1.0e-9_wp, "tangent")
        end do
      end do
    end do
  end subroutine weight

end module test_beamw_inertia
