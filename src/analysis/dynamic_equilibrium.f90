!> One step in time: the equations of motion at its end, M a + h + D'sigma + C'mu = f with the held
!> strains on their targets, solved by Newton in mixed form (theory 8).
!>
!> The matrix is unsymmetric, of inertia and turns. It is factorized at the start of a step, and
!> again only where the iteration converges slowly.
!>
!> Stabilised (Gear, Gupta, Leimkuhler 1985; Arnold, Cardona, Bruels 2015) held strains have their
!> rates too: these decide the multipliers, and the places are put right by an increment that the
!> rates know nothing of, S^-1 C' eta with the matrix of the step.
module dynamic_equilibrium
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: state_t, node_coordinates
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: coordinate_scale
  use system_dynamics, only: shares_t, add_inertia, inertia_forces
  use system_inertia, only: masses_t
  use system_motion, only: target_rates
  use system_newton, only: right_hand_side, advance
  use system_rates, only: strain_rates
  use system_unknowns, only: by_coordinate, by_unknown, held_entries
  use generalized_alpha, only: scheme_t, flow_t, predict, correct, inverse_tangent
  use newton_method, only: newton_outcome_t, newton_converged, newton_slow, newton_diverged, &
                           newton_distorted
  implicit none
  private

  public :: dynamics_t, new_dynamics, take_step, release_dynamics
  public :: assemble_motion, set_shares, correct_velocity, inertia_of, largest_gap
  public :: constraint_tolerance

  !> Fixed strains are on their targets to this part of the model's length.
  real(wp), parameter :: constraint_tolerance = 1.0e-12_wp

  !> An iteration that reduces the increment less than this asks for new factors, unless one more
  !> like it will do.
  real(wp), parameter :: slow = 0.1_wp

  !> Behind a larger one Newton is on its way still, and the places alone lead it.
  real(wp), parameter :: near = 1.0e-2_wp

  !> After an increment this small strains are linear in it to round-off, and their forces to this
  !> part of them: only elements with held strains are evaluated again.
  real(wp), parameter :: linear = 1.0e-9_wp

  !> An increment this large, in lengths of the model or radians, is no solution.
  real(wp), parameter :: far = 10.0_wp

  !> A model in motion.
  type :: dynamics_t
    type(system_t) :: system               !< with an unsymmetric pattern
    type(masses_t) :: masses
    type(solver_t) :: solver
    type(iterate_t) :: iterate
    type(flow_t) :: flow                   !< rates at the present state
    type(scheme_t) :: scheme
    type(shares_t) :: shares
    real(wp), allocatable :: scale(:)      !< by coordinate: what counts as one
    real(wp) :: mass_damping = 0.0_wp      !< Rayleigh's alpha [1/T]
    real(wp) :: tolerance = 1.0e-10_wp     !< of what is left of the increment after a step
    integer :: iterations = 20
    logical :: stabilised = .false.        !< velocities satisfy the constraints too
    real(wp), allocatable :: demand(:)     !< by strain: rates of the targets at the step's end
  end type dynamics_t

contains

  !> From a system with its state; the solver and pattern are its own.
  subroutine new_dynamics(system, masses, iterate, scheme, mass_damping, self, error)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(iterate_t), intent(in) :: iterate
    type(scheme_t), intent(in) :: scheme
    real(wp), intent(in) :: mass_damping
    type(dynamics_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: k

    self%system = system
    self%masses = masses
    self%scheme = scheme
    self%mass_damping = mass_damping
    call find_system_pattern(self%system, unsymmetric=.true.)
    call new_iterate(self%system, self%iterate)
    self%iterate%state = iterate%state
    self%iterate%stress = iterate%stress
    associate (n => system%coordinates)
      allocate (self%iterate%velocity(n), self%iterate%inertial(n), self%scale(n))
      allocate (self%flow%velocity(n), self%flow%acceleration(n), self%flow%pseudo(n))
      self%scale = [(coordinate_scale(system, k), k=1, n)]
    end associate
    allocate (self%iterate%rate(size(system%multiplier)), &
              self%iterate%viscous(size(system%multiplier)))
    allocate (self%shares%turn(3, 3, system%nodes), self%demand(size(system%multiplier)))
    self%iterate%velocity = 0
    self%iterate%inertial = 0
    self%iterate%rate = 0
    self%iterate%viscous = 0
    self%flow%velocity = 0
    self%flow%acceleration = 0
    self%flow%pseudo = 0
    call self%solver%prepare(self%system%equations(), self%system%pattern%row, &
                             self%system%pattern%column, .false., error)
  end subroutine new_dynamics

  !> Give back what the solver holds; the elements' constants belong to the system it came from.
  subroutine release_dynamics(self)
    type(dynamics_t), intent(inout) :: self

    call self%solver%free()
  end subroutine release_dynamics

  !> Advance by h to the time at which the patterns stand at `level`. After a failure the state is
  !> to be reset. `increment` is the step's, by coordinate; `predicted` its first guess.
  subroutine take_step(self, level, h, increment, predicted, outcome, error)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), h
    real(wp), intent(out) :: increment(:), predicted(:)
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    type(flow_t) :: next
    real(wp) :: change(size(increment))
    real(wp), dimension(self%system%equations()) :: aside, more
    real(wp) :: largest, before, left
    real(wp) :: unused(size(self%demand))
    logical :: fresh, rough

    next = self%flow
    call predict(self%scheme, h, self%flow, next, increment)
    call clear_held(self%system, next, increment)
    predicted = increment
    call self%iterate%state%move(increment)
    call set_shares(self, h)
    if (self%stabilised) call target_rates(self%system, level, self%demand, unused)
    fresh = .true.
    rough = .false.
    before = huge(before)
    aside = 0
    do
      outcome%last%iteration = outcome%last%iteration + 1
      self%iterate%keeps_matrix = .not. fresh
      call assemble_motion(self, level, increment, next)
      outcome%last%constraint = largest_gap(self)/self%system%length
      if (self%iterate%invalid > 0) then
        outcome%status = newton_distorted
        outcome%element = self%iterate%invalid
        return
      end if
      if (fresh) call self%solver%factorize(self%iterate%values, error)
      if (allocated(error)) return
      more = 0
      if (self%stabilised .and. .not. rough) call step_aside(self, fresh, aside, more, error)
      if (allocated(error)) return
      call improve(self, h, self%stabilised .and. .not. rough, more, increment, next, change, error)
      if (allocated(error)) return
      largest = maxval(max(abs(change), abs(by_coordinate(self%system, more)))/self%scale)
      outcome%last%increment = largest
      if (.not. ieee_is_finite(largest) .or. largest > far) then
        outcome%status = newton_diverged
        return
      end if
      left = largest
      if (before < huge(before)) left = largest*min(1.0_wp, largest/before)
      fresh = largest > slow*before .and. left*largest > self%tolerance*before
      before = largest
      if (left <= self%tolerance .and. .not. rough .and. &
          (outcome%last%constraint <= constraint_tolerance .or. &
           outcome%last%iteration > 2)) exit
      rough = self%stabilised .and. largest > near
      if (outcome%last%iteration < self%iterations) cycle
      outcome%status = newton_slow
      return
    end do
    self%iterate%keeps_matrix = .true.
    self%iterate%keeps_strains = largest <= linear
    call assemble_motion(self, level, increment, next)
    self%iterate%keeps_matrix = .false.
    self%iterate%keeps_strains = .false.
    outcome%last%constraint = largest_gap(self)/self%system%length
    if (self%iterate%invalid > 0) then
      outcome%status = newton_distorted
      outcome%element = self%iterate%invalid
      return
    end if
    self%flow = next
    if (self%stabilised) call correct_velocity(self, error)
  end subroutine take_step

  !> Put the rates of held strains on those of their targets, `demand`, by the least motion in the
  !> sense of the matrix that was factorized last; the system is assembled with the velocity.
  subroutine correct_velocity(self, error)
    type(dynamics_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(self%system%equations())

    solution = held_entries(self%system, self%demand - self%iterate%rate)
    if (.not. any(abs(solution) > 0)) return
    call self%solver%solve(solution, error)
    if (allocated(error)) return
    self%flow%velocity = self%flow%velocity + by_coordinate(self%system, solution)
  end subroutine correct_velocity

  !> Rates and increments of coordinates that are held are zero.
  pure subroutine clear_held(system, flow, increment)
    type(system_t), intent(in) :: system
    type(flow_t), intent(inout) :: flow
    real(wp), intent(inout) :: increment(:)

    where (system%unknown == 0)
      flow%velocity = 0
      flow%acceleration = 0
      flow%pseudo = 0
      increment = 0
    end where
  end subroutine clear_held

  !> For a step of length h [T].
  pure subroutine set_shares(self, h)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: h

    self%shares%velocity = self%scheme%velocity_share(h)
    self%shares%acceleration = self%scheme%acceleration_share(h) &
                               + self%mass_damping*self%shares%velocity
    self%iterate%velocity_share = self%shares%velocity
  end subroutine set_shares

  !> Residual, and tangent unless the iterate keeps its matrix, at the end of a step.
  pure subroutine assemble_motion(self, level, increment, next)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), increment(:)
    type(flow_t), intent(in) :: next
    integer :: i

    if (self%stabilised .or. .not. self%iterate%keeps_matrix) then
      do i = 1, self%system%nodes
        self%shares%turn(:, :, i) = &
          inverse_tangent(increment(node_coordinates*i - 3:node_coordinates*i - 1))
      end do
    end if
    self%iterate%velocity = next%velocity
    call assemble(self%system, level, self%iterate)
    if (self%iterate%invalid > 0) return
    if (self%iterate%keeps_matrix) then
      call inertia_forces(self%masses, self%iterate%state, next%velocity, &
                          next%acceleration + self%mass_damping*next%velocity, &
                          self%iterate%inertial)
      return
    end if
    call add_inertia(self%system, self%masses, self%shares, self%iterate%state, next%velocity, &
                     next%acceleration + self%mass_damping*next%velocity, self%iterate%inertial, &
                     self%iterate%values)
  end subroutine assemble_motion

  !> What the increment `aside`, of which the rates know nothing, lacks to close the gap of the
  !> places that the one of the velocities leaves: S aside + C'nu = 0. With a `fresh` matrix all of
  !> it is found anew: a sum would keep what matrices far from the solution made of the gaps there.
  subroutine step_aside(self, fresh, aside, more, error)
    type(dynamics_t), intent(inout) :: self
    logical, intent(in) :: fresh
    real(wp), intent(inout) :: aside(:)    !< of the step, by unknown, of rotations spins; and nu
    real(wp), intent(out) :: more(:)       !< what it gains
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%demand)) :: lack, closed

    lack = self%iterate%target - self%iterate%strain &
           - (self%demand - self%iterate%rate)/self%shares%velocity
    if (fresh) then
      call strain_rates(self%system, self%iterate, by_coordinate(self%system, aside), closed)
      lack = lack + closed
    end if
    more = held_entries(self%system, lack)
    call self%solver%solve(more, error)
    if (allocated(error)) return
    if (fresh) more = more - aside
    aside = aside + more
  end subroutine step_aside

  !> One Newton increment, `more` of which changes no rates. With `both` the rest closes the gap of
  !> the velocities, else that of the places.
  subroutine improve(self, h, both, more, increment, next, change, error)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: h
    logical, intent(in) :: both
    real(wp), intent(in) :: more(:)        !< of the increment aside
    real(wp), intent(inout) :: increment(:)
    type(flow_t), intent(inout) :: next
    real(wp), intent(out) :: change(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(size(more)), aside(size(change))

    change = 0
    aside = by_coordinate(self%system, more)
    solution = right_hand_side(self%system, self%iterate)
    if (both) then
      solution(self%system%unknowns + 1:) = 0
      solution = solution + inertia_of(self, aside) + held_entries(self%system, &
                   (self%demand - self%iterate%rate)/self%shares%velocity)
    end if
    call self%solver%solve(solution, error)
    if (allocated(error)) return
    solution = solution + more
    call advance(self%system, solution, 1.0_wp, self%iterate, change)
    call turn_spins(self, aside)
    call correct(self%scheme, self%system%nodes, h, change, aside, increment, next)
  end subroutine improve

  !> Mass times the accelerations that go with a motion, as right-hand side.
  pure function inertia_of(self, motion) result(b)
    type(dynamics_t), intent(in) :: self
    real(wp), intent(in) :: motion(:)      !< by coordinate
    real(wp) :: b(self%system%equations())
    real(wp), dimension(size(motion)) :: still, force

    still = 0
    call inertia_forces(self%masses, self%iterate%state, still, self%shares%acceleration*motion, &
                        force)
    b = by_unknown(self%system, force)
  end function inertia_of

  !> Spins as changes of the step's rotation vectors, in place.
  pure subroutine turn_spins(self, motion)
    type(dynamics_t), intent(in) :: self
    real(wp), intent(inout) :: motion(:)   !< by coordinate
    integer :: i

    do i = 1, self%system%nodes
      associate (spin => motion(node_coordinates*i - 3:node_coordinates*i - 1))
        if (any(abs(spin) > 0)) spin = matmul(self%shares%turn(:, :, i), spin)
      end associate
    end do
  end subroutine turn_spins

  !> Largest distance of a held strain from its target.
  pure real(wp) function largest_gap(self)
    type(dynamics_t), intent(in) :: self

    largest_gap = maxval(merge(abs(self%iterate%strain - self%iterate%target), 0.0_wp, &
                               self%system%multiplier > 0))
  end function largest_gap

end module dynamic_equilibrium
