!> The times that a motion reaches exactly: ends of equal steps, or of intervals of the output.
module time_grid
  use kinds, only: wp
  use model_data, only: analysis_t
  implicit none
  private

  public :: time_grid_t, new_time_grid

  !> Times closer than this part of an interval are the same.
  real(wp), parameter :: same = 1.0e-9_wp

  !> Stops 1, 2, ...; the last one is the end. They do not depend on the end unless the steps are
  !> equal and do not fit.
  type :: time_grid_t
    private
    real(wp), public :: start = 0.0_wp, end = 0.0_wp, interval = 0.0_wp   !< [T]
    integer, public :: stops = 1
    real(wp) :: origin = 0.0_wp, count = 0.0_wp, unit = 0.0_wp   !< start, interval in 1/unit
    real(wp) :: every = 0.0_wp                                   !< from one output to the next [T]
  contains
    procedure :: time
    procedure :: next
    procedure :: slack
    procedure :: is_regular
  end type time_grid_t

contains

  !> The stops of an analysis that starts at `start` [T].
  pure function new_time_grid(analysis, start) result(grid)
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: start
    type(time_grid_t) :: grid
    real(wp) :: span

    grid%start = start
    grid%end = analysis%end_time
    grid%every = analysis%every
    span = grid%end - start
    grid%interval = span
    if (analysis%every > 0) grid%interval = analysis%every
    if (analysis%time_step > 0) grid%interval = analysis%time_step
    grid%stops = max(1, ceiling(span/grid%interval - 1.0e-6_wp))
    if (analysis%time_step > 0 .and. &
        abs(grid%stops*grid%interval - span) > 1.0e-6_wp*grid%interval) then
      grid%interval = span/grid%stops
    end if
    call count_decimals(grid)
  end function new_time_grid

  !> Where start and interval are short decimal numbers the stops are too, without round-off of
  !> sums: whole multiples of a power of ten.
  pure subroutine count_decimals(grid)
    type(time_grid_t), intent(inout) :: grid
    integer :: digits
    real(wp) :: unit, origin, count

    do digits = 0, 15
      unit = 10.0_wp**digits
      origin = anint(grid%start*unit)
      count = anint(grid%interval*unit)
      if (abs(origin) + grid%stops*count > 2.0_wp**53) return
      if (abs(origin/unit - grid%start) > 0 .or. abs(count/unit - grid%interval) > 0) cycle
      grid%unit = unit
      grid%origin = origin
      grid%count = count
      return
    end do
  end subroutine count_decimals

  !> When a stop is [T].
  pure real(wp) function time(self, stop)
    class(time_grid_t), intent(in) :: self
    integer, intent(in) :: stop

    if (stop >= self%stops) then
      time = self%end
    else if (self%unit > 0) then
      time = (self%origin + stop*self%count)/self%unit
    else
      time = self%start + stop*self%interval
    end if
  end function time

  !> The first stop behind a time; more than there are: none.
  pure integer function next(self, time) result(stop)
    class(time_grid_t), intent(in) :: self
    real(wp), intent(in) :: time   !< [T]

    stop = max(1, min(self%stops, floor((time - self%start)/self%interval)))
    do while (stop <= self%stops)
      if (self%time(stop) > time + self%slack()) exit
      stop = stop + 1
    end do
  end function next

  !> Times so close are the same [T].
  pure real(wp) function slack(self)
    class(time_grid_t), intent(in) :: self

    slack = same*self%interval
  end function slack

  !> Whether the state at a stop is recorded wherever the end is: with equal steps those nearest to
  !> multiples of EVERY are.
  pure logical function is_regular(self, stop)
    class(time_grid_t), intent(in) :: self
    integer, intent(in) :: stop

    is_regular = .true.
    if (.not. self%every > 0) return
    is_regular = floor((stop + 0.5_wp)*self%interval/self%every) > &
                 floor((stop - 0.5_wp)*self%interval/self%every)
    if (self%interval < self%every .or. stop < self%stops) return
    is_regular = self%end > self%start + (stop - 1.0e-6_wp)*self%interval
  end function is_regular

end module time_grid
