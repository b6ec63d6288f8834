!> Arrays and attributes of the result file that are written once and have no description: those of
!> formats that others define.
module output_arrays
  use, intrinsic :: iso_fortran_env, only: i1 => int8
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc, c_char
  use hdf5, only: hid_t, hsize_t, size_t, h5oopen_f, h5oclose_f, h5acreate_f, h5awrite_f, &
                  h5aclose_f, h5pcreate_f, h5pclose_f, h5pset_obj_track_times_f, h5screate_f, &
                  h5screate_simple_f, h5sclose_f, h5dcreate_f, h5dwrite_f, h5dclose_f, &
                  h5tcopy_f, h5tclose_f, h5tset_size_f, h5tset_strpad_f, h5p_dataset_create_f, &
                  h5s_scalar_f, h5t_fortran_s1, h5t_str_nullpad_f, h5t_std_i64le, h5t_std_u8le, &
                  h5kind_to_type, h5_integer_kind
  use kinds, only: i8
  use output_hdf5, only: hdf5_file_t
  implicit none
  private

  public :: write_longs, write_bytes, set_longs, set_ascii

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

  !> A dataset in one piece, without time stamps.
  subroutine write_list(file, path, stored, given, entries, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(hid_t), intent(in) :: stored, given   !< types in the file and in memory
    integer, intent(in) :: entries
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: list, space, dataset
    integer :: status

    if (allocated(file%failure)) return
    call h5pcreate_f(h5p_dataset_create_f, list, status)
    call h5pset_obj_track_times_f(list, .false., status)
    call file%check(status, "h5pset_obj_track_times_f")
    call h5screate_simple_f(1, [int(entries, hsize_t)], space, status)
    call h5dcreate_f(file%id, path, stored, space, dataset, status, dcpl_id=list)
    call file%check(status, "h5dcreate_f")
    call h5sclose_f(space, status)
    call h5pclose_f(list, status)
    if (allocated(file%failure)) return
    call h5dwrite_f(dataset, given, values, status)
    call file%check(status, "h5dwrite_f")
    call h5dclose_f(dataset, status)
  end subroutine write_list

  !> An attribute of long whole numbers.
  subroutine set_longs(file, path, name, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: values(:)
    integer(i8), target :: longs(size(values))
    integer(hid_t) :: space
    integer :: status

    longs = values
    call h5screate_simple_f(1, [size(values, kind=hsize_t)], space, status)
    call write_attribute(file, path, name, h5t_std_i64le, h5kind_to_type(i8, h5_integer_kind), &
                         space, c_loc(longs))
    call h5sclose_f(space, status)
  end subroutine set_longs

  !> An attribute that is a text in ASCII; that of `set_text` is UTF-8.
  subroutine set_ascii(file, path, name, text)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path, name, text
    character(kind=c_char), target :: letters(len(text))
    integer(hid_t) :: space, type
    integer :: status, i

    do i = 1, len(text)
      letters(i) = text(i:i)
    end do
    call h5tcopy_f(h5t_fortran_s1, type, status)
    call h5tset_size_f(type, len(text, size_t), status)
    call h5tset_strpad_f(type, h5t_str_nullpad_f, status)
    call h5screate_f(h5s_scalar_f, space, status)
    call write_attribute(file, path, name, type, type, space, c_loc(letters))
    call h5sclose_f(space, status)
    call h5tclose_f(type, status)
  end subroutine set_ascii

  subroutine write_attribute(file, path, name, stored, given, space, values)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path, name
    integer(hid_t), intent(in) :: stored, given, space
    type(c_ptr), intent(in) :: values
    integer(hid_t) :: object, attribute
    integer :: status

    if (allocated(file%failure)) return
    call h5oopen_f(file%id, path, object, status)
    call file%check(status, "h5oopen_f")
    call h5acreate_f(object, name, stored, space, attribute, status)
    call file%check(status, "h5acreate_f")
    if (allocated(file%failure)) return
    call h5awrite_f(attribute, given, values, status)
    call file%check(status, "h5awrite_f")
    call h5aclose_f(attribute, status)
    call h5oclose_f(object, status)
  end subroutine write_attribute

end module output_arrays
