!> How far held strains are from their targets, in units that mean the same for lengths, angles and
!> rates of twist.
module strain_gaps
  use kinds, only: wp
  use nodal_state, only: state_t
  use element_base, only: element_t
  use system_data, only: system_t
  use system_constraints, only: coordinate_scale
  use system_motion, only: set_targets
  implicit none
  private

  public :: is_open, row_size

  !> Gaps up to this count as closed, in lengths of the model or radians.
  real(wp), parameter, public :: closed_gap = 1.0e-9_wp

contains

  !> Whether a held strain is off its target with the patterns at `level`.
  pure logical function is_open(system, level, state)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    type(state_t), intent(in) :: state
    real(wp) :: target(size(system%multiplier))
    integer :: e

    call set_targets(system, level, target)
    is_open = .false.
    do e = 1, size(system%element)
      associate (element => system%element(e)%e, &
                 mine => target(system%first(e) + 1:system%first(e + 1)))
        if (any(element%fixed)) is_open = is_open .or. is_off(system, element, state, mine)
      end associate
      if (is_open) return
    end do
  end function is_open

  pure logical function is_off(system, element, state, target)
    type(system_t), intent(in) :: system
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: target(element%strains)
    real(wp) :: strain(element%strains), stress(element%strains)
    real(wp) :: jacobian(element%strains, element%coordinates)
    real(wp) :: geometric(element%coordinates, element%coordinates)
    logical :: valid

    stress = 0
    call element%evaluate(state, stress, strain, jacobian, geometric, valid)
    is_off = .not. valid
    if (valid) is_off = any(element%fixed .and. &
                            abs(strain - target) > closed_gap*row_size(system, element, jacobian))
  end function is_off

  !> By strain: its change when the model moves by its length or a radian.
  pure function row_size(system, element, jacobian) result(size_of)
    type(system_t), intent(in) :: system
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates)
    real(wp) :: size_of(element%strains)
    integer :: j

    size_of = tiny(1.0_wp)
    do j = 1, element%coordinates
      size_of = max(size_of, abs(jacobian(:, j))*coordinate_scale(system, element%coordinate(j)))
    end do
  end function row_size

end module strain_gaps
