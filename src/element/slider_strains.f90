!> Strains of a body that slides along the centroid line of a beam element, with exact first and
!> second derivatives.
!>
!> The line is the cubic of theory 7, r = H1 r^p + H2 l0 d^p + H3 r^q + H4 l0 d^q. The body stands
!> where the foot of the perpendicular is: f = (r^s - r(xi)) . r'(xi) = 0. Strains F(xi(u), u) have
!> the derivatives F_u + F_xi xi_u with xi_u = -f_u/f_xi. The second derivatives of the sum of
!> sigma F are those of the sum of sigma F - lambda f, with lambda such that its derivative to xi
!> is zero: xi_uu is not needed.
!> Coordinates: r^s (3), the body's spin (3), then of p and q: r (3), spin (3), alpha.
module slider_strains
  use kinds, only: wp
  use pair_strains, only: spin_hessian
  use rotation, only: cross, skew, identity3, add_skew
  use vector_jets, only: jet_t, vectors, variables, vector_product, triple_product, power, &
                         argument, operator(+), operator(-), operator(*)
  implicit none
  private

  public :: rail_t, find_foot, distance, slider_jets, slider_derivatives, rail_frame, is_sound

  integer, parameter, public :: rail_coordinates = 20
  integer, parameter :: body = 0, spin = 3, ends(2) = [6, 13]  !< coordinates before those of each

  !> Vectors that the strains are functions of: from the foot to the body, r', an axis that the
  !> section's y is the projection of, the body's y and z.
  integer, parameter :: gap = 1, tangent = 2, axis = 3, body_y = 4, body_z = 5

  integer, parameter :: most_iterations = 50
  real(wp), parameter :: settled = 1.0e-9_wp   !< the square of what is left then is round-off
  real(wp), parameter :: longest = 0.5_wp      !< step of the iteration
  real(wp), parameter :: farthest = 2.0_wp     !< beyond the ends, in lengths
  real(wp), parameter :: least_sine = 1.0e-3_wp

  !> An element and a body as they stand.
  type :: rail_t
    real(wp) :: length = 0.0_wp           !< l0 [L]
    real(wp) :: away(3) = 0.0_wp          !< r^s - r^p [L]
    real(wp) :: chord(3) = 0.0_wp         !< r^q - r^p [L]
    real(wp) :: d(3, 2) = 0.0_wp          !< slopes of the line at p and q
    real(wp) :: s(3, 2) = 0.0_wp          !< their derivatives to alpha [L]
    real(wp) :: y(3, 2) = 0.0_wp          !< y axes of the sections at p and q
    real(wp) :: axes(3, 2) = 0.0_wp       !< y and z axis of the body
  end type rail_t

contains

  !> Coefficients of r^p, l0 d^p, r^q, l0 d^q in a derivative of r to xi.
  pure function hermite(order, xi) result(h)
    integer, intent(in) :: order
    real(wp), intent(in) :: xi
    real(wp) :: h(4)

    select case (order)
    case (0)
      h = [1 - xi**2*(3 - 2*xi), xi*(1 - xi)**2, xi**2*(3 - 2*xi), xi**2*(xi - 1)]
    case (1)
      h = [6*xi*(xi - 1), (1 - xi)*(1 - 3*xi), 6*xi*(1 - xi), xi*(3*xi - 2)]
    case (2)
      h = [12*xi - 6, 6*xi - 4, 6 - 12*xi, 6*xi - 2]
    case default
      h = [12, 6, -12, 6]
    end select
  end function hermite

  !> A derivative of r - r^p to xi [L].
  pure function line(rail, order, xi) result(r)
    type(rail_t), intent(in) :: rail
    integer, intent(in) :: order
    real(wp), intent(in) :: xi
    real(wp) :: r(3), h(4)

    h = hermite(order, xi)
    r = rail%length*(h(2)*rail%d(:, 1) + h(4)*rail%d(:, 2)) + h(3)*rail%chord
  end function line

  !> The foot of the perpendicular from the body, by Newton from `xi`; it may lie beyond the ends,
  !> on the cubic as it goes on there.
  pure subroutine find_foot(rail, xi, found)
    type(rail_t), intent(in) :: rail
    real(wp), intent(inout) :: xi
    logical, intent(out) :: found
    real(wp) :: a(3), b(3), slope, step
    integer :: i

    found = .false.
    do i = 1, most_iterations
      a = rail%away - line(rail, 0, xi)
      b = line(rail, 1, xi)
      slope = dot_product(b, b)
      if (.not. slope > 0) return
      slope = max(slope - dot_product(a, line(rail, 2, xi)), 0.25_wp*slope)
      step = dot_product(a, b)/slope
      step = sign(min(abs(step), longest), step)
      xi = xi + step
      found = abs(step) <= settled
      if (found) return
      if (abs(xi - 0.5_wp) > farthest) return
    end do
  end subroutine find_foot

  !> How far the body is from the line at `xi` [L].
  pure real(wp) function distance(rail, xi)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi

    distance = norm2(rail%away - line(rail, 0, xi))
  end function distance

  !> The vectors at the foot.
  pure function vectors_at(rail, xi) result(v)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi
    real(wp) :: v(3, vectors)

    v(:, gap) = rail%away - line(rail, 0, xi)
    v(:, tangent) = line(rail, 1, xi)
    v(:, axis) = (1 - xi)*rail%y(:, 1) + xi*rail%y(:, 2)
    v(:, [body_y, body_z]) = rail%axes
  end function vectors_at

  !> Whether the strains are defined: the line has a direction and an axis across it, the body is
  !> nearer than the centre of curvature and, if it is `guided`, turned by less than a right angle.
  pure logical function is_sound(rail, xi, guided)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi
    logical, intent(in) :: guided
    real(wp) :: v(3, vectors), b

    v = vectors_at(rail, xi)
    b = norm2(v(:, tangent))
    is_sound = b > least_sine*rail%length .and. norm2(cross(v(:, tangent), v(:, axis))) > &
               least_sine*b .and. dot_product(v(:, gap), line(rail, 2, xi)) < b**2
    if (guided) is_sound = is_sound .and. &
      dot_product(cross(v(:, body_y), v(:, body_z)), v(:, tangent)) > 0
  end function is_sound

  !> Axes of the section at the foot: along the line, y and z.
  pure function rail_frame(rail, xi) result(frame)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi
    real(wp) :: frame(3, 3), v(3, vectors)

    v = vectors_at(rail, xi)
    frame(:, 1) = v(:, tangent)/norm2(v(:, tangent))
    frame(:, 3) = cross(v(:, tangent), v(:, axis))
    frame(:, 3) = frame(:, 3)/norm2(frame(:, 3))
    frame(:, 2) = cross(frame(:, 3), frame(:, 1))
  end function rail_frame

  !> Strains 2 and on, functions of the vectors: distances from the line along the section's y and
  !> z; if there are six, the turn about the line and the tilts of the body's y and z to it. With
  !> a . b = 0 they are, n = b x c: (a . c)|b|/|n|, a . n/|n|, ...
  pure subroutine slider_jets(rail, xi, strain)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi
    type(jet_t), intent(out) :: strain(2:)
    type(jet_t) :: bb, bc, normal, long
    real(wp) :: v(3, vectors)

    v = vectors_at(rail, xi)
    bb = vector_product(v, tangent, tangent)
    bc = vector_product(v, tangent, axis)
    normal = power(bb*vector_product(v, axis, axis) - bc*bc, -0.5_wp)
    long = power(bb, 0.5_wp)
    strain(2) = vector_product(v, gap, axis)*long*normal
    strain(3) = triple_product(v, gap, tangent, axis)*normal
    if (ubound(strain, 1) < 6) return
    strain(4) = argument( &
      triple_product(v, body_y, tangent, axis)*long - along_y(body_z), &
      along_y(body_y) + triple_product(v, body_z, tangent, axis)*long)
    strain(5) = vector_product(v, body_y, tangent)*power(bb, -0.5_wp)
    strain(6) = vector_product(v, body_z, tangent)*power(bb, -0.5_wp)

  contains

    !> Vector k times the section's y axis, times |b||n|.
    pure function along_y(k) result(product)
      integer, intent(in) :: k
      type(jet_t) :: product

      product = vector_product(v, k, axis)*bb - vector_product(v, k, tangent)*bc
    end function along_y

  end subroutine slider_jets

  !> Jacobian of all strains and the sum of stress times Hessian, by coordinate. Strain 1 is
  !> l0 xi and a constant.
  pure subroutine slider_derivatives(rail, xi, strain, stress, jacobian, geometric)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi
    type(jet_t), intent(in) :: strain(2:)
    real(wp), intent(in) :: stress(:)
    real(wp), intent(out) :: jacobian(:, :)  !< (strains, 20)
    real(wp), intent(out) :: geometric(rail_coordinates, rail_coordinates)
    real(wp) :: change(variables, 0:rail_coordinates), foot(0:rail_coordinates)
    real(wp) :: rate(0:rail_coordinates), total(0:rail_coordinates, 0:rail_coordinates), pull
    type(jet_t) :: potential
    integer :: i, j

    change = vector_changes(rail, xi)
    potential = vector_product(vectors_at(rail, xi), gap, tangent)
    foot = matmul(potential%gradient, change)
    foot(1:) = -foot(1:)/foot(0)
    pull = stress(1)*rail%length
    jacobian(1, :) = rail%length*foot(1:)
    do i = 2, size(stress)
      rate = matmul(strain(i)%gradient, change)
      jacobian(i, :) = rate(1:) + rate(0)*foot(1:)
      pull = pull + stress(i)*rate(0)
    end do
    pull = -pull/foot(0)
    potential%gradient = pull*potential%gradient
    potential%hessian = pull*potential%hessian
    do i = 2, size(stress)
      potential%gradient = potential%gradient + stress(i)*strain(i)%gradient
      potential%hessian = potential%hessian + stress(i)*strain(i)%hessian
    end do
    total = matmul(transpose(change), matmul(potential%hessian, change))
    call add_bends(rail, xi, reshape(potential%gradient, [3, vectors]), total)
    do j = 1, rail_coordinates
      geometric(:, j) = total(1:, j) + total(1:, 0)*foot(j) + foot(1:)*(total(0, j) &
                                                                      + total(0, 0)*foot(j))
    end do
  end subroutine slider_derivatives

  !> Derivatives of the vectors to xi (column 0) and the coordinates.
  pure function vector_changes(rail, xi) result(change)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi
    real(wp) :: change(variables, 0:rail_coordinates)
    integer :: e

    change = 0
    change(1:3, 0) = -line(rail, 1, xi)
    change(1:3, 1:) = -line_changes(rail, 0, xi)
    change(1:3, body + 1:body + 3) = identity3
    change(4:6, 0) = line(rail, 2, xi)
    change(4:6, 1:) = line_changes(rail, 1, xi)
    change(7:9, 0) = rail%y(:, 2) - rail%y(:, 1)
    do e = 1, 2
      change(7:9, ends(e) + 4:ends(e) + 6) = -merge(1 - xi, xi, e == 1)*skew(rail%y(:, e))
      change(6 + 3*e + 1:9 + 3*e, spin + 1:spin + 3) = -skew(rail%axes(:, e))
    end do
  end function vector_changes

  !> Derivatives of a derivative of r to the coordinates.
  pure function line_changes(rail, order, xi) result(change)
    type(rail_t), intent(in) :: rail
    integer, intent(in) :: order
    real(wp), intent(in) :: xi
    real(wp) :: change(3, rail_coordinates), h(4)
    integer :: e

    h = hermite(order, xi)
    change = 0
    do e = 1, 2
      associate (here => change(:, ends(e) + 1:ends(e) + 7), lever => h(2*e)*rail%length)
        here(:, 1:3) = h(2*e - 1)*identity3
        call add_skew(-lever, rail%d(:, e), here(:, 4:6))
        here(:, 7) = lever*rail%s(:, e)
      end associate
    end do
  end function line_changes

  !> Add the sum of force times the second derivatives of the vectors.
  pure subroutine add_bends(rail, xi, force, total)
    type(rail_t), intent(in) :: rail
    real(wp), intent(in) :: xi, force(3, vectors)
    real(wp), intent(inout) :: total(0:rail_coordinates, 0:rail_coordinates)
    real(wp) :: mixed(rail_coordinates), h(4), rate(4), lever(3), share
    integer :: e

    total(0, 0) = total(0, 0) + dot_product(force(:, tangent), line(rail, 3, xi)) &
                  - dot_product(force(:, gap), line(rail, 2, xi))
    mixed = matmul(force(:, tangent), line_changes(rail, 2, xi)) &
            - matmul(force(:, gap), line_changes(rail, 1, xi))
    h = hermite(0, xi)
    rate = hermite(1, xi)
    do e = 1, 2
      lever = rail%length*(rate(2*e)*force(:, tangent) - h(2*e)*force(:, gap))
      share = merge(1 - xi, xi, e == 1)
      associate (r => ends(e) + 4, alpha => ends(e) + 7)
        mixed(r:r + 2) = mixed(r:r + 2) &
                         + merge(-1, 1, e == 1)*cross(rail%y(:, e), force(:, axis))
        total(r:r + 2, r:r + 2) = total(r:r + 2, r:r + 2) + spin_hessian(rail%d(:, e), lever) &
                                  + spin_hessian(rail%y(:, e), share*force(:, axis))
        total(r:r + 2, alpha) = total(r:r + 2, alpha) + cross(rail%s(:, e), lever)
        total(alpha, r:r + 2) = total(alpha, r:r + 2) + cross(rail%s(:, e), lever)
        total(spin + 1:spin + 3, spin + 1:spin + 3) = total(spin + 1:spin + 3, spin + 1:spin + 3) &
          + spin_hessian(rail%axes(:, e), force(:, axis + e))
      end associate
    end do
    total(0, 1:) = total(0, 1:) + mixed
    total(1:, 0) = total(1:, 0) + mixed
  end subroutine add_bends

end module slider_strains
