!> CYLINDRICAL and PRISMATIC: two bodies that slide along a common axis a, fixed in both, and turn
!> about it; a PRISMATIC joint is one whose turn is fixed. b and c complete the triad.
!> Strains: the slide, the angle, the gaps b^p . (r^q - r^p) and c^p . (r^q - r^p), then b^p . a^q
!> and c^p . a^q.
module element_cylindrical
  use kinds, only: wp
  use element_base, only: element_t
  use element_pair, only: element_pair_t
  use pair_strains, only: pair_t, strain_t, axes_product, gap_product, hinge_angle, aligned, &
                          completed_triad
  implicit none
  private

  public :: new_element_cylindrical

  type, extends(element_pair_t) :: element_cylindrical_t
  contains
    procedure :: measure
  end type element_cylindrical_t

contains

  !> An element between two nodes that translate and rotate; `slot`: of the angle in
  !> `state%angle`. Of the initial chord the part along the axis is no strain, the rest is.
  subroutine new_element_cylindrical(node, chord, axis, fixed, stiffness, damping, slot, element)
    integer, intent(in) :: node(2, 2)     !< by kind (translational, rotational) and end
    integer, intent(in) :: slot
    real(wp), intent(in) :: chord(3)      !< initial vector from p to q [L]
    real(wp), intent(in) :: axis(3)       !< initially, global; not zero
    logical, intent(in) :: fixed(6)
    real(wp), intent(in) :: stiffness(6)  !< [F L^-1], of strains 2, 5 and 6 [F L]
    real(wp), intent(in) :: damping(6)    !< [F L^-1 T], of strains 2, 5 and 6 [F L T]
    class(element_t), allocatable, intent(out) :: element
    type(element_cylindrical_t), allocatable :: new

    allocate (new)
    new%chord = chord
    new%axes = completed_triad(axis)
    new%size = norm2(chord)
    call new%set_law(fixed, stiffness, damping)
    call new%set_nodes(node, [0, slot, 0, 0, 0, 0])
    call move_alloc(new, element)
  end subroutine new_element_cylindrical

  !> The slide is formed from what has changed, so that small ones are exact.
  pure subroutine measure(self, pair, strain, valid)
    class(element_cylindrical_t), intent(in) :: self
    type(pair_t), intent(in) :: pair
    type(strain_t), intent(out) :: strain(self%strains)
    logical, intent(out) :: valid

    valid = aligned(pair)
    if (.not. valid) return
    strain(1) = gap_product(pair, 1)
    strain(1)%value = dot_product(pair%triad(:, 1, 1), pair%shift) &
                      + dot_product(pair%triad(:, 1, 1) - self%axes(:, 1), pair%chord)
    strain(2) = hinge_angle(pair)
    strain(3) = gap_product(pair, 2)
    strain(4) = gap_product(pair, 3)
    strain(5) = axes_product(pair, 2, 1)
    strain(6) = axes_product(pair, 3, 1)
  end subroutine measure

end module element_cylindrical
