!> A file of the HDF5 library: groups, attributes, datasets, datasets that grow by rows.
!>
!> A failure stays in the file and silences what follows; `flush` and `close` hand it over, so that
!> a run of calls is checked once. Files of equal contents are equal byte by byte.
module output_hdf5
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc, c_char, c_null_char
  use hdf5, only: hid_t, hsize_t, h5open_f, h5close_f, h5eset_auto_f, h5fcreate_f, h5fopen_f, &
                  h5fclose_f, h5fflush_f, h5pcreate_f, h5pclose_f, h5pset_libver_bounds_f, &
                  h5pset_fclose_degree_f, h5pset_obj_track_times_f, h5pset_chunk_f, &
                  h5gcreate_f, h5gclose_f, h5acreate_f, h5aopen_f, h5awrite_f, h5aclose_f, &
                  h5screate_f, h5screate_simple_f, h5sclose_f, h5sselect_hyperslab_f, &
                  h5dcreate_f, h5dset_extent_f, h5dget_space_f, h5dwrite_f, h5dclose_f, &
                  h5tcopy_f, h5tset_size_f, h5tset_strpad_f, h5tset_cset_f, h5tclose_f, &
                  h5f_acc_trunc_f, h5f_libver_v18_f, h5f_close_strong_f, h5f_scope_global_f, &
                  h5p_default_f, h5p_file_create_f, h5p_file_access_f, h5p_group_create_f, &
                  h5p_dataset_create_f, h5s_scalar_f, h5s_select_set_f, h5s_unlimited_f, &
                  h5t_native_double, h5t_native_integer, h5t_ieee_f64le, h5t_std_i32le, &
                  h5t_fortran_s1, h5t_str_nullpad_f, h5t_cset_utf8_f
  use kinds, only: wp
  use errors, only: error_t, fail, exit_io
  use text, only: string_t
  use output_dimensions, only: dimension_powers
  implicit none
  private

  public :: hdf5_file_t, growing_t, about_t

  integer, parameter :: chunk_bytes = 16384   !< size of the pieces in which datasets grow

  !> What a dataset holds.
  type :: about_t
    character(len=:), allocatable :: dimension    !< "F FL": see `output_dimensions`
    character(len=:), allocatable :: axes         !< "step*node; X Y Z"
    character(len=:), allocatable :: description
  end type about_t

  !> A dataset to which rows are added.
  type :: growing_t
    private
    integer(hid_t) :: id = 0
    integer(hsize_t) :: columns = 0    !< 0: one-dimensional
    integer(hsize_t) :: rows = 0
  end type growing_t

  type :: hdf5_file_t
    private
    integer(hid_t) :: id = 0, group_list = 0, dataset_list = 0
    logical :: open = .false.
    character(len=:), allocatable :: path
    type(error_t), allocatable :: failure
  contains
    procedure, public :: create
    procedure, public :: flush => flush_file
    procedure, public :: close => close_file
    procedure, public :: group
    procedure, public :: set_number
    procedure, public :: set_text
    procedure, private :: write_integers, write_integer_table, write_reals, write_real_table
    procedure, private :: write_text, write_texts
    generic, public :: write => write_integers, write_integer_table, write_reals, &
                                write_real_table, write_text, write_texts
    procedure, public :: start_integers
    procedure, public :: start_reals
    procedure, private :: append_integer, append_reals, append_real_table
    generic, public :: append => append_integer, append_reals, append_real_table
    procedure, public :: finish
    procedure, private :: check
  end type hdf5_file_t

contains

  !> Create a file, or empty it. HDF5 is started here: programs that write nothing do not pay.
  subroutine create(self, path, error)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    integer(hid_t) :: creation, access
    integer :: status

    self%path = path
    call h5open_f(status)
    call self%check(status, "h5open_f")
    call h5eset_auto_f(0, status)
    call h5pcreate_f(h5p_file_create_f, creation, status)
    call h5pset_obj_track_times_f(creation, .false., status)
    call self%check(status, "h5pset_obj_track_times_f")
    call h5pcreate_f(h5p_file_access_f, access, status)
    call h5pset_libver_bounds_f(access, h5f_libver_v18_f, h5f_libver_v18_f, status)
    call self%check(status, "h5pset_libver_bounds_f")
    call h5pset_fclose_degree_f(access, h5f_close_strong_f, status)
    call h5pcreate_f(h5p_group_create_f, self%group_list, status)
    call h5pset_obj_track_times_f(self%group_list, .false., status)
    call h5pcreate_f(h5p_dataset_create_f, self%dataset_list, status)
    call h5pset_obj_track_times_f(self%dataset_list, .false., status)
    call self%check(status, "h5pset_obj_track_times_f")
    call h5fcreate_f(path, h5f_acc_trunc_f, self%id, status, creation, access)
    call self%check(status, "h5fcreate_f")
    self%open = .not. allocated(self%failure)
    call h5pclose_f(creation, status)
    call h5pclose_f(access, status)
    if (allocated(self%failure)) error = self%failure
  end subroutine create

  !> Write to the disk what is still in memory; hands over the first failure.
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

  !> Close the file and all that is open in it; hands over the first failure.
  subroutine close_file(self, error)
    class(hdf5_file_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: status

    if (self%open) then
      call h5pclose_f(self%group_list, status)
      call h5pclose_f(self%dataset_list, status)
      call h5fclose_f(self%id, status)
      call self%check(status, "h5fclose_f")
      self%open = .false.
      if (.not. allocated(self%failure)) call h5close_f(status)
    end if
    if (allocated(self%failure)) error = self%failure
  end subroutine close_file

  !> Keep the first failure.
  subroutine check(self, status, routine)
    class(hdf5_file_t), intent(inout) :: self
    integer, intent(in) :: status
    character(len=*), intent(in) :: routine

    if (status >= 0 .or. allocated(self%failure)) return
    call fail(self%failure, exit_io, "cannot write '"//self%path//"' ("//routine//" failed)")
  end subroutine check

  !> Make a group; those above it exist.
  subroutine group(self, path)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    integer(hid_t) :: id
    integer :: status

    if (allocated(self%failure)) return
    call h5gcreate_f(self%id, path, id, status, gcpl_id=self%group_list)
    call self%check(status, "h5gcreate_f")
    if (status >= 0) call h5gclose_f(id, status)
  end subroutine group

  !> Set an attribute of a group or dataset to a whole number, new or not.
  subroutine set_number(self, path, name, number)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: number
    integer, target :: value(1)

    value = number
    call write_attribute(self, path, name, h5t_std_i32le, h5t_native_integer, &
                         [integer(hsize_t) ::], c_loc(value))
  end subroutine set_number

  !> Set an attribute of a group or dataset to a text.
  subroutine set_text(self, path, name, text)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, name, text
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(hid_t) :: type

    if (allocated(self%failure)) return
    call to_bytes([text], bytes)
    call text_type(self, size(bytes), type)
    call write_attribute(self, path, name, type, type, [integer(hsize_t) ::], c_loc(bytes))
    call close_type(type)
  end subroutine set_text

  subroutine write_attribute(self, path, name, stored, given, extents, values)
    class(hdf5_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path, name
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer(hsize_t), intent(in) :: extents(:)
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: object
    integer :: status

    if (allocated(self%failure)) return
    call h5oopen_f(self%id, path, object, status)
    call self%check(status, "h5oopen_f")
    if (status < 0) return
    call write_attribute_of(self, object, name, stored, given, extents, values)
    call h5oclose_f(object, status)
  end subroutine write_attribute

  subroutine write_attribute_of(self, object, name, stored, given, extents, values)
    class(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name
    integer(hid_t), intent(in) :: stored, given
    integer(hsize_t), intent(in) :: extents(:)
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: space, attribute
    logical :: exists
    integer :: status

    call h5aexists_f(object, name, exists, status)
    if (exists) then
      call h5aopen_f(object, name, attribute, status)
    else
      call make_space(extents, space, status)
      call h5acreate_f(object, name, stored, space, attribute, status)
      call h5sclose_f(space, exists_status(status))
    end if
    call self%check(status, "h5acreate_f")
    if (status < 0) return
    call h5awrite_f(attribute, given, values, status)
    call self%check(status, "h5awrite_f")
    call h5aclose_f(attribute, status)
    call self%check(status, "h5aclose_f")
  end subroutine write_attribute_of
