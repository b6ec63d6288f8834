!> Interruptions by the user without handlers: the signals are held back and asked for.
!>
!> Numbers are those of Linux and macOS; a signal that was ignored at the start stays so.
module output_signals
  use, intrinsic :: iso_c_binding, only: c_int, c_char, c_intptr_t
  implicit none
  private

  public :: signal_watch_t

  integer(c_int), parameter :: hangup = 1, interrupt = 2, broken_pipe = 13, terminate = 15, &
                               file_too_large = 25
  integer(c_int), parameter :: stop_signals(3) = [hangup, interrupt, terminate]

  !> A sigset_t of C: at least as large, contents unknown.
  type, bind(c) :: signal_set_t
    character(kind=c_char) :: bytes(128)
  end type signal_set_t

  type :: signal_watch_t
    private
    logical :: watched(size(stop_signals)) = .false.
  contains
    procedure :: start
    procedure :: raised
  end type signal_watch_t

  interface
    integer(c_int) function c_sigemptyset(set) bind(c, name="sigemptyset")
      import :: c_int, signal_set_t
      implicit none
      type(signal_set_t), intent(out) :: set
    end function c_sigemptyset

    integer(c_int) function c_sigaddset(set, signal) bind(c, name="sigaddset")
      import :: c_int, signal_set_t
      implicit none
      type(signal_set_t), intent(inout) :: set
      integer(c_int), value :: signal
    end function c_sigaddset

    integer(c_int) function c_sigismember(set, signal) bind(c, name="sigismember")
      import :: c_int, signal_set_t
      implicit none
      type(signal_set_t), intent(in) :: set
      integer(c_int), value :: signal
    end function c_sigismember

    integer(c_int) function c_sigprocmask(how, set, old) bind(c, name="sigprocmask")
      import :: c_int, signal_set_t
      implicit none
      integer(c_int), value :: how
      type(signal_set_t), intent(in) :: set
      type(signal_set_t), intent(out) :: old
    end function c_sigprocmask

    integer(c_int) function c_sigpending(set) bind(c, name="sigpending")
      import :: c_int, signal_set_t
      implicit none
      type(signal_set_t), intent(out) :: set
    end function c_sigpending

    !> The handlers are pointers: 0 the default, 1 to ignore.
    integer(c_intptr_t) function c_signal(signal, handler) bind(c, name="signal")
      import :: c_int, c_intptr_t
      implicit none
      integer(c_int), value :: signal
      integer(c_intptr_t), value :: handler
    end function c_signal
  end interface

contains

  !> Hold back what would end the program at once: interruptions, closed pipes, full quotas (the
  !> latter two then come back as failures to write).
  subroutine start(self)
    class(signal_watch_t), intent(inout) :: self
    type(signal_set_t) :: set, old
    integer :: i
    integer(c_int) :: status

    status = c_sigemptyset(set)
    status = c_sigaddset(set, broken_pipe)
    status = c_sigaddset(set, file_too_large)
    do i = 1, size(stop_signals)
      self%watched(i) = .not. is_ignored(stop_signals(i))
      if (self%watched(i)) status = c_sigaddset(set, stop_signals(i))
    end do
    status = c_sigprocmask(0_c_int, set, old)                    ! SIG_BLOCK of Linux
    if (status /= 0) status = c_sigprocmask(1_c_int, set, old)   ! SIG_BLOCK of macOS
  end subroutine start

  !> Whether the program was started with a signal ignored, as in the background of a script.
  logical function is_ignored(signal)
    integer(c_int), intent(in) :: signal
    integer(c_intptr_t) :: old

    old = c_signal(signal, 0_c_intptr_t)
    is_ignored = old == 1
    if (is_ignored) old = c_signal(signal, 1_c_intptr_t)
  end function is_ignored

  !> Whether one of the signals that end a run has come.
  logical function raised(self)
    class(signal_watch_t), intent(in) :: self
    type(signal_set_t) :: set
    integer :: i

    raised = .false.
    if (.not. any(self%watched)) return
    if (c_sigpending(set) /= 0) return
    do i = 1, size(stop_signals)
      if (.not. self%watched(i)) cycle
      raised = c_sigismember(set, stop_signals(i)) == 1
      if (raised) exit
    end do
  end function raised

end module output_signals
