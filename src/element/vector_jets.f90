!> Functions of a few vectors with exact first and second derivatives to their components.
!>
!> The arguments are the columns of one array; component i of column k is variable 3 (k - 1) + i.
module vector_jets
  use kinds, only: wp
  use rotation, only: cross, skew, identity3
  implicit none
  private

  public :: jet_t, vector_product, triple_product, power, argument
  public :: operator(+), operator(-), operator(*)

  integer, parameter, public :: vectors = 5, variables = 3*vectors

  !> A value and its derivatives.
  type :: jet_t
    real(wp) :: value = 0.0_wp
    real(wp) :: gradient(variables) = 0.0_wp
    real(wp) :: hessian(variables, variables) = 0.0_wp
  end type jet_t

  interface operator(+)
    module procedure :: plus
  end interface operator(+)

  interface operator(-)
    module procedure :: minus
  end interface operator(-)

  interface operator(*)
    module procedure :: times
  end interface operator(*)

contains

  !> Vector i times vector j; they may be the same.
  pure function vector_product(v, i, j) result(product)
    real(wp), intent(in) :: v(3, vectors)
    integer, intent(in) :: i, j
    type(jet_t) :: product

    product%value = dot_product(v(:, i), v(:, j))
    associate (g => product%gradient, h => product%hessian, p => 3*i - 3, q => 3*j - 3)
      g(p + 1:p + 3) = v(:, j)
      g(q + 1:q + 3) = g(q + 1:q + 3) + v(:, i)
      h(p + 1:p + 3, q + 1:q + 3) = identity3
      h(q + 1:q + 3, p + 1:p + 3) = h(q + 1:q + 3, p + 1:p + 3) + identity3
    end associate
  end function vector_product

  !> i . (j x k), of three different vectors.
  pure function triple_product(v, i, j, k) result(product)
    real(wp), intent(in) :: v(3, vectors)
    integer, intent(in) :: i, j, k
    type(jet_t) :: product
    integer :: turn, at(3), p, q

    at = [i, j, k]
    product%value = dot_product(v(:, i), cross(v(:, j), v(:, k)))
    do turn = 1, 3
      p = 3*at(1) - 3
      q = 3*at(2) - 3
      product%gradient(p + 1:p + 3) = cross(v(:, at(2)), v(:, at(3)))
      product%hessian(p + 1:p + 3, q + 1:q + 3) = -skew(v(:, at(3)))
      product%hessian(q + 1:q + 3, p + 1:p + 3) = skew(v(:, at(3)))
      at = cshift(at, 1)
    end do
  end function triple_product

  !> A positive jet to a power.
  pure function power(a, order) result(b)
    type(jet_t), intent(in) :: a
    real(wp), intent(in) :: order
    type(jet_t) :: b
    real(wp) :: rate, bend
    integer :: j

    b%value = a%value**order
    rate = order*b%value/a%value
    bend = (order - 1)*rate/a%value
    b%gradient = rate*a%gradient
    do j = 1, variables
      b%hessian(:, j) = rate*a%hessian(:, j) + bend*a%gradient(j)*a%gradient
    end do
  end function power

  !> The angle whose sine and cosine are in this proportion, of -pi to pi: the imaginary part of
  !> log z, whose derivatives are dz/z and d2z/z - (dz/z)(dz/z)'.
  pure function argument(sine, cosine) result(angle)
    type(jet_t), intent(in) :: sine, cosine
    type(jet_t) :: angle
    real(wp) :: growth(variables), x, y
    integer :: j

    x = cosine%value/(cosine%value**2 + sine%value**2)
    y = sine%value/(cosine%value**2 + sine%value**2)
    angle%value = atan2(sine%value, cosine%value)
    angle%gradient = x*sine%gradient - y*cosine%gradient
    growth = x*cosine%gradient + y*sine%gradient
    do j = 1, variables
      angle%hessian(:, j) = x*sine%hessian(:, j) - y*cosine%hessian(:, j) &
                            - growth*angle%gradient(j) - angle%gradient*growth(j)
    end do
  end function argument

  pure function plus(a, b) result(c)
    type(jet_t), intent(in) :: a, b
    type(jet_t) :: c

    c%value = a%value + b%value
    c%gradient = a%gradient + b%gradient
    c%hessian = a%hessian + b%hessian
  end function plus

  pure function minus(a, b) result(c)
    type(jet_t), intent(in) :: a, b
    type(jet_t) :: c

    c%value = a%value - b%value
    c%gradient = a%gradient - b%gradient
    c%hessian = a%hessian - b%hessian
  end function minus

  pure function times(a, b) result(c)
    type(jet_t), intent(in) :: a, b
    type(jet_t) :: c
    integer :: j

    c%value = a%value*b%value
    c%gradient = a%value*b%gradient + b%value*a%gradient
    do j = 1, variables
      c%hessian(:, j) = a%value*b%hessian(:, j) + b%value*a%hessian(:, j) &
                        + a%gradient(j)*b%gradient + a%gradient*b%gradient(j)
    end do
  end function times

end module vector_jets
