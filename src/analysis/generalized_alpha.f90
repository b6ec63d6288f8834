!> Generalized-alpha on Lie groups (Arnold and Bruels 2007; Bruels and Cardona 2010): the formulas
!> of one step, coordinate by coordinate.
!>
!> The step's increment of a rotation is the spatial rotation vector of R(n+1) R(n)'; angular
!> velocities are spatial too, R' = skew(w) R.
module generalized_alpha
  use kinds, only: wp
  use nodal_state, only: node_coordinates
  use rotation, only: turned, rotation_vector, skew, identity3, no_rotation
  implicit none
  private

  public :: scheme_t, new_scheme, flow_t, predict, correct, inverse_tangent

  !> Coefficients for a spectral radius at infinite frequency.
  type :: scheme_t
    real(wp) :: alpha_m = 0.0_wp, alpha_f = 0.0_wp, beta = 0.25_wp, gamma = 0.5_wp
  contains
    procedure :: velocity_share
    procedure :: acceleration_share
  end type scheme_t

  !> Rates at a time, by coordinate; `pseudo` is the scheme's own acceleration variable a.
  type :: flow_t
    real(wp), allocatable :: velocity(:), acceleration(:), pseudo(:)
  end type flow_t

contains

  !> Chung and Hulbert's choice: second order, least low-frequency damping; `radius` 0 to 1.
  pure function new_scheme(radius) result(scheme)
    real(wp), intent(in) :: radius
    type(scheme_t) :: scheme

    scheme%alpha_m = (2*radius - 1)/(radius + 1)
    scheme%alpha_f = radius/(radius + 1)
    scheme%gamma = 0.5_wp + scheme%alpha_f - scheme%alpha_m
    scheme%beta = 0.25_wp*(scheme%gamma + 0.5_wp)**2
  end function new_scheme

  !> Change of the velocity with the step's increment [1/T].
  pure real(wp) function velocity_share(self, h)
    class(scheme_t), intent(in) :: self
    real(wp), intent(in) :: h

    velocity_share = self%gamma/(self%beta*h)
  end function velocity_share

  !> Change of the acceleration with the step's increment [1/T^2].
  pure real(wp) function acceleration_share(self, h)
    class(scheme_t), intent(in) :: self
    real(wp), intent(in) :: h

    acceleration_share = (1 - self%alpha_m)/((1 - self%alpha_f)*self%beta*h**2)
  end function acceleration_share

  !> Start of a step of length h from `flow`: the acceleration is kept; rates at the end of the step
  !> and its increment.
  pure subroutine predict(scheme, h, flow, next, increment)
    type(scheme_t), intent(in) :: scheme
    real(wp), intent(in) :: h
    type(flow_t), intent(in) :: flow
    type(flow_t), intent(inout) :: next
    real(wp), intent(out) :: increment(:)

    next%acceleration = flow%acceleration
    next%pseudo = (flow%acceleration - scheme%alpha_m*flow%pseudo)/(1 - scheme%alpha_m)
    next%velocity = flow%velocity + h*((1 - scheme%gamma)*flow%pseudo + scheme%gamma*next%pseudo)
    increment = h*flow%velocity + h**2*((0.5_wp - scheme%beta)*flow%pseudo &
                                        + scheme%beta*next%pseudo)
  end subroutine predict

  !> After the coordinates moved by `change` (spins) the step's increment and the rates at its end.
  pure subroutine correct(scheme, nodes, h, change, increment, next)
    type(scheme_t), intent(in) :: scheme
    integer, intent(in) :: nodes
    real(wp), intent(in) :: h, change(:)
    real(wp), intent(inout) :: increment(:)
    type(flow_t), intent(inout) :: next
    real(wp) :: difference(size(change)), total(3), p(0:3), velocity, acceleration
    integer :: k

    difference = change
    do k = 4, node_coordinates*nodes, node_coordinates
      if (.not. any(abs(change(k:k + 2)) > 0)) cycle
      p = turned(turned(no_rotation, increment(k:k + 2)), change(k:k + 2))
      total = rotation_vector(p)
      difference(k:k + 2) = total - increment(k:k + 2)
    end do
    velocity = scheme%velocity_share(h)
    acceleration = scheme%acceleration_share(h)
    increment = increment + difference
    next%velocity = next%velocity + velocity*difference
    next%acceleration = next%acceleration + acceleration*difference
    next%pseudo = next%pseudo + difference/(scheme%beta*h**2)
  end subroutine correct

  !> From a spin at the end of the step to the change of its rotation vector theta: the inverse of
  !> I + S/2 + S^2/6 + ..., S = skew(theta), up to terms of the order of theta^4/720.
  pure function inverse_tangent(theta) result(t)
    real(wp), intent(in) :: theta(3)
    real(wp) :: t(3, 3), s(3, 3)

    s = skew(theta)
    t = identity3 - 0.5_wp*s + matmul(s, s)/12
  end function inverse_tangent

end module generalized_alpha
