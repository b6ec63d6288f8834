!> The result file that a run goes on from: its restart point, whether the deck is that of the file,
!> and its results up to there.
module output_source
  use, intrinsic :: iso_c_binding, only: c_loc
  use hdf5, only: h5ocopy_f, h5t_native_double
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_deck, exit_io
  use text, only: string_t, to_text, newline, plural
  use model_data, only: model_t, analysis_transient
  use model_statement, only: statement_t, topics, topic_names
  use restart_point, only: point_t
  use output_files, only: file_exists, check_unused
  use output_hdf5, only: hdf5_file_t
  use output_reader, only: reader_t, dataset_t
  use output_restart, only: restart_root, restart_places, topic_path
  use output_slab, only: read_slab
  implicit none
  private

  public :: source_t

  type :: source_t
    type(reader_t) :: reader
    type(point_t) :: point
    character(len=:), allocatable :: group      !< name of the group of its analysis
  contains
    procedure :: open => open_source
    procedure :: check_model
    procedure :: check_deck
    procedure :: same
    procedure :: count => count_entities
    procedure :: check_choice
    procedure :: check_times
    procedure :: copy_before
    procedure :: read_rows
    procedure, private :: refuse
  end type source_t

contains

  !> Open a result file, finished or not, and find its last restart point.
  subroutine open_source(self, path, error)
    class(source_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    type(string_t), allocatable :: groups(:)
    integer :: i
    logical :: exist(2)

    exist = [file_exists(path), file_exists(path//".part")]
    if (exist(2) .and. .not. exist(1)) then
      call fail(error, exit_io, "cannot read '"//path//"': there is no such file"//newline// &
                "    hint: --restart "//path//".part, which an unfinished run has left")
      return
    end if
    if (exist(1)) call check_unused(path, error)
    if (allocated(error)) then
      error%message = "cannot go on from '"//path//"': a run is still writing it"
      return
    end if
    call self%reader%open(path, error)
    if (allocated(error)) return
    call self%reader%groups("/"//restart_root, groups)
    do i = 1, size(groups)
      call find_point(self, groups(i)%s(len(restart_root) + 3:))
    end do
    if (self%point%analysis == 0) then
      call fail(error, exit_io, "cannot go on from '"//path//"': it holds no restart point"// &
                newline//"    hint: only TRANSIENT makes them")
    end if
  end subroutine open_source

  !> Take the points of a group that are whole, with all their states in the file, if they are later
  !> than the one found so far.
  subroutine find_point(self, group)
    class(source_t), intent(inout) :: self
    character(len=*), intent(in) :: group
    type(error_t), allocatable :: error
    type(dataset_t) :: dataset
    type(point_t) :: point
    integer(i8), allocatable :: extents(:)
    integer :: i

    call self%reader%get_extents("/analysis/"//group//"/step", extents)
    if (size(extents) == 0) return
    do i = 1, size(restart_places)
      call self%reader%read("/"//restart_root//"/"//group//"/"//trim(restart_places(i)), dataset, &
                            error)
      if (allocated(error)) cycle
      call point%unpack(dataset%value)
      if (point%states < 1 .or. point%states > extents(1)) cycle
      if (point%analysis < self%point%analysis) cycle
      if (point%analysis == self%point%analysis .and. point%time <= self%point%time) cycle
      self%point = point
      self%group = group
    end do
  end subroutine find_point

  !> Why the run cannot go on.
  subroutine refuse(self, reason, error)
    class(source_t), intent(in) :: self
    character(len=*), intent(in) :: reason
    type(error_t), allocatable, intent(out) :: error

    call fail(error, exit_deck, "cannot go on from '"//self%reader%path//"': "//reason)
  end subroutine refuse

  !> The deck has to say the same about all that comes before the point. A state that was recorded
  !> for an earlier end is dropped.
  subroutine check_deck(self, model, statement, error)
    class(source_t), intent(inout) :: self
    type(model_t), intent(in) :: model
    type(statement_t), intent(in) :: statement(:)   !< of the deck, about the point's analysis
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: dataset
    logical :: equal
    integer :: i

    do i = 1, topics
      call self%reader%read("/"//restart_root//"/"//self%group//topic_path(i), dataset, error)
      if (allocated(error)) return
      equal = size(dataset%value) == size(statement(i)%value)
      if (equal) equal = all(abs(dataset%value - statement(i)%value) <= 0)
      if (equal) cycle
      call self%refuse(trim(topic_names(i))//" of the deck differ from those of the file", error)
      return
    end do
    associate (end_time => model%analysis(self%point%analysis)%end_time)
      if (end_time < self%point%time) then
        call self%refuse("it is at time "//to_text(self%point%time)//", behind TEND "// &
                         to_text(end_time), error)
      end if
      call self%point%extend(end_time)
    end associate
  end subroutine check_deck

  !> The model, as it was written to the new file, has to be that of this file.
  subroutine check_model(self, file, model, error)
    class(source_t), intent(in) :: self
    type(hdf5_file_t), intent(in) :: file
    type(model_t), intent(in) :: model
    type(error_t), allocatable, intent(out) :: error
    type(reader_t) :: new
    type(string_t), allocatable :: here(:), there(:)
    integer :: i

    if (self%point%analysis > size(model%analysis)) then
      call self%refuse("the deck has no analysis "//to_text(self%point%analysis), error)
      return
    else if (model%analysis(self%point%analysis)%kind /= analysis_transient) then
      call self%refuse("analysis "//to_text(self%point%analysis)//" of the deck is no TRANSIENT", &
                       error)
      return
    end if
    new%file = file%id
    new%path = file%path
    call check_count(self, new, "nodes", "node", error)
    if (.not. allocated(error)) call check_count(self, new, "elements", "element", error)
    if (.not. allocated(error)) call check_count(self, new, "joints", "joint", error)
    if (allocated(error)) return
    call new%list("/model", here)
    call self%reader%list("/model", there)
    if (size(here) /= size(there)) then
      call self%refuse("the model of the deck is not that of the file", error)
      return
    end if
    do i = 1, size(here)
      if (self%same(new, here(i)%s, here(i)%s)) cycle
      call self%refuse(here(i)%s(2:)//" ("//description(new, here(i)%s)// &
                       ") of the deck is not that of the file", error)
      return
    end do
  end subroutine check_model

  function description(reader, path) result(text)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: text

    call reader%get_text(path, "description", text)
  end function description

  subroutine check_count(self, new, group, noun, error)
    class(source_t), intent(in) :: self
    type(reader_t), intent(in) :: new
    character(len=*), intent(in) :: group, noun
    type(error_t), allocatable, intent(out) :: error
    integer :: here, there

    here = rows(new, "/model/"//group//"/id")
    there = self%count(group)
    if (here /= there) call self%refuse("it has "//plural(there, noun)//", the deck "// &
                                        to_text(here), error)
  end subroutine check_count

  !> How many nodes, elements or joints the model has.
  integer function count_entities(self, group)
    class(source_t), intent(in) :: self
    character(len=*), intent(in) :: group

    count_entities = rows(self%reader, "/model/"//group//"/id")
  end function count_entities

  !> Length of a list; 0 if it is not there.
  integer function rows(reader, path)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path
    integer(i8), allocatable :: extents(:)

    rows = 0
    call reader%get_extents(path, extents)
    if (size(extents) > 0) rows = int(extents(1))
  end function rows

  !> Whether a dataset of another file is in this one, number by number and word by word; or is in
  !> neither.
  logical function same(self, other, there, here)
    class(source_t), intent(in) :: self
    type(reader_t), intent(in) :: other
    character(len=*), intent(in) :: there, here   !< paths in the other file and in this one
    type(dataset_t) :: a, b
    type(error_t), allocatable :: error
    integer :: i
    logical :: has(2)

    has = [other%has(there), self%reader%has(here)]
    same = has(1) .eqv. has(2)
    if (.not. all(has)) return
    call other%read(there, a, error)
    if (.not. allocated(error)) call self%reader%read(here, b, error)
    same = .not. allocated(error)
    if (same) same = a%kind == b%kind .and. size(a%extents) == size(b%extents)
    if (same) same = all(a%extents == b%extents)
    if (.not. same) return
    same = all(abs(a%value - b%value) <= 0)
    do i = 1, size(a%word)
      same = same .and. a%word(i)%s == b%word(i)%s
    end do
  end function same

  !> The point's analysis has to keep the same nodes and elements; `group`: of it in the new file.
  subroutine check_choice(self, file, group, error)
    class(source_t), intent(in) :: self
    type(hdf5_file_t), intent(in) :: file
    character(len=*), intent(in) :: group
    type(error_t), allocatable, intent(out) :: error
    type(reader_t) :: new

    new%file = file%id
    new%path = file%path
    if (.not. self%same(new, "/"//group//"/nodes/index", &
                        "/analysis/"//self%group//"/nodes/index")) then
      call self%refuse("OUTPUT NODES of the deck are not those of the file", error)
    else if (.not. self%same(new, "/"//group//"/elements/index", &
                             "/analysis/"//self%group//"/elements/index")) then
      call self%refuse("OUTPUT ELEMENTS of the deck are not those of the file", error)
    end if
  end subroutine check_choice

  !> A kill in the midst of writing may have spoilt more than what was written last.
  subroutine check_times(self, time, error)
    class(source_t), intent(in) :: self
    real(wp), intent(in) :: time(:)          !< of the states before the point
    type(error_t), allocatable, intent(out) :: error

    if (all(time(2:) > time(:size(time) - 1))) return
    call fail(error, exit_io, "cannot go on from '"//self%reader%path// &
              "': it was damaged by a kill")
  end subroutine check_times

  !> Copy the groups of the analyses before the point's, with their restart points, under the names
  !> that they have now.
  subroutine copy_before(self, file, names)
    class(source_t), intent(in) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(string_t), intent(in) :: names(:)      !< of all analyses' groups
    type(string_t), allocatable :: groups(:)
    character(len=12) :: number
    integer :: i, k, status

    call self%reader%groups("/analysis", groups)
    do i = 1, self%point%analysis - 1
      write (number, "(i0.2)") i
      do k = 1, size(groups)
        if (index(groups(k)%s, "/analysis/"//trim(number)//"_") /= 1) cycle
        call h5ocopy_f(self%reader%file, groups(k)%s, file%id, "analysis/"//names(i)%s, status)
        call file%check(status, "h5ocopy_f")
        associate (old => restart_root//groups(k)%s(len("/analysis") + 1:))
          if (.not. self%reader%has("/"//old)) cycle
          call h5ocopy_f(self%reader%file, old, file%id, restart_root//"/"//names(i)%s, status)
          call file%check(status, "h5ocopy_f")
        end associate
      end do
    end do
  end subroutine copy_before

  !> Rows of a dataset as reals; zero if they cannot be read.
  subroutine read_rows(self, path, first, values)
    class(source_t), intent(in) :: self
    character(len=*), intent(in) :: path
    integer(i8), intent(in) :: first                                !< from 0
    real(wp), intent(out), target, contiguous :: values(:, :)       !< (columns, rows)
    integer :: status

    values = 0
    if (size(values) == 0) return
    call read_slab(self%reader%file, path, h5t_native_double, size(values, 1), first, &
                   size(values, 2, i8), c_loc(values), status)
  end subroutine read_rows

end module output_source
