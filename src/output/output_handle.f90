!> A file that the HDF5 library writes: its life, its groups, and arrays of any type in it.
!>
!> A failure stays in the handle and silences what follows; `flush` and `close` hand it over.
!> Files of equal contents are equal byte by byte.
module output_handle
  use, intrinsic :: iso_c_binding, only: c_ptr, c_char, c_null_char
  use hdf5, only: hid_t, hsize_t, size_t, h5dont_atexit_f, h5open_f, h5close_f, h5eset_auto_f, &
                  h5fcreate_f, h5fclose_f, h5fflush_f, h5pcreate_f, h5pclose_f, &
                  h5pset_libver_bounds_f, h5pset_fclose_degree_f, h5pset_obj_track_times_f, &
                  h5pset_link_phase_change_f, h5pset_fill_time_f, h5d_fill_time_never_f, &
                  h5gcreate_f, h5gclose_f, h5acreate_f, h5awrite_f, h5aclose_f, h5screate_f, &
                  h5screate_simple_f, &
                  h5sclose_f, h5dcreate_f, h5dwrite_f, h5tcopy_f, h5tset_size_f, &
                  h5tset_strpad_f, h5tset_cset_f, h5f_acc_trunc_f, h5f_libver_v18_f, &
                  h5f_close_strong_f, h5f_scope_global_f, h5p_file_create_f, h5p_file_access_f, &
                  h5p_group_create_f, h5p_dataset_create_f, h5p_dataset_access_f, h5s_scalar_f, &
                  h5t_fortran_s1, h5t_str_nullpad_f, h5t_cset_utf8_f
  use errors, only: error_t, fail, exit_io
  implicit none
  private

  public :: handle_t

  type :: handle_t
    integer(hid_t) :: id = 0
    logical :: open = .false.
    character(len=:), allocatable :: path
    type(error_t), allocatable :: failure               !< the first one
    integer(hid_t) :: group_list = 0, dataset_list = 0  !< how they are created: without times
    integer(hid_t) :: table_list = 0, table_access = 0  !< the same of what grows
    integer(hid_t) :: piece_list = 0                    !< by pieces not filled with zeros before
    integer(hid_t) :: text_type = 0                     !< of one byte, filled up with zeros
  contains
    procedure :: create
    procedure :: flush => flush_file
    procedure :: close => close_file
    procedure :: check
    procedure :: group
    procedure :: get_text_type
    procedure :: put_attribute
    procedure :: put_dataset
  end type handle_t

  !> Members of a group that are listed one after the other, without an index.
  integer, parameter :: most_links = 24

contains

  !> Create a file, or empty it. HDF5 is started here: programs that write nothing do not pay.
  subroutine create(self, path, error)
    class(handle_t), intent(inout) :: self
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
    call prepare(self)
    if (allocated(self%failure)) error = self%failure
  end subroutine create

  !> What is needed again and again; it lives as long as the library.
  subroutine prepare(self)
    type(handle_t), intent(inout) :: self
    integer :: status

    call new_list(self, h5p_dataset_create_f, self%dataset_list)
    call new_list(self, h5p_dataset_create_f, self%table_list)
    call new_list(self, h5p_dataset_create_f, self%piece_list)
    call h5pset_fill_time_f(self%piece_list, h5d_fill_time_never_f, status)
    call h5pcreate_f(h5p_dataset_access_f, self%table_access, status)
    call new_list(self, h5p_group_create_f, self%group_list)
    call h5pset_link_phase_change_f(self%group_list, most_links, most_links - 1, status)
    call self%check(status, "h5pset_link_phase_change_f")
    call h5tcopy_f(h5t_fortran_s1, self%text_type, status)
    call h5tset_strpad_f(self%text_type, h5t_str_nullpad_f, status)
    call h5tset_cset_f(self%text_type, h5t_cset_utf8_f, status)
    call self%check(status, "h5tset_cset_f")
  end subroutine prepare

  !> A creation property list without time stamps.
  subroutine new_list(self, class, list)
    type(handle_t), intent(inout) :: self
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
    class(handle_t), intent(inout) :: self
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
    class(handle_t), intent(inout) :: self
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
    class(handle_t), intent(inout) :: self
    integer, intent(in) :: status
    character(len=*), intent(in) :: routine

    if (status >= 0 .or. allocated(self%failure)) return
    call fail(self%failure, exit_io, "cannot write '"//self%path//"' ("//routine// &
              " failed); is the disk full?")
  end subroutine check

  !> Make a group; those above it exist.
  subroutine group(self, path)
    class(handle_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer(hid_t) :: id
    integer :: status

    if (allocated(self%failure)) return
    call h5gcreate_f(self%id, path, id, status, gcpl_id=self%group_list)
    call self%check(status, "h5gcreate_f")
    if (status >= 0) call h5gclose_f(id, status)
  end subroutine group

  !> The type of texts of `width` bytes, filled up with zeros; to be closed.
  subroutine get_text_type(self, width, type)
    class(handle_t), intent(inout) :: self
    integer, intent(in) :: width
    integer(hid_t), intent(out) :: type
    integer :: status

    call h5tcopy_f(self%text_type, type, status)
    call h5tset_size_f(type, int(width, size_t), status)
    call self%check(status, "h5tset_size_f")
  end subroutine get_text_type

  !> Write an attribute that is new.
  subroutine put_attribute(self, object, name, stored, given, extents, values)
    class(handle_t), intent(inout) :: self
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer(hsize_t), intent(in) :: extents(:)    !< none: one value
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: space, attribute
    integer :: status

    if (allocated(self%failure)) return
    call make_space(self, extents, space)
    call h5acreate_f(object, name, stored, space, attribute, status)
    call self%check(status, "h5acreate_f")
    call h5sclose_f(space, status)
    if (allocated(self%failure)) return
    call h5awrite_f(attribute, given, values, status)
    call self%check(status, "h5awrite_f")
    call h5aclose_f(attribute, status)
    call self%check(status, "h5aclose_f")
  end subroutine put_attribute

  !> Write a dataset in one piece. It stays open, unless there is a failure.
  subroutine put_dataset(self, path, stored, given, extents, values, dataset)
    class(handle_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer(hsize_t), intent(in) :: extents(:)    !< none: one value
    type(c_ptr), intent(in) :: values
    integer(hid_t), intent(out) :: dataset
    integer(hid_t) :: space
    integer :: status

    dataset = 0
    if (allocated(self%failure)) return
    call make_space(self, extents, space)
    call h5dcreate_f(self%id, path, stored, space, dataset, status, dcpl_id=self%dataset_list)
    call self%check(status, "h5dcreate_f")
    call h5sclose_f(space, status)
    if (allocated(self%failure)) return
    if (all(extents > 0)) call h5dwrite_f(dataset, given, values, status)
    call self%check(status, "h5dwrite_f")
  end subroutine put_dataset

  !> A dataspace; without extents it holds one value.
  subroutine make_space(self, extents, space)
    type(handle_t), intent(inout) :: self
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

end module output_handle
