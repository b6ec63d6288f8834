!> The moment that turns a body: J w' + w x (J w), and its derivatives.
!>
!> J is the inertia tensor about the point that carries it, in global axes; it turns with the
!> body (theory 7).
module rotary_inertia
  use kinds, only: wp
  use rotation, only: cross, add_skew, add_turned
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
    real(wp) :: momentum(3), gain(3), turned_momentum(3, 3)
    integer :: j

    momentum = matmul(tensor, spin)
    gain = matmul(tensor, rate)
    moment = gain + cross(spin, momentum)
    call turn_product(tensor, spin, momentum, turned_momentum)
    call turn_product(tensor, rate, gain, to_place)
    to_spin = -transpose(turned_momentum)
    do j = 1, 3
      to_place(:, j) = to_place(:, j) + cross(spin, turned_momentum(:, j))
    end do
  end subroutine rotary_moment

  !> Derivative of J v to a turn of J: J skew(v) - skew(J v).
  pure subroutine turn_product(tensor, v, product, derivative)
    real(wp), intent(in) :: tensor(3, 3), v(3)
    real(wp), intent(in) :: product(3)  !< J v
    real(wp), intent(out) :: derivative(3, 3)

    derivative = 0
    call add_turned(tensor, -v, derivative)
    call add_skew(-1.0_wp, product, derivative)
  end subroutine turn_product

end module rotary_inertia
