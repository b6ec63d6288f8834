!> How fast strains change when the coordinates move with given velocities.
module system_rates
  use kinds, only: wp
  use nodal_state, only: state_t
  use element_base, only: element_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  implicit none
  private

  public :: strain_rates, convective_rates, strain_forces, held_forces

contains

  !> D v, by strain; of an assembled iterate.
  pure subroutine strain_rates(system, iterate, velocity, rate)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: velocity(:)
    real(wp), intent(out) :: rate(:)
    integer :: e, j, at

    rate = 0
    do e = 1, size(system%element)
      associate (element => system%element(e)%e, &
                 mine => rate(system%first(e) + 1:system%first(e + 1)))
        at = system%jacobian(e)
        do j = 1, element%coordinates
          mine = mine + iterate%jacobian(at + 1:at + size(mine))*velocity(element%coordinate(j))
          at = at + size(mine)
        end do
      end associate
    end do
  end subroutine strain_rates

  !> v'Hv, by strain: what the strains' accelerations are besides D a. `held_only`: zero for all
  !> others.
  pure subroutine convective_rates(system, state, velocity, held_only, rate)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(:)
    logical, intent(in) :: held_only
    real(wp), intent(out) :: rate(:)
    integer :: e

    rate = 0
    do e = 1, size(system%element)
      associate (element => system%element(e)%e)
        if (held_only .and. .not. any(element%fixed)) cycle
        if (.not. any(abs(velocity(element%coordinate)) > 0)) cycle
        if (allocated(element%part)) then
          call part_convection(element, size(element%part, 1), state, &
                               velocity(element%coordinate), held_only, &
                               rate(system%first(e) + 1:system%first(e + 1)))
          cycle
        end if
        call element_convection(element, state, velocity(element%coordinate), held_only, &
                                rate(system%first(e) + 1:system%first(e + 1)))
      end associate
    end do
  end subroutine convective_rates

  pure subroutine element_convection(element, state, velocity, held_only, rate)
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(element%coordinates)
    logical, intent(in) :: held_only
    real(wp), intent(inout) :: rate(element%strains)
    real(wp) :: stress(element%strains), strain(element%strains)
    real(wp) :: jacobian(element%strains, element%coordinates)
    real(wp) :: geometric(element%coordinates, element%coordinates)
    integer :: i
    logical :: valid

    do i = 1, element%strains
      if (held_only .and. .not. element%fixed(i)) cycle
      stress = 0
      stress(i) = 1
      call element%evaluate(state, stress, strain, jacobian, geometric, valid)
      if (valid) rate(i) = dot_product(velocity, matmul(geometric, velocity))
    end do
  end subroutine element_convection

  !> The same of an element with parts.
  pure subroutine part_convection(element, n, state, velocity, held_only, rate)
    class(element_t), intent(in) :: element
    integer, intent(in) :: n              !< coordinates of a part
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: velocity(element%coordinates)
    logical, intent(in) :: held_only
    real(wp), intent(inout) :: rate(element%strains)
    real(wp) :: stress(element%strains), strain(element%strains)
    real(wp) :: jacobian(element%strains, n), geometric(n, n)
    integer :: i, part
    logical :: valid

    do i = 1, element%strains
      if (held_only .and. .not. element%fixed(i)) cycle
      stress = 0
      stress(i) = 1
      call element%evaluate_part(state, stress, part, strain, jacobian, geometric, valid)
      if (.not. valid) return
      associate (v => velocity(element%part(:, part)))
        rate(i) = dot_product(v, matmul(geometric, v))
      end associate
    end do
  end subroutine part_convection

  !> D'S strain, by coordinate: the forces of strains by their law; of an assembled iterate.
  pure subroutine strain_forces(system, iterate, strain, force)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: strain(:)
    real(wp), intent(out) :: force(:)
    integer :: e

    force = 0
    do e = 1, size(system%element)
      call add_forces(system%element(e)%e, iterate%jacobian(system%jacobian(e) + 1:), &
                      strain(system%first(e) + 1:), force)
    end do
  end subroutine strain_forces

  pure subroutine add_forces(element, jacobian, strain, force)
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates)
    real(wp), intent(in) :: strain(element%strains)
    real(wp), intent(inout) :: force(:)
    real(wp) :: law(element%strains, element%strains), stress(element%strains)
    integer :: j

    call element%law(law)
    stress = matmul(law, strain)
    do j = 1, element%coordinates
      associate (at => element%coordinate(j))
        force(at) = force(at) + dot_product(jacobian(:, j), stress)
      end associate
    end do
  end subroutine add_forces

  !> C'mu, by coordinate: the forces of the multipliers of a solution; of an assembled iterate.
  pure subroutine held_forces(system, iterate, solution, force)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: solution(:)
    real(wp), intent(out) :: force(:)
    integer :: e, i, j

    force = 0
    do e = 1, size(system%element)
      associate (element => system%element(e)%e, first => system%first(e))
        do i = 1, element%strains
          if (system%multiplier(first + i) == 0) cycle
          do j = 1, element%coordinates
            associate (at => element%coordinate(j))
              force(at) = force(at) + solution(system%multiplier(first + i)) &
                          *iterate%jacobian(system%jacobian(e) + (j - 1)*element%strains + i)
            end associate
          end do
        end do
      end associate
    end do
  end subroutine held_forces

end module system_rates
