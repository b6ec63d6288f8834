!> The equations of motion at the end of a step in time, M a + h + D'sigma + C'mu = f with the held
!> strains on their targets, and their matrix, unsymmetric, of inertia and turns (theory 8).
module dynamic_equilibrium
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
  use system_unknowns, only: by_coordinate, by_unknown, held_entries
  use generalized_alpha, only: scheme_t, flow_t, inverse_tangent
  implicit none
  private

  public :: dynamics_t, new_dynamics, release_dynamics
  public :: assemble_motion, set_shares, correct_velocity, inertia_of, largest_gap
  public :: constraint_tolerance

  !> Fixed strains are on their targets to this part of the model's length.
  real(wp), parameter :: constraint_tolerance = 1.0e-12_wp

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

  !> Largest distance of a held strain from its target.
  pure real(wp) function largest_gap(self)
    type(dynamics_t), intent(in) :: self

    largest_gap = maxval(merge(abs(self%iterate%strain - self%iterate%target), 0.0_wp, &
                               self%system%multiplier > 0))
  end function largest_gap

end module dynamic_equilibrium
