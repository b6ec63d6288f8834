!> Instants of a motion to come back to.
module motion_instant
  use kinds, only: wp
  use nodal_state, only: state_t
  use generalized_alpha, only: flow_t
  use dynamic_equilibrium, only: dynamics_t
  implicit none
  private

  public :: instant_t, remember, go_back

  !> A motion at one time.
  type :: instant_t
    real(wp) :: time = 0.0_wp
    type(state_t) :: state
    type(flow_t) :: flow
    real(wp), allocatable :: stress(:), level(:)
  end type instant_t

contains

  !> Remember where a motion stands.
  pure subroutine remember(time, level, motion, instant)
    real(wp), intent(in) :: time, level(:)
    type(dynamics_t), intent(in) :: motion
    type(instant_t), intent(inout) :: instant

    instant%time = time
    instant%level = level
    instant%state = motion%iterate%state
    instant%stress = motion%iterate%stress
    instant%flow = motion%flow
  end subroutine remember

  !> Back to what `remember` noted; the motion is not assembled there.
  pure subroutine go_back(instant, time, level, motion)
    type(instant_t), intent(in) :: instant
    real(wp), intent(out) :: time, level(:)
    type(dynamics_t), intent(inout) :: motion

    time = instant%time
    level = instant%level
    motion%iterate%state = instant%state
    motion%iterate%stress = instant%stress
    motion%flow = instant%flow
  end subroutine go_back

end module motion_instant
