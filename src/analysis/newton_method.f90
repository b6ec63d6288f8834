!> Newton in mixed form on the system with multipliers (theory 8), with the load factor given or
!> found along a path.
module newton_method
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: state_t, node_coordinates
  use linalg_solver, only: solver_t
  use model_data, only: control_load
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_constraints, only: coordinate_scale
  use system_newton, only: right_hand_side, pattern_direction, advance
  use system_unknowns, only: by_coordinate
  use path_control, only: control_t, load_increment
  use recorder, only: recorder_t, iteration_t
  implicit none
  private

  public :: newton_t, newton_outcome_t, find_equilibrium

  integer, parameter, public :: newton_converged = 0, newton_slow = 1, newton_diverged = 2, &
                                newton_distorted = 3, newton_interrupted = 4

  real(wp), parameter, public :: default_tolerance = 1.0e-7_wp
  integer, parameter, public :: default_iterations = 30

  !> Fixed strains are zero to this part of the model's length when an iteration has converged.
  real(wp), parameter :: constraint_tolerance = 1.0e-11_wp

  !> A motion this large, in lengths of the model or radians, is no solution.
  real(wp), parameter :: far = 1.0e2_wp

  !> Residuals this many times their estimated round-off are as small as they get.
  real(wp), parameter :: noise_margin = 8.0_wp

  !> When to stop.
  type :: newton_t
    real(wp) :: tolerance = default_tolerance  !< of increment and residual, both relative
    integer :: iterations = default_iterations
  end type newton_t

  !> How it ended.
  type :: newton_outcome_t
    integer :: status = newton_converged  !< one of `newton_*`
    type(iteration_t) :: last
    integer :: worst = 0                  !< coordinate with the largest residual
    integer :: element = 0                !< of `newton_distorted`: the one rotated too far
  end type newton_outcome_t

contains

  !> Iterate to equilibrium. `level` holds the load factors of the patterns; that of the control's
  !> pattern is found, unless the control is the load. `count` holds the step for the record.
  !> On return `iterate` is assembled at its state; after a failure it is to be reset.
  subroutine find_equilibrium(system, solver, options, control, level, count, iterate, recorder, &
                              outcome, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(newton_t), intent(in) :: options
    type(control_t), intent(inout) :: control
    real(wp), intent(inout) :: level(:)
    type(iteration_t), intent(in) :: count
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(system%equations()), increment(system%coordinates), motion, rise
    logical :: converged

    outcome%last = count
    call assemble(system, level, iterate)
    do
      if (recorder%interrupted()) then
        outcome%status = newton_interrupted
        return
      end if
      outcome%last%iteration = outcome%last%iteration + 1
      call solver%factorize(iterate%values, error)
      if (allocated(error)) return
      call solve_on_path(system, solver, control, level, iterate, solution, rise, error)
      if (allocated(error)) return
      call step_safely(system, control, solution, rise, level, iterate, increment, outcome)
      if (outcome%status /= newton_converged) return
      if (allocated(control%total)) control%total = control%total + increment
      motion = largest_motion(system, iterate%state)
      outcome%last%increment = measure(system, increment)/max(motion, tiny(1.0_wp))
      if (control%pattern > 0) outcome%last%factor = level(control%pattern)
      call judge(system, options, iterate, motion, outcome, converged)
      call recorder%iteration(outcome%last)
      if (converged .or. outcome%status /= newton_converged) return
      if (outcome%last%iteration >= options%iterations) then
        outcome%status = newton_slow
        return
      end if
    end do
  end subroutine find_equilibrium

  !> Increment of the unknowns (multipliers: new values) and the rise of the load factor with it.
  subroutine solve_on_path(system, solver, control, level, iterate, solution, rise, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(control_t), intent(in) :: control
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(out) :: solution(:), rise
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: direction(:)

    rise = 0
    solution = right_hand_side(system, iterate)
    call solver%solve(solution, error)
    if (allocated(error) .or. control%kind == control_load) return
    direction = pattern_direction(system, iterate%state, level, control%pattern)
    call solver%solve(direction, error)
    if (allocated(error)) return
    rise = load_increment(system, control, iterate, by_coordinate(system, solution), &
                          by_coordinate(system, direction))
    solution = solution + rise*direction
  end subroutine solve_on_path

  !> Advance and assemble; a step that turns an element too far is halved up to four times.
  subroutine step_safely(system, control, solution, rise, level, iterate, increment, outcome)
    type(system_t), intent(in) :: system
    type(control_t), intent(in) :: control
    real(wp), intent(in) :: solution(:), rise
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    real(wp), intent(out) :: increment(:)
    type(newton_outcome_t), intent(inout) :: outcome
    type(state_t) :: state
    real(wp) :: stress(size(system%multiplier)), share, start(size(level))
    integer :: attempt

    state = iterate%state
    stress = iterate%stress
    start = level
    share = 1
    do attempt = 0, 4
      if (attempt > 0) then
        share = share/2
        iterate%state = state
        iterate%stress = stress
        level = start
        call assemble(system, level, iterate)
      end if
      call advance(system, solution, share, iterate, increment)
      if (control%kind /= control_load) then
        level(control%pattern) = start(control%pattern) + share*rise
      end if
      outcome%status = newton_diverged
      if (.not. measure(system, increment) < far) return
      call assemble(system, level, iterate)
      outcome%status = newton_converged
      if (iterate%invalid == 0) return
    end do
    outcome%element = iterate%invalid
    outcome%status = newton_distorted
  end subroutine step_safely

  !> Measure the residual and decide. Converged means a small increment, whose square is what is
  !> left, and forces in balance to the tolerance or to round-off.
  subroutine judge(system, options, iterate, motion, outcome, converged)
    type(system_t), intent(in) :: system
    type(newton_t), intent(in) :: options
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: motion
    type(newton_outcome_t), intent(inout) :: outcome
    logical, intent(out) :: converged
    real(wp) :: reference, residual, largest, noise
    integer :: k

    reference = 0
    largest = 0
    noise = 0
    outcome%worst = 0
    do k = 1, system%coordinates
      associate (scale => coordinate_scale(system, k))
        reference = max(reference, scale*abs(iterate%external(k)))
        residual = iterate%external(k) - iterate%internal(k) - iterate%constraint(k)
        if (system%unknown(k) == 0) then
          reference = max(reference, scale*abs(residual))
          cycle
        end if
        noise = max(noise, abs(residual)/max(noise_margin*iterate%noise(k), tiny(1.0_wp)))
        if (.not. scale*abs(residual) > largest) cycle
        largest = scale*abs(residual)
        outcome%worst = k
      end associate
    end do
    outcome%last%residual = largest/max(reference, tiny(1.0_wp))
    outcome%last%constraint = largest_constraint(system, iterate)/system%length
    converged = outcome%last%increment*motion <= options%tolerance*motion + 100*epsilon(1.0_wp) &
                .and. (outcome%last%residual <= options%tolerance .or. noise <= 1) &
                .and. outcome%last%constraint <= constraint_tolerance
    if (.not. ieee_is_finite(largest)) outcome%status = newton_diverged
  end subroutine judge

  pure function largest_constraint(system, iterate) result(largest)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp) :: largest
    integer :: k

    largest = 0
    do k = 1, size(system%multiplier)
      if (system%multiplier(k) == 0) cycle
      largest = max(largest, abs(iterate%strain(k) - iterate%target(k)))
    end do
  end function largest_constraint

  !> Largest entry of a vector by coordinate, in units of the model's length and radians.
  pure function measure(system, motion) result(largest)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: motion(:)
    real(wp) :: largest
    integer :: k

    largest = 0
    do k = 1, size(motion)
      if (system%unknown(k) == 0) cycle
      if (abs(motion(k)) <= largest*coordinate_scale(system, k)) cycle
      largest = abs(motion(k))/coordinate_scale(system, k)
    end do
  end function measure

  !> How far the model is from its undeformed state, in the same units.
  pure function largest_motion(system, state) result(largest)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp) :: largest

    largest = max(maxval(abs(state%displacement))/system%length, &
                  2*maxval(abs(state%euler(1:3, :))), maxval(abs(state%warping))*system%length)
    if (size(state%release) > 0) largest = max(largest, maxval(abs(state%release))/system%length)
  end function largest_motion

end module newton_method
