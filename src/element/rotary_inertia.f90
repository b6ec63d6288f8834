!> The moment that turns a body: J w' + w x (J w), and its derivatives.
!>
!> J is the inertia tensor about the point that carries it, in global axes; it turns with the
!> body (theory 7).
module rotary_inertia
  use kinds, only: wp
  use rotation, only: cross, skew
  implicit none
  private

  public :: rotary_moment

contains

  !> Moment and derivatives. That to the place holds `spin` and `rate` as global components and
  !> turns the body by spatial rotations dR = skew(dphi) R: dJ = skew(dphi) J - J skew(dphi).
  pure subroutine rotary_moment(tensor, spin, rate, moment, to_spin, to_place)
    real(wp), intent(in) :: tensor(3, 3)     !< J, symmetric [M L^2]
    real(wp), intent(in) :: spin(3)          !< angular velocity w [T^-1]
    real(wp), intent(in) :: rate(3)          !< w' [T^-2]
    real(wp), intent(out) :: moment(3)       !< [F L]
    real(wp), intent(out) :: to_spin(3, 3)   !< [F L T]
    real(wp), intent(out) :: to_place(3, 3)  !< [F L]
    real(wp) :: momentum(3), gain(3), w(3, 3)

    w = skew(spin)
    momentum = matmul(tensor, spin)
    gain = matmul(tensor, rate)
    moment = gain + cross(spin, momentum)
    to_spin = matmul(w, tensor) - skew(momentum)
    to_place = matmul(tensor, skew(rate)) - skew(gain) - matmul(w, transpose(to_spin))
  end subroutine rotary_moment

end module rotary_inertia
