!> Inertia of a BEAMW element: mass matrix, inertia forces, kinetic energy, weight (theory 6, 7).
!>
!> The mass of the centroid line, r = H1 r^p + H2 l0 d^p + H3 r^q + H4 l0 d^q with cubic Hermite
!> functions H and its slope d = R(eX + alpha s), s = zs eY - ys eZ, or half of it at each end;
!> the rotary inertia of the sections, and that of warping, always half at each end.
!> Coordinates of an end: r (3), spatial spin (3), alpha; velocities and accelerations likewise,
!> (7, 2) or (14) for p and q.
module beamw_inertia
  use kinds, only: wp
  use rotation, only: rotated, cross, add_skew, identity3
  implicit none
  private

  public :: inertia_t, new_inertia, inertia_mass, inertia_force, kinetic_energy, weight_force
  public :: ends_t, ends_of

  !> What depends on the element alone.
  type :: inertia_t
    real(wp) :: triad(3, 3) = 0.0_wp    !< columns eX eY eZ, initially
    real(wp) :: line(4, 4) = 0.0_wp     !< for r^p, d^p, r^q, d^q [M, M L, M L^2]
    real(wp) :: section(3, 3) = 0.0_wp  !< rotary inertia of an end in section axes [M L^2]
    real(wp) :: warping = 0.0_wp        !< of an end [M L^4]
    real(wp) :: s(3) = 0.0_wp           !< in section axes [L]
  end type inertia_t

  !> The ends in a configuration.
  type :: ends_t
    real(wp) :: d(3, 2)           !< slopes of the centroid line
    real(wp) :: s(3, 2)           !< their derivative to alpha, R s [L]
    real(wp) :: slope(3, 4, 2)    !< their derivative to spin and alpha
    real(wp) :: rotary(3, 3, 2)   !< rotary inertia in global axes [M L^2]
  end type ends_t

  !> 420 times the integrals of Hi Hj.
  real(wp), parameter :: hermite(4, 4) = &
    reshape([156, 22, 54, -13, 22, 4, 13, -3, 54, 13, 156, -22, -13, -3, -22, 4]*1.0_wp, [4, 4])
  real(wp), parameter :: halves(4, 4) = &
    reshape([1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0]*0.5_wp, [4, 4])

contains

  !> Inertia of an element from that per length: rho A [M L^-1], rho Ip, Iy, Iz, Iyz [M L] and
  !> rho Iw [M L^3], the order of EM, with Iyz the integral of y z.
  pure function new_inertia(density, length, triad, shear_centre, consistent, rotary) result(self)
    real(wp), intent(in) :: density(6)
    real(wp), intent(in) :: length           !< l0 [L]
    real(wp), intent(in) :: triad(3, 3)      !< columns eX eY eZ, initially
    real(wp), intent(in) :: shear_centre(2)  !< ys, zs of the stiffness [L]
    logical, intent(in) :: consistent        !< MASS CONSISTENT, not LUMPED
    logical, intent(in) :: rotary            !< ROTARY ON
    type(inertia_t) :: self
    real(wp) :: scale(4), half
    integer :: j

    half = 0.5_wp*length
    scale = [1.0_wp, length, 1.0_wp, length]
    self%triad = triad
    self%s = [0.0_wp, shear_centre(2), -shear_centre(1)]
    self%line = halves
    if (consistent) self%line = hermite/420
    do j = 1, 4
      self%line(:, j) = density(1)*length*scale(j)*scale*self%line(:, j)
    end do
    self%section = 0
    self%section(1, 1) = half*density(2)
    if (rotary) then
      self%section(2, 2:3) = half*[density(3), -density(5)]
      self%section(3, 2:3) = half*[-density(5), density(4)]
    end if
    self%warping = half*density(6)
  end function new_inertia

  !> Slopes and rotary inertias of the ends.
  pure function ends_of(self, euler, warping) result(ends)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2), warping(2)
    type(ends_t) :: ends
    real(wp) :: axes(3, 3), turned(3, 3)
    integer :: e, j

    do e = 1, 2
      axes = rotated(euler(:, e), self%triad)
      ends%s(:, e) = matmul(axes, self%s)
      ends%d(:, e) = axes(:, 1) + warping(e)*ends%s(:, e)
      ends%slope(:, 1:3, e) = 0
      call add_skew(-1.0_wp, ends%d(:, e), ends%slope(:, 1:3, e))
      ends%slope(:, 4, e) = ends%s(:, e)
      do j = 1, 3
        turned(:, j) = axes(:, 1)*self%section(1, j) + axes(:, 2)*self%section(2, j) &
                       + axes(:, 3)*self%section(3, j)
      end do
      do j = 1, 3
        ends%rotary(:, j, e) = turned(:, 1)*axes(j, 1) + turned(:, 2)*axes(j, 2) &
                               + turned(:, 3)*axes(j, 3)
      end do
    end do
  end function ends_of

  !> Mass matrix, symmetric positive semidefinite.
  pure subroutine inertia_mass(self, euler, warping, mass)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2)  !< Euler parameters of p and q
    real(wp), intent(in) :: warping(2)     !< alpha of p and q [L^-1]
    real(wp), intent(out) :: mass(14, 14)
    type(ends_t) :: ends
    real(wp) :: block(7, 7)
    integer :: i, j

    ends = ends_of(self, euler, warping)
    do j = 1, 2
      do i = 1, 2
        associate (m => self%line(2*i - 1:2*i, 2*j - 1:2*j), &
                   si => ends%slope(:, :, i), sj => ends%slope(:, :, j))
          block(1:3, 1:3) = m(1, 1)*identity3
          block(1:3, 4:7) = m(1, 2)*sj
          block(4:7, 1:3) = m(2, 1)*transpose(si)
          block(4:7, 4:7) = m(2, 2)*matmul(transpose(si), sj)
        end associate
        if (i == j) then
          block(4:6, 4:6) = block(4:6, 4:6) + ends%rotary(:, :, i)
          block(7, 7) = block(7, 7) + self%warping
        end if
        mass(7*i - 6:7*i, 7*j - 6:7*j) = block
      end do
    end do
  end subroutine inertia_mass

  !> Inertia forces M a + h(x, v), exact: f.v is the rate of the kinetic energy.
  pure subroutine inertia_force(self, euler, warping, velocity, acceleration, force)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2), warping(2)
    real(wp), intent(in) :: velocity(7, 2)      !< rate of r, angular velocity, rate of alpha
    real(wp), intent(in) :: acceleration(7, 2)  !< their derivatives to time
    real(wp), intent(out) :: force(7, 2)
    type(ends_t) :: ends
    real(wp) :: w(3), p(3, 4)
    integer :: e

    ends = ends_of(self, euler, warping)
    p = line_rates(ends, acceleration)
    do e = 1, 2
      w = velocity(4:6, e)
      p(:, 2*e) = p(:, 2*e) + cross(w, cross(w, ends%d(:, e)) + 2*velocity(7, e)*ends%s(:, e))
    end do
    p = matmul(p, self%line)
    do e = 1, 2
      w = velocity(4:6, e)
      force(1:3, e) = p(:, 2*e - 1)
      force(4:7, e) = matmul(p(:, 2*e), ends%slope(:, :, e))
      force(4:6, e) = force(4:6, e) + matmul(ends%rotary(:, :, e), acceleration(4:6, e)) &
                      + cross(w, matmul(ends%rotary(:, :, e), w))
      force(7, e) = force(7, e) + self%warping*acceleration(7, e)
    end do
  end subroutine inertia_force

  !> Rates of r^p, d^p, r^q, d^q, as columns.
  pure function line_rates(ends, velocity) result(rate)
    type(ends_t), intent(in) :: ends
    real(wp), intent(in) :: velocity(7, 2)
    real(wp) :: rate(3, 4)
    integer :: e

    do e = 1, 2
      rate(:, 2*e - 1) = velocity(1:3, e)
      rate(:, 2*e) = matmul(ends%slope(:, :, e), velocity(4:7, e))
    end do
  end function line_rates

  !> Kinetic energy [F L].
  pure function kinetic_energy(self, euler, warping, velocity) result(energy)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2), warping(2), velocity(7, 2)
    real(wp) :: energy
    type(ends_t) :: ends
    real(wp) :: rate(3, 4)
    integer :: e

    ends = ends_of(self, euler, warping)
    rate = line_rates(ends, velocity)
    energy = 0.5_wp*sum(rate*matmul(rate, self%line))
    do e = 1, 2
      associate (w => velocity(4:6, e))
        energy = energy + 0.5_wp*dot_product(w, matmul(ends%rotary(:, :, e), w)) &
                 + 0.5_wp*self%warping*velocity(7, e)**2
      end associate
    end do
  end function kinetic_energy

  !> Weight in a uniform field, and what the tangent stiffness gains by it: the Hessian of its
  !> potential, which couples the spin and alpha of each end (theory 1, 6).
  pure subroutine weight_force(self, euler, warping, field, force, tangent)
    type(inertia_t), intent(in) :: self
    real(wp), intent(in) :: euler(0:3, 2), warping(2)
    real(wp), intent(in) :: field(3)              !< acceleration [L T^-2]
    real(wp), intent(out) :: force(7, 2)
    real(wp), intent(out) :: tangent(4, 4, 2)     !< spin and alpha of p, of q
    type(ends_t) :: ends
    real(wp) :: weight(3, 4)
    integer :: e, i

    ends = ends_of(self, euler, warping)
    tangent = 0
    do i = 1, 4
      weight(:, i) = (self%line(1, i) + self%line(3, i))*field
    end do
    do e = 1, 2
      force(1:3, e) = weight(:, 2*e - 1)
      force(4:7, e) = matmul(weight(:, 2*e), ends%slope(:, :, e))
      associate (d => ends%d(:, e), w => weight(:, 2*e))
        do i = 1, 3
          tangent(1:3, i, e) = dot_product(d, w)*identity3(:, i) - 0.5_wp*(d*w(i) + w*d(i))
        end do
        tangent(1:3, 4, e) = -cross(ends%s(:, e), w)
        tangent(4, 1:3, e) = tangent(1:3, 4, e)
      end associate
    end do
  end subroutine weight_force

end module beamw_inertia
