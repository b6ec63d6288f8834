!> Strains of a beam between two nodes, with exact first and second derivatives (theory 1, 2, 5).
!>
!> The eleven coordinates here are the chord l (3), the spins of p and q (3 + 3) and the warping
!> coordinates of p and q; the chord stands for r^q - r^p.
module beam_strains
  use kinds, only: wp
  use rotation, only: cross, outer, skew, identity3
  use beam_angles, only: angle_ratio
  implicit none
  private

  public :: kinematics_t, beam_kinematics, beam_curvature, mid_twist_derivatives

  integer, parameter, public :: reduced = 11  !< number of coordinates

  !> Strains and what their derivatives are made of.
  type :: kinematics_t
    real(wp) :: strain(8)             !< e of the nodes [L], see `beamw_constants`
    real(wp) :: gradient(reduced, 8)  !< column i: derivative of strain i
    logical :: valid                  !< rotations small enough for the angles
    logical :: angles
    real(wp) :: length, unstrained    !< of the chord now and initially [L]
    real(wp) :: n(3)                  !< its direction
    real(wp) :: triad(3, 3, 2)        !< axes of the sections at p and q
    real(wp) :: c(3, 2)               !< n . axes
    real(wp) :: dn(3, 3, 2), dr(3, 3, 2)  !< derivative of c to the chord and to the spin
    real(wp) :: f(0:2, 2)             !< angle over sine and its derivatives at p and q
    real(wp) :: sine, cosine          !< of the twist, not normalised: a and b
    real(wp) :: da(3), db(3)          !< their derivative to the spin of p; that of q is opposite
    real(wp) :: raw(8)                !< strains before the mid-twist frame
    real(wp) :: draw(9, 6)            !< column i: derivative of raw strain i to chord and spins
    real(wp) :: half_cosine, half_sine  !< of half the twist
  end type kinematics_t

  !> In the mid-twist frame raw strain i mixes with its partner, with a sign (theory 5 b).
  integer, parameter :: partner(3:6) = [5, 6, 3, 4]
  real(wp), parameter :: mix(3:6) = [1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp]

  !> Raw bending strains are sign * l0 * (n . axis) at end p (3, 5) or q (4, 6), (7c).
  integer, parameter :: bending_end(3:6) = [1, 2, 1, 2], bending_axis(3:6) = [3, 3, 2, 2]
  real(wp), parameter :: bending_sign(3:6) = [-1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp]

contains

  !> Strains and gradients. With `angles` they are finite angles in the mid-twist frame, else (7).
  pure subroutine beam_kinematics(chord, triad, warping, release, length, angles, k)
    real(wp), intent(in) :: chord(3)        !< r^q - r^p [L]
    real(wp), intent(in) :: triad(3, 3, 2)  !< eX eY eZ of p and of q
    real(wp), intent(in) :: warping(2)      !< alpha of p and q [1/L]
    real(wp), intent(in) :: release(8)      !< parts of the strains that are released [L]
    real(wp), intent(in) :: length          !< l0 [L]
    logical, intent(in) :: angles
    type(kinematics_t), intent(out) :: k
    integer :: i

    k%angles = angles
    k%unstrained = length
    k%triad = triad
    k%length = sqrt(dot_product(chord, chord))
    k%n = chord/k%length
    do i = 1, 2
      call chord_in_section(k, i)
    end do
    call twist(k)
    k%valid = .not. angles .or. (k%c(1, 1) > 0 .and. k%c(1, 2) > 0 .and. k%cosine > 0)
    if (.not. k%valid) return
    call raw_strains(k, warping)
    k%raw = k%raw - release
    call to_mid_twist(k)
  end subroutine beam_kinematics

  !> Components of the chord's direction in a section's axes and their derivatives.
  pure subroutine chord_in_section(k, i)
    type(kinematics_t), intent(inout) :: k
    integer, intent(in) :: i  !< end
    integer :: j

    do j = 1, 3
      k%c(j, i) = dot_product(k%n, k%triad(:, j, i))
      k%dn(:, j, i) = (k%triad(:, j, i) - k%c(j, i)*k%n)/k%length
      k%dr(:, j, i) = cross(k%triad(:, j, i), k%n)
    end do
  end subroutine chord_in_section

  !> Sine and cosine of the relative twist: a = (Zp.Yq - Yp.Zq)/2, b = (Yp.Yq + Zp.Zq)/2.
  pure subroutine twist(k)
    type(kinematics_t), intent(inout) :: k

    associate (yp => k%triad(:, 2, 1), zp => k%triad(:, 3, 1), &
               yq => k%triad(:, 2, 2), zq => k%triad(:, 3, 2))
      k%sine = 0.5_wp*(dot_product(zp, yq) - dot_product(yp, zq))
      k%cosine = 0.5_wp*(dot_product(yp, yq) + dot_product(zp, zq))
      k%da = 0.5_wp*(cross(zp, yq) - cross(yp, zq))
      k%db = 0.5_wp*(cross(yp, yq) + cross(zp, zq))
    end associate
  end subroutine twist

  !> The strains (7), or the angles of theory 5 a, and their gradients.
  pure subroutine raw_strains(k, warping)
    type(kinematics_t), intent(inout) :: k
    real(wp), intent(in) :: warping(2)
    real(wp) :: l0, r2
    integer :: i, e, j

    l0 = k%unstrained
    k%draw = 0
    k%raw(1) = k%length - l0
    k%draw(1:3, 1) = k%n
    if (k%angles) then
      r2 = k%sine**2 + k%cosine**2
      k%raw(2) = l0*atan2(k%sine, k%cosine)
      k%draw(4:6, 2) = l0*(k%cosine*k%da - k%sine*k%db)/r2
      do e = 1, 2
        call angle_ratio(k%c(1, e), k%f(0, e), k%f(1, e), k%f(2, e))
      end do
    else
      k%raw(2) = l0*k%sine
      k%draw(4:6, 2) = l0*k%da
      k%f(0, :) = 1
      k%f(1:2, :) = 0
    end if
    k%draw(7:9, 2) = -k%draw(4:6, 2)
    do i = 3, 6
      e = bending_end(i)
      j = bending_axis(i)
      k%raw(i) = bending_sign(i)*l0*k%f(0, e)*k%c(j, e)
      k%draw(1:3, i) = bending_sign(i)*l0* &
                       (k%f(0, e)*k%dn(:, j, e) + k%f(1, e)*k%c(j, e)*k%dn(:, 1, e))
      k%draw(1 + 3*e:3 + 3*e, i) = bending_sign(i)*l0* &
                                   (k%f(0, e)*k%dr(:, j, e) + k%f(1, e)*k%c(j, e)*k%dr(:, 1, e))
    end do
    k%raw(7:8) = l0**2*warping
  end subroutine raw_strains

  !> Bending strains in the mid-twist frame (theory 5 b); the others stay.
  pure subroutine to_mid_twist(k)
    type(kinematics_t), intent(inout) :: k
    real(wp) :: half, turn
    integer :: i, j

    half = 0.5_wp/k%unstrained
    k%strain = k%raw
    k%gradient = 0
    k%gradient(10, 7) = k%unstrained**2
    k%gradient(11, 8) = k%unstrained**2
    k%gradient(1:9, 1:6) = k%draw
    k%half_cosine = 1
    k%half_sine = 0
    if (.not. k%angles) return
    k%half_cosine = cos(half*k%raw(2))
    k%half_sine = sin(half*k%raw(2))
    do i = 3, 6
      j = partner(i)
      k%strain(i) = k%half_cosine*k%raw(i) + mix(i)*k%half_sine*k%raw(j)
      turn = half*(mix(i)*k%half_cosine*k%raw(j) - k%half_sine*k%raw(i))
      k%gradient(1:9, i) = k%half_cosine*k%draw(:, i) + mix(i)*k%half_sine*k%draw(:, j) &
                           + turn*k%draw(:, 2)
    end do
  end subroutine to_mid_twist

  !> Sum of weight(i) times the Hessian of strain i, for the chord and the spins (the warping
  !> coordinates enter linearly).
  pure subroutine beam_curvature(k, weight, h)
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: weight(8)
    real(wp), intent(out) :: h(9, 9)
    real(wp) :: t(6)

    h = 0
    t = weight(1:6)
    if (k%angles) call mid_twist_curvature(k, weight, t, h)
    call twist_curvature(k, t(2), h)
    call bending_curvature(k, t, h)
  end subroutine beam_curvature

  !> Second derivatives of the mid-twist frame; `t`: the weights on the raw strains.
  pure subroutine mid_twist_curvature(k, weight, t, h)
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: weight(8)
    real(wp), intent(inout) :: t(6), h(9, 9)
    real(wp) :: half, with_twist(9), square
    integer :: i, j

    half = 0.5_wp/k%unstrained
    with_twist = 0
    square = 0
    t(3:6) = 0
    do i = 3, 6
      j = partner(i)
      t(2) = t(2) + weight(i)*half*(mix(i)*k%half_cosine*k%raw(j) - k%half_sine*k%raw(i))
      t(i) = t(i) + weight(i)*k%half_cosine
      t(j) = t(j) + weight(i)*mix(i)*k%half_sine
      square = square - weight(i)*half**2*k%strain(i)
      with_twist = with_twist + weight(i)*half*(mix(i)*k%half_cosine*k%draw(:, j) &
                                                - k%half_sine*k%draw(:, i))
    end do
    with_twist = with_twist + 0.5_wp*square*k%draw(:, 2)
    call add_symmetric(h, k%draw(:, 2), with_twist)
  end subroutine mid_twist_curvature

  !> Derivatives of the strains to the raw strains, and the weighted sum of the second ones:
  !> what a released part of a raw strain needs.
  pure subroutine mid_twist_derivatives(k, weight, first, second)
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: weight(8)
    real(wp), intent(out) :: first(8, 8)   !< first(i, j): strain i to raw strain j
    real(wp), intent(out) :: second(8, 8)
    real(wp) :: half
    integer :: i, j

    first = 0
    second = 0
    do i = 1, 8
      first(i, i) = 1
    end do
    if (.not. k%angles) return
    half = 0.5_wp/k%unstrained
    do i = 3, 6
      j = partner(i)
      first(i, i) = k%half_cosine
      first(i, j) = mix(i)*k%half_sine
      first(i, 2) = half*(mix(i)*k%half_cosine*k%raw(j) - k%half_sine*k%raw(i))
      second(2, 2) = second(2, 2) - weight(i)*half**2*k%strain(i)
      second(2, i) = second(2, i) - weight(i)*half*k%half_sine
      second(2, j) = second(2, j) + weight(i)*mix(i)*half*k%half_cosine
    end do
    second(3:6, 2) = second(2, 3:6)
  end subroutine mid_twist_derivatives

  !> Second derivatives of the raw twist.
  pure subroutine twist_curvature(k, t, h)
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: t
    real(wp), intent(inout) :: h(9, 9)
    real(wp) :: m(3, 3), w(2), r2, g(3), s(3, 3), trace, l0
    integer :: i

    l0 = k%unstrained
    w = [t*l0, 0.0_wp]
    s = 0
    if (k%angles) then
      r2 = k%sine**2 + k%cosine**2
      w = t*l0/r2*[k%cosine, -k%sine]
      g = (k%sine**2 - k%cosine**2)*k%db - k%sine*k%cosine*k%da
      s = t*l0/r2**2*(outer(k%da, g) + outer(g, k%da) + 2*k%sine*k%cosine*outer(k%db, k%db))
    end if
    associate (p => k%triad(:, :, 1), q => k%triad(:, :, 2))
      m = 0.5_wp*(w(1)*(outer(p(:, 3), q(:, 2)) - outer(p(:, 2), q(:, 3))) &
                  + w(2)*(outer(p(:, 2), q(:, 2)) + outer(p(:, 3), q(:, 3))))
    end associate
    trace = m(1, 1) + m(2, 2) + m(3, 3)
    do i = 1, 3
      h(3 + i, 4:6) = h(3 + i, 4:6) + s(i, :) + 0.5_wp*(m(i, :) + m(:, i))
      h(6 + i, 7:9) = h(6 + i, 7:9) + s(i, :) + 0.5_wp*(m(i, :) + m(:, i))
      h(3 + i, 7:9) = h(3 + i, 7:9) - s(i, :) - m(:, i)
      h(6 + i, 4:6) = h(6 + i, 4:6) - s(i, :) - m(i, :)
      h(3 + i, 3 + i) = h(3 + i, 3 + i) - trace
      h(6 + i, 6 + i) = h(6 + i, 6 + i) - trace
      h(3 + i, 6 + i) = h(3 + i, 6 + i) + trace
      h(6 + i, 3 + i) = h(6 + i, 3 + i) + trace
    end do
  end subroutine twist_curvature

  !> Second derivatives of elongation and raw bending strains.
  pure subroutine bending_curvature(k, t, h)
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: t(6)
    real(wp), intent(inout) :: h(9, 9)
    real(wp) :: w(3, 2), total(3), across(3), x(6), y(6), m(3, 3), along, slope(2)
    integer :: e, i, j, r

    w = 0
    do i = 3, 6
      e = bending_end(i)
      j = bending_axis(i)
      w(j, e) = k%f(0, e)*bending_sign(i)*k%unstrained*t(i)
    end do
    total = 0
    do e = 1, 2
      r = 3*e
      slope = w(2:3, e)/k%f(0, e)
      w(1, e) = k%f(1, e)*dot_product(slope, k%c(2:3, e))
      if (k%angles) then
        x = [k%dn(:, 1, e), k%dr(:, 1, e)]
        y = 0.5_wp*k%f(2, e)*dot_product(slope, k%c(2:3, e))*x + k%f(1, e)* &
            (slope(1)*[k%dn(:, 2, e), k%dr(:, 2, e)] + slope(2)*[k%dn(:, 3, e), k%dr(:, 3, e)])
        call add_end(h, r, x, y)
      end if
      across = matmul(k%triad(:, :, e), w(:, e))
      total = total + across
      m = 0.5_wp*(outer(k%n, across) + outer(across, k%n)) - dot_product(k%n, across)*identity3
      h(r + 1:r + 3, r + 1:r + 3) = h(r + 1:r + 3, r + 1:r + 3) + m
      m = -matmul(identity3 - outer(k%n, k%n), skew(across))/k%length
      h(1:3, r + 1:r + 3) = h(1:3, r + 1:r + 3) + m
      h(r + 1:r + 3, 1:3) = h(r + 1:r + 3, 1:3) + transpose(m)
    end do
    along = dot_product(total, k%n)
    across = (total - along*k%n)/k%length**2
    h(1:3, 1:3) = h(1:3, 1:3) - outer(across, k%n) - outer(k%n, across) &
                  + (t(1)/k%length - along/k%length**2)*(identity3 - outer(k%n, k%n))
  end subroutine bending_curvature

  !> Add x y' + y x' for vectors of the chord (1:3) and the spin in rows r + 1 to r + 3 (4:6).
  pure subroutine add_end(h, r, x, y)
    real(wp), intent(inout) :: h(9, 9)
    integer, intent(in) :: r
    real(wp), intent(in) :: x(6), y(6)
    integer :: i, j, row(6)

    row = [1, 2, 3, r + 1, r + 2, r + 3]
    do j = 1, 6
      do i = 1, 6
        h(row(i), row(j)) = h(row(i), row(j)) + x(i)*y(j) + y(i)*x(j)
      end do
    end do
  end subroutine add_end

  !> h + x y' + y x'.
  pure subroutine add_symmetric(h, x, y)
    real(wp), intent(inout) :: h(9, 9)
    real(wp), intent(in) :: x(9), y(9)
    integer :: j

    do j = 1, 9
      h(:, j) = h(:, j) + x*y(j) + y*x(j)
    end do
  end subroutine add_symmetric

end module beam_strains
