!> Which eigenvalues count as one: modes of equal eigenvalues have no shape of their own, any basis
!> of their space is as good as another.
module linalg_equality
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp
  implicit none
  private

  public :: are_equal

  !> Relative distance: far more than round-off, so that distinct ones have modes to some digits.
  real(wp), parameter :: cluster = 1.0e-6_wp

contains

  !> Whether two eigenvalues are equal, but for round-off.
  elemental logical function are_equal(a, b)
    complex(wp), intent(in) :: a, b

    are_equal = .false.
    if (.not. ieee_is_finite(abs(a)) .or. .not. ieee_is_finite(abs(b))) return
    are_equal = abs(a - b) <= cluster*max(abs(a), abs(b))
  end function are_equal

end module linalg_equality
