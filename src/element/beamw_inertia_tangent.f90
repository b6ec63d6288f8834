!> Inertia forces of a BEAMW element with their exact derivatives (theory 7).
!>
!> Coordinates of an end as in `beamw_inertia`: r (3), spatial spin (3), alpha; those of p, then q.
module beamw_inertia_tangent
  use kinds, only: wp
  use rotation, only: cross, add_skew, add_turned, identity3
  use beamw_inertia, only: inertia_t, ends_t, ends_of
  use rotary_inertia, only: rotary_moment
  implicit none
  private

  public :: inertia_force_and_tangents, inertia_step_tangent

contains

  !> Forces M a + h(x, v) as of `inertia_force`, the mass matrix M as of `inertia_mass`, and the
  !> derivatives of the forces to velocity and place.
  !>
  !> That to the place holds velocity and acceleration as global components; a spin dphi turns an
  !> end by dR = skew(dphi) R. It is not symmetric. Where the other tangents are Hessians
  !> (theory 1), add skew(moment)/2 to the spins of each end.
  pure subroutine inertia_force_and_tangents(self, euler, warping, velocity, acceleration, force, &
                                             mass, rate, place)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2)       !< Euler parameters of p and q
    real(wp), intent(in) :: warping(2)          !< alpha of p and q [L^-1]
    real(wp), intent(in) :: velocity(7, 2)      !< rate of r, angular velocity, rate of alpha
    real(wp), intent(in) :: acceleration(7, 2)  !< their derivatives to time
    real(wp), intent(out) :: force(7, 2)
    real(wp), intent(out) :: mass(14, 14)       !< derivative to the acceleration
    real(wp), intent(out) :: rate(14, 14)       !< derivative to the velocity
    real(wp), intent(out) :: place(14, 14)      !< derivative to the place
    type(ends_t) :: ends
    real(wp) :: p(3, 4), of_velocity(3, 4, 2), of_place(3, 4, 2)
    integer :: e

    ends = ends_of(self, euler, warping)
    do e = 1, 2
      p(:, 2*e - 1) = acceleration(1:3, e)
      call accelerate(ends%d(:, e), ends%s(:, e), velocity(4:7, e), acceleration(4:7, e), &
                      p(:, 2*e), of_velocity(:, :, e), of_place(:, :, e))
    end do
    p = matmul(p, self%line)
    call spread_line(self%line, ends%slope, ends%slope, mass)
    call spread_line(self%line, ends%slope, of_velocity, rate)
    call spread_line(self%line, ends%slope, of_place, place)
    call add_translation(self%line, ends%slope, 1.0_wp, mass)
    do e = 1, 2
      force(1:3, e) = p(:, 2*e - 1)
      force(4:7, e) = matmul(p(:, 2*e), ends%slope(:, :, e))
      call turn_arms(ends%d(:, e), ends%s(:, e), p(:, 2*e), 7*e - 4, place)
      call add_section(self%warping, ends%rotary(:, :, e), velocity(:, e), acceleration(:, e), &
                       7*e - 4, force(:, e), mass, rate, place)
    end do
  end subroutine inertia_force_and_tangents

  !> Forces, and what an increment of the coordinates changes in them directly and by the velocities
  !> and accelerations that go with it: place + (share(1) rate + share(2) mass) T in the words of
  !> `inertia_force_and_tangents`, T the unit matrix but for the spins. In one pass.
  pure subroutine inertia_step_tangent(self, euler, warping, velocity, acceleration, share, turn, &
                                       force, tangent)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2), warping(2)
    real(wp), intent(in), dimension(7, 2) :: velocity, acceleration
    real(wp), intent(in) :: share(2)       !< change of velocity [T^-1] and acceleration [T^-2]
    real(wp), intent(in) :: turn(3, 3, 2)  !< T of the spins of p and q
    real(wp), intent(out) :: force(7, 2), tangent(14, 14)
    type(ends_t) :: ends
    real(wp) :: p(3, 4), change(3, 4, 2), rate(3, 4), moment(3)
    real(wp), dimension(3, 3) :: to_spin, to_place
    integer :: e, i, at

    ends = ends_of(self, euler, warping)
    do e = 1, 2
      p(:, 2*e - 1) = acceleration(1:3, e)
      call accelerate(ends%d(:, e), ends%s(:, e), velocity(4:7, e), acceleration(4:7, e), &
                      p(:, 2*e), rate, change(:, :, e))
      rate = share(1)*rate + share(2)*ends%slope(:, :, e)
      call add_product(rate(:, 1:3), turn(:, :, e), change(:, 1:3, e))
      change(:, 4, e) = change(:, 4, e) + rate(:, 4)
    end do
    p = matmul(p, self%line)
    call spread_line(self%line, ends%slope, change, tangent)
    call add_translation(self%line, ends%slope, share(2), tangent)
    do e = 1, 2
      at = 7*e - 4
      force(1:3, e) = p(:, 2*e - 1)
      force(4:7, e) = matmul(p(:, 2*e), ends%slope(:, :, e))
      call turn_arms(ends%d(:, e), ends%s(:, e), p(:, 2*e), at, tangent)
      call rotary_moment(ends%rotary(:, :, e), velocity(4:6, e), acceleration(4:6, e), moment, &
                         to_spin, to_place)
      call add_product(share(1)*to_spin + share(2)*ends%rotary(:, :, e), turn(:, :, e), to_place)
      do i = 1, 3
        tangent(at + 1:at + 3, at + i) = tangent(at + 1:at + 3, at + i) + to_place(:, i)
      end do
      tangent(at + 4, at + 4) = tangent(at + 4, at + 4) + share(2)*self%warping
      force(4:6, e) = force(4:6, e) + moment
      force(7, e) = force(7, e) + self%warping*acceleration(7, e)
    end do
  end subroutine inertia_step_tangent

  !> c + a b.
  pure subroutine add_product(a, b, c)
    real(wp), intent(in) :: a(3, 3), b(3, 3)
    real(wp), intent(inout) :: c(3, 3)
    integer :: j

    do j = 1, 3
      c(:, j) = c(:, j) + a(:, 1)*b(1, j) + a(:, 2)*b(2, j) + a(:, 3)*b(3, j)
    end do
  end subroutine add_product

  !> d'' = w' x d + w x (w x d) + alpha'' s + 2 alpha' w x s of an end, its derivatives to the
  !> velocities and to the place of spin and alpha. A turn moves d and s, and alpha moves d.
  pure subroutine accelerate(d, s, v, a, second, of_velocity, of_place)
    real(wp), intent(in) :: d(3), s(3)
    real(wp), intent(in) :: v(4), a(4)  !< w, alpha' and w', alpha''
    real(wp), intent(out) :: second(3), of_velocity(3, 4), of_place(3, 4)
    real(wp) :: of_d(3, 3), of_s(3, 3), w(3)
    integer :: j

    w = v(1:3)
    of_s = a(4)*identity3
    call add_skew(2*v(4), w, of_s)
    of_d = -dot_product(w, w)*identity3
    call add_skew(1.0_wp, a(1:3), of_d)
    of_velocity(:, 1:3) = dot_product(w, d)*identity3
    call add_skew(-2*v(4), s, of_velocity)
    do j = 1, 3
      of_d(:, j) = of_d(:, j) + w*w(j)
      of_velocity(:, j) = of_velocity(:, j) + w*d(j) - 2*d*w(j)
    end do
    of_velocity(:, 4) = 2*cross(w, s)
    of_place = 0
    call add_turned(of_d, d, of_place)
    call add_turned(of_s, s, of_place)
    of_place(:, 4) = matmul(of_d, s)
    second = matmul(of_d, d) + matmul(of_s, s)
  end subroutine accelerate

  !> What a change of d'' at the ends, by their spins and alpha, adds to the forces of the line.
  pure subroutine spread_line(line, slope, change, tangent)
    real(wp), intent(in) :: line(4, 4)
    real(wp), intent(in), dimension(3, 4, 2) :: slope, change
    real(wp), intent(out) :: tangent(14, 14)
    real(wp) :: c(3)
    integer :: i, j, k, at

    do j = 1, 2
      tangent(:, 7*j - 6:7*j - 4) = 0
      do k = 1, 4
        c = change(:, k, j)
        do i = 1, 2
          at = 7*i - 7
          tangent(at + 1:at + 3, 7*j - 4 + k) = line(2*i - 1, 2*j)*c
          tangent(at + 4, 7*j - 4 + k) = line(2*i, 2*j)*dot_product(slope(:, 1, i), c)
          tangent(at + 5, 7*j - 4 + k) = line(2*i, 2*j)*dot_product(slope(:, 2, i), c)
          tangent(at + 6, 7*j - 4 + k) = line(2*i, 2*j)*dot_product(slope(:, 3, i), c)
          tangent(at + 7, 7*j - 4 + k) = line(2*i, 2*j)*dot_product(slope(:, 4, i), c)
        end do
      end do
    end do
  end subroutine spread_line

  !> The accelerations of r: the columns of the mass matrix that `spread_line` left zero, times
  !> `share`.
  pure subroutine add_translation(line, slope, share, mass)
    real(wp), intent(in) :: line(4, 4), slope(3, 4, 2), share
    real(wp), intent(inout) :: mass(14, 14)
    integer :: i, j, k

    do j = 1, 2
      do i = 1, 2
        do k = 1, 3
          mass(7*i - 7 + k, 7*j - 7 + k) = share*line(2*i - 1, 2*j - 1)
          mass(7*i - 3:7*i, 7*j - 7 + k) = share*line(2*i, 2*j - 1)*slope(k, :, i)
        end do
      end do
    end do
  end subroutine add_translation

  !> The arms d and s of the force p turn: derivatives of d x p and s.p to spin and alpha.
  pure subroutine turn_arms(d, s, p, at, place)
    real(wp), intent(in) :: d(3), s(3), p(3)
    integer, intent(in) :: at  !< what comes before the spins of the end
    real(wp), intent(inout) :: place(14, 14)
    real(wp) :: arm(3)
    integer :: j

    arm = cross(s, p)
    do j = 1, 3
      place(at + 1:at + 3, at + j) = place(at + 1:at + 3, at + j) + d*p(j)
      place(at + j, at + j) = place(at + j, at + j) - dot_product(d, p)
      place(at + j, at + 4) = place(at + j, at + 4) + arm(j)
      place(at + 4, at + j) = place(at + 4, at + j) + arm(j)
    end do
  end subroutine turn_arms

  !> The section of an end: rotary inertia, and that of warping.
  pure subroutine add_section(warping, tensor, v, a, at, force, mass, rate, place)
    real(wp), intent(in) :: warping, tensor(3, 3), v(7), a(7)
    integer, intent(in) :: at  !< what comes before the spins of the end
    real(wp), intent(inout) :: force(7)
    real(wp), intent(inout), dimension(14, 14) :: mass, rate, place
    real(wp) :: moment(3)
    real(wp), dimension(3, 3) :: to_spin, to_place
    integer :: j

    call rotary_moment(tensor, v(4:6), a(4:6), moment, to_spin, to_place)
    force(4:6) = force(4:6) + moment
    force(7) = force(7) + warping*a(7)
    do j = 1, 3
      mass(at + 1:at + 3, at + j) = mass(at + 1:at + 3, at + j) + tensor(:, j)
      rate(at + 1:at + 3, at + j) = rate(at + 1:at + 3, at + j) + to_spin(:, j)
      place(at + 1:at + 3, at + j) = place(at + 1:at + 3, at + j) + to_place(:, j)
    end do
    mass(at + 4, at + 4) = mass(at + 4, at + 4) + warping
  end subroutine add_section

end module beamw_inertia_tangent
