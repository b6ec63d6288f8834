!> A line on standard error that says how far a long run is, overwritten from time to time; only
!> for who looks at a terminal.
module output_progress
  use, intrinsic :: iso_fortran_env, only: error_unit
  use kinds, only: wp, i8
  use text, only: to_text
  use output_files, only: error_is_terminal
  implicit none
  private

  public :: progress_t, seconds_since, time_line

  real(wp), parameter :: patience = 0.5_wp   !< before the first line of a run [s]
  character(len=*), parameter :: erase = achar(13)//achar(27)//"[K"

  type :: progress_t
    private
    logical :: wanted = .false.
    logical :: shown = .false.
    integer(i8) :: start = 0, shown_at = 0   !< clock
  contains
    procedure :: open => open_progress
    procedure :: due
    procedure :: show
    procedure :: hide
  end type progress_t

contains

  subroutine open_progress(self, wanted)
    class(progress_t), intent(inout) :: self
    logical, intent(in) :: wanted

    self%wanted = wanted
    if (wanted) self%wanted = error_is_terminal()
    call system_clock(self%start)
    self%shown_at = self%start
  end subroutine open_progress

  !> Whether it is time for a new line.
  logical function due(self, pause)
    class(progress_t), intent(in) :: self
    real(wp), intent(in) :: pause            !< between two lines [s]

    due = self%wanted
    if (.not. due) return
    due = seconds_since(self%shown_at) >= merge(pause, patience, self%shown_at > self%start)
  end function due

  subroutine show(self, line)
    class(progress_t), intent(inout) :: self
    character(len=*), intent(in) :: line
    integer :: status

    call system_clock(self%shown_at)
    self%shown = .true.
    write (error_unit, "(a)", advance="no", iostat=status) erase//line
    if (status == 0) flush (error_unit)
  end subroutine show

  subroutine hide(self)
    class(progress_t), intent(inout) :: self
    integer :: status

    if (.not. self%shown) return
    write (error_unit, "(a)", advance="no", iostat=status) erase
    if (status == 0) flush (error_unit)
    self%shown = .false.
  end subroutine hide

  !> Seconds of the clock.
  function seconds_since(start) result(seconds)
    integer(i8), intent(in) :: start
    real(wp) :: seconds
    integer(i8) :: now, rate

    call system_clock(now, rate)
    seconds = real(now - start, wp)/real(rate, wp)
  end function seconds_since

  !> How far a motion from one time to another is, that has recorded `steps` in `seconds`.
  pure function time_line(from, time, to, steps, seconds) result(line)
    real(wp), intent(in) :: from, time, to   !< [T]
    integer, intent(in) :: steps
    real(wp), intent(in) :: seconds          !< by the clock
    character(len=:), allocatable :: line
    real(wp) :: done

    done = min(1.0_wp, max(0.0_wp, time - from)/max(to - from, tiny(to)))
    line = "time "//to_text(time, 4)//" of "//to_text(to, 4)//", "//to_text(int(100*done))//" %"
    if (.not. seconds*done > 0) return
    line = line//", "//to_text(steps/seconds, max(3, 1 + floor(log10(steps/seconds + 1))))// &
           " steps per second, "//duration(seconds*(1 - done)/done)//" to go"
  end function time_line

  !> "40 s", "3:20 min", "2:05 h".
  pure function duration(seconds) result(phrase)
    real(wp), intent(in) :: seconds
    character(len=:), allocatable :: phrase
    integer(i8) :: whole
    character(len=2) :: rest

    whole = nint(min(seconds, 1.0e9_wp), i8)
    if (whole < 100) then
      phrase = to_text(int(whole))//" s"
    else if (whole < 6000) then
      write (rest, "(i2.2)") modulo(whole, 60_i8)
      phrase = to_text(int(whole/60))//":"//rest//" min"
    else
      write (rest, "(i2.2)") modulo(whole/60, 60_i8)
      phrase = to_text(int(whole/3600))//":"//rest//" h"
    end if
  end function duration

end module output_progress
