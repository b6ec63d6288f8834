!> UNIVERSAL: two bodies joined by a cross that turns about a, fixed in p, and b, fixed in q.
!> Strains: the angle of the cross about a from p, that of q about b from the cross, a^p . b^q.
module element_universal
  use kinds, only: wp
  use element_base, only: element_t
  use element_pair, only: element_pair_t
  use pair_strains, only: pair_t, strain_t, axes_product, angle_of
  use rotation, only: cross
  implicit none
  private

  public :: new_element_universal

  type, extends(element_pair_t) :: element_universal_t
  contains
    procedure :: measure
  end type element_universal_t

  !> Least sine of the angle between the axes.
  real(wp), parameter :: least_sine = 0.01_wp

contains

  !> An element between two rotational nodes; `slot`: of the angles in `state%angle`.
  subroutine new_element_universal(node, axis, fixed, stiffness, damping, slot, element)
    integer, intent(in) :: node(2), slot(2)
    real(wp), intent(in) :: axis(3, 2)    !< a and b initially, global; b is made normal to a
    logical, intent(in) :: fixed(3)
    real(wp), intent(in) :: stiffness(3)  !< [F L]
    real(wp), intent(in) :: damping(3)    !< [F L T]
    class(element_t), allocatable, intent(out) :: element
    type(element_universal_t), allocatable :: new
    real(wp) :: a(3), c(3)

    allocate (new)
    a = axis(:, 1)/norm2(axis(:, 1))
    c = cross(a, axis(:, 2))
    c = c/norm2(c)
    new%axes = reshape([a, cross(c, a), c], [3, 3])
    new%size = 1
    call new%set_law(fixed, stiffness, damping)
    call new%set_nodes(reshape([0, node(1), 0, node(2)], [2, 2]), [slot(1), slot(2), 0])
    call move_alloc(new, element)
  end subroutine new_element_universal

  !> b^q seen from p, a^p seen from q; not defined where a and b are parallel.
  pure subroutine measure(self, pair, strain, valid)
    class(element_universal_t), intent(in) :: self
    type(pair_t), intent(in) :: pair
    type(strain_t), intent(out) :: strain(self%strains)
    logical, intent(out) :: valid

    valid = norm2(cross(pair%triad(:, 1, 1), pair%triad(:, 2, 2))) > least_sine
    if (.not. valid) return
    strain(1) = angle_of(axes_product(pair, 3, 2), axes_product(pair, 2, 2))
    strain(2) = angle_of(axes_product(pair, 1, 3), axes_product(pair, 1, 1))
    strain(3) = axes_product(pair, 1, 2)
  end subroutine measure

end module element_universal
