!> Generalized-alpha on Lie groups (Arnold and Bruels 2007; Bruels and Cardona 2010): the formulas
!> of one step, coordinate by coordinate.
!>
!> The step's increment of a rotation is the spatial rotation vector of R(n+1) R(n)'; angular
!> velocities are spatial too, R' = skew(w) R.
!>
!> The scheme's own acceleration and, of constraints held by places alone, the velocity across them
!> are not those of the motion but differ by O(h) and O(h^2); whoever starts it has to know
!> (Arnold, Bruels, Cardona 2015), or the multipliers are of first order.
module generalized_alpha
  use kinds, only: wp
  use nodal_state, only: node_coordinates
  use rotation, only: turned, rotation_vector, skew, identity3, no_rotation
  implicit none
  private

  public :: scheme_t, new_scheme, flow_t, predict, correct, inverse_tangent

  !> Lengths of steps that differ less, relatively, are the same.
  real(wp), parameter :: same_step = 1.0e-9_wp

  !> Coefficients for a spectral radius at infinite frequency.
  type :: scheme_t
    real(wp) :: alpha_m = 0.0_wp, alpha_f = 0.0_wp, beta = 0.25_wp, gamma = 0.5_wp
  contains
    procedure :: velocity_share
    procedure :: acceleration_share
    procedure :: lead
    procedure :: place_error
  end type scheme_t

  !> Rates at a time, by coordinate; `pseudo` is the scheme's own acceleration variable a, which
  !> for steps of length `step` stands for the acceleration at another time, `lead` of them later.
  type :: flow_t
    real(wp), allocatable :: velocity(:), acceleration(:), pseudo(:)
    real(wp) :: step = 0.0_wp          !< of the last step [T]; 0: there was none
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

  !> How far the scheme's own acceleration is ahead, in steps: a(n) = v'(t + lead h) + O(h^2).
  pure real(wp) function lead(self)
    class(scheme_t), intent(in) :: self

    lead = self%alpha_m - self%alpha_f
  end function lead

  !> A step misses the place by this times h^3 v'' (and, of rotations, h^3/12 w' x w).
  pure real(wp) function place_error(self)
    class(scheme_t), intent(in) :: self

    place_error = 1.0_wp/6 - 0.5_wp*self%lead() - self%beta
  end function place_error

  !> Start of a step of length h from `flow`: the acceleration is kept; rates at the end of the step
  !> and its increment.
  pure subroutine predict(scheme, h, flow, next, increment)
    type(scheme_t), intent(in) :: scheme
    real(wp), intent(in) :: h
    type(flow_t), intent(in) :: flow
    type(flow_t), intent(inout) :: next
    real(wp), intent(out) :: increment(:)

    real(wp) :: pseudo(size(increment))

    pseudo = flow%pseudo
    if (flow%step > 0 .and. abs(h - flow%step) > same_step*h) then
      pseudo = flow%acceleration + h/flow%step*(flow%pseudo - flow%acceleration)
    end if
    next%acceleration = flow%acceleration
    next%pseudo = (flow%acceleration - scheme%alpha_m*pseudo)/(1 - scheme%alpha_m)
    next%velocity = flow%velocity + h*((1 - scheme%gamma)*pseudo + scheme%gamma*next%pseudo)
    next%step = h
    increment = h*flow%velocity + h**2*((0.5_wp - scheme%beta)*pseudo &
                                        + scheme%beta*next%pseudo)
  end subroutine predict

  !> After the coordinates moved by `change` (spins) the step's increment and the rates at its end,
  !> which know nothing of the part `aside` of the increment (rotation vectors).
  pure subroutine correct(scheme, nodes, h, change, aside, increment, next)
    type(scheme_t), intent(in) :: scheme
    integer, intent(in) :: nodes
    real(wp), intent(in) :: h, change(:), aside(:)
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
    difference = difference - aside
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
