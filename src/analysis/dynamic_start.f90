!> What a motion starts from: places and velocities that the constraints allow, and accelerations
!> and multipliers that satisfy the equations of motion.
module dynamic_start
  use kinds, only: wp
  use errors, only: error_t
  use model_data, only: model_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble, right_hand_side
  use system_motion, only: target_rates
  use system_rates, only: convective_rates
  use system_dynamics, only: add_inertia
  use system_inertia, only: find_massive
  use rotation, only: identity3
  use dynamic_equilibrium, only: dynamics_t
  use start_assembly, only: assemble_model
  use start_velocity, only: find_velocities
  implicit none
  private

  public :: start_motion, restart_motion, constraint_accelerations

  !> The accelerations come from the matrix of a step this part of the first one's length: the
  !> stiffness then weighs 1e-4 of what it does there.
  real(wp), parameter, public :: part_of_step = 1.0e-2_wp

contains

  !> Prepare `motion` for its first step, of length h, at the time of the timed patterns' `level`.
  !> `fresh`: the motion starts here, with the model's initial velocities.
  subroutine start_motion(model, h, fresh, level, motion, error)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: h, level(:)
    logical, intent(in) :: fresh
    type(dynamics_t), intent(inout) :: motion
    type(error_t), allocatable, intent(out) :: error

    if (fresh) then
      call assemble_model(model, motion%system, level, motion%iterate%state, error)
      if (allocated(error)) return
      call find_velocities(model, motion%system, motion%iterate%state, level, &
                           motion%flow%velocity, error)
      if (allocated(error)) return
    end if
    call restart_motion(part_of_step*h, level, motion, error)
  end subroutine start_motion

  !> M a + C'mu = f - h - D'sigma, C a = rates of the targets - v'Hv; with the matrix of a very
  !> short step, whose stiffness gives coordinates without mass theirs. Left in flow and iterate.
  subroutine restart_motion(h, level, motion, error)
    real(wp), intent(in) :: h          !< length of the very short step [T]
    real(wp), intent(in) :: level(:)
    type(dynamics_t), intent(inout) :: motion
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(motion%system%equations()), share, demand(size(motion%iterate%strain))
    logical :: massive(motion%system%coordinates)
    integer :: i, k

    motion%flow%acceleration = 0
    motion%shares%velocity = motion%scheme%velocity_share(h)
    motion%shares%acceleration = motion%scheme%acceleration_share(h)
    motion%iterate%velocity_share = motion%shares%velocity
    share = motion%shares%acceleration
    do i = 1, motion%system%nodes
      motion%shares%turn(:, :, i) = identity3
    end do
    motion%iterate%velocity = motion%flow%velocity
    call assemble_at_rest(motion, level)
    call constraint_accelerations(motion%system, motion%iterate, level, demand)
    solution = right_hand_side(motion%system, motion%iterate)
    do k = 1, size(demand)
      associate (at => motion%system%multiplier(k))
        if (at > 0) solution(at) = demand(k)/share
      end associate
    end do
    call motion%solver%factorize(motion%iterate%values, error)
    if (.not. allocated(error)) call motion%solver%solve(solution, error)
    if (allocated(error)) return
    call find_massive(motion%masses, motion%iterate%state, massive)
    do k = 1, motion%system%coordinates
      associate (at => motion%system%unknown(k))
        if (at > 0 .and. massive(k)) motion%flow%acceleration(k) = share*solution(at)
      end associate
    end do
    do k = 1, size(demand)
      associate (at => motion%system%multiplier(k))
        if (at > 0) motion%iterate%stress(k) = solution(at)
      end associate
    end do
    motion%flow%pseudo = motion%flow%acceleration
    call assemble_at_rest(motion, level)
  end subroutine restart_motion

  subroutine assemble_at_rest(motion, level)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(in) :: level(:)

    call assemble(motion%system, level, motion%iterate)
    call add_inertia(motion%system, motion%masses, motion%shares, motion%iterate%state, &
                     motion%flow%velocity, motion%flow%acceleration &
                     + motion%mass_damping*motion%flow%velocity, motion%iterate%inertial, &
                     motion%iterate%values)
  end subroutine assemble_at_rest

  !> What D a has to be for the held strains: the second rate of their targets less v'Hv, by strain.
  pure subroutine constraint_accelerations(system, iterate, level, demand)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate  !< with its state and velocity
    real(wp), intent(in) :: level(:)
    real(wp), intent(out) :: demand(:)
    real(wp), dimension(size(demand)) :: rate, convective

    call target_rates(system, level, rate, demand)
    call convective_rates(system, iterate%state, iterate%velocity, .true., convective)
    demand = demand - convective
  end subroutine constraint_accelerations

end module dynamic_start
