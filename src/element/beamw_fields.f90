!> Displacement fields of a BEAMW element as linear forms in its eight strains (theory 5 c).
module beamw_fields
  use kinds, only: wp
  use beamw_rigidity, only: rigidity_t
  implicit none
  private

  public :: fields_t, shears_t, element_fields, twist_fields, eccentricity
  public :: product_form, square_form, unit_form

  !> Fields along the element as linear forms in the eight strains.
  type :: fields_t
    real(wp), dimension(8) :: vs = 0, ws = 0      !< slopes of the shear-centre line
    real(wp), dimension(8) :: vss = 0, wss = 0    !< their x-derivatives [1/L]
    real(wp), dimension(8) :: phi = 0, dphi = 0   !< twist in the mid-twist frame, its rate
  end type fields_t

  !> Shear strains, constant along the element, as linear forms in the eight strains.
  type :: shears_t
    real(wp), dimension(8) :: y = 0, z = 0, omega = 0
  end type shears_t

  !> Four Gauss points on (0, 1) integrate polynomials of degree 7 exactly.
  real(wp), parameter :: inner = sqrt((3 - 2*sqrt(1.2_wp))/7), outer = sqrt((3 + 2*sqrt(1.2_wp))/7)
  real(wp), parameter, public :: gauss_point(4) = (1 + [-outer, -inner, inner, outer])/2
  real(wp), parameter :: root30 = sqrt(30.0_wp)
  real(wp), parameter, public :: gauss_weight(4) = &
    [18 - root30, 18 + root30, 18 + root30, 18 - root30]/72

contains

  !> Matrix F of a product of two linear forms: e'Fe = (a.e)(b.e), symmetric.
  pure function product_form(a, b) result(f)
    real(wp), intent(in) :: a(8), b(8)
    real(wp) :: f(8, 8)
    integer :: j

    do j = 1, 8
      f(:, j) = 0.5_wp*(a*b(j) + b*a(j))
    end do
  end function product_form

  !> Matrix of the square of a linear form.
  pure function square_form(a) result(f)
    real(wp), intent(in) :: a(8)
    real(wp) :: f(8, 8)

    f = product_form(a, a)
  end function square_form

  !> The linear form that picks strain i.
  pure function unit_form(i) result(e)
    integer, intent(in) :: i
    real(wp) :: e(8)

    e = 0
    e(i) = 1
  end function unit_form

  !> E of (41): strains at the shear centre from those at the centroid.
  pure function eccentricity(r, l) result(e)
    type(rigidity_t), intent(in) :: r
    real(wp), intent(in) :: l
    real(wp) :: e(8, 8)
    integer :: i

    e = 0
    do i = 1, 8
      e(i, i) = 1
    end do
    e(3:6, 2) = [-r%ys, r%ys, -r%zs, r%zs]/l
  end function eccentricity

  !> The part of the fields that comes from torsion, in the strains "s" (theory 5 c).
  pure function twist_fields(xi, l, warping, gamma) result(f)
    real(wp), intent(in) :: xi, l, gamma(8)
    logical, intent(in) :: warping
    type(fields_t) :: f

    if (warping) then
      f%phi = l*gamma*(xi*(1 - xi)**2 + xi**3 - xi**2)
      f%phi(2) = f%phi(2) + (3*xi**2 - 2*xi**3 - 0.5_wp)/l
      f%phi(7) = f%phi(7) + xi*(1 - xi)**2/l
      f%phi(8) = f%phi(8) + (xi**3 - xi**2)/l
      f%dphi = gamma*(1 - 6*xi + 6*xi**2)
      f%dphi(2) = f%dphi(2) + 6*(xi - xi**2)/l**2
      f%dphi(7) = f%dphi(7) + (1 - 4*xi + 3*xi**2)/l**2
      f%dphi(8) = f%dphi(8) + (3*xi**2 - 2*xi)/l**2
    else
      f%phi(2) = (xi - 0.5_wp)/l
      f%dphi(2) = 1/l**2
    end if
  end function twist_fields

  !> All fields at xi = x/l (theory 5 c): absolute slopes of the shear-centre line and twist.
  pure function element_fields(xi, l, r, warping, gamma) result(f)
    real(wp), intent(in) :: xi, l
    type(rigidity_t), intent(in) :: r
    logical, intent(in) :: warping
    type(shears_t), intent(in) :: gamma
    type(fields_t) :: f
    real(wp) :: e(8, 8), d2, d4, dd2, dd4

    e = eccentricity(r, l)
    d2 = 1 - 4*xi + 3*xi**2
    d4 = 3*xi**2 - 2*xi
    dd2 = -4 + 6*xi
    dd4 = 6*xi - 2
    f = twist_fields(xi, l, warping, gamma%omega)
    f%vs = (-e(5, :)/l + gamma%y)*d2 + (e(6, :)/l + gamma%y)*d4
    f%ws = (e(3, :)/l + gamma%z)*d2 + (-e(4, :)/l + gamma%z)*d4
    f%vss = ((-e(5, :)/l + gamma%y)*dd2 + (e(6, :)/l + gamma%y)*dd4)/l
    f%wss = ((e(3, :)/l + gamma%z)*dd2 + (-e(4, :)/l + gamma%z)*dd4)/l
    f%vs(2) = f%vs(2) - r%zs/l**2
    f%ws(2) = f%ws(2) + r%ys/l**2
  end function element_fields

end module beamw_fields
