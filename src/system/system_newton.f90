!> A step of Newton's iteration in mixed form (theory 8): its right-hand side, and what its solution
!> makes of the iterate.
module system_newton
  use kinds, only: wp
  use nodal_state, only: state_t
  use element_base, only: element_t, max_strains
  use system_data, only: system_t
  use system_assembly, only: iterate_t, multiply
  use system_loads, only: load_direction
  use system_motion, only: target_direction
  use system_unknowns, only: by_coordinate, mixed_entries
  implicit none
  private

  public :: right_hand_side, pattern_direction, advance

contains

  !> Loads minus forces of the strains, and what the held strains lack: the solution is the
  !> increment and the new multipliers.
  pure function right_hand_side(system, iterate) result(b)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp) :: b(system%equations()), force(system%coordinates)

    force = iterate%external - iterate%internal
    if (allocated(iterate%inertial)) force = force - iterate%inertial
    b = mixed_entries(system, force, iterate%target - iterate%strain)
  end function right_hand_side

  !> Derivative of the right-hand side to the level of a pattern: loads and motions.
  pure function pattern_direction(system, state, level, pattern) result(b)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    integer, intent(in) :: pattern
    real(wp) :: b(system%equations()), force(system%coordinates), rise(size(system%multiplier))

    call load_direction(system, state, level, pattern, force)
    call target_direction(system, level, pattern, rise)
    b = mixed_entries(system, force, rise)
  end function pattern_direction

  !> Take a step: move the state by `share` of the solution, extrapolate strains and stresses.
  pure subroutine advance(system, solution, share, iterate, increment)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: solution(:), share
    type(iterate_t), intent(inout) :: iterate
    real(wp), intent(out) :: increment(:)  !< by coordinate
    integer :: e

    increment = share*by_coordinate(system, solution)
    do e = 1, size(system%element)
      associate (jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)))
        call extrapolate(system, e, system%element(e)%e, jacobian, solution, share, increment, &
                         iterate)
      end associate
    end do
    call iterate%state%move(increment)
    do e = 1, size(system%element)
      if (system%element(e)%e%counts_turns) call system%element(e)%e%count_turns(iterate%state)
    end do
  end subroutine advance

  !> sigma <- S (strain + D du), with strain and D before the step; multipliers from the solution.
  pure subroutine extrapolate(system, e, element, jacobian, solution, share, increment, iterate)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates), solution(:), share
    real(wp), intent(in) :: increment(:)
    type(iterate_t), intent(inout) :: iterate
    real(wp) :: law(max_strains**2), strain(max_strains), stress(max_strains)
    integer :: first, last, i, n

    n = element%strains
    first = system%first(e) + 1
    last = system%first(e + 1)
    call element%law(law)
    strain(:n) = iterate%strain(first:last)
    do i = 1, element%coordinates
      strain(:n) = strain(:n) + jacobian(:, i)*increment(element%coordinate(i))
    end do
    iterate%strain(first:last) = strain(:n)
    call multiply(n, law, strain, stress)
    stress(:n) = stress(:n) + system%initial_stress(first:last)
    do i = 1, element%strains
      associate (old => iterate%stress(first + i - 1), at => system%multiplier(first + i - 1))
        if (at > 0) stress(i) = old + share*(solution(at) - old)
      end associate
    end do
    iterate%stress(first:last) = stress(:n)
  end subroutine extrapolate

end module system_newton
