!> Finite rotations in Euler parameters, and the vectors' products that go with them.
!>
!> A rotation is a unit 4-vector `(lambda0, lambda)`, scalar part first (theory 1, paper (2)).
module rotation
  use kinds, only: wp
  implicit none
  private

  public :: rotation_matrix, rotated, turned, rotation_vector, cross, outer, skew
  public :: add_skew, add_turned

  real(wp), parameter, public :: identity3(3, 3) = &
    reshape([1, 0, 0, 0, 1, 0, 0, 0, 1]*1.0_wp, [3, 3])
  real(wp), parameter, public :: no_rotation(0:3) = [1, 0, 0, 0]*1.0_wp

contains

  !> Rotation matrix of Euler parameters, (2); column i is the image of the base vector i.
  pure function rotation_matrix(p) result(r)
    real(wp), intent(in) :: p(0:3)  !< Euler parameters, `norm2(p) = 1`
    real(wp) :: r(3, 3)

    r(:, 1) = [1 - 2*(p(2)**2 + p(3)**2), &
               2*(p(1)*p(2) + p(0)*p(3)), &
               2*(p(1)*p(3) - p(0)*p(2))]
    r(:, 2) = [2*(p(1)*p(2) - p(0)*p(3)), &
               1 - 2*(p(1)**2 + p(3)**2), &
               2*(p(2)*p(3) + p(0)*p(1))]
    r(:, 3) = [2*(p(1)*p(3) + p(0)*p(2)), &
               2*(p(2)*p(3) - p(0)*p(1)), &
               1 - 2*(p(1)**2 + p(2)**2)]
  end function rotation_matrix

  !> The images of three vectors, the columns of `triad`.
  pure function rotated(p, triad) result(image)
    real(wp), intent(in) :: p(0:3), triad(3, 3)
    real(wp) :: image(3, 3), r(3, 3)
    integer :: j

    r = rotation_matrix(p)
    do j = 1, 3
      image(:, j) = r(:, 1)*triad(1, j) + r(:, 2)*triad(2, j) + r(:, 3)*triad(3, j)
    end do
  end function rotated

  !> Euler parameters after a further rotation by the spatial rotation vector `theta` [rad]:
  !> the quaternion product of exp(theta) and `p`, normalised.
  pure function turned(p, theta) result(q)
    real(wp), intent(in) :: p(0:3), theta(3)
    real(wp) :: q(0:3), d(3), d0, half

    half = 0.5_wp*norm2(theta)
    d0 = cos(half)
    d = 0.5_wp*theta*sine_ratio(half)
    q(0) = d0*p(0) - dot_product(d, p(1:3))
    q(1:3) = d0*p(1:3) + p(0)*d + cross(d, p(1:3))
    q = q/norm2(q)
  end function turned

  !> The rotation vector of Euler parameters, of length 0 to pi [rad].
  pure function rotation_vector(p) result(theta)
    real(wp), intent(in) :: p(0:3)
    real(wp) :: theta(3), half, q(0:3)

    q = sign(1.0_wp, p(0))*p
    half = atan2(norm2(q(1:3)), q(0))
    theta = 2*q(1:3)/sine_ratio(half)
    if (half > 0.5_wp) theta = 2*half*q(1:3)/norm2(q(1:3))
  end function rotation_vector

  !> sin(x)/x.
  pure function sine_ratio(x) result(ratio)
    real(wp), intent(in) :: x
    real(wp) :: ratio

    if (abs(x) < 1.0e-4_wp) then
      ratio = 1 - x**2/6
    else
      ratio = sin(x)/x
    end if
  end function sine_ratio

  !> a x b.
  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)

    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> a b', the matrix of a dyadic product.
  pure function outer(a, b) result(m)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: m(3, 3)

    m(:, 1) = a*b(1)
    m(:, 2) = a*b(2)
    m(:, 3) = a*b(3)
  end function outer

  !> The matrix of a cross product: `matmul(skew(a), b)` is a x b, (3).
  pure function skew(a) result(s)
    real(wp), intent(in) :: a(3)
    real(wp) :: s(3, 3)

    s = 0
    call add_skew(1.0_wp, a, s)
  end function skew

  !> matrix + scale skew(a).
  pure subroutine add_skew(scale, a, matrix)
    real(wp), intent(in) :: scale, a(3)
    real(wp), intent(inout) :: matrix(3, 3)
    real(wp) :: v(3)

    v = scale*a
    matrix(2, 1) = matrix(2, 1) + v(3)
    matrix(3, 1) = matrix(3, 1) - v(2)
    matrix(1, 2) = matrix(1, 2) - v(3)
    matrix(3, 2) = matrix(3, 2) + v(1)
    matrix(1, 3) = matrix(1, 3) + v(2)
    matrix(2, 3) = matrix(2, 3) - v(1)
  end subroutine add_skew

  !> matrix - matmul(factor, skew(a)): the derivative of `matmul(factor, a)` as `a` is turned.
  pure subroutine add_turned(factor, a, matrix)
    real(wp), intent(in) :: factor(3, 3), a(3)
    real(wp), intent(inout) :: matrix(3, 3)

    matrix(:, 1) = matrix(:, 1) + a(2)*factor(:, 3) - a(3)*factor(:, 2)
    matrix(:, 2) = matrix(:, 2) + a(3)*factor(:, 1) - a(1)*factor(:, 3)
    matrix(:, 3) = matrix(:, 3) + a(1)*factor(:, 2) - a(2)*factor(:, 1)
  end subroutine add_turned

end module rotation
