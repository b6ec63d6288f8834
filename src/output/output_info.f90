!> What a result file holds: `spar info`.
module output_info
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_io
  use text, only: string_t, to_text, plural
  use output_json, only: json_string, json_number, json_logical
  use output_reader, only: reader_t, dataset_t
  implicit none
  private

  public :: file_info_t, analysis_info_t, read_info, print_info, print_info_json

  !> One analysis.
  type :: analysis_info_t
    character(len=:), allocatable :: group, kind
    logical :: complete = .false.
    integer :: steps = 0, modes = 0
    character(len=:), allocatable :: quantity     !< of `last`; empty: nothing to tell
    real(wp) :: last = 0.0_wp                     !< load factor at the end, or of the first mode
  end type analysis_info_t

  type :: file_info_t
    character(len=:), allocatable :: path, program, version, title
    integer :: layout = 0
    logical :: complete = .false.
    integer :: nodes = 0, elements = 0, sections = 0, materials = 0, drawn = 0
    type(analysis_info_t), allocatable :: analysis(:)
  end type file_info_t

contains

  !> Read what a file says about itself.
  subroutine read_info(path, info, error)
    character(len=*), intent(in) :: path
    type(file_info_t), intent(out) :: info
    type(error_t), allocatable, intent(out) :: error
    type(reader_t) :: reader
    type(string_t), allocatable :: groups(:)
    integer :: i, complete

    call reader%open(path, error)
    if (allocated(error)) return
    info%path = path
    call reader%get_text("/", "program", info%program)
    call reader%get_text("/", "version", info%version)
    call reader%get_text("/", "title", info%title)
    call reader%get_number("/", "layout_version", info%layout)
    call reader%get_number("/", "complete", complete)
    info%complete = complete == 1
    info%nodes = rows(reader, "/model/nodes/id")
    info%elements = rows(reader, "/model/elements/id") + rows(reader, "/model/joints/id")
    info%sections = rows(reader, "/model/sections/name")
    info%materials = rows(reader, "/model/materials/name")
    info%drawn = rows(reader, "/VTKHDF/Steps/Values")
    call reader%groups("/analysis", groups)
    allocate (info%analysis(size(groups)))
    do i = 1, size(groups)
      call read_analysis(reader, groups(i)%s, info%analysis(i), error)
      if (allocated(error)) exit
    end do
    call reader%close()
    if (info%layout < 1 .and. .not. allocated(error)) then
      call fail(error, exit_io, "cannot read '"//path//"': it is no result file of spar")
    end if
  end subroutine read_info

  integer function rows(reader, path)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path
    integer(i8), allocatable :: extents(:)

    call reader%get_extents(path, extents)
    rows = 0
    if (size(extents) > 0) rows = int(extents(1))
  end function rows

  subroutine read_analysis(reader, group, info, error)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: group
    type(analysis_info_t), intent(out) :: info
    type(error_t), allocatable, intent(out) :: error
    integer :: complete, at

    info%group = group
    info%quantity = ""
    call reader%get_text(group, "kind", info%kind)
    call reader%get_number(group, "complete", complete)
    info%complete = complete == 1
    if (reader%has(group//"/step")) then
      info%steps = rows(reader, group//"/step")
      call read_one(reader, group//"/load_factor", info%steps, "load factor", info, error)
      if (allocated(error)) return
      call read_one(reader, group//"/time", info%steps, "time", info, error)
    else if (reader%has(group//"/multiplier")) then
      info%modes = rows(reader, group//"/multiplier")
      call find_critical(reader, group//"/multiplier", at, error)
      if (allocated(error)) return
      call read_one(reader, group//"/load_factor", at, "critical load factor", info, error)
    else if (reader%has(group//"/frequency")) then
      info%modes = rows(reader, group//"/frequency")
      call read_one(reader, group//"/frequency", 1, "first frequency", info, error)
    else if (reader%has(group//"/modes/energy")) then
      info%modes = rows(reader, group//"/modes/energy")
    end if
  end subroutine read_analysis

  !> Which multiplier comes first when the load grows, or else when it is reversed; 0: none.
  subroutine find_critical(reader, path, at, error)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path
    integer, intent(out) :: at
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: dataset

    at = 0
    call reader%read(path, dataset, error)
    if (allocated(error)) return
    at = minloc(dataset%value, 1, dataset%value > 0)
    if (at == 0) at = maxloc(dataset%value, 1)
  end subroutine find_critical

  subroutine read_one(reader, path, at, quantity, info, error)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path, quantity
    integer, intent(in) :: at
    type(analysis_info_t), intent(inout) :: info
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: dataset

    if (.not. reader%has(path)) return
    call reader%read(path, dataset, error)
    if (allocated(error)) return
    if (at < 1 .or. at > size(dataset%value)) return
    info%quantity = quantity
    info%last = dataset%value(at)
  end subroutine read_one

  subroutine print_info(unit, info)
    integer, intent(in) :: unit
    type(file_info_t), intent(in) :: info
    integer :: i

    write (unit, "(a)") info%path//": "//info%program//" "//info%version//", layout "// &
      to_text(info%layout)//", "//trim(merge("complete    ", "NOT complete", info%complete))
    if (info%title /= "") write (unit, "(a)") info%title
    write (unit, "(a)") plural(info%nodes, "node")//", "//plural(info%elements, "element")// &
      ", "//plural(info%sections, "section")//", "//plural(info%materials, "material")
    do i = 1, size(info%analysis)
      write (unit, "(a)") "  "//analysis_line(info%analysis(i))
    end do
    if (info%drawn > 0) write (unit, "(a)") "  /VTKHDF  "//plural(info%drawn, "step")
  end subroutine print_info

  pure function analysis_line(a) result(line)
    type(analysis_info_t), intent(in) :: a
    character(len=:), allocatable :: line

    line = a%group//"  "//a%kind
    select case (a%kind)
    case ("buckling", "eigen", "check")
      line = line//", "//plural(a%modes, "mode")
    case ("compliance")
    case default
      line = line//", "//plural(a%steps, "step")
    end select
    if (a%quantity /= "") line = line//", "//a%quantity//" "//to_text(a%last, 8)
    if (.not. a%complete) line = line//", NOT complete"
  end function analysis_line

  subroutine print_info_json(unit, info)
    integer, intent(in) :: unit
    type(file_info_t), intent(in) :: info
    integer :: i

    write (unit, "(a)") "{""file"": "//json_string(info%path)//", ""program"": "// &
      json_string(info%program)//", ""version"": "//json_string(info%version)//","
    write (unit, "(a)") " ""layout_version"": "//to_text(info%layout)//", ""complete"": "// &
      json_logical(info%complete)//", ""title"": "//json_string(info%title)//","
    write (unit, "(a)") " ""nodes"": "//to_text(info%nodes)//", ""elements"": "// &
      to_text(info%elements)//", ""sections"": "//to_text(info%sections)//", ""materials"": "// &
      to_text(info%materials)//", ""drawn_steps"": "//to_text(info%drawn)//","
    write (unit, "(a)") " ""analyses"": ["
    do i = 1, size(info%analysis)
      associate (a => info%analysis(i))
        write (unit, "(a)", advance="no") "  {""group"": "//json_string(a%group)// &
          ", ""kind"": "//json_string(a%kind)//", ""complete"": "//json_logical(a%complete)// &
          ", ""steps"": "//to_text(a%steps)//", ""modes"": "//to_text(a%modes)
        if (a%quantity /= "") write (unit, "(a)", advance="no") ", "//json_string(underscored( &
          a%quantity))//": "//json_number(a%last)
      end associate
      write (unit, "(a)") "}"//trim(merge(",", " ", i < size(info%analysis)))
    end do
    write (unit, "(a)") " ]}"
  end subroutine print_info_json

  pure function underscored(words) result(word)
    character(len=*), intent(in) :: words
    character(len=len(words)) :: word
    integer :: i

    word = words
    do i = 1, len(words)
      if (words(i:i) == " ") word(i:i) = "_"
    end do
  end function underscored

end module output_info
