!> Where a motion in time stands: all that it takes to go on from there, bit by bit.
module restart_point
  use kinds, only: wp
  use nodal_state, only: state_t
  implicit none
  private

  !> A converged instant of an analysis.
  type, public :: point_t
    integer :: analysis = 0              !< its number in the deck
    real(wp) :: start = 0.0_wp           !< when the analysis started [T]
    real(wp) :: time = 0.0_wp            !< of the instant [T]
    integer :: states = 0                !< recorded so far
    integer :: regular = 0               !< of them; one less if the last is there for the end only
    type(state_t) :: state
    real(wp), allocatable :: rest(:)     !< what the analysis alone understands
  contains
    procedure :: pack => pack_point
    procedure :: unpack => unpack_point
    procedure :: extend
  end type point_t

  integer, parameter :: layout = 2       !< raised when `pack` or what is in `rest` changes
  integer, parameter :: head = 9         !< numbers in front of the state
  integer, parameter :: per_node = 8     !< displacement, Euler parameters, warping

contains

  !> As a list of numbers, with the time at both ends: one that was written in part is told so.
  pure function pack_point(self) result(list)
    class(point_t), intent(in) :: self
    real(wp), allocatable :: list(:)

    associate (s => self%state)
      list = [self%time, real([layout, self%analysis, self%states, self%regular], wp), self%start, &
              real([size(s%warping), size(s%release), size(s%angle)], wp), s%displacement, &
              s%euler, s%warping, s%release, s%angle, self%rest, self%time]
    end associate
  end function pack_point

  !> From such a list; `analysis` is 0 if it is none, or not whole.
  subroutine unpack_point(self, list)
    class(point_t), intent(out) :: self
    real(wp), intent(in) :: list(:)
    integer :: sizes(3), at, n

    n = size(list)
    if (n < head + 1) return
    if (abs(list(1) - list(n)) > 0 .or. nint(list(2)) /= layout) return
    sizes = nint(list(7:9))
    if (any(sizes < 0) .or. n < head + 1 + per_node*sizes(1) + sum(sizes(2:3))) return
    self%time = list(1)
    self%analysis = nint(list(3))
    self%states = nint(list(4))
    self%regular = nint(list(5))
    self%start = list(6)
    at = head
    associate (s => self%state, nodes => sizes(1))
      s%displacement = reshape(list(at + 1:), [3, nodes])
      at = at + 3*nodes
      allocate (s%euler(0:3, nodes))
      s%euler(:, :) = reshape(list(at + 1:), [4, nodes])
      at = at + 4*nodes
      s%warping = list(at + 1:at + nodes)
      at = at + nodes
      s%release = list(at + 1:at + sizes(2))
      at = at + sizes(2)
      s%angle = list(at + 1:at + sizes(3))
      at = at + sizes(3)
    end associate
    self%rest = list(at + 1:n - 1)
  end subroutine unpack_point

  !> The analysis is to end at `end_time` [T]: a state recorded for an earlier end is dropped.
  pure subroutine extend(self, end_time)
    class(point_t), intent(inout) :: self
    real(wp), intent(in) :: end_time

    if (end_time > self%time) self%states = self%regular
  end subroutine extend

end module restart_point
