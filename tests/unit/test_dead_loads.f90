module test_dead_loads
  use kinds, only: wp
  use check, only: run, expect_close
  use rotation, only: rotation_matrix
  use nodal_state, only: state_t, new_state
  use system_data, only: dead_load_t
  use system_loads, only: dead_load
  implicit none
  private

  public :: run_dead_loads_tests

contains

  subroutine run_dead_loads_tests()
    call run("loads: a dead load on a leaning arm agrees with differences", load_differences)
  end subroutine run_dead_loads_tests

  !> Force and tangent of a load whose arm leans, by central differences of its potential
  !> -F.R(arm + alpha warp) in the symmetric Hessian of exp(theta): errors of about 1e-9.
  subroutine load_differences()
    real(wp), parameter :: h = 1.0e-4_wp
    type(dead_load_t) :: load
    type(state_t) :: state
    real(wp) :: force(9), tangent(6, 6), step(9), second, first
    integer :: i, j

    load%node = 1
    load%force = [0.7_wp, -1.2_wp, 0.4_wp]
    load%arm = [0.9_wp, 0.1_wp, -0.2_wp]
    load%warp = [0.3_wp, -0.2_wp, 0.5_wp]
    load%lean = [8, 9]
    load%lean_rate = [1.3_wp, -0.8_wp]
    load%axes = reshape([0.2_wp, 0.7_wp, 0.1_wp, -0.3_wp, 0.2_wp, 0.8_wp], [3, 2])
    call new_state(1, 2, 0, state)
    call state%move([0.0_wp, 0.0_wp, 0.0_wp, 0.4_wp, -0.7_wp, 0.3_wp, 0.25_wp, 0.6_wp, -0.5_wp])
    call dead_load(load, 1.0_wp, state, force, tangent)
    do i = 4, 9
      step = 0
      step(i) = h
      first = (potential(step) - potential(-step))/(2*h)
      call expect_close(force(i), -first, 1.0e-7_wp, "force")
      do j = 4, 9
        step = 0
        step(i) = h
        step(j) = step(j) + h
        second = potential(step)
        step(j) = step(j) - 2*h
        second = second - potential(step)
        step = -step
        second = second - potential(step)
        step(j) = step(j) - 2*h
        second = second + potential(step)
        call expect_close(tangent(i - 3, j - 3), second/(4*h**2), 1.0e-6_wp, "tangent")
      end do
    end do

  contains

    !> Potential after a step of the coordinates, read off the force's definition: only F.o.
    real(wp) function potential(step)
      real(wp), intent(in) :: step(9)
      type(state_t) :: moved
      real(wp) :: a(2), t, o(3)

      moved = state
      call moved%move(step)
      a = load%lean_rate*moved%release
      t = norm2(a)
      o = cos(t)*load%arm + sin(t)/t*matmul(load%axes, a) + moved%warping(1)*load%warp
      potential = -dot_product(load%force, matmul(rotation_matrix(moved%euler(:, 1)), o))
    end function potential

  end subroutine load_differences

end module test_dead_loads
