!> Arrays and attributes of the result file that are written once and have no description: those of
!> formats that others define.
module output_arrays
  use, intrinsic :: iso_fortran_env, only: i1 => int8
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc, c_char
  use hdf5, only: hid_t, hsize_t, size_t, h5oopen_f, h5oclose_f, h5dclose_f, h5tcopy_f, &
                  h5tclose_f, h5tset_size_f, h5tset_strpad_f, h5t_fortran_s1, h5t_str_nullpad_f, &
                  h5t_std_i64le, h5t_std_u8le, h5kind_to_type, h5_integer_kind
  use kinds, only: i8
  use output_hdf5, only: hdf5_file_t
  implicit none
  private

  public :: write_longs, write_bytes, set_longs, set_ascii

  integer(hsize_t), parameter :: scalar(0) = 0_hsize_t

contains

  !> A list of long whole numbers.
  subroutine write_longs(file, path, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer, intent(in) :: values(:)
    integer(i8), target :: longs(size(values))

    longs = values
    call write_list(file, path, h5t_std_i64le, h5kind_to_type(i8, h5_integer_kind), &
                    size(values), c_loc(longs))
  end subroutine write_longs

  !> A list of whole numbers from 0 to 127.
  subroutine write_bytes(file, path, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer, intent(in) :: values(:)
    integer(i1), target :: bytes(size(values))

    bytes = int(values, i1)
    call write_list(file, path, h5t_std_u8le, h5t_std_u8le, size(values), c_loc(bytes))
  end subroutine write_bytes

  subroutine write_list(file, path, stored, given, entries, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer, intent(in) :: entries
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: dataset
    integer :: status

    call file%put_dataset(path, stored, given, [int(entries, hsize_t)], values, dataset)
    if (.not. allocated(file%failure)) call h5dclose_f(dataset, status)
  end subroutine write_list

  !> An attribute of long whole numbers.
  subroutine set_longs(file, path, name, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: values(:)
    integer(i8), target :: longs(size(values))

    longs = values
    call set_new(file, path, name, h5t_std_i64le, h5kind_to_type(i8, h5_integer_kind), &
                 [size(values, kind=hsize_t)], c_loc(longs))
  end subroutine set_longs

  !> An attribute that is a text in ASCII; that of `set_text` is UTF-8.
  subroutine set_ascii(file, path, name, text)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path, name, text
    character(kind=c_char), target :: letters(len(text))
    integer(hid_t) :: type
    integer :: status, i

    do i = 1, len(text)
      letters(i) = text(i:i)
    end do
    call h5tcopy_f(h5t_fortran_s1, type, status)
    call h5tset_size_f(type, len(text, size_t), status)
    call h5tset_strpad_f(type, h5t_str_nullpad_f, status)
    call set_new(file, path, name, type, type, scalar, c_loc(letters))
    call h5tclose_f(type, status)
  end subroutine set_ascii

  !> An attribute that an object does not have yet.
  subroutine set_new(file, path, name, stored, given, extents, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path, name
    integer(hid_t), intent(in) :: stored, given
    integer(hsize_t), intent(in) :: extents(:)
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: object
    integer :: status

    if (allocated(file%failure)) return
    call h5oopen_f(file%id, path, object, status)
    call file%check(status, "h5oopen_f")
    call file%put_attribute(object, name, stored, given, extents, values)
    if (.not. allocated(file%failure)) call h5oclose_f(object, status)
  end subroutine set_new

end module output_arrays
