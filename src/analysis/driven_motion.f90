!> A motion that prescribed strains determine: where the model is at a time, how fast it moves
!> there, and the forces that this takes.
!>
!> Held strains are on their targets, the others in equilibrium: with the loads, and for INVERSE
!> with inertia forces and dampers too. Position, then rates, from one matrix [K, C'; C, 0].
module driven_motion
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use model_data, only: model_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: free_motions
  use system_dynamics, only: inertia_forces
  use system_inertia, only: masses_t
  use system_motion, only: target_rates
  use system_newton, only: right_hand_side, advance
  use system_rates, only: convective_rates, strain_forces
  use system_unknowns, only: by_coordinate, mixed_entries
  use generalized_alpha, only: new_scheme
  use dynamic_equilibrium, only: dynamics_t, new_dynamics, release_dynamics
  use newton_method, only: newton_outcome_t, newton_converged, newton_slow, newton_diverged, &
                           newton_distorted
  implicit none
  private

  public :: driven_t, new_driven, release_driven, find_undriven, find_motion, is_smooth

  !> Of the increment and of what held strains lack, in lengths of the model and radians.
  real(wp), parameter :: tolerance = 1.0e-12_wp

  !> An increment that shrinks no more is round-off if it is this small.
  real(wp), parameter :: round_off = 1.0e-9_wp, stalled = 0.1_wp

  integer, parameter :: most_iterations = 20

  !> A larger increment is no solution; targets farther away than this are approached in stages.
  real(wp), parameter :: far = 10.0_wp, stage_length = 0.2_wp

  !> Inertia forces and the elastic deflection by them agree to this; each pass leaves the square
  !> of the motion's frequency over the natural one.
  real(wp), parameter :: inertia_tolerance = 1.0e-10_wp
  integer, parameter :: most_passes = 40

  !> A position is poor if coordinates move this many times as far as at best for what held strains
  !> lack: round-off grows so much in positions, by the square in velocities.
  real(wp), parameter :: poor_sensitivity = 1.0e2_wp

  real(wp), parameter :: largest_break = 0.1_wp  !< of velocities, to their size

  type :: driven_t
    type(dynamics_t) :: motion
    logical :: inertia = .false.               !< INVERSE
    logical :: poor = .false.                  !< the last position found
    real(wp) :: here = 0.0_wp                  !< sensitivity of the last position found
    real(wp) :: sensitivity = huge(1.0_wp)     !< the least found
    integer :: nulls = 0                       !< null pivots at the start, of no motion
    real(wp), allocatable :: strain_scale(:)   !< by strain: what counts as one
  end type driven_t

contains

  !> From a system with its state.
  subroutine new_driven(model, system, masses, iterate, inertia, self, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(iterate_t), intent(in) :: iterate
    logical, intent(in) :: inertia
    type(driven_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: e

    call new_dynamics(system, masses, iterate, new_scheme(1.0_wp), model%rayleigh(1), self%motion, &
                      error)
    self%inertia = inertia
    allocate (self%strain_scale(size(system%multiplier)))
    do e = 1, size(system%element)
      self%strain_scale(system%first(e) + 1:system%first(e + 1)) = &
        merge(system%element(e)%e%size, system%length, system%element(e)%e%size > 0)
    end do
  end subroutine new_driven

  subroutine release_driven(self)
    type(driven_t), intent(inout) :: self

    call release_dynamics(self%motion)
  end subroutine release_driven

  !> Coordinates that neither constraints nor the stiffness of the unstressed model determine.
  subroutine find_undriven(self, level, coordinates, error)
    type(driven_t), intent(inout) :: self
    real(wp), intent(in) :: level(:)
    integer, allocatable, intent(out) :: coordinates(:)
    type(error_t), allocatable, intent(out) :: error
    type(iterate_t) :: unstressed

    call new_iterate(self%motion%system, unstressed)
    unstressed%state = self%motion%iterate%state
    call assemble(self%motion%system, 0*level, unstressed)
    call self%motion%solver%factorize(unstressed%values, error)
    if (allocated(error)) return
    call free_motions(self%motion%system, unstressed, self%motion%solver, coordinates, error)
    self%nulls = size(self%motion%solver%null_pivots())
  end subroutine find_undriven

  !> Position and rates with the patterns at `level`, from the present state as a first guess;
  !> assembled there. After a failure the state is to be reset.
  subroutine find_motion(self, level, outcome, error)
    type(driven_t), intent(inout) :: self
    real(wp), intent(in) :: level(:)
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: change, before
    integer :: pass

    before = huge(before)
    do pass = 1, most_passes
      call find_position(self, level, outcome, error)
      if (allocated(error) .or. outcome%status /= newton_converged) return
      call find_rates(self, level, error)
      if (allocated(error)) return
      if (.not. self%inertia) return
      call renew_inertia(self%motion, change)
      if (has_settled(self%here, change, before)) return
      if (.not. ieee_is_finite(change)) exit
      before = change
    end do
    outcome%status = newton_diverged
    if (.not. self%poor) call fail(error, exit_solve, "the deflection by the inertia forces "// &
      "does not settle: the motion is too fast for INVERSE, TRANSIENT follows it")
  end subroutine find_motion

  !> Whether inertia forces that change so much, and `before` that, have settled: they agree to the
  !> tolerance, or shrink no more and differ by their round-off. Positions are right to theirs; C,
  !> off by as much, is inverted for velocities, off by s times that, and with these for
  !> accelerations, off by s**2 times that.
  pure logical function has_settled(sensitivity, change, before)
    real(wp), intent(in) :: sensitivity    !< s
    real(wp), intent(in) :: change, before

    has_settled = change <= inertia_tolerance .or. &
                  change > stalled*before .and. change <= tolerance*sensitivity**2
  end function has_settled

  !> Newton, in stages where the targets are far.
  subroutine find_position(self, level, outcome, error)
    type(driven_t), intent(inout) :: self
    real(wp), intent(in) :: level(:)
    type(newton_outcome_t), intent(inout) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: from(size(self%strain_scale)), distance
    integer :: stage, stages

    call assemble(self%motion%system, level, self%motion%iterate)
    from = self%motion%iterate%strain
    distance = largest(self, (self%motion%iterate%target - from)/self%strain_scale)
    stages = 1
    if (distance < huge(stages)*stage_length) stages = max(1, ceiling(distance/stage_length))
    do stage = 1, stages
      call iterate_position(self, level, from, real(stage, wp)/stages, outcome, error)
      if (allocated(error) .or. outcome%status /= newton_converged) return
    end do
  end subroutine find_position

  !> Held strains to a share of the way between `from` and their targets. Converged: what is left
  !> after the last increment, judged by the one before, is below the tolerance.
  subroutine iterate_position(self, level, from, share, outcome, error)
    type(driven_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), from(:), share
    type(newton_outcome_t), intent(inout) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(self%motion%system%equations()), change(self%motion%system%coordinates)
    real(wp) :: moved, before, left
    integer :: iteration

    before = huge(before)
    left = before
    associate (motion => self%motion)
      do iteration = 0, most_iterations
        call assemble(motion%system, level, motion%iterate)
        motion%iterate%target = from + share*(motion%iterate%target - from)
        outcome%element = motion%iterate%invalid
        outcome%status = newton_distorted
        if (outcome%element > 0) return
        outcome%last%constraint = largest(self, motion%iterate%target - motion%iterate%strain) &
                                  /motion%system%length
        outcome%status = newton_converged
        if (left <= tolerance .and. &
            (outcome%last%constraint <= tolerance .or. iteration > 3)) return
        call motion%solver%factorize(motion%iterate%values, error)
        if (allocated(error)) return
        solution = right_hand_side(motion%system, motion%iterate)
        call motion%solver%solve(solution, error)
        if (allocated(error)) return
        call advance(motion%system, solution, 1.0_wp, motion%iterate, change)
        outcome%last%iteration = outcome%last%iteration + 1
        moved = maxval(abs(change)/motion%scale)
        outcome%last%increment = moved
        outcome%status = newton_diverged
        if (.not. ieee_is_finite(moved) .or. moved > far) return
        left = moved
        if (before < huge(before)) left = moved*min(1.0_wp, moved/before)
        if (moved <= round_off .and. moved > stalled*before) left = 0
        before = moved
      end do
    end associate
    outcome%status = newton_slow
  end subroutine iterate_position

  !> Largest entry, by strain, of those that are held.
  pure real(wp) function largest(self, by_strain)
    type(driven_t), intent(in) :: self
    real(wp), intent(in) :: by_strain(:)

    largest = maxval(merge(abs(by_strain), 0.0_wp, self%motion%system%multiplier > 0))
  end function largest

  !> Velocities with C v = rates of the targets, accelerations with C a = their second rates - v'Hv;
  !> other strains yield to these with the least energy: D'S(D a + v'Hv) + ... = 0.
  subroutine find_rates(self, level, error)
    type(driven_t), intent(inout) :: self
    real(wp), intent(in) :: level(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%strain_scale)) :: rate, second, convective
    real(wp) :: force(self%motion%system%coordinates)

    associate (motion => self%motion)
      call motion%solver%factorize(motion%iterate%values, error)
      if (.not. allocated(error)) call probe(self, error)
      if (allocated(error)) return
      call target_rates(motion%system, level, rate, second)
      force = 0
      call solve_rates(motion, force, rate, motion%flow%velocity, error)
      if (allocated(error)) return
      call convective_rates(motion%system, motion%iterate%state, motion%flow%velocity, .false., &
                            convective)
      call strain_forces(motion%system, motion%iterate, convective, force)
      call solve_rates(motion, -force, second - convective, motion%flow%acceleration, error)
      motion%flow%pseudo = motion%flow%acceleration
    end associate
  end subroutine find_rates

  !> [K, C'; C, 0] (x, m) = (force, strain).
  subroutine solve_rates(motion, force, strain, x, error)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(in) :: force(:), strain(:)  !< by coordinate, by strain
    real(wp), intent(out) :: x(:)                !< by coordinate
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(motion%system%equations())

    x = 0
    solution = mixed_entries(motion%system, force, strain)
    call motion%solver%solve(solution, error)
    if (.not. allocated(error)) x = by_coordinate(motion%system, solution)
  end subroutine solve_rates

  !> How far the coordinates move for changes of all held strains, of irregular signs: near a
  !> singular position very far.
  subroutine probe(self, error)
    type(driven_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp), parameter :: golden = 0.6180339887498949_wp
    real(wp) :: no_force(size(self%motion%scale)), x(size(self%motion%scale))
    real(wp) :: strain(size(self%strain_scale))
    integer :: k

    no_force = 0
    strain = [(merge(1, -1, modulo(k*golden, 1.0_wp) < 0.5_wp)*self%strain_scale(k), &
               k=1, size(strain))]
    call solve_rates(self%motion, no_force, strain, x, error)
    if (allocated(error)) return
    self%here = maxval(abs(x)/self%motion%scale)
    self%poor = size(self%motion%solver%null_pivots()) > self%nulls .or. &
                .not. self%here/poor_sensitivity <= self%sensitivity
    if (.not. self%poor) self%sensitivity = min(self%sensitivity, self%here)
  end subroutine probe

  !> Inertia forces of the rates found, and the velocities that dampers see; how much both changed.
  pure subroutine renew_inertia(motion, change)
    type(dynamics_t), intent(inout) :: motion
    real(wp), intent(out) :: change
    real(wp) :: force(size(motion%scale))

    call inertia_forces(motion%masses, motion%iterate%state, motion%flow%velocity, &
                        motion%flow%acceleration + motion%mass_damping*motion%flow%velocity, force)
    change = max(difference(force*motion%scale, motion%iterate%inertial*motion%scale), &
                 difference(motion%flow%velocity/motion%scale, &
                            motion%iterate%velocity/motion%scale))
    motion%iterate%inertial = force
    motion%iterate%velocity = motion%flow%velocity
  end subroutine renew_inertia

  !> Largest change of an entry, relative to the largest entry.
  pure real(wp) function difference(new, old)
    real(wp), intent(in) :: new(:), old(:)

    difference = maxval(abs(new - old))
    if (difference > 0) difference = difference/max(maxval(abs(new)), maxval(abs(old)))
  end function difference

  !> Whether the trapezoidal rule links velocities over a step h: for a smooth motion it errs by a
  !> part of them that shrinks with the square of h.
  pure logical function is_smooth(h, v, a, v_next, a_next, scale)
    real(wp), intent(in) :: h, v(:), a(:), v_next(:), a_next(:), scale(:)

    is_smooth = maxval(abs(v_next - v - 0.5_wp*h*(a + a_next))/scale) &
                <= largest_break*(maxval(abs(v)/scale) + maxval(abs(v_next)/scale))
  end function is_smooth

end module driven_motion
