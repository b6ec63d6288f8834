!> Single components of a rotation held at zero: the strains are components of the Euler
!> parameters, lambda_i = sin(theta/2) of a turn about axis i, the others stay free.
module element_rotation
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number
  use element_base, only: element_t
  use rotation, only: skew, identity3
  implicit none
  private

  public :: new_element_rotation

  type, extends(element_t) :: element_rotation_t
    integer :: node = 0
    integer, allocatable :: component(:)  !< 1 to 3: X Y Z
  contains
    procedure :: evaluate
    procedure :: law
  end type element_rotation_t

contains

  !> Hold the components marked in `held` of a rotational node.
  subroutine new_element_rotation(node, held, element)
    integer, intent(in) :: node
    logical, intent(in) :: held(3)
    class(element_t), allocatable, intent(out) :: element
    type(element_rotation_t), allocatable :: new
    integer :: i

    allocate (new)
    new%node = node
    new%size = 1
    allocate (new%component(count(held)))
    new%component(:) = pack([1, 2, 3], held)
    new%strains = count(held)
    new%coordinates = 3
    new%coordinate = [(coordinate_number(node, 3 + i), i=1, 3)]
    allocate (new%fixed(new%strains))
    new%fixed = .true.
    call move_alloc(new, element)
  end subroutine new_element_rotation

  !> d lambda = (lambda0 I - skew(lambda)) theta/2 - lambda |theta|^2/8 + ...
  pure subroutine evaluate(self, state, stress, strain, jacobian, geometric, valid)
    class(element_rotation_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
    real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
    logical, intent(out) :: valid
    real(wp) :: p(0:3), d(3, 3)

    p = state%euler(:, self%node)
    d = 0.5_wp*(p(0)*identity3 - skew(p(1:3)))
    strain = p(self%component)
    jacobian = d(self%component, :)
    geometric = -0.25_wp*dot_product(stress, strain)*identity3
    valid = .true.
  end subroutine evaluate

  pure subroutine law(self, stiffness)
    class(element_rotation_t), intent(in) :: self
    real(wp), intent(out) :: stiffness(self%strains, self%strains)

    stiffness = 0
  end subroutine law

end module element_rotation
