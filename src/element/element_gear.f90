!> GEAR: ties the angles of two hinges; its strain is the angle of the second minus the ratio
!> times that of the first.
module element_gear
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number
  use element_base, only: element_t
  use element_joint, only: element_joint_t
  use element_pair, only: get_triads
  use pair_strains, only: pair_t, strain_t, hinge_angle, unwrapped, aligned, completed_triad
  implicit none
  private

  public :: new_element_gear

  type, extends(element_joint_t) :: element_gear_t
    integer :: node(2, 2) = 0             !< rotational, by end (1 = p, 2 = q) and hinge
    integer :: place(2, 2) = 0            !< where the coordinates of such a node start, less 1
    real(wp) :: axes(3, 3, 2) = 0.0_wp    !< by hinge: unit vectors a b c, initially
    real(wp) :: factor(2) = 0.0_wp        !< by hinge: of its angle in the strain
    integer :: slot(2) = 0                !< by hinge: of its angle in `state%angle`
  contains
    procedure :: evaluate
  end type element_gear_t

contains

  !> The hinges, or cylindrical joints, are given by their nodes, axes and slots, which they
  !> count themselves. They may share nodes.
  subroutine new_element_gear(node, axis, slot, ratio, fixed, stiffness, damping, element)
    integer, intent(in) :: node(2, 2)     !< rotational, by end (1 = p, 2 = q) and hinge
    real(wp), intent(in) :: axis(3, 2)    !< by hinge: initially, global; not zero
    integer, intent(in) :: slot(2)        !< by hinge
    real(wp), intent(in) :: ratio
    logical, intent(in) :: fixed(1)
    real(wp), intent(in) :: stiffness(1)  !< [F L]
    real(wp), intent(in) :: damping(1)    !< [F L T]
    class(element_t), allocatable, intent(out) :: element
    type(element_gear_t), allocatable :: new
    integer :: h

    allocate (new)
    do h = 1, 2
      new%axes(:, :, h) = completed_triad(axis(:, h))
    end do
    new%factor = [-ratio, 1.0_wp]
    new%slot = slot
    new%size = 1
    call new%set_law(fixed, stiffness, damping)
    call set_places(new, node)
    call move_alloc(new, element)
  end subroutine new_element_gear

  !> The coordinates of every node once.
  pure subroutine set_places(new, node)
    type(element_gear_t), intent(inout) :: new
    integer, intent(in) :: node(2, 2)
    integer :: distinct(4), n, e, h, i, k

    n = 0
    do h = 1, 2
      do e = 1, 2
        k = 1
        do while (k <= n)
          if (distinct(k) == node(e, h)) exit
          k = k + 1
        end do
        distinct(k) = node(e, h)
        n = max(n, k)
        new%place(e, h) = 3*(k - 1)
      end do
    end do
    new%node = node
    new%coordinates = 3*n
    allocate (new%coordinate(3*n))
    new%coordinate(:) = [((coordinate_number(distinct(k), 3 + i), i=1, 3), k=1, n)]
  end subroutine set_places

  pure subroutine evaluate(self, state, stress, strain, jacobian, geometric, valid)
    class(element_gear_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
    real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
    logical, intent(out) :: valid
    type(pair_t) :: pair
    type(strain_t) :: angle
    integer :: h, i, at(6)

    strain = 0
    jacobian = 0
    geometric = 0
    do h = 1, 2
      call get_triads(state, self%node(:, h), self%axes(:, :, h), pair)
      valid = aligned(pair)
      if (.not. valid) return
      angle = hinge_angle(pair)
      angle%value = unwrapped(angle%value, state%angle(self%slot(h)))
      at = [(self%place(1, h) + i, i=1, 3), (self%place(2, h) + i, i=1, 3)]
      strain(1) = strain(1) + self%factor(h)*angle%value
      jacobian(1, at) = jacobian(1, at) + self%factor(h)*angle%gradient(4:9)
      geometric(at, at) = geometric(at, at) + self%factor(h)*stress(1)*angle%hessian(4:9, 4:9)
    end do
  end subroutine evaluate

end module element_gear
