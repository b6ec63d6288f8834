!> A displacement of a node or marker as a function of the state, with its gradient: what a path
!> is controlled by or stopped at.
module system_measure
  use kinds, only: wp
  use model_data, only: model_t, target_t
  use nodal_state, only: state_t, coordinate_number
  use rotation, only: rotation_matrix, cross, skew, identity3
  implicit none
  private

  public :: measure_t, new_measure

  !> A component of a point R (arm + alpha warp) from a node, or a rotation or alpha of the node.
  type :: measure_t
    integer :: node(3) = 0              !< translational, rotational, warping
    integer :: component = 0            !< 1 to 7: X Y Z RX RY RZ W
    real(wp) :: arm(3) = 0.0_wp         !< initially, global axes [L]
    real(wp) :: warp(3) = 0.0_wp        !< -omega eX [L^2]
  contains
    procedure :: value => measure_value
    procedure :: gradient
  end type measure_t

contains

  !> From what the deck names.
  pure function new_measure(model, target) result(self)
    type(model_t), intent(in) :: model
    type(target_t), intent(in) :: target
    type(measure_t) :: self

    self%component = target%component
    self%node = target%node
    if (target%marker == 0) return
    associate (marker => model%marker(target%marker))
      self%node = marker%node
      if (marker%member == 0) return
      associate (m => model%member(marker%member))
        self%node = m%node(:, merge(1, 2, m%node(1, 1) == marker%node))
        self%arm = marker%offset(1)*m%triad(:, 2) + marker%offset(2)*m%triad(:, 3)
        if (marker%omega_known) self%warp = -marker%omega*m%triad(:, 1)
      end associate
    end associate
  end function new_measure

  !> The value [L], [rad] or [1/L]; one rotation alone is theta of sin(theta/2) = lambda.
  pure function measure_value(self, state) result(value)
    class(measure_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp) :: value, u(3), p(0:3)

    select case (self%component)
    case (1:3)
      u = state%displacement(:, self%node(1)) + point(self, state) - self%arm
      value = u(self%component)
    case (4:6)
      p = state%euler(:, self%node(2))
      p = sign(1.0_wp, p(0))*p
      value = 2*asin(max(-1.0_wp, min(1.0_wp, p(self%component - 3))))
    case default
      value = state%warping(self%node(3))
    end select
  end function measure_value

  !> Derivative to the seven coordinates of the node, X Y Z RX RY RZ W, and their numbers.
  pure subroutine gradient(self, state, coordinate, slope)
    class(measure_t), intent(in) :: self
    type(state_t), intent(in) :: state
    integer, intent(out) :: coordinate(7)
    real(wp), intent(out) :: slope(7)
    real(wp) :: r(3, 3), d(3, 3), w(3), p(0:3), along(3)

    coordinate = coordinate_number(self%node([1, 1, 1, 2, 2, 2, 3]), [1, 2, 3, 4, 5, 6, 7])
    slope = 0
    select case (self%component)
    case (1:3)
      along = identity3(:, self%component)
      r = rotation_matrix(state%euler(:, self%node(2)))
      w = matmul(r, self%warp)
      slope(1:3) = along
      slope(4:6) = cross(point(self, state), along)
      slope(7) = dot_product(w, along)
    case (4:6)
      p = state%euler(:, self%node(2))
      p = sign(1.0_wp, p(0))*p
      d = 0.5_wp*(p(0)*identity3 - skew(p(1:3)))
      slope(4:6) = 2*d(self%component - 3, :) &
                   /sqrt(max(1 - p(self%component - 3)**2, epsilon(1.0_wp)))
    case default
      slope(7) = 1
    end select
  end subroutine gradient

  !> The point relative to the node, now.
  pure function point(self, state)
    type(measure_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp) :: point(3), r(3, 3)

    r = rotation_matrix(state%euler(:, self%node(2)))
    point = matmul(r, self%arm + state%warping(self%node(3))*self%warp)
  end function point

end module system_measure
