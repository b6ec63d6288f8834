!> Second-order parts of the strains of a BEAMW element: the symmetric matrices Q (theory 5).
module beamw_second_order
  use kinds, only: wp
  use beamw_rigidity, only: rigidity_t
  use beamw_fields, only: fields_t, shears_t, element_fields, eccentricity, product_form, &
                          square_form, unit_form, gauss_point, gauss_weight
  implicit none
  private

  public :: consistent_second_order, jonker_second_order

contains

  !> SECOND CONSISTENT: second-order strains of a general section with moment-area weights
  !> (theory 5 c); strain i gains 1/2 e'Q(:, :, i)e [1/L].
  pure function consistent_second_order(r, l, warping, gamma) result(q)
    type(rigidity_t), intent(in) :: r
    real(wp), intent(in) :: l
    logical, intent(in) :: warping
    type(shears_t), intent(in) :: gamma
    real(wp) :: q(8, 8, 9)
    real(wp), dimension(8, 8) :: kx, ky, kz, gy, gz, twist2, c2
    real(wp), dimension(8) :: vc, wc, phi_y, phi_z
    type(fields_t) :: f
    real(wp) :: x, w
    integer :: i

    q = 0
    do i = 1, 4
      x = gauss_point(i)*l
      w = gauss_weight(i)*l
      f = element_fields(gauss_point(i), l, r, warping, gamma)
      phi_z = f%vs - gamma%y
      phi_y = gamma%z - f%ws
      vc = f%vs + r%zs*f%dphi
      wc = f%ws - r%ys*f%dphi
      twist2 = square_form(f%dphi)
      kx = -product_form(phi_y, f%vss)
      ky = product_form(f%phi, f%vss) + r%by/2*twist2 - product_form(f%dphi, gamma%y)
      kz = product_form(f%phi, f%wss) - r%bz/2*twist2 - product_form(f%dphi, gamma%z)
      gy = product_form(f%phi, wc + phi_y) - r%zs*kx
      gz = product_form(f%phi, phi_z - vc) + r%ys*kx
      q(:, :, 1) = q(:, :, 1) + w/2*(square_form(vc) + square_form(wc) + r%polar*twist2)
      q(:, :, 2) = q(:, :, 2) + w*l*kx
      q(:, :, 3) = q(:, :, 3) + w*(ky*(l - x) - gz)
      q(:, :, 4) = q(:, :, 4) + w*(ky*x + gz)
      q(:, :, 5) = q(:, :, 5) + w*(kz*(l - x) + gy)
      q(:, :, 6) = q(:, :, 6) + w*(kz*x - gy)
      q(:, :, 7) = q(:, :, 7) + w/2*r%bw*l*(l - x)*twist2
      q(:, :, 8) = q(:, :, 8) - w/2*r%bw*l*x*twist2
      q(:, :, 9) = q(:, :, 9) + w/2*twist2
    end do
    c2 = product_form(unit_form(4) - unit_form(3), unit_form(5) + unit_form(6))/(2*l)
    q(:, :, 2) = q(:, :, 2) + c2
    q(:, :, 3) = q(:, :, 3) - r%ys/l*c2
    q(:, :, 4) = q(:, :, 4) + r%ys/l*c2
    q(:, :, 5) = q(:, :, 5) - r%zs/l*c2
    q(:, :, 6) = q(:, :, 6) + r%zs/l*c2
    q = 2*q
  end function consistent_second_order

  !> SECOND JONKER: (66) as printed, then taken to the shear centre by E (theory 5).
  pure function jonker_second_order(r, l) result(q)
    type(rigidity_t), intent(in) :: r
    real(wp), intent(in) :: l
    real(wp) :: q(8, 8, 8), p(8, 8, 8), e(8, 8)
    integer :: i, j

    p = 0
    call add(p(:, :, 1), 1/(30*l), [3, 3, 4, 5, 5, 6], [3, 4, 4, 5, 6, 6], [2, 1, 2, 2, 1, 2])
    call add(p(:, :, 1), r%polar/(30*l**3), [2, 2, 2, 7, 7, 8], [2, 7, 8, 7, 8, 8], &
             [18, -3, -3, 2, -1, 2])
    call add(p(:, :, 1), -(r%ys**2 + r%zs**2)/(10*l**3), [2], [2], [1])
    call add(p(:, :, 2), 1/l, [3, 4], [6, 5], [-1, 1])
    call add(p(:, :, 3), 1/(30*l), [2, 2, 5, 8, 8], [5, 6, 7, 5, 6], [3, 6, 3, -1, -1])
    call add(p(:, :, 4), 1/(30*l), [2, 2, 6, 7, 7], [5, 6, 8, 5, 6], [-6, -3, -3, 1, 1])
    call add(p(:, :, 5), 1/(30*l), [2, 2, 3, 8, 8], [3, 4, 7, 3, 4], [-3, -6, -3, 1, 1])
    call add(p(:, :, 6), 1/(30*l), [2, 2, 4, 7, 7], [3, 4, 8, 3, 4], [6, 3, 3, -1, -1])
    e = eccentricity(r, l)
    q = 0
    do i = 1, 8
      do j = 1, 8
        q(:, :, i) = q(:, :, i) + e(i, j)*p(:, :, j)
      end do
    end do
  end function jonker_second_order

  !> Add factor times the sum of c(k) e(a(k)) e(b(k)) to a strain whose matrix is q.
  pure subroutine add(q, factor, a, b, c)
    real(wp), intent(inout) :: q(8, 8)
    real(wp), intent(in) :: factor
    integer, intent(in) :: a(:), b(:), c(:)
    integer :: k

    do k = 1, size(c)
      q = q + 2*factor*c(k)*product_form(unit_form(a(k)), unit_form(b(k)))
    end do
  end subroutine add

end module beamw_second_order
