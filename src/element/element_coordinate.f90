!> Coordinates of a node that move as prescribed: the strains are displacements or alpha.
module element_coordinate
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number
  use element_base, only: element_t
  implicit none
  private

  public :: new_element_coordinate

  type, extends(element_t) :: element_coordinate_t
    integer :: node = 0
    integer, allocatable :: component(:)  !< 1 to 3 X Y Z, 7 W
  contains
    procedure :: evaluate
    procedure :: law
  end type element_coordinate_t

contains

  !> Prescribe the components X Y Z . . . W that are marked in `driven`.
  subroutine new_element_coordinate(node, driven, element)
    integer, intent(in) :: node
    logical, intent(in) :: driven(7)
    class(element_t), allocatable, intent(out) :: element
    type(element_coordinate_t), allocatable :: new
    integer :: i

    allocate (new)
    new%node = node
    allocate (new%component(count(driven)))
    new%component(:) = pack([(i, i=1, 7)], driven)
    new%strains = count(driven)
    new%coordinates = new%strains
    new%coordinate = coordinate_number(node, new%component)
    allocate (new%fixed(new%strains))
    new%fixed = .true.
    call move_alloc(new, element)
  end subroutine new_element_coordinate

  pure subroutine evaluate(self, state, stress, strain, jacobian, geometric, valid)
    class(element_coordinate_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
    real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
    logical, intent(out) :: valid
    integer :: i

    jacobian = 0
    do i = 1, self%strains
      if (self%component(i) == 7) then
        strain(i) = state%warping(self%node)
      else
        strain(i) = state%displacement(self%component(i), self%node)
      end if
      jacobian(i, i) = 1
    end do
    geometric = 0*spread(stress, 2, self%coordinates)
    valid = .true.
  end subroutine evaluate

  pure subroutine law(self, stiffness)
    class(element_coordinate_t), intent(in) :: self
    real(wp), intent(out) :: stiffness(self%strains, self%strains)

    stiffness = 0
  end subroutine law

end module element_coordinate
