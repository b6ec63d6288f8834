!> What a reader of decks has to say about them: errors, warnings and notes, each with its place.
!>
!> A report keeps the text of the files read, so that a message can show its line with a caret.
module diagnostics
  use text, only: to_text, plural
  implicit none
  private

  public :: place_t, diagnostic_t, text_file_t, report_t

  integer, parameter, public :: severity_note = 1, severity_warning = 2, severity_error = 3

  integer, parameter :: most_kept = 1000    !< of each severity; the rest is counted
  integer, parameter :: most_printed = 50   !< of each severity
  integer, parameter :: window = 100        !< longest part of a line that is shown

  !> Where a word stands. `file = 0` means no place: the message is printed without one.
  type :: place_t
    integer :: file = 0    !< index of the file in the report
    integer :: line = 0    !< line number; 0: the file as a whole
    integer :: column = 0  !< first column of the word, in bytes
    integer :: width = 1   !< number of columns
  end type place_t

  !> One thing to say.
  type :: diagnostic_t
    integer :: severity = severity_error
    type(place_t) :: place
    character(len=:), allocatable :: message  !< one sentence, no trailing period
    character(len=:), allocatable :: hint     !< empty when there is none
  end type diagnostic_t

  !> A file that was read.
  type :: text_file_t
    character(len=:), allocatable :: name
    character(len=:), allocatable :: text
    integer, allocatable :: line_start(:)  !< where each line starts, and one past the last
  end type text_file_t

  !> Everything said so far and the files it is about.
  type :: report_t
    type(diagnostic_t), allocatable :: item(:)
    integer :: items = 0
    type(text_file_t), allocatable :: file(:)
    integer :: files = 0
    integer :: said(3) = 0                     !< how many of each severity, kept or not
  contains
    procedure :: add_file
    procedure :: add_error
    procedure :: add_warning
    procedure :: add_note
    procedure :: errors
    procedure :: warnings
    procedure :: sort
    procedure :: print
    procedure :: heading
    procedure :: location
  end type report_t

contains

  !> Keep a file's text (which is moved) and find its lines.
  subroutine add_file(self, name, text, number)
    class(report_t), intent(inout) :: self
    character(len=*), intent(in) :: name
    character(len=:), allocatable, intent(inout) :: text
    integer, intent(out) :: number  !< index of the file, for places
    type(text_file_t), allocatable :: more(:)
    integer :: i

    if (.not. allocated(self%file)) allocate (self%file(4))
    if (self%files == size(self%file)) then
      allocate (more(2*self%files))
      do i = 1, self%files
        more(i)%name = self%file(i)%name
        call move_alloc(self%file(i)%text, more(i)%text)
        call move_alloc(self%file(i)%line_start, more(i)%line_start)
      end do
      call move_alloc(more, self%file)
    end if
    self%files = self%files + 1
    number = self%files
    self%file(number)%name = name
    call move_alloc(text, self%file(number)%text)
    call find_lines(self%file(number))
  end subroutine add_file

  subroutine find_lines(file)
    type(text_file_t), intent(inout) :: file
    integer :: i, lines

    lines = 1
    do i = 1, len(file%text)
      if (file%text(i:i) == achar(10)) lines = lines + 1
    end do
    allocate (file%line_start(lines + 1))
    file%line_start(1) = 1
    lines = 1
    do i = 1, len(file%text)
      if (file%text(i:i) /= achar(10)) cycle
      lines = lines + 1
      file%line_start(lines) = i + 1
    end do
    file%line_start(lines + 1) = len(file%text) + 2
  end subroutine find_lines

  subroutine add_error(self, place, message, hint)
    class(report_t), intent(inout) :: self
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: message
    character(len=*), intent(in), optional :: hint

    call add(self, severity_error, place, message, hint)
  end subroutine add_error

  subroutine add_warning(self, place, message, hint)
    class(report_t), intent(inout) :: self
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: message
    character(len=*), intent(in), optional :: hint

    call add(self, severity_warning, place, message, hint)
  end subroutine add_warning

  subroutine add_note(self, place, message, hint)
    class(report_t), intent(inout) :: self
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: message
    character(len=*), intent(in), optional :: hint

    call add(self, severity_note, place, message, hint)
  end subroutine add_note

  subroutine add(report, severity, place, message, hint)
    type(report_t), intent(inout) :: report
    integer, intent(in) :: severity
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: message
    character(len=*), intent(in), optional :: hint
    type(diagnostic_t), allocatable :: more(:)

    if (is_said(report, severity, place, message)) return
    report%said(severity) = report%said(severity) + 1
    if (report%said(severity) > most_kept) return
    if (.not. allocated(report%item)) allocate (report%item(8))
    if (report%items == size(report%item)) then
      allocate (more(2*report%items))
      more(:report%items) = report%item
      call move_alloc(more, report%item)
    end if
    report%items = report%items + 1
    associate (item => report%item(report%items))
      item%severity = severity
      item%place = place
      item%message = message
      item%hint = ""
      if (present(hint)) item%hint = hint
    end associate
  end subroutine add

  !> Whether the same is said of the same place already, among what is kept.
  pure logical function is_said(report, severity, place, message)
    type(report_t), intent(in) :: report
    integer, intent(in) :: severity
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: message
    integer :: i

    is_said = .false.
    if (report%said(severity) >= most_kept) return
    do i = 1, report%items
      associate (item => report%item(i))
        if (item%severity /= severity .or. item%place%file /= place%file) cycle
        if (item%place%line /= place%line .or. item%place%column /= place%column) cycle
        is_said = is_said .or. item%message == message
      end associate
    end do
  end function is_said

  !> Number of errors.
  pure integer function errors(self)
    class(report_t), intent(in) :: self

    errors = self%said(severity_error)
  end function errors

  !> Number of warnings.
  pure integer function warnings(self)
    class(report_t), intent(in) :: self

    warnings = self%said(severity_warning)
  end function warnings

  !> Order by file, line and column; what stands at the same place keeps its order.
  subroutine sort(self)
    class(report_t), intent(inout) :: self
    type(diagnostic_t) :: item
    integer :: i, j

    do i = 2, self%items
      if (.not. before(self%item(i)%place, self%item(i - 1)%place)) cycle
      item = self%item(i)
      j = i - 1
      do while (j >= 1)
        if (.not. before(item%place, self%item(j)%place)) exit
        self%item(j + 1) = self%item(j)
        j = j - 1
      end do
      self%item(j + 1) = item
    end do
  end subroutine sort

  pure logical function before(a, b)
    type(place_t), intent(in) :: a, b

    if (a%file /= b%file) then
      before = a%file < b%file
    else if (a%line /= b%line) then
      before = a%line < b%line
    else
      before = a%column < b%column
    end if
  end function before

  !> Write everything in order: message, line, caret, hint; at most 50 of each severity.
  subroutine print(self, unit)
    class(report_t), intent(inout) :: self
    integer, intent(in) :: unit
    character(len=*), parameter :: noun(3) = ["note   ", "warning", "error  "]
    integer :: i, printed(3)

    call self%sort()
    printed = 0
    do i = 1, self%items
      associate (item => self%item(i))
        if (printed(item%severity) == most_printed) cycle
        printed(item%severity) = printed(item%severity) + 1
        write (unit, "(a)") self%heading(item)
        call print_line(self, item%place, unit)
        if (item%hint /= "") write (unit, "(a)") "    hint: "//item%hint
      end associate
    end do
    do i = 1, 3
      if (self%said(i) > printed(i)) write (unit, "(a)") &
        "and "//plural(self%said(i) - printed(i), "more "//trim(noun(i)))
    end do
  end subroutine print

  !> `file:line:column: message`; a warning or note says so.
  function heading(self, item) result(phrase)
    class(report_t), intent(in) :: self
    type(diagnostic_t), intent(in) :: item
    character(len=:), allocatable :: phrase

    phrase = ""
    associate (place => item%place)
      if (place%file > 0) then
        phrase = self%file(place%file)%name//":"
        if (place%line > 0) phrase = phrase//to_text(place%line)//":"// &
                                     to_text(column_shown(self, place))//":"
        phrase = phrase//" "
      end if
    end associate
    if (item%severity == severity_warning) phrase = phrase//"warning: "
    if (item%severity == severity_note) phrase = phrase//"note: "
    phrase = phrase//item%message
  end function heading

  !> "frame.deck:12", to point at an earlier card in a hint.
  function location(self, place) result(phrase)
    class(report_t), intent(in) :: self
    type(place_t), intent(in) :: place
    character(len=:), allocatable :: phrase

    phrase = self%file(place%file)%name//":"//to_text(place%line)
  end function location

  !> The line of a place, or a window of it, with carets below the word.
  subroutine print_line(report, place, unit)
    type(report_t), intent(in) :: report
    type(place_t), intent(in) :: place
    integer, intent(in) :: unit
    character(len=:), allocatable :: line, front, back
    integer :: from, to, start, last, width

    if (place%file == 0 .or. place%line == 0) return
    associate (file => report%file(place%file))
      start = file%line_start(place%line)
      last = file%line_start(place%line + 1) - 2
      from = start
      if (place%column > window - 20) from = start + place%column - 41
      to = min(last, from + window - 1)
      line = file%text(from:to)
      front = merge("... ", "    ", from > start)
      back = ""
      if (to < last) back = " ..."
    end associate
    call blank_controls(line)
    write (unit, "(a)") front//line//back
    start = place%column - (from - start)
    width = max(1, min(place%width, len(line) - start + 1))
    last = min(start + width - 1, len(line))
    width = max(1, characters(line(start:last)))
    write (unit, "(a)") repeat(" ", 4 + characters(line(:start - 1)))//repeat("^", width)
  end subroutine print_line

  !> The column in characters, as an editor shows it.
  integer function column_shown(report, place)
    type(report_t), intent(in) :: report
    type(place_t), intent(in) :: place
    integer :: start

    start = report%file(place%file)%line_start(place%line)
    column_shown = 1 + characters(report%file(place%file)%text(start:start + place%column - 2))
  end function column_shown

  !> Number of characters of UTF-8 text: bytes that do not continue a character.
  pure integer function characters(line)
    character(len=*), intent(in) :: line
    integer :: i

    characters = 0
    do i = 1, len(line)
      if (iand(ichar(line(i:i)), 192) /= 128) characters = characters + 1
    end do
  end function characters

  pure subroutine blank_controls(line)
    character(len=*), intent(inout) :: line
    integer :: i

    do i = 1, len(line)
      if (ichar(line(i:i)) < 32 .or. ichar(line(i:i)) == 127) line(i:i) = " "
    end do
  end subroutine blank_controls

end module diagnostics
