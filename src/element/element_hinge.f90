!> HINGE: two bodies that turn about a common axis a, fixed in both; b and c complete the triad.
!> Strains: the angle, b^p . a^q and c^p . a^q (theory 2).
module element_hinge
  use kinds, only: wp
  use element_base, only: element_t
  use element_pair, only: element_pair_t
  use pair_strains, only: pair_t, strain_t, axes_product, hinge_angle, aligned, completed_triad
  implicit none
  private

  public :: new_element_hinge

  type, extends(element_pair_t) :: element_hinge_t
  contains
    procedure :: measure
  end type element_hinge_t

contains

  !> An element between two rotational nodes; `slot`: of the angle in `state%angle`.
  subroutine new_element_hinge(node, axis, fixed, stiffness, damping, slot, element)
    integer, intent(in) :: node(2), slot
    real(wp), intent(in) :: axis(3)       !< initially, global; not zero
    logical, intent(in) :: fixed(3)
    real(wp), intent(in) :: stiffness(3)  !< [F L]
    real(wp), intent(in) :: damping(3)    !< [F L T]
    class(element_t), allocatable, intent(out) :: element
    type(element_hinge_t), allocatable :: new

    allocate (new)
    new%axes = completed_triad(axis)
    new%size = 1
    call new%set_law(fixed, stiffness, damping)
    call new%set_nodes(reshape([0, node(1), 0, node(2)], [2, 2]), [slot, 0, 0])
    call move_alloc(new, element)
  end subroutine new_element_hinge

  pure subroutine measure(self, pair, strain, valid)
    class(element_hinge_t), intent(in) :: self
    type(pair_t), intent(in) :: pair
    type(strain_t), intent(out) :: strain(self%strains)
    logical, intent(out) :: valid

    valid = aligned(pair)
    if (.not. valid) return
    strain(1) = hinge_angle(pair)
    strain(2) = axes_product(pair, 2, 1)
    strain(3) = axes_product(pair, 3, 1)
  end subroutine measure

end module element_hinge
