!> What a run ends with on the terminal: a row for each of its analyses.
module output_summary
  use kinds, only: wp
  use text, only: to_text, plural, string_t
  implicit none
  private

  public :: summary_t, summary_lines, right

  integer, parameter, public :: longest_name = 20   !< of a node

  !> What the summary says of an analysis.
  type :: summary_t
    character(len=:), allocatable :: name
    integer :: steps = 0, iterations = 0, cutbacks = 0
    logical :: in_time = .false., restarts = .false.
    real(wp) :: factor = 0.0_wp                  !< load factor or time
    real(wp) :: largest = 0.0_wp                 !< displacement at the end
    character(len=longest_name) :: node = ""     !< whose it is
    integer :: found = -1                        !< modes, or nodes asked for; -1: it has steps
    character(len=4) :: noun = "mode"            !< what `found` counts
    logical :: complete = .false.
  end type summary_t

contains

  !> A table, its head first.
  subroutine summary_lines(summary, line)
    type(summary_t), intent(in) :: summary(:)
    type(string_t), allocatable, intent(out) :: line(:)
    integer :: i, width

    width = 8
    do i = 1, size(summary)
      width = max(width, len(summary(i)%name))
    end do
    allocate (line(size(summary) + 1))
    line(1)%s = "Analysis"//repeat(" ", width - 8)//"   steps"// &
                merge("  factor, time", "   load factor", any(summary%in_time))// &
                "   iterations   cut-backs   largest displacement"
    do i = 1, size(summary)
      line(i + 1)%s = summary_row(summary(i), width)
    end do
  end subroutine summary_lines

  pure function summary_row(summary, width) result(line)
    type(summary_t), intent(in) :: summary
    integer, intent(in) :: width
    character(len=:), allocatable :: line

    line = summary%name//repeat(" ", width - len(summary%name))
    if (summary%found >= 0) then
      line = line//"   "//plural(summary%found, summary%noun)
    else
      line = line//right(to_text(summary%steps), 8)//right(to_text(summary%factor), 14)// &
             right(to_text(summary%iterations), 13)//right(to_text(summary%cutbacks), 12)
      if (summary%steps > 0) line = line//right(to_text(summary%largest, 5), 14)// &
                                    " at node "//trim(summary%node)
    end if
    if (.not. summary%complete) line = line//"   (not complete)"
  end function summary_row

  !> A word with blanks in front.
  pure function right(word, width)
    character(len=*), intent(in) :: word
    integer, intent(in) :: width
    character(len=:), allocatable :: right

    right = repeat(" ", max(0, width - len(word)))//word
  end function right

end module output_summary
