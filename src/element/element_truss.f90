!> TRUSS: a bar or spring between two points; its strain is the elongation l - l0.
module element_truss
  use kinds, only: wp
  use element_base, only: element_t
  use element_pair, only: element_pair_t
  use pair_strains, only: pair_t, strain_t, gap_elongation
  implicit none
  private

  public :: new_element_truss

  type, extends(element_pair_t) :: element_truss_t
  contains
    procedure :: measure
  end type element_truss_t

contains

  !> An element between two translational nodes.
  subroutine new_element_truss(node, chord, fixed, stiffness, damping, element)
    integer, intent(in) :: node(2)
    real(wp), intent(in) :: chord(3)      !< initial vector from p to q, not zero [L]
    logical, intent(in) :: fixed(1)       !< the length is held or prescribed
    real(wp), intent(in) :: stiffness(1)  !< [F L^-1], EA/l0 of a bar
    real(wp), intent(in) :: damping(1)    !< [F L^-1 T]
    class(element_t), allocatable, intent(out) :: element
    type(element_truss_t), allocatable :: new

    allocate (new)
    new%chord = chord
    new%size = norm2(chord)
    call new%set_law(fixed, stiffness, damping)
    call new%set_nodes(reshape([node(1), 0, node(2), 0], [2, 2]), [0])
    call move_alloc(new, element)
  end subroutine new_element_truss

  !> Not defined when the ends meet: the direction is lost.
  pure subroutine measure(self, pair, strain, valid)
    class(element_truss_t), intent(in) :: self
    type(pair_t), intent(in) :: pair
    type(strain_t), intent(out) :: strain(self%strains)
    logical, intent(out) :: valid

    valid = norm2(pair%chord + pair%shift) > epsilon(1.0_wp)*self%size
    if (valid) strain(1) = gap_elongation(pair)
  end subroutine measure

end module element_truss
