!> What every element provides: generalized strains of the nodal coordinates, their first and
!> second derivatives, and a law for the stress resultants. Assembly knows nothing else.
module element_base
  use kinds, only: wp
  use nodal_state, only: state_t
  implicit none
  private

  integer, parameter, public :: max_strains = 9, max_coordinates = 22

  !> Base of all elements.
  type, abstract, public :: element_t
    integer :: strains = 0                   !< number of generalized strains
    integer :: coordinates = 0               !< number of coordinates they depend on
    integer, allocatable :: coordinate(:)    !< their numbers, see `nodal_state`
    !> by strain: held, at zero or where a motion puts it; its stress is a multiplier
    logical, allocatable :: fixed(:)
    logical :: counts_turns = .false.        !< `count_turns` has something to do
    logical :: damped = .false.              !< `damping` is not zero
    real(wp) :: size = 0.0_wp                !< its length, for estimates of round-off [L]
    integer :: section_node(2) = 0           !< rotational nodes of its end sections; 0: it has none
    real(wp) :: triad(3, 3) = 0.0_wp         !< initial axes eX eY eZ of the sections
    !> Of an element of many nodes, else not allocated: (coordinates, parts), the indices in
    !> `coordinate` of those that the strains depend on together; which part it is depends on the
    !> state. At most `max_coordinates`.
    integer, allocatable :: part(:, :)
  contains
    procedure(evaluate_interface), deferred :: evaluate
    procedure(law_interface), deferred :: law
    procedure :: evaluate_part
    procedure :: damping
    procedure :: count_turns
  end type element_t

  !> An array of these is a list of elements of any type.
  type, public :: element_slot_t
    class(element_t), allocatable :: e
  end type element_slot_t

  abstract interface
    !> Strains, their Jacobian, and the second derivatives contracted with `stress`.
    pure subroutine evaluate_interface(self, state, stress, strain, jacobian, geometric, valid)
      import :: element_t, state_t, wp
      implicit none
      class(element_t), intent(in) :: self
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: stress(self%strains)
      real(wp), intent(out) :: strain(self%strains)
      real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
      !> sum of stress(i) times the Hessian of strain i; symmetric
      real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
      logical, intent(out) :: valid  !< false: rotations beyond what the element can describe
    end subroutine evaluate_interface

    !> The stiffness between strains and stress resultants; rows of fixed strains are zero.
    pure subroutine law_interface(self, stiffness)
      import :: element_t, wp
      implicit none
      class(element_t), intent(in) :: self
      real(wp), intent(out) :: stiffness(self%strains, self%strains)
    end subroutine law_interface
  end interface

contains

  !> What `evaluate` does, for the coordinates of one part only; all other derivatives are zero.
  !> For elements that have parts.
  pure subroutine evaluate_part(self, state, stress, part, strain, jacobian, geometric, valid)
    class(element_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    integer, intent(out) :: part                !< which
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(:, :)     !< (strains, coordinates of a part)
    real(wp), intent(out) :: geometric(:, :)
    logical, intent(out) :: valid

    part = 0
    valid = .false.
    strain = stress*size(state%warping)
    jacobian = 0
    geometric = 0
  end subroutine evaluate_part

  !> Stress resultants per rate of strain; rows of fixed strains are zero. None unless an element
  !> says otherwise.
  pure subroutine damping(self, viscosity)
    class(element_t), intent(in) :: self
    real(wp), intent(out) :: viscosity(self%strains, self%strains)

    viscosity = 0
  end subroutine damping

  !> Note the angles as they are now, see `state%angle`; called after every increment, which turns
  !> a hinge by less than pi.
  pure subroutine count_turns(self, state)
    class(element_t), intent(in) :: self
    type(state_t), intent(inout) :: state

    if (self%strains < 0) state%angle = 0
  end subroutine count_turns

end module element_base
