!> What is written into a file of the HDF5 library: attributes, and datasets that say what they are.
module output_hdf5
  use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_loc, c_char, c_null_char
  use hdf5, only: hid_t, hsize_t, h5oopen_f, h5oclose_f, h5aexists_f, h5adelete_f, h5dclose_f, &
                  h5tclose_f, h5t_native_double, h5t_native_integer, h5t_ieee_f64le, h5t_std_i32le
  use kinds, only: wp
  use output_dimensions, only: get_powers
  use output_handle, only: handle_t
  implicit none
  private

  public :: hdf5_file_t, about_t

  !> What a dataset holds; kept as its attributes.
  type :: about_t
    character(len=220) :: dimension = "1"     !< of all columns or each, see `output_dimensions`
    character(len=80) :: axes = ""           !< one after the other, separated by semicolons
    character(len=120) :: description = ""
  end type about_t

  type, extends(handle_t) :: hdf5_file_t
  contains
    procedure :: set_number
    procedure :: set_text
    procedure :: describe
    procedure, private :: write_integers, write_integer_table, write_reals, write_real_table, &
                          write_real_tables, write_text, write_texts
    generic :: write => write_integers, write_integer_table, write_reals, write_real_table, &
                        write_real_tables, write_text, write_texts
  end type hdf5_file_t

  integer(hsize_t), parameter :: scalar(0) = 0_hsize_t

contains

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
    call remove_attribute(object, name)
    call self%put_attribute(object, name, h5t_std_i32le, h5t_native_integer, scalar, c_loc(value))
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
    call remove_attribute(object, name)
    call put_text(self, object, name, text)
    call h5oclose_f(object, status)
  end subroutine set_text

  subroutine put_text(self, object, name, text)
    type(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name, text
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(hid_t) :: type
    integer :: status

    call get_bytes([text], bytes)
    call self%get_text_type(size(bytes), type)
    call self%put_attribute(object, name, type, type, scalar, c_loc(bytes))
    call h5tclose_f(type, status)
  end subroutine put_text

  !> Remove an attribute if it is there.
  subroutine remove_attribute(object, name)
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name
    logical :: exists
    integer :: status

    call h5aexists_f(object, name, exists, status)
    if (exists) call h5adelete_f(object, name, status)
  end subroutine remove_attribute

  !> Put what a new dataset holds into its attributes.
  subroutine describe(self, dataset, about)
    class(hdf5_file_t), intent(inout) :: self
    integer(hid_t), intent(in) :: dataset
    type(about_t), intent(in) :: about
    integer, allocatable, target :: powers(:, :)
    integer(hsize_t) :: extents(2)

    call get_powers(trim(about%dimension), powers)
    extents = shape(powers, kind=hsize_t)
    call self%put_attribute(dataset, "dimension", h5t_std_i32le, h5t_native_integer, &
                            extents(:merge(1, 2, extents(2) == 1)), c_loc(powers))
    call put_text(self, dataset, "axes", trim(about%axes))
    call put_text(self, dataset, "description", trim(about%description))
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
    call self%get_text_type(size(bytes)/max(1, size(words)), type)
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
    integer(hid_t) :: dataset
    integer :: status

    call self%put_dataset(path, stored, given, extents, values, dataset)
    if (allocated(self%failure)) return
    call self%describe(dataset, about)
    call h5dclose_f(dataset, status)
  end subroutine write_dataset

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
