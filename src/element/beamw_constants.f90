!> Constants of a BEAMW element: first-order stiffness and second-order strains.
!>
!> Generalized strains, from the strains e of the nodes (finite angles in the mid-twist frame for
!> CONSISTENT, theory 5; those of the paper's (7) else):
!>     strain(i) = sum w(j, i) e(j) + 1/2 sum q(j, k, i) e(j) e(k),     i = 1..9.
!> The first eight are the paper's modes at the shear centre ("s"), the ninth is the residual
!> Wagner strain. Their stiffness is `s`. Computed once for all elements that are alike.
module beamw_constants
  use kinds, only: wp
  use beamw_rigidity, only: rigidity_t, shear_compliance
  use beamw_fields, only: fields_t, shears_t, twist_fields, eccentricity, product_form, &
                          square_form, gauss_point, gauss_weight
  use beamw_second_order, only: consistent_second_order, jonker_second_order
  implicit none
  private

  public :: beamw_t, new_beamw

  integer, parameter, public :: beamw_none = 0, beamw_jonker = 1, beamw_consistent = 2

  type :: beamw_t
    real(wp) :: length = 0.0_wp          !< l0 [L]
    logical :: angles = .false.          !< finite angles and mid-twist frame (CONSISTENT)
    logical :: warping = .true.          !< carries a bimoment
    real(wp) :: w(8, 9) = 0.0_wp         !< first-order part, E' of (41) with a column of zeros
    real(wp) :: q(8, 8, 9) = 0.0_wp      !< second-order parts [1/L], symmetric in the first two
    logical :: curved(9) = .false.       !< by strain: whether its second-order part is not zero
    real(wp) :: s(9, 9) = 0.0_wp         !< stiffness [F/L]
  end type beamw_t

contains

  !> Constants of an element of length `length` [L].
  pure function new_beamw(rigidity, length, second) result(self)
    type(rigidity_t), intent(in) :: rigidity
    real(wp), intent(in) :: length
    integer, intent(in) :: second  !< one of `beamw_*`
    type(beamw_t) :: self
    type(shears_t) :: gamma
    integer :: i

    self%length = length
    self%angles = second == beamw_consistent
    self%warping = rigidity%eiw > 0
    self%w(:, 1:8) = transpose(eccentricity(rigidity, length))
    if (second == beamw_consistent) then
      call condensed_stiffness(rigidity, length, self%warping, gamma, self%s(1:8, 1:8))
      self%s(9, 9) = rigidity%eir/length
      self%q = consistent_second_order(rigidity, length, self%warping, gamma)
    else
      self%s(1:8, 1:8) = coupled_stiffness(rigidity, length, self%warping)
      if (second == beamw_jonker) self%q(:, :, 1:8) = jonker_second_order(rigidity, length)
    end if
    self%curved = [(any(abs(self%q(:, :, i)) > 0), i=1, 9)]
  end function new_beamw

  !> Mean shear angles of the element (theory 4), rows y, z, omega, in the strains "s".
  pure function shear_forms(l) result(g)
    real(wp), intent(in) :: l
    real(wp) :: g(3, 8)

    g = 0
    g(1, 5:6) = [1, -1]/(2*l)
    g(2, 3:4) = [-1, 1]/(2*l)
    g(3, 2) = 1/l**2
    g(3, 7:8) = -0.5_wp/l**2
  end function shear_forms

  !> Stiffness with condensed shear strains (theory 4, CONSISTENT) and those strains as forms in
  !> the strains of the nodes.
  pure subroutine condensed_stiffness(r, l, warping, gamma, s)
    type(rigidity_t), intent(in) :: r
    real(wp), intent(in) :: l
    logical, intent(in) :: warping
    type(shears_t), intent(out) :: gamma
    real(wp), intent(out) :: s(8, 8)
    real(wp) :: g(3, 8), k(3, 3), strain(3, 8)
    type(fields_t) :: field
    integer :: i

    g = shear_forms(l)
    k = 0
    k(1, 1) = r%eiz
    k(2, 2) = r%eiy
    k(3, 3) = r%eiw
    k = 12/l**2*k
    strain = solve3(matmul(shear_compliance(r), k), g)
    s = bernoulli_stiffness(r, l, [0.0_wp, 0.0_wp, 0.0_wp]) &
        - l*matmul(transpose(g), matmul(k, strain))
    gamma%omega = strain(3, :)
    do i = 1, 4
      field = twist_fields(gauss_point(i), l, warping, gamma%omega)
      s = s + gauss_weight(i)*l*r%git*square_form(field%dphi)
    end do
    strain = matmul(strain, eccentricity(r, l))
    gamma = shears_t(strain(1, :), strain(2, :), strain(3, :))
  end subroutine condensed_stiffness

  !> (1 + fk)^-1 fk g, the shear strains in equilibrium; fk: compliance times stiffness.
  pure function solve3(fk, g) result(x)
    real(wp), intent(in) :: fk(3, 3), g(3, 8)
    real(wp) :: x(3, 8), a(3, 11)
    integer :: i, j

    a(:, 1:3) = fk
    a(:, 4:) = matmul(fk, g)
    do i = 1, 3
      a(i, i) = a(i, i) + 1
    end do
    do i = 1, 3
      a(i, :) = a(i, :)/a(i, i)
      do j = 1, 3
        if (j /= i) a(j, :) = a(j, :) - a(j, i)*a(i, :)
      end do
    end do
    x = a(:, 4:)
  end function solve3

  !> Axial, bending and warping stiffness with shear parameters phi = Phi_y, Phi_z, Phi_omega
  !> (theory 4, Appendix A without torsion and coupling).
  pure function bernoulli_stiffness(r, l, phi) result(s)
    type(rigidity_t), intent(in) :: r
    real(wp), intent(in) :: l, phi(3)
    real(wp) :: s(8, 8)

    s = 0
    s(1, 1) = r%ea/l
    s(3:4, 3:4) = r%eiy/(l**3*(1 + phi(2)))*bending_block(phi(2))
    s(5:6, 5:6) = r%eiz/(l**3*(1 + phi(1)))*bending_block(phi(1))
    s([2, 7, 8], [2, 7, 8]) = r%eiw/(l**5*(1 + phi(3)))* &
      reshape([12.0_wp, -6.0_wp, -6.0_wp, -6.0_wp, 4 + phi(3), 2 - phi(3), &
               -6.0_wp, 2 - phi(3), 4 + phi(3)], [3, 3])
  end function bernoulli_stiffness

  pure function bending_block(phi) result(block)
    real(wp), intent(in) :: phi
    real(wp) :: block(2, 2)

    block = reshape([4 + phi, -2 + phi, -2 + phi, 4 + phi], [2, 2])
  end function bending_block

  !> Stiffness of Appendix A with the constant shear strains of the modified Hermitian
  !> interpolation (theory 4, used by JONKER and NONE).
  pure function coupled_stiffness(r, l, warping) result(s)
    type(rigidity_t), intent(in) :: r
    real(wp), intent(in) :: l
    logical, intent(in) :: warping
    real(wp) :: s(8, 8), phi(3), p1, p2, g(3, 8), bending(3)
    integer :: i, j

    bending = [r%eiz, r%eiy, r%eiw]
    phi = 0
    do i = 1, 3
      if (.not. r%shear_rigid(i)) phi(i) = 12*bending(i)/(r%gd(i, i)*l**2)
    end do
    s = bernoulli_stiffness(r, l, phi)
    p1 = 30*phi(3)*(2 + phi(3))
    p2 = 5*phi(3)*(1 + phi(3)/2)
    if (warping) then
      s([2, 7, 8], [2, 7, 8]) = s([2, 7, 8], [2, 7, 8]) + r%git/(30*l**3*(1 + phi(3))**2)* &
        reshape([36 + p1, -3.0_wp, -3.0_wp, -3.0_wp, 4 + p2, -(1 + p2), &
                 -3.0_wp, -(1 + p2), 4 + p2], [3, 3])
    else
      s(2, 2) = r%git/l**3
    end if
    g = shear_forms(l)
    do i = 1, 3
      g(i, :) = phi(i)/(1 + phi(i))*g(i, :)
    end do
    do i = 1, 3
      do j = 1, i - 1
        s = s + 2*l*r%gd(i, j)*product_form(g(i, :), g(j, :))
      end do
    end do
  end function coupled_stiffness

end module beamw_constants
