!> Inertia of a TRUSS, whose mass lies on the line from p to q.
module truss_inertia
  use kinds, only: wp
  use rotation, only: identity3
  implicit none
  private

  public :: truss_mass

contains

  !> Mass matrix of the positions of p and q, constant: the inertia forces are M a, and the kinetic
  !> energy is v.M v/2. Half of the mass at each end, or that of an evenly loaded line.
  pure function truss_mass(line_density, length, consistent) result(mass)
    real(wp), intent(in) :: line_density  !< rho A [M L^-1]
    real(wp), intent(in) :: length        !< l0 [L]
    logical, intent(in) :: consistent     !< MASS CONSISTENT, not LUMPED
    real(wp) :: mass(6, 6), own, other

    own = line_density*length/merge(3, 2, consistent)
    other = merge(0.5_wp*own, 0.0_wp, consistent)
    mass(1:3, 1:3) = own*identity3
    mass(4:6, 4:6) = own*identity3
    mass(1:3, 4:6) = other*identity3
    mass(4:6, 1:3) = other*identity3
  end function truss_mass

end module truss_inertia
