!> INVERSE: the forces of prescribed motions against closed forms.
module test_inverse
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use model_data, only: model_t, analysis_inverse
  use memory_recorder, only: memory_t
  use mechanism_kit, only: new_mechanism, add_node, add_bar, add_hinge, add_mass, drive, &
                           add_analysis, run_mechanism, make_slider_crank, slider_jet, unit, across
  implicit none
  private

  public :: run_inverse_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  integer, parameter :: x = 1, y = 2, z = 3, rx = 4, ry = 5, rz = 6

contains

  subroutine run_inverse_tests()
    call run("inverse: driven compound pendulum", pendulum)
    call run("inverse: slider-crank, forces at the slider and the crank", driven_slider)
    call run("inverse: whirling mass on a spring", whirling)
  end subroutine run_inverse_tests

  subroutine solve(model, memory)
    type(model_t), intent(inout) :: model
    type(memory_t), intent(out) :: memory
    type(error_t), allocatable :: error

    call run_mechanism(model, memory, error)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
  end subroutine solve

  !> A bar of mass m and length l, its rotary inertia included, turned from level up with gravity:
  !> torque of the drive m l**2/3 a + J a + m g l/2 cos; forces m (a_c + g).
  subroutine pendulum()
    real(wp), parameter :: l = 1.2_wp, density = 2.5_wp, rotary = 0.3_wp, g = 9.81_wp
    real(wp), parameter :: v0 = 0.4_wp, a0 = 1.7_wp, m = density*l
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: t, angle, v, torque, force(3), kinetic
    integer :: a, b, base, i

    call new_mechanism(model)
    a = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    b = add_node(model, [l, 0.0_wp, 0.0_wp])
    base = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [rx, ry, rz])
    i = add_bar(model, a, b, a, b)
    model%member(i)%has_inertia = .true.
    model%member(i)%inertia = [density, 2*rotary, rotary, rotary, 0.0_wp, 0.0_wp]
    i = add_hinge(model, base, a, .true.)
    call drive(model, i, 0.0_wp, v0, a0)
    model%pattern(1)%gravity = [0.0_wp, -g, 0.0_wp]
    call add_analysis(model, analysis_inverse, 2.0_wp, 0.01_wp)
    call solve(model, memory)
    call expect(memory%steps == 201, "all steps")
    do i = 1, memory%steps
      t = memory%record(i)%time
      angle = v0*t + 0.5_wp*a0*t**2
      v = v0 + a0*t
      torque = (m*l**2/3 + rotary*l)*a0 + 0.5_wp*m*g*l*cos(angle)
      force = m*(0.5_wp*l*(a0*across(angle) - v**2*unit(angle)) + [0.0_wp, g, 0.0_wp])
      kinetic = 0.5_wp*(m*l**2/3 + rotary*l)*v**2
      associate (now => memory%results(i))
        call expect_close(now%joint_stress(1, 1), -torque, 1.0e-9_wp*m*g*l, "torque")
        call expect_close(now%reaction(1:3, a), force, 1.0e-9_wp*m*g, "force of the pivot")
        call expect_close(now%reaction(6, base), torque, 1.0e-9_wp*m*g*l, "torque on the base")
        call expect_close(now%energy(1), kinetic, 1.0e-10_wp*kinetic, "kinetic energy")
        call expect_close(now%momentum(1:3), 0.5_wp*m*l*v*across(angle), 1.0e-10_wp*m*l*v, &
                          "momentum")
        ! trapezoidal rule over angles of 0.038 at most: 0.038**2/12 times twice m g l/2
        call expect_close(now%energy(6), 0.0_wp, 1.2e-4_wp*m*g*l, "balance of energies")
      end associate
    end do
  end subroutine pendulum

  !> All mass at the slider: it is pushed along x by m a, held by the rod and the guide, and the
  !> crank gives the power m a v.
  subroutine driven_slider()
    real(wp), parameter :: r = 0.15_wp, l = 0.3_wp, w = 150, m = 0.8_wp
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: jet(0:2), force, angle, slope
    integer :: i, slider

    call make_slider_crank(r, l, w, model, slider)
    call add_mass(model, slider, m)
    call add_analysis(model, analysis_inverse, 2*pi/w, 2*pi/w/90)
    call solve(model, memory)
    call expect(memory%steps == 91, "all steps")
    do i = 1, memory%steps
      angle = (i - 1)*pi/45
      jet = slider_jet(r, l, angle)
      force = m*w**2*jet(2)
      slope = -r*sin(angle)/sqrt(l**2 - (r*sin(angle))**2)
      associate (now => memory%results(i), unit_force => m*w**2*r)
        call expect_close(now%joint_stress(1, 1), -force*jet(1), 1.0e-9_wp*unit_force*r, "torque")
        call expect_close(now%reaction(1:3, 1), [force, force*slope, 0.0_wp], &
                          1.0e-9_wp*unit_force, "bearing of the crank")
        call expect_close(now%reaction(2, slider), -force*slope, 1.0e-9_wp*unit_force, "guide")
      end associate
    end do
  end subroutine driven_slider

  !> k d = m w**2 (l + d).
  subroutine whirling()
    real(wp), parameter :: l = 2, k = 50, m = 1.5_wp, w = 3
    type(model_t) :: model
    type(memory_t) :: memory
    real(wp) :: stretch, angle
    integer :: a, b, base, i

    call new_mechanism(model)
    a = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    b = add_node(model, [l, 0.0_wp, 0.0_wp])
    base = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [rx, ry, rz])
    i = add_bar(model, a, b, a, b)
    model%member(i)%status(1) = 1
    model%member(i)%has_stiffness = .true.
    model%member(i)%stiffness(1:4) = [k*l, 1.0_wp, 1.0_wp, 1.0_wp]
    i = add_hinge(model, base, a, .true.)
    call drive(model, i, 0.0_wp, w, 0.0_wp)
    call add_mass(model, b, m)
    call add_analysis(model, analysis_inverse, 1.0_wp, 0.1_wp)
    call solve(model, memory)
    call expect(memory%steps == 11, "all steps")
    stretch = m*w**2*l/(k - m*w**2)
    do i = 1, memory%steps
      angle = w*memory%record(i)%time
      associate (now => memory%results(i))
        call expect_close(now%displacement(:, b), (l + stretch)*unit(angle) - l*unit(0.0_wp), &
                          1.0e-9_wp*l, "place of the mass")
        call expect_close(now%velocity(1:3, b), w*(l + stretch)*across(angle), 1.0e-8_wp*w*l, &
                          "velocity")
        call expect_close(now%reaction(1:3, a), -m*w**2*(l + stretch)*unit(angle), &
                          1.0e-8_wp*m*w**2*l, "force of the pivot")
        call expect_close(now%stress(1, 1), k*stretch, 1.0e-8_wp*k*l, "force of the spring")
      end associate
    end do
  end subroutine whirling

end module test_inverse
