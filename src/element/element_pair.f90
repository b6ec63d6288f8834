!> A joint of two bodies: a few strains of their relative motion. Each kind says which.
module element_pair
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number
  use element_joint, only: element_joint_t
  use pair_strains, only: pair_t, strain_t, pair_coordinates, unwrapped
  use rotation, only: rotated
  implicit none
  private

  public :: element_pair_t, get_triads

  integer, parameter :: translational = 1, rotational = 2  !< rows of `node`

  type, abstract, extends(element_joint_t) :: element_pair_t
    integer :: node(2, 2) = 0          !< by kind and end (1 = p, 2 = q); 0: none
    real(wp) :: chord(3) = 0.0_wp      !< initial vector from p to q [L]
    real(wp) :: axes(3, 3) = 0.0_wp    !< of both bodies, initially: unit vectors a b c
    integer, allocatable :: slot(:)    !< by strain: an angle's index in `state%angle`; 0: none
    integer, allocatable :: from(:)    !< by coordinate: which of `pair_strains` it is part of
    real(wp), allocatable :: share(:)  !< by coordinate: with this factor
  contains
    procedure(measure_interface), deferred :: measure
    procedure :: set_nodes
    procedure :: evaluate
    procedure :: count_turns
    procedure, private :: counted_strains
  end type element_pair_t

  abstract interface
    !> The strains and their derivatives; angles within -pi to pi.
    pure subroutine measure_interface(self, pair, strain, valid)
      import :: element_pair_t, pair_t, strain_t
      implicit none
      class(element_pair_t), intent(in) :: self
      type(pair_t), intent(in) :: pair
      type(strain_t), intent(out) :: strain(self%strains)
      logical, intent(out) :: valid  !< false: the strains are not defined there
    end subroutine measure_interface
  end interface

contains

  !> Nodes and coordinates: those of p, then those of q. `slot`: see the type.
  pure subroutine set_nodes(self, node, slot)
    class(element_pair_t), intent(inout) :: self
    integer, intent(in) :: node(2, 2), slot(:)
    integer :: e, i, n

    n = 3*count(node > 0)
    self%node = node
    self%coordinates = n
    self%counts_turns = any(slot > 0)
    allocate (self%slot, source=slot)
    allocate (self%coordinate(n), self%from(n), self%share(n))
    n = 0
    do e = 1, 2
      do i = 1, 6
        associate (at => node((i + 2)/3, e))
          if (at == 0) cycle
          n = n + 1
          self%coordinate(n) = coordinate_number(at, i)
          self%from(n) = i
          self%share(n) = 1
          if (i <= 3 .and. e == 1) self%share(n) = -1
          if (i > 3 .and. e == 2) self%from(n) = i + 3
        end associate
      end do
    end do
  end subroutine set_nodes

  pure subroutine evaluate(self, state, stress, strain, jacobian, geometric, valid)
    class(element_pair_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
    real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
    logical, intent(out) :: valid
    type(strain_t) :: measured(self%strains)
    real(wp) :: total(pair_coordinates, pair_coordinates)
    integer :: i, j

    call self%counted_strains(state, measured, valid)
    if (.not. valid) return
    total = 0
    do i = 1, self%strains
      strain(i) = measured(i)%value
      jacobian(i, :) = self%share*measured(i)%gradient(self%from)
      total = total + stress(i)*measured(i)%hessian
    end do
    do j = 1, self%coordinates
      geometric(:, j) = self%share*total(self%from, self%from(j))*self%share(j)
    end do
  end subroutine evaluate

  !> Where an angle is not defined it keeps what was counted.
  pure subroutine count_turns(self, state)
    class(element_pair_t), intent(in) :: self
    type(state_t), intent(inout) :: state
    type(strain_t) :: measured(self%strains)
    logical :: valid
    integer :: i

    call self%counted_strains(state, measured, valid)
    if (.not. valid) return
    do i = 1, self%strains
      if (self%slot(i) > 0) state%angle(self%slot(i)) = measured(i)%value
    end do
  end subroutine count_turns

  !> The strains, angles through full turns.
  pure subroutine counted_strains(self, state, strain, valid)
    class(element_pair_t), intent(in) :: self
    type(state_t), intent(in) :: state
    type(strain_t), intent(out) :: strain(self%strains)
    logical, intent(out) :: valid
    type(pair_t) :: pair
    integer :: i

    pair%chord = self%chord
    if (self%node(translational, 1) > 0) then
      pair%shift = state%displacement(:, self%node(translational, 2)) &
                   - state%displacement(:, self%node(translational, 1))
    end if
    if (self%node(rotational, 1) > 0) then
      call get_triads(state, self%node(rotational, :), self%axes, pair)
    end if
    call self%measure(pair, strain, valid)
    if (.not. valid) return
    do i = 1, self%strains
      if (self%slot(i) == 0) cycle
      strain(i)%value = unwrapped(strain(i)%value, state%angle(self%slot(i)))
    end do
  end subroutine counted_strains

  !> How the two bodies stand.
  pure subroutine get_triads(state, node, axes, pair)
    type(state_t), intent(in) :: state
    integer, intent(in) :: node(2)      !< rotational nodes of p and q
    real(wp), intent(in) :: axes(3, 3)  !< initially
    type(pair_t), intent(inout) :: pair
    integer :: e

    do e = 1, 2
      pair%triad(:, :, e) = rotated(state%euler(:, node(e)), axes)
    end do
  end subroutine get_triads

end module element_pair
