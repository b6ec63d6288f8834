!> What a motion starts from: places and velocities that the constraints allow, and accelerations
!> and multipliers that satisfy the equations of motion.
module dynamic_start
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use model_data, only: model_t
  use nodal_state, only: state_t, node_coordinates
  use rotation, only: cross
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_motion, only: target_rates
  use system_newton, only: right_hand_side, advance
  use system_rates, only: strain_rates, convective_rates, held_forces
  use system_unknowns, only: by_coordinate, by_unknown, held_entries
  use system_inertia, only: find_massive
  use generalized_alpha, only: flow_t
  use dynamic_equilibrium, only: dynamics_t, assemble_motion, set_shares, inertia_of, &
                                 largest_gap, constraint_tolerance
  use start_assembly, only: assemble_model
  use start_velocity, only: find_velocities
  use singular_refusal, only: leave_singular
  implicit none
  private

  public :: start_motion, restart_motion, settle_motion, constraint_accelerations

  !> The accelerations come from the matrix of a step this part of the first one's length: the
  !> stiffness then weighs 1e-4 of what it does there.
  real(wp), parameter, public :: part_of_step = 1.0e-2_wp

  !> Iterations that close gaps behind a jump; smaller gaps, in lengths of the model, are none.
  integer, parameter :: most_closings = 20, enough_closings = 3
  real(wp), parameter :: no_jump = 1.0e-9_wp

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
      if (.not. allocated(error)) call leave_singular( &
        model, motion%system, motion%iterate%state, level, motion%flow%velocity, error)
      if (allocated(error)) return
    end if
    call restart_motion(part_of_step*h, level, motion, error)
  end subroutine start_motion

  !> Velocities that satisfy the constraints, M a + C'mu = f - h - D'sigma, C a = rates of the
  !> targets - v'Hv; with the matrix of a very short step, whose stiffness gives coordinates without
  !> mass theirs. Left in flow and iterate.
  subroutine restart_motion(h, level, motion, error)
    real(wp), intent(in) :: h          !< length of the very short step [T]
    real(wp), intent(in) :: level(:)
    type(dynamics_t), intent(inout) :: motion
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: share, demand(size(motion%iterate%strain))
    real(wp), dimension(motion%system%equations()) :: b, solution
    integer :: k

    motion%flow%acceleration = 0
    call set_shares(motion, h)
    share = motion%scheme%acceleration_share(h)
    motion%shares%acceleration = share
    call close_places(level, motion, error)
    if (allocated(error)) return
    call motion%solver%factorize(motion%iterate%values, error)
    if (allocated(error)) return
    if (motion%system%multipliers > 0) then
      call target_rates(motion%system, level, motion%demand, demand)
      b = held_entries(motion%system, motion%demand - motion%iterate%rate)
      call solve_by_mass(motion, b, solution, error)
      if (allocated(error)) return
      motion%flow%velocity = motion%flow%velocity + by_coordinate(motion%system, solution)
      call assemble_here(motion, level, keeps_matrix=.true.)
    end if
    call constraint_accelerations(motion%system, motion%iterate, level, demand)
    b = right_hand_side(motion%system, motion%iterate)
    b(motion%system%unknowns + 1:) = 0
    call solve_by_mass(motion, b + held_entries(motion%system, demand/share), solution, error)
    if (allocated(error)) return
    motion%flow%acceleration = share*by_coordinate(motion%system, solution)
    call guide_massless(motion, demand, motion%flow%acceleration, error)
    if (allocated(error)) return
    do k = 1, size(demand)
      associate (at => motion%system%multiplier(k))
        if (at > 0) motion%iterate%stress(k) = solution(at)
      end associate
    end do
    motion%flow%pseudo = motion%flow%acceleration
    motion%flow%step = 0
    call assemble_here(motion, level)
  end subroutine restart_motion

  !> Put held strains on targets that have jumped, by the motion of least mass times square that
  !> does it; with the shares of a very short step. Left assembled.
  subroutine close_places(level, motion, error)
    real(wp), intent(in) :: level(:)
    type(dynamics_t), intent(inout) :: motion
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(motion%system%equations()), change(motion%system%coordinates), gap
    integer :: iteration

    do iteration = 0, most_closings
      call assemble_here(motion, level)
      if (motion%iterate%invalid > 0) exit
      gap = largest_gap(motion)/motion%system%length
      if (gap <= constraint_tolerance) return
      if (gap <= no_jump .and. (iteration == 0 .or. iteration > enough_closings)) return
      call motion%solver%factorize(motion%iterate%values, error)
      if (allocated(error)) return
      solution = held_entries(motion%system, motion%iterate%target - motion%iterate%strain)
      call motion%solver%solve(solution, error)
      if (allocated(error)) return
      call advance(motion%system, solution, 1.0_wp, motion%iterate, change)
    end do
    call fail(error, exit_solve, "a prescribed motion jumps farther than the model can follow")
  end subroutine close_places

  !> Solve [M, C'; C, 0] x = b, M times the share of accelerations, by the factors of a very short
  !> step: of what its damping and stiffness have added, a part of the order of h, a second solution
  !> leaves the square.
  subroutine solve_by_mass(motion, b, x, error)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(in) :: b(:)
    real(wp), intent(out) :: x(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: rest(size(b)), held(motion%system%coordinates)

    x = b
    call motion%solver%solve(x, error)
    if (allocated(error)) return
    call held_forces(motion%system, motion%iterate, x, held)
    rest = b - inertia_of(motion, by_coordinate(motion%system, x)) - by_unknown(motion%system, held)
    rest(motion%system%unknowns + 1:) = 0
    call motion%solver%solve(rest, error)
    x = x + rest
  end subroutine solve_by_mass

  !> Give the scheme's own acceleration, and unless stabilised the velocities across constraints,
  !> the values that steps of length h keep: a = v' + lead h v'', and the part of
  !> h^2 (place_error v'' + w' x w/12) that changes held strains. Else these start an error of the
  !> multipliers of first order, which fades like RHOINF^n.
  !>
  !> v'' is the difference of accelerations at the present and after part of a step, by the matrix
  !> of a whole one: vibrations that the steps cannot follow then add nothing to it.
  subroutine settle_motion(h, level, motion, error)
    real(wp), intent(in) :: h, level(:)
    type(dynamics_t), intent(inout) :: motion
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: jerk(motion%system%coordinates), missed(size(jerk)), rate(size(motion%demand))
    real(wp) :: solution(motion%system%equations())
    integer :: k

    if (motion%system%multipliers == 0) return
    call set_shares(motion, h)
    call assemble_here(motion, level)
    call motion%solver%factorize(motion%iterate%values, error)
    if (allocated(error)) return
    call unbalance_rate(part_of_step*h, level, motion, solution)
    rate = 0
    do k = 1, size(rate)
      associate (at => motion%system%multiplier(k))
        if (at > 0) rate(k) = motion%shares%acceleration*solution(at)
      end associate
    end do
    call motion%solver%solve(solution, error)
    if (allocated(error)) return
    jerk = motion%shares%acceleration*by_coordinate(motion%system, solution)
    call guide_massless(motion, rate, jerk, error)
    if (allocated(error)) return
    motion%flow%pseudo = motion%flow%acceleration + motion%scheme%lead()*h*jerk
    motion%flow%step = h
    if (motion%stabilised) return
    missed = motion%scheme%place_error()*jerk + twist(motion)/12
    call strain_rates(motion%system, motion%iterate, missed, rate)
    solution = held_entries(motion%system, h**2*rate)
    call motion%solver%solve(solution, error)
    if (allocated(error)) return
    motion%flow%velocity = motion%flow%velocity + by_coordinate(motion%system, solution)
  end subroutine settle_motion

  !> Of coordinates without mass, whose accelerations (or changes of these) the equations of motion
  !> leave open: those that held strains ask for, D a = demand, and else none.
  subroutine guide_massless(motion, demand, acceleration, error)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(in) :: demand(:)      !< by strain
    real(wp), intent(inout) :: acceleration(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(motion%system%equations()), rate(size(demand))
    logical :: massive(size(acceleration))

    call find_massive(motion%masses, motion%iterate%state, massive)
    acceleration = merge(acceleration, 0.0_wp, massive)
    if (all(massive .or. motion%system%unknown == 0)) return
    call strain_rates(motion%system, motion%iterate, acceleration, rate)
    solution = held_entries(motion%system, (demand - rate)/motion%shares%acceleration)
    call motion%solver%solve(solution, error)
    if (allocated(error)) return
    where (.not. massive)
      acceleration = motion%shares%acceleration*by_coordinate(motion%system, solution)
    end where
  end subroutine guide_massless

  !> How fast the accelerations and multipliers of now fail to balance: rate of
  !> f - h - D'sigma - C'mu - M a, and of what held strains' second rates lack, as right-hand side.
  !> The motion is assembled at the present and left so, but for the matrix.
  subroutine unbalance_rate(dt, level, motion, b)
    real(wp), intent(in) :: dt, level(:)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(out) :: b(:)
    real(wp) :: later(size(level))
    type(state_t) :: state
    type(flow_t) :: flow

    b = unbalance(motion, level)
    state = motion%iterate%state
    flow = motion%flow
    later = level
    where (motion%system%timed) later = level + dt
    call motion%iterate%state%move(dt*flow%velocity + 0.5_wp*dt**2*flow%acceleration)
    motion%flow%velocity = flow%velocity + dt*flow%acceleration
    call assemble_here(motion, later, keeps_matrix=.true.)
    b = (unbalance(motion, later) - b)/dt
    motion%iterate%state = state
    motion%flow = flow
    call assemble_here(motion, level, keeps_matrix=.true.)
  end subroutine unbalance_rate

  !> What accelerations and multipliers leave of the equations of motion.
  pure function unbalance(motion, level) result(b)
    type(dynamics_t), intent(in) :: motion
    real(wp), intent(in) :: level(:)
    real(wp) :: b(motion%system%equations())
    real(wp), dimension(size(motion%demand)) :: demand, rate
    integer :: k

    call constraint_accelerations(motion%system, motion%iterate, level, demand)
    call strain_rates(motion%system, motion%iterate, motion%flow%acceleration, rate)
    b = right_hand_side(motion%system, motion%iterate)
    b(motion%system%unknowns + 1:) = 0
    b = b + held_entries(motion%system, (demand - rate)/motion%shares%acceleration)
    do k = 1, motion%system%coordinates
      associate (at => motion%system%unknown(k))
        if (at > 0) b(at) = b(at) - motion%iterate%constraint(k)
      end associate
    end do
  end function unbalance

  !> w' x w of each rotation, zero elsewhere.
  pure function twist(motion)
    type(dynamics_t), intent(in) :: motion
    real(wp) :: twist(motion%system%coordinates)
    integer :: k

    twist = 0
    do k = 4, node_coordinates*motion%system%nodes, node_coordinates
      twist(k:k + 2) = cross(motion%flow%acceleration(k:k + 2), motion%flow%velocity(k:k + 2))
    end do
  end function twist

  !> Residual and tangent, or the residual alone, at the present state.
  pure subroutine assemble_here(motion, level, keeps_matrix)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(in) :: level(:)
    logical, intent(in), optional :: keeps_matrix
    real(wp) :: none(motion%system%coordinates)

    none = 0
    if (present(keeps_matrix)) motion%iterate%keeps_matrix = keeps_matrix
    call assemble_motion(motion, level, none, motion%flow)
    motion%iterate%keeps_matrix = .false.
  end subroutine assemble_here

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
