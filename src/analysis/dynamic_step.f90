!> One step in time: Newton in mixed form for the equations of motion at its end (theory 8).
!>
!> The matrix is factorized at the start of a step, and again only where the iteration converges
!> slowly.
!>
!> Stabilised (Gear, Gupta, Leimkuhler 1985; Arnold, Cardona, Bruels 2015) held strains have their
!> rates too: these decide the multipliers, and the places are put right by an increment that the
!> rates know nothing of, S^-1 C' eta with the matrix of the step.
module dynamic_step
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: node_coordinates
  use system_data, only: system_t
  use system_motion, only: target_rates
  use system_newton, only: right_hand_side, advance
  use system_rates, only: strain_rates
  use system_unknowns, only: by_coordinate, held_entries
  use generalized_alpha, only: flow_t, predict, correct
  use dynamic_equilibrium, only: dynamics_t, assemble_motion, set_shares, correct_velocity, &
                                 inertia_of, largest_gap, constraint_tolerance
  use newton_method, only: newton_outcome_t, newton_converged, newton_slow, newton_diverged, &
                           newton_distorted
  use recorder, only: iteration_t
  implicit none
  private

  public :: take_step

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

  !> Where the iteration of a step stands.
  type :: course_t
    logical :: fresh = .true.              !< the next increment needs new factors
    logical :: rough = .false.             !< it is led by the places alone
    logical :: done = .false.
    real(wp) :: largest = 0.0_wp           !< entry of the last increment, scaled
    real(wp) :: before = huge(1.0_wp)      !< that of the one before
  end type course_t

contains

  !> Advance by h to the time at which the patterns stand at `level`. After a failure the state is
  !> to be reset. `increment` is the step's, by coordinate; `predicted` its first guess.
  subroutine take_step(self, level, h, increment, predicted, outcome, error)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), h
    real(wp), intent(out) :: increment(:), predicted(:)
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    type(flow_t) :: next

    call begin_step(self, level, h, next, increment)
    predicted = increment
    call iterate_step(self, level, h, increment, next, outcome, error)
    if (allocated(error) .or. outcome%status /= newton_converged) return
    call close_step(self, level, increment, next, outcome, error)
  end subroutine take_step

  !> Move to the first guess of the step's end, and set what holds for the whole step.
  subroutine begin_step(self, level, h, next, increment)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), h
    type(flow_t), intent(out) :: next
    real(wp), intent(out) :: increment(:)
    real(wp) :: unused(size(self%demand))

    next = self%flow
    call predict(self%scheme, h, self%flow, next, increment)
    call clear_held(self%system, next, increment)
    call self%iterate%state%move(increment)
    call set_shares(self, h)
    if (self%stabilised) call target_rates(self%system, level, self%demand, unused)
  end subroutine begin_step

  !> Newton increments until what is left of them is below the tolerance.
  subroutine iterate_step(self, level, h, increment, next, outcome, error)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), h
    real(wp), intent(inout) :: increment(:)
    type(flow_t), intent(inout) :: next
    type(newton_outcome_t), intent(inout) :: outcome
    type(error_t), allocatable, intent(out) :: error
    type(course_t) :: course
    real(wp) :: aside(self%system%equations())

    aside = 0
    do
      outcome%last%iteration = outcome%last%iteration + 1
      self%iterate%keeps_matrix = .not. course%fresh
      call assemble_step(self, level, increment, next, outcome)
      if (outcome%status /= newton_converged) return
      if (course%fresh) call self%solver%factorize(self%iterate%values, error)
      if (.not. allocated(error)) call improve_step(self, h, course, aside, increment, next, error)
      if (allocated(error)) return
      outcome%last%increment = course%largest
      if (.not. ieee_is_finite(course%largest) .or. course%largest > far) then
        outcome%status = newton_diverged
        return
      end if
      call judge(self, outcome%last, course)
      if (course%done) return
      if (outcome%last%iteration >= self%iterations) exit
    end do
    outcome%status = newton_slow
  end subroutine iterate_step

  !> Residual at the end of the step, and how far held strains are from their targets there.
  subroutine assemble_step(self, level, increment, next, outcome)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), increment(:)
    type(flow_t), intent(in) :: next
    type(newton_outcome_t), intent(inout) :: outcome

    call assemble_motion(self, level, increment, next)
    outcome%last%constraint = largest_gap(self)/self%system%length
    if (self%iterate%invalid == 0) return
    outcome%status = newton_distorted
    outcome%element = self%iterate%invalid
  end subroutine assemble_step

  !> One Newton increment, with the share of it that the rates know nothing of.
  subroutine improve_step(self, h, course, aside, increment, next, error)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: h
    type(course_t), intent(inout) :: course
    real(wp), intent(inout) :: aside(:), increment(:)
    type(flow_t), intent(inout) :: next
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: more(size(aside)), change(size(increment))
    logical :: both

    both = self%stabilised .and. .not. course%rough
    more = 0
    if (both) call step_aside(self, course%fresh, aside, more, error)
    if (.not. allocated(error)) call improve(self, h, both, more, increment, next, change, error)
    if (allocated(error)) return
    course%largest = maxval(max(abs(change), abs(by_coordinate(self%system, more)))/self%scale)
  end subroutine improve_step

  !> Whether the iteration is done, and how the next increment is to be found. What is left after
  !> an increment is judged by the one before.
  pure subroutine judge(self, last, course)
    type(dynamics_t), intent(in) :: self
    type(iteration_t), intent(in) :: last
    type(course_t), intent(inout) :: course
    real(wp) :: left

    associate (largest => course%largest, before => course%before)
      left = largest
      if (before < huge(before)) left = largest*min(1.0_wp, largest/before)
      course%fresh = largest > slow*before .and. left*largest > self%tolerance*before
      course%done = left <= self%tolerance .and. .not. course%rough .and. &
                    (last%constraint <= constraint_tolerance .or. last%iteration > 2)
      course%rough = self%stabilised .and. largest > near
      before = largest
    end associate
  end subroutine judge

  !> Forces, rates and held strains at the end found.
  subroutine close_step(self, level, increment, next, outcome, error)
    type(dynamics_t), intent(inout) :: self
    real(wp), intent(in) :: level(:), increment(:)
    type(flow_t), intent(in) :: next
    type(newton_outcome_t), intent(inout) :: outcome
    type(error_t), allocatable, intent(out) :: error

    self%iterate%keeps_matrix = .true.
    self%iterate%keeps_strains = outcome%last%increment <= linear
    call assemble_step(self, level, increment, next, outcome)
    self%iterate%keeps_matrix = .false.
    self%iterate%keeps_strains = .false.
    if (outcome%status /= newton_converged) return
    self%flow = next
    if (self%stabilised) call correct_velocity(self, error)
  end subroutine close_step

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

end module dynamic_step
