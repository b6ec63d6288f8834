!> SPHERICAL: two points held together; its strains are the global components of r^q - r^p.
module element_spherical
  use kinds, only: wp
  use element_base, only: element_t
  use element_pair, only: element_pair_t
  use pair_strains, only: pair_t, strain_t, gap_component
  implicit none
  private

  public :: new_element_spherical

  type, extends(element_pair_t) :: element_spherical_t
  contains
    procedure :: measure
  end type element_spherical_t

contains

  !> An element between two translational nodes. With a gap that is not zero its strains are not
  !> those of a joint: they change when the two points turn together.
  subroutine new_element_spherical(node, gap, fixed, stiffness, damping, element)
    integer, intent(in) :: node(2)
    real(wp), intent(in) :: gap(3)        !< initial vector from p to q [L]
    logical, intent(in) :: fixed(3)
    real(wp), intent(in) :: stiffness(3)  !< [F L^-1]
    real(wp), intent(in) :: damping(3)    !< [F L^-1 T]
    class(element_t), allocatable, intent(out) :: element
    type(element_spherical_t), allocatable :: new

    allocate (new)
    new%chord = gap
    new%size = norm2(gap)
    call new%set_law(fixed, stiffness, damping)
    call new%set_nodes(reshape([node(1), 0, node(2), 0], [2, 2]), [0, 0, 0])
    call move_alloc(new, element)
  end subroutine new_element_spherical

  pure subroutine measure(self, pair, strain, valid)
    class(element_spherical_t), intent(in) :: self
    type(pair_t), intent(in) :: pair
    type(strain_t), intent(out) :: strain(self%strains)
    logical, intent(out) :: valid
    integer :: i

    do i = 1, self%strains
      strain(i) = gap_component(pair, i)
    end do
    valid = .true.
  end subroutine measure

end module element_spherical
