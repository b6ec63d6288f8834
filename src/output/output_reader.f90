!> Reads result files: which datasets there are, what they hold, attributes.
module output_reader
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc, c_char, c_int, c_null_char
  use hdf5, only: hid_t, hsize_t, size_t, h5dont_atexit_f, h5open_f, h5eset_auto_f, h5fopen_f, &
                  h5fclose_f, &
                  h5dopen_f, h5dclose_f, h5dread_f, h5dget_space_f, h5dget_type_f, h5sclose_f, &
                  h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5tclose_f, &
                  h5tget_class_f, h5tget_size_f, h5oopen_f, h5oclose_f, h5aexists_by_name_f, &
                  h5aopen_f, h5aclose_f, h5aread_f, h5aget_type_f, h5aget_space_f, h5lexists_f, &
                  h5gn_members_f, h5gget_obj_info_idx_f, h5g_group_f, h5g_dataset_f, &
                  h5f_acc_rdonly_f, h5t_native_double, h5t_float_f, h5t_integer_f, h5t_string_f
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_io
  use text, only: string_t
  use output_files, only: file_exists, folder_exists
  use output_interfaces, only: c_setenv, c_unsetenv
  implicit none
  private

  public :: reader_t, dataset_t

  integer, parameter, public :: kind_other = 0, kind_whole = 1, kind_real = 2, kind_text = 3

  integer, parameter :: longest_name = 200

  !> A dataset with its values, the last index of the file fastest.
  type :: dataset_t
    character(len=:), allocatable :: path
    integer :: kind = kind_other
    integer(i8), allocatable :: extents(:)      !< as the file has them
    real(wp), allocatable :: value(:)           !< of numbers
    type(string_t), allocatable :: word(:)      !< of texts
    character(len=:), allocatable :: axes       !< attribute; empty: none
    integer, allocatable :: dimension(:, :)     !< (4, 1 or columns) attribute; empty: none
  contains
    procedure :: columns
  end type dataset_t

  type :: reader_t
    integer(hid_t) :: file = -1
    character(len=:), allocatable :: path
  contains
    procedure :: open => open_file
    procedure :: close => close_file
    procedure :: list
    procedure :: groups
    procedure :: has
    procedure :: read => read_dataset
    procedure :: get_extents
    procedure :: get_text
    procedure :: get_number
  end type reader_t

contains

  !> Number of columns of a table, 1 of a list; of a list of tables, entries of each if they have
  !> dimensions of their own.
  pure integer function columns(self)
    class(dataset_t), intent(in) :: self

    columns = 1
    if (size(self%extents) > 1) columns = int(self%extents(size(self%extents)))
    if (size(self%extents) > 2) columns = max(columns, size(self%dimension, 2))
  end function columns

  !> Open a file to read. It is not locked: a run may be writing it.
  subroutine open_file(self, path, error)
    class(reader_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    character(len=*), parameter :: locking = "HDF5_USE_FILE_LOCKING"
    integer :: status, unset
    integer(c_int) :: ignored

    self%path = path
    self%file = -1
    if (.not. file_exists(path)) then
      call fail(error, exit_io, "cannot read '"//path//"': there is no such file")
      return
    else if (folder_exists(path)) then
      call fail(error, exit_io, "cannot read '"//path//"': it is a folder")
      return
    end if
    call get_environment_variable(locking, status=unset)
    if (unset /= 0) ignored = c_setenv(locking//c_null_char, "FALSE"//c_null_char, 1_c_int)
    call h5dont_atexit_f(status)
    call h5open_f(status)
    call h5eset_auto_f(0, status)
    call h5fopen_f(path, h5f_acc_rdonly_f, self%file, status)
    if (unset /= 0) ignored = c_unsetenv(locking//c_null_char)
    if (status >= 0) return
    self%file = -1
    call fail(error, exit_io, "cannot read '"//path//"': it is no HDF5 file, or damaged")
  end subroutine open_file

  subroutine close_file(self)
    class(reader_t), intent(inout) :: self
    integer :: status

    if (self%file >= 0) call h5fclose_f(self%file, status)
    self%file = -1
  end subroutine close_file

  !> Paths of all datasets of a group and below, by name.
  subroutine list(self, group, paths)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: group   !< "" for the whole file
    type(string_t), allocatable, intent(out) :: paths(:)

    allocate (paths(0))
    call add_members(self, group, .true., h5g_dataset_f, paths)
  end subroutine list

  !> Paths of the groups in a group.
  subroutine groups(self, group, paths)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: group
    type(string_t), allocatable, intent(out) :: paths(:)

    allocate (paths(0))
    if (self%has(group)) call add_members(self, group, .false., h5g_group_f, paths)
  end subroutine groups

  recursive subroutine add_members(self, group, below, wanted, paths)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: group
    logical, intent(in) :: below         !< look into groups
    integer, intent(in) :: wanted        !< kind of object
    type(string_t), allocatable, intent(inout) :: paths(:)
    type(string_t), allocatable :: more(:)
    character(len=longest_name) :: name
    integer :: members, kind, i, k, status

    members = 0
    call h5gn_members_f(self%file, group//"/", members, status)
    do i = 0, members - 1
      call h5gget_obj_info_idx_f(self%file, group//"/", i, name, kind, status)
      if (status < 0) cycle
      if (kind == wanted) then
        allocate (more(size(paths) + 1))
        do k = 1, size(paths)
          call move_alloc(paths(k)%s, more(k)%s)
        end do
        more(size(more))%s = group//"/"//trim(name)
        call move_alloc(more, paths)
      end if
      if (below .and. kind == h5g_group_f) then
        call add_members(self, group//"/"//trim(name), below, wanted, paths)
      end if
    end do
  end subroutine add_members

  !> Whether a path leads to something.
  logical function has(self, path)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path
    integer :: at, status

    has = .true.
    at = 1
    do while (has .and. at < len(path))
      at = at + index(path(at + 1:)//"/", "/")
      call h5lexists_f(self%file, path(:at - 1), has, status)
      if (status < 0) has = .false.
    end do
  end function has

  !> A dataset with all it holds.
  subroutine read_dataset(self, path, dataset, error)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path
    type(dataset_t), intent(out) :: dataset
    type(error_t), allocatable, intent(out) :: error
    integer(hid_t) :: id, type
    integer :: class, status

    dataset%path = path
    allocate (dataset%value(0), dataset%word(0), dataset%dimension(4, 0))
    call self%get_text(path, "axes", dataset%axes)
    call read_dimension(self, path, dataset%dimension)
    call h5dopen_f(self%file, path, id, status)
    if (status >= 0) then
      call get_shape(id, dataset%extents)
      call h5dget_type_f(id, type, status)
      call h5tget_class_f(type, class, status)
      if (class == h5t_integer_f) dataset%kind = kind_whole
      if (class == h5t_float_f) dataset%kind = kind_real
      if (class == h5t_string_f) dataset%kind = kind_text
      if (dataset%kind == kind_text) call read_words(id, type, dataset, status)
      if (class == h5t_integer_f .or. class == h5t_float_f) call read_numbers(id, dataset, status)
      if (status >= 0) call h5tclose_f(type, status)
      if (status >= 0) call h5dclose_f(id, status)
    end if
    if (status < 0) call fail(error, exit_io, "cannot read '"//path//"' of '"//self%path//"'")
  end subroutine read_dataset

  subroutine read_numbers(id, dataset, status)
    integer(hid_t), intent(in) :: id
    type(dataset_t), intent(inout) :: dataset
    integer, intent(out) :: status
    real(wp), allocatable, target :: value(:)
    type(c_ptr) :: address

    status = 0
    allocate (value(product(dataset%extents)))
    if (size(value) > 0) then
      address = c_loc(value)
      call h5dread_f(id, h5t_native_double, address, status)
    end if
    call move_alloc(value, dataset%value)
  end subroutine read_numbers

  !> Texts of fixed length, without the zeros at their ends.
  subroutine read_words(id, type, dataset, status)
    integer(hid_t), intent(in) :: id, type
    type(dataset_t), intent(inout) :: dataset
    integer, intent(out) :: status
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(size_t) :: width
    integer(i8) :: i, words
    type(c_ptr) :: address

    call h5tget_size_f(type, width, status)
    words = product(dataset%extents)
    deallocate (dataset%word)
    allocate (dataset%word(words), bytes(words*width))
    if (words == 0) return
    address = c_loc(bytes)
    call h5dread_f(id, type, address, status)
    do i = 1, words
      dataset%word(i)%s = joined_bytes(bytes((i - 1)*width + 1:i*width))
    end do
  end subroutine read_words

  pure function joined_bytes(bytes) result(text)
    character(kind=c_char), intent(in) :: bytes(:)
    character(len=:), allocatable :: text
    integer :: i, n

    n = size(bytes)
    do while (n > 0)
      if (bytes(n) /= c_null_char) exit
      n = n - 1
    end do
    allocate (character(len=n) :: text)
    do i = 1, n
      text(i:i) = bytes(i)
    end do
  end function joined_bytes

  !> Extents as the file has them: HDF5's Fortran gives them backwards.
  subroutine get_shape(id, extents)
    integer(hid_t), intent(in) :: id
    integer(i8), allocatable, intent(out) :: extents(:)
    integer(hid_t) :: space
    integer :: status

    call h5dget_space_f(id, space, status)
    call shape_of(space, extents)
    call h5sclose_f(space, status)
  end subroutine get_shape

  subroutine shape_of(space, extents)
    integer(hid_t), intent(in) :: space
    integer(i8), allocatable, intent(out) :: extents(:)
    integer(hsize_t) :: now(32), most(32)
    integer :: rank, status

    call h5sget_simple_extent_ndims_f(space, rank, status)
    call h5sget_simple_extent_dims_f(space, now, most, status)
    extents = now(rank:1:-1)
  end subroutine shape_of

  !> Extents of a dataset; none if it is not there.
  subroutine get_extents(self, path, extents)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path
    integer(i8), allocatable, intent(out) :: extents(:)
    integer(hid_t) :: id
    integer :: status

    allocate (extents(0))
    if (.not. self%has(path)) return
    call h5dopen_f(self%file, path, id, status)
    if (status < 0) return
    call get_shape(id, extents)
    call h5dclose_f(id, status)
  end subroutine get_extents

  !> Powers of force, length, time, mass; for each column where they differ.
  subroutine read_dimension(self, path, dimension)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path
    integer, allocatable, intent(out) :: dimension(:, :)
    integer(hid_t) :: owner, attribute, space
    integer(i8), allocatable :: extents(:)
    real(wp), allocatable, target :: value(:)
    type(c_ptr) :: address
    integer :: status

    allocate (dimension(4, 0))
    call open_attribute(self, path, "dimension", owner, attribute)
    if (attribute < 0) return
    call h5aget_space_f(attribute, space, status)
    call shape_of(space, extents)
    call h5sclose_f(space, status)
    allocate (value(product(extents)))
    address = c_loc(value)
    call h5aread_f(attribute, h5t_native_double, address, status)
    if (status >= 0) dimension = reshape(nint(value), [4, size(value)/4])
    call close_attribute(owner, attribute)
  end subroutine read_dimension

  !> A text attribute of a group or dataset; empty if there is none.
  subroutine get_text(self, path, name, text)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path, name
    character(len=:), allocatable, intent(out) :: text
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(hid_t) :: owner, attribute, type
    integer(size_t) :: width
    type(c_ptr) :: address
    integer :: status

    text = ""
    call open_attribute(self, path, name, owner, attribute)
    if (attribute < 0) return
    call h5aget_type_f(attribute, type, status)
    call h5tget_size_f(type, width, status)
    allocate (bytes(width))
    address = c_loc(bytes)
    call h5aread_f(attribute, type, address, status)
    if (status >= 0) text = joined_bytes(bytes)
    call h5tclose_f(type, status)
    call close_attribute(owner, attribute)
  end subroutine get_text

  !> A whole number that is an attribute; -1 if there is none.
  subroutine get_number(self, path, name, number)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path, name
    integer, intent(out) :: number
    integer(hid_t) :: owner, attribute
    real(wp), target :: value
    type(c_ptr) :: address
    integer :: status

    number = -1
    call open_attribute(self, path, name, owner, attribute)
    if (attribute < 0) return
    address = c_loc(value)
    call h5aread_f(attribute, h5t_native_double, address, status)
    if (status >= 0) number = nint(value)
    call close_attribute(owner, attribute)
  end subroutine get_number

  subroutine open_attribute(self, path, name, owner, attribute)
    class(reader_t), intent(in) :: self
    character(len=*), intent(in) :: path, name
    integer(hid_t), intent(out) :: owner, attribute
    logical :: exists
    integer :: status

    attribute = -1
    owner = -1
    call h5aexists_by_name_f(self%file, path, name, exists, status)
    if (status < 0 .or. .not. exists) return
    call h5oopen_f(self%file, path, owner, status)
    if (status < 0) return
    call h5aopen_f(owner, name, attribute, status)
    if (status < 0) attribute = -1
  end subroutine open_attribute

  subroutine close_attribute(owner, attribute)
    integer(hid_t), intent(in) :: owner, attribute
    integer :: status

    call h5aclose_f(attribute, status)
    call h5oclose_f(owner, status)
  end subroutine close_attribute

end module output_reader
