module test_element_joints
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use element_base, only: element_t
  use element_differences, only: compare_with_differences
  use joint_samples, only: new_joint, far_state, turn, move_rigidly, measure, joint_names, &
                           kinds_of_joints, truss, hinge, universal, spherical, cylindrical, &
                           gear, shared_gear, nodes, slots, pi, a, b, chord, stiffness, damping
  use nodal_state, only: state_t, new_state
  use pair_strains, only: completed_triad
  use rotation, only: cross, identity3
  implicit none
  private

  public :: run_element_joints_tests

contains

  subroutine run_element_joints_tests()
    call run("joints: Jacobian and Hessian agree with differences", differences)
    call run("joints: a common rigid motion changes no strain", rigid_motion)
    call run("joints: stiffness and damping by strain, none of fixed ones", laws)
    call run("joints: states they cannot describe are refused", invalid_states)
    call run("joints: triad of an axis", triads)
  end subroutine run_element_joints_tests

  subroutine differences()
    class(element_t), allocatable :: element
    type(state_t) :: state
    integer :: kind, i

    do kind = 1, kinds_of_joints
      call new_joint(kind, spread(.false., 1, 6), element)
      call expect(size(element%coordinate) == element%coordinates, "coordinates")
      do i = 1, 5
        call far_state(i, state)
        call compare_with_differences(element, state, trim(joint_names(kind)))
      end do
    end do
  end subroutine differences

  !> The points of the spherical joint coincide.
  subroutine rigid_motion()
    class(element_t), allocatable :: element
    type(state_t) :: state, moved
    real(wp), allocatable :: before(:), after(:)
    logical :: valid
    integer :: kind, i

    do kind = 1, kinds_of_joints
      call new_joint(kind, spread(.false., 1, 6), element)
      do i = 1, 5
        call far_state(i, state)
        if (kind == spherical) then
          state%displacement(:, 2) = state%displacement(:, 1) - chord
        end if
        moved = state
        call move_rigidly(moved, [2.0_wp, 0.3_wp*i, -1.1_wp], [-1.0_wp, 0.5_wp*i, 4.0_wp])
        call measure(element, state, before, valid)
        call expect(valid, "valid")
        call measure(element, moved, after, valid)
        call expect_close(after, before, 200*epsilon(1.0_wp), trim(joint_names(kind))//" strain")
      end do
    end do
  end subroutine rigid_motion

  subroutine laws()
    class(element_t), allocatable :: element
    real(wp) :: k(6, 6)
    integer :: kind, i, n

    do kind = 1, kinds_of_joints
      call new_joint(kind, [(modulo(i, 2) == 0, i=1, 6)], element)
      n = element%strains
      call expect(element%damped .and. size(element%fixed) == n, "damped")
      k = 0
      do i = 1, n, 2
        k(i, i) = 1
      end do
      call expect_close(law_of(element), k(:n, :n)*spread(stiffness(:n), 1, n), 0.0_wp, "stiffness")
      call expect_close(damping_of(element), k(:n, :n)*spread(damping(:n), 1, n), 0.0_wp, "damping")
      call new_joint(kind, spread(.true., 1, 6), element)
      call expect(.not. element%damped, "fixed: not damped")
    end do
  end subroutine laws

  function law_of(element) result(k)
    class(element_t), intent(in) :: element
    real(wp) :: k(element%strains, element%strains)

    call element%law(k)
  end function law_of

  function damping_of(element) result(k)
    class(element_t), intent(in) :: element
    real(wp) :: k(element%strains, element%strains)

    call element%damping(k)
  end function damping_of

  subroutine invalid_states()
    integer, parameter :: with_axis(4) = [hinge, cylindrical, gear, shared_gear]
    real(wp) :: normal(3)
    integer :: i

    normal = cross(a, [1.0_wp, 0.0_wp, 0.0_wp])
    normal = normal/norm2(normal)
    do i = 1, size(with_axis)
      call expect(is_valid(with_axis(i), 0.49_wp*pi*normal, 0*a), "less than a right angle")
      call expect(.not. is_valid(with_axis(i), 0.51_wp*pi*normal, 0*a), "more than a right angle")
    end do
    normal = cross(a, b)/norm2(cross(a, b))
    call expect(is_valid(universal, 0.49_wp*pi*normal, 0*a), "universal bent aside")
    call expect(.not. is_valid(universal, 0.5_wp*pi*normal, 0*a), &
                "universal with parallel axes")
    call expect(is_valid(truss, 0*a, -0.99_wp*chord), "short truss")
    call expect(.not. is_valid(truss, 0*a, -chord), "truss of no length")
  end subroutine invalid_states

  !> Whether a joint can be after node 2 has turned and moved.
  logical function is_valid(kind, theta, shift)
    integer, intent(in) :: kind
    real(wp), intent(in) :: theta(3), shift(3)
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp), allocatable :: strain(:)

    call new_joint(kind, spread(.false., 1, 6), element)
    call new_state(nodes, 0, slots, state)
    call turn(state, 2, theta)
    state%displacement(:, 2) = shift
    call measure(element, state, strain, is_valid)
  end function is_valid

  !> Orthonormal and right-handed; b is along a global axis normal to a.
  subroutine triads()
    real(wp) :: t(3, 3), axis(3)
    integer :: i

    do i = 1, 40
      axis = [sin(1.7_wp*i), sin(2.9_wp*i), sin(4.1_wp*i)]
      if (i <= 3) axis = identity3(:, i)
      if (i > 3 .and. i <= 6) axis = -1.0e-3_wp*identity3(:, i - 3)
      t = completed_triad(axis)
      call expect_close(matmul(transpose(t), t), identity3, 8*epsilon(1.0_wp), "orthonormal")
      call expect_close(cross(t(:, 1), t(:, 2)), t(:, 3), 8*epsilon(1.0_wp), "right-handed")
      call expect_close(t(:, 1)*norm2(axis), axis, 4*epsilon(1.0_wp), "along the axis")
    end do
    t = completed_triad([0.0_wp, 0.0_wp, 2.0_wp])
    call expect_close(t(:, 2), identity3(:, 1), 0.0_wp, "tie goes to x")
    t = completed_triad([1.0_wp, 1.0e-9_wp, 0.0_wp])
    call expect_close(t(:, 2), identity3(:, 2), 1.0e-8_wp, "a near tie goes to y")
  end subroutine triads

end module test_element_joints
