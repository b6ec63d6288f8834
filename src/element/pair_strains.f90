!> Strains of two bodies p and q in relative motion, with exact first and second derivatives
!> (theory 1).
!>
!> They depend on nine coordinates: the gap r^q - r^p (3) and the spins of p and q (3 + 3). All are
!> sums and angles of two kinds of products: an axis of p with an axis of q or with the gap.
module pair_strains
  use kinds, only: wp
  use rotation, only: cross, outer, skew, identity3
  implicit none
  private

  public :: pair_t, strain_t, axes_product, gap_product, gap_component, gap_elongation
  public :: angle_of, hinge_angle, unwrapped, aligned, completed_triad, spin_hessian
  public :: operator(+), operator(-)

  integer, parameter, public :: pair_coordinates = 9

  !> Where two bodies are.
  type :: pair_t
    real(wp) :: chord(3) = 0.0_wp        !< r^q - r^p at the start [L]
    real(wp) :: shift(3) = 0.0_wp        !< how much it has grown [L]
    real(wp) :: triad(3, 3, 2) = 0.0_wp  !< axes a b c of p and of q, at the start the same
  end type pair_t

  !> A strain, a length [L] or an angle [rad], and its derivatives at theta = 0 of exp(theta).
  type :: strain_t
    real(wp) :: value = 0.0_wp
    real(wp) :: gradient(pair_coordinates) = 0.0_wp
    real(wp) :: hessian(pair_coordinates, pair_coordinates) = 0.0_wp
  end type strain_t

  interface operator(+)
    module procedure :: plus
  end interface operator(+)

  interface operator(-)
    module procedure :: minus
  end interface operator(-)

  real(wp), parameter :: turn = 2*acos(-1.0_wp)
  real(wp), parameter :: tie = 1.0e-6_wp  !< of direction cosines

contains

  !> Axis i of p times axis j of q.
  pure function axes_product(pair, i, j) result(product)
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: i, j
    type(strain_t) :: product

    associate (u => pair%triad(:, i, 1), v => pair%triad(:, j, 2), h => product%hessian)
      product%value = dot_product(u, v)
      product%gradient(4:6) = cross(u, v)
      product%gradient(7:9) = -product%gradient(4:6)
      h(4:6, 4:6) = spin_hessian(u, v)
      h(7:9, 7:9) = h(4:6, 4:6)
      h(4:6, 7:9) = product%value*identity3 - outer(v, u)
      h(7:9, 4:6) = transpose(h(4:6, 7:9))
    end associate
  end function axes_product

  !> Axis i of p times the gap.
  pure function gap_product(pair, i) result(product)
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: i
    type(strain_t) :: product
    real(wp) :: gap(3)

    gap = pair%chord + pair%shift
    associate (u => pair%triad(:, i, 1), h => product%hessian)
      product%value = dot_product(u, gap)
      product%gradient(1:3) = u
      product%gradient(4:6) = cross(u, gap)
      h(4:6, 4:6) = spin_hessian(u, gap)
      h(4:6, 1:3) = skew(u)
      h(1:3, 4:6) = -h(4:6, 1:3)
    end associate
  end function gap_product

  !> Global component i of the gap.
  pure function gap_component(pair, i) result(component)
    type(pair_t), intent(in) :: pair
    integer, intent(in) :: i
    type(strain_t) :: component

    component%value = pair%chord(i) + pair%shift(i)
    component%gradient(i) = 1
  end function gap_component

  !> What the length of the gap has grown by, without cancellation; for a gap that is not zero.
  pure function gap_elongation(pair) result(elongation)
    type(pair_t), intent(in) :: pair
    type(strain_t) :: elongation
    real(wp) :: gap(3), length

    gap = pair%chord + pair%shift
    length = norm2(gap)
    elongation%value = dot_product(pair%shift, pair%chord + gap)/(norm2(pair%chord) + length)
    elongation%gradient(1:3) = gap/length
    associate (n => elongation%gradient(1:3))
      elongation%hessian(1:3, 1:3) = (identity3 - outer(n, n))/length
    end associate
  end function gap_elongation

  !> Angle of q relative to p about a, of -pi to pi [rad]: that of the turn about a which, with a
  !> second one about an axis at right angles to it, takes p to q. Smooth while `aligned`.
  pure function hinge_angle(pair) result(angle)
    type(pair_t), intent(in) :: pair
    type(strain_t) :: angle

    angle = angle_of(axes_product(pair, 3, 2) - axes_product(pair, 2, 3), &
                     axes_product(pair, 2, 2) + axes_product(pair, 3, 3))
  end function hinge_angle

  !> Whether the axes a of p and q are less than a right angle apart.
  pure logical function aligned(pair)
    type(pair_t), intent(in) :: pair

    aligned = dot_product(pair%triad(:, 1, 1), pair%triad(:, 1, 2)) > 0
  end function aligned

  !> atan2 of a sine and a cosine, which need not be normalised. With z = cosine + i sine it is
  !> the imaginary part of log z, whose derivatives are dz/z and d2z/z - (dz/z)(dz/z)'.
  pure function angle_of(sine, cosine) result(angle)
    type(strain_t), intent(in) :: sine, cosine
    type(strain_t) :: angle
    real(wp) :: growth(pair_coordinates), x, y
    integer :: j

    x = cosine%value/(cosine%value**2 + sine%value**2)
    y = sine%value/(cosine%value**2 + sine%value**2)
    angle%value = atan2(sine%value, cosine%value)
    angle%gradient = x*sine%gradient - y*cosine%gradient
    growth = x*cosine%gradient + y*sine%gradient
    do j = 1, pair_coordinates
      angle%hessian(:, j) = x*sine%hessian(:, j) - y*cosine%hessian(:, j) &
                            - growth*angle%gradient(j) - angle%gradient*growth(j)
    end do
  end function angle_of

  !> The angle that differs from `angle` by full turns and is nearest to `counted` [rad].
  pure real(wp) function unwrapped(angle, counted)
    real(wp), intent(in) :: angle, counted

    unwrapped = angle + turn*anint((counted - angle)/turn)
  end function unwrapped

  !> Unit axes a b c: a along `axis`, b the projection of the global axis that is most at right
  !> angles to it, ties in the order x y z.
  pure function completed_triad(axis) result(triad)
    real(wp), intent(in) :: axis(3)  !< not zero
    real(wp) :: triad(3, 3)
    integer :: i

    associate (a => triad(:, 1), b => triad(:, 2))
      a = axis/norm2(axis)
      do i = 1, 3
        if (abs(a(i)) <= minval(abs(a)) + tie) exit
      end do
      b = identity3(:, i) - a(i)*a
      b = b/norm2(b)
      triad(:, 3) = cross(a, b)
    end associate
  end function completed_triad

  !> d2/dtheta2 of exp(theta) a . c.
  pure function spin_hessian(a, c) result(h)
    real(wp), intent(in) :: a(3), c(3)
    real(wp) :: h(3, 3)

    h = 0.5_wp*(outer(a, c) + outer(c, a)) - dot_product(a, c)*identity3
  end function spin_hessian

  pure function plus(s, t) result(total)
    type(strain_t), intent(in) :: s, t
    type(strain_t) :: total

    total%value = s%value + t%value
    total%gradient = s%gradient + t%gradient
    total%hessian = s%hessian + t%hessian
  end function plus

  pure function minus(s, t) result(difference)
    type(strain_t), intent(in) :: s, t
    type(strain_t) :: difference

    difference%value = s%value - t%value
    difference%gradient = s%gradient - t%gradient
    difference%hessian = s%hessian - t%hessian
  end function minus

end module pair_strains
