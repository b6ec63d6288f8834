!> A file of the HDF5 library: groups, attributes, datasets.
!>
!> A failure stays in the file and silences what follows; `flush` and `close` hand it over.
!> Files of equal contents are equal byte by byte.
module output_hdf5
  use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_loc, c_char, c_null_char
  use hdf5, only: hid_t, hsize_t, size_t, h5dont_atexit_f, h5open_f, h5close_f, h5eset_auto_f, &
                  h5fcreate_f, h5fclose_f, h5fflush_f, h5pcreate_f, h5pclose_f, &
                  h5pset_libver_bounds_f, h5pset_fclose_degree_f, h5pset_obj_track_times_f, &
                  h5pset_link_phase_change_f, &
                  h5gcreate_f, h5gclose_f, h5oopen_f, h5oclose_f, h5aexists_f, h5adelete_f, &
                  h5acreate_f, h5awrite_f, h5aclose_f, h5screate_f, h5screate_simple_f, &
                  h5sclose_f, h5dcreate_f, h5dwrite_f, h5dclose_f, h5tcopy_f, h5tset_size_f, &
                  h5tset_strpad_f, h5tset_cset_f, h5tclose_f, h5f_acc_trunc_f, h5f_libver_v18_f, &
                  h5f_close_strong_f, h5f_scope_global_f, h5p_file_create_f, h5p_file_access_f, &
                  h5p_group_create_f, h5p_dataset_create_f, h5s_scalar_f, h5t_native_double, &
                  h5t_native_integer, h5t_ieee_f64le, h5t_std_i32le, h5t_fortran_s1, &
                  h5t_str_nullpad_f, h5t_cset_utf8_f
  use kinds, only: wp
  use errors, only: error_t, fail, exit_io
  use output_dimensions, only: get_powers
  implicit none
  private

  public :: hdf5_file_t, about_t

  !> What a dataset holds; kept as its attributes.
  type :: about_t
    character(len=220) :: dimension = "1"     !< of all columns or each, see `output_dimensions`
    character(len=80) :: axes = ""           !< one after the other, separated by semicolons
    character(len=120) :: description = ""
  end type about_t

  type :: hdf5_file_t
    integer(hid_t) :: id = 0
    logical :: open = .false.
    character(len=:), allocatable :: path
    type(error_t), allocatable :: failure      !< the first one
  contains
    procedure :: create
    procedure :: flush => flush_file
    procedure :: close => close_file
    procedure :: check
    procedure :: group
    procedure :: set_number
    procedure :: set_text
    procedure :: describe
    procedure, private :: write_integers, write_integer_table, write_reals, write_real_table, &
                          write_real_tables, write_text, write_texts
    generic :: write => write_integers, write_integer_table, write_reals, write_real_table, &
                        write_real_tables, write_text, write_texts
  end type hdf5_file_t

  integer(hsize_t), parameter :: scalar(0) = 0_hsize_t

  !> Members of a group that are listed one after the other, without an index.
  integer, parameter :: most_links = 24

contains

  !> Create a file, or empty it. HDF5 is started here: programs that write nothing do not pay.
  subroutine create(self, path, error)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    integer(hid_t) :: creation, access
    integer :: status

    self%path = path
    call h5dont_atexit_f(status)
    call h5open_f(status)
    call self%check(status, "h5open_f")
    call h5eset_auto_f(0, status)
    call new_list(self, h5p_file_create_f, creation)
    call h5pcreate_f(h5p_file_access_f, access, status)
    call h5pset_libver_bounds_f(access, h5f_libver_v18_f, h5f_libver_v18_f, status)
    call self%check(status, "h5pset_libver_bounds_f")
    call h5pset_fclose_degree_f(access, h5f_close_strong_f, status)
    call h5fcreate_f(path, h5f_acc_trunc_f, self%id, status, creation, access)
    call self%check(status, "h5fcreate_f")
    self%open = status >= 0
    call h5pclose_f(creation, status)
    call h5pclose_f(access, status)
    if (allocated(self%failure)) error = self%failure
  end subroutine create

  !> A creation property list without time stamps.
  subroutine new_list(self, class, list)
    type(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: class
    integer(hid_t), intent(out) :: list
    integer :: status

    call h5pcreate_f(class, list, status)
    call self%check(status, "h5pcreate_f")
    call h5pset_obj_track_times_f(list, .false., status)
    call self%check(status, "h5pset_obj_track_times_f")
  end subroutine new_list

  !> Give the system what is still in memory; hands over the first failure.
  subroutine flush_file(self, error)
    class(hdf5_file_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: status

    if (.not. allocated(self%failure)) then
      call h5fflush_f(self%id, h5f_scope_global_f, status)
      call self%check(status, "h5fflush_f")
    end if
    if (allocated(self%failure)) error = self%failure
  end subroutine flush_file

  !> Close the file and all that is open in it; hands over the first failure. After one HDF5 is
  !> left alone, also at the end of the process: it would try again to write, and crash.
  subroutine close_file(self, error)
    class(hdf5_file_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: status

    if (self%open .and. .not. allocated(self%failure)) then
      call h5fclose_f(self%id, status)
      call self%check(status, "h5fclose_f")
      if (status >= 0) call h5close_f(status)
    end if
    self%open = .false.
    if (allocated(self%failure)) error = self%failure
  end subroutine close_file

  !> Keep the first failure.
  subroutine check(self, status, routine)
    class(hdf5_file_t), intent(inout) :: self
    integer, intent(in) :: status
    character(len=*), intent(in) :: routine

    if (status >= 0 .or. allocated(self%failure)) return
    call fail(self%failure, exit_io, "cannot write '"//self%path//"' ("//routine// &
              " failed); is the disk full?")
  end subroutine check

  !> Make a group; those above it exist.
  subroutine group(self, path)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer(hid_t) :: id, list
    integer :: status

    if (allocated(self%failure)) return
    call new_list(self, h5p_group_create_f, list)
    call h5pset_link_phase_change_f(list, most_links, most_links - 1, status)
    call self%check(status, "h5pset_link_phase_change_f")
    call h5gcreate_f(self%id, path, id, status, gcpl_id=list)
    call self%check(status, "h5gcreate_f")
    if (status >= 0) call h5gclose_f(id, status)
    call h5pclose_f(list, status)
  end subroutine group

  !> Set an attribute of a group or dataset to a whole number, new or not.
  subroutine set_number(self, path, name, number)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: number
    integer(hid_t) :: object
    integer, target :: value
    integer :: status

    if (allocated(self%failure)) return
    value = number
    call h5oopen_f(self%id, path, object, status)
    call self%check(status, "h5oopen_f")
    if (status < 0) return
    call set_attribute(self, object, name, h5t_std_i32le, h5t_native_integer, scalar, &
                       c_loc(value))
    call h5oclose_f(object, status)
  end subroutine set_number

  !> Set an attribute of a group or dataset to a text.
  subroutine set_text(self, path, name, text)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, name, text
    integer(hid_t) :: object
    integer :: status

    if (allocated(self%failure)) return
    call h5oopen_f(self%id, path, object, status)
    call self%check(status, "h5oopen_f")
    if (status < 0) return
    call set_text_of(self, object, name, text)
    call h5oclose_f(object, status)
  end subroutine set_text

  subroutine set_text_of(self, object, name, text)
    type(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name, text
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(hid_t) :: type
    integer :: status

    call get_bytes([text], bytes)
    call text_type(self, size(bytes), type)
    call set_attribute(self, object, name, type, type, scalar, c_loc(bytes))
    call h5tclose_f(type, status)
  end subroutine set_text_of

  !> Write an attribute, in place of one of the same name.
  subroutine set_attribute(self, object, name, stored, given, extents, values)
    type(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer(hsize_t), intent(in) :: extents(:)
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: space, attribute
    logical :: exists
    integer :: status

    if (allocated(self%failure)) return
    call h5aexists_f(object, name, exists, status)
    if (exists) call h5adelete_f(object, name, status)
    call make_space(self, extents, space)
    call h5acreate_f(object, name, stored, space, attribute, status)
    call self%check(status, "h5acreate_f")
    call h5sclose_f(space, status)
    if (allocated(self%failure)) return
    call h5awrite_f(attribute, given, values, status)
    call self%check(status, "h5awrite_f")
    call h5aclose_f(attribute, status)
    call self%check(status, "h5aclose_f")
  end subroutine set_attribute

  !> Put what a dataset holds into its attributes.
  subroutine describe(self, dataset, about)
    class(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: dataset
    type(about_t), intent(in) :: about
    integer, allocatable, target :: powers(:, :)
    integer(hsize_t) :: extents(2)

    call get_powers(trim(about%dimension), powers)
    extents = shape(powers, kind=hsize_t)
    call set_attribute(self, dataset, "dimension", h5t_std_i32le, h5t_native_integer, &
                       extents(:merge(1, 2, extents(2) == 1)), c_loc(powers))
    call set_text_of(self, dataset, "axes", trim(about%axes))
    call set_text_of(self, dataset, "description", trim(about%description))
  end subroutine describe

  subroutine write_integers(self, path, values, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer, intent(in), contiguous, target :: values(:)
    type(about_t), intent(in) :: about
    type(c_ptr) :: address

    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    call write_dataset(self, path, h5t_std_i32le, h5t_native_integer, &
                       [size(values, kind=hsize_t)], address, about)
  end subroutine write_integers

  subroutine write_integer_table(self, path, values, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer, intent(in), contiguous, target :: values(:, :)  !< (columns, rows)
    type(about_t), intent(in) :: about
    type(c_ptr) :: address

    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    call write_dataset(self, path, h5t_std_i32le, h5t_native_integer, &
                       int([size(values, 1), size(values, 2)], hsize_t), address, about)
  end subroutine write_integer_table

  subroutine write_reals(self, path, values, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    real(wp), intent(in), contiguous, target :: values(:)
    type(about_t), intent(in) :: about
    type(c_ptr) :: address

    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    call write_dataset(self, path, h5t_ieee_f64le, h5t_native_double, &
                       [size(values, kind=hsize_t)], address, about)
  end subroutine write_reals

  subroutine write_real_table(self, path, values, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    real(wp), intent(in), contiguous, target :: values(:, :)  !< (columns, rows)
    type(about_t), intent(in) :: about
    type(c_ptr) :: address

    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    call write_dataset(self, path, h5t_ieee_f64le, h5t_native_double, &
                       int([size(values, 1), size(values, 2)], hsize_t), address, about)
  end subroutine write_real_table

  !> A table for each entry of a list.
  subroutine write_real_tables(self, path, values, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    real(wp), intent(in), contiguous, target :: values(:, :, :)  !< (columns, rows, entries)
    type(about_t), intent(in) :: about
    type(c_ptr) :: address

    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    call write_dataset(self, path, h5t_ieee_f64le, h5t_native_double, &
                       shape(values, kind=hsize_t), address, about)
  end subroutine write_real_tables

  !> One text, whatever its length.
  subroutine write_text(self, path, text, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, text
    type(about_t), intent(in) :: about

    call write_strings(self, path, [text], scalar, about)
  end subroutine write_text

  !> A list of words, all as long as the longest.
  subroutine write_texts(self, path, words, about)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, words(:)
    type(about_t), intent(in) :: about

    call write_strings(self, path, words, [size(words, kind=hsize_t)], about)
  end subroutine write_texts

  subroutine write_strings(self, path, words, extents, about)
    type(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, words(:)
    integer(hsize_t), intent(in) :: extents(:)
    type(about_t), intent(in) :: about
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(hid_t) :: type
    integer :: status

    if (allocated(self%failure)) return
    call get_bytes(words, bytes)
    call text_type(self, size(bytes)/max(1, size(words)), type)
    call write_dataset(self, path, type, type, extents, c_loc(bytes), about)
    call h5tclose_f(type, status)
  end subroutine write_strings

  subroutine write_dataset(self, path, stored, given, extents, values, about)
    type(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer(hsize_t), intent(in) :: extents(:)
    type(c_ptr), intent(in) :: values
    type(about_t), intent(in) :: about
    integer(hid_t) :: space, list, dataset
    integer :: status

    if (allocated(self%failure)) return
    call make_space(self, extents, space)
    call new_list(self, h5p_dataset_create_f, list)
    call h5dcreate_f(self%id, path, stored, space, dataset, status, dcpl_id=list)
    call self%check(status, "h5dcreate_f")
    call h5pclose_f(list, status)
    call h5sclose_f(space, status)
    if (allocated(self%failure)) return
    if (all(extents > 0)) call h5dwrite_f(dataset, given, values, status)
    call self%check(status, "h5dwrite_f")
    call self%describe(dataset, about)
    call h5dclose_f(dataset, status)
  end subroutine write_dataset

  !> A dataspace; without extents it holds one value.
  subroutine make_space(self, extents, space)
    type(hdf5_file_t), intent(inout) :: self
    integer(hsize_t), intent(in) :: extents(:)
    integer(hid_t), intent(out) :: space
    integer :: status

    if (size(extents) == 0) then
      call h5screate_f(h5s_scalar_f, space, status)
    else
      call h5screate_simple_f(size(extents), extents, space, status)
    end if
    call self%check(status, "h5screate_f")
  end subroutine make_space

  !> The type of texts of `width` bytes, filled up with zeros.
  subroutine text_type(self, width, type)
    type(hdf5_file_t), intent(inout) :: self
    integer, intent(in) :: width
    integer(hid_t), intent(out) :: type
    integer :: status

    call h5tcopy_f(h5t_fortran_s1, type, status)
    call h5tset_size_f(type, int(width, size_t), status)
    call self%check(status, "h5tset_size_f")
    call h5tset_strpad_f(type, h5t_str_nullpad_f, status)
    call h5tset_cset_f(type, h5t_cset_utf8_f, status)
    call self%check(status, "h5tset_cset_f")
  end subroutine text_type

  !> The bytes of words, each as wide as the longest, at least one, filled up with zeros.
  pure subroutine get_bytes(words, bytes)
    character(len=*), intent(in) :: words(:)
    character(kind=c_char), allocatable, intent(out) :: bytes(:)
    integer :: width, i, j

    width = 1
    do i = 1, size(words)
      width = max(width, len_trim(words(i)))
    end do
    allocate (bytes(width*max(1, size(words))))
    bytes = c_null_char
    do i = 1, size(words)
      do j = 1, len_trim(words(i))
        bytes((i - 1)*width + j) = words(i)(j:j)
      end do
    end do
  end subroutine get_bytes

end module output_hdf5
