!> Arrays of the result file that are written once and have no description: those of formats that
!> others define.
module output_arrays
  use, intrinsic :: iso_fortran_env, only: i1 => int8
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc
  use hdf5, only: hid_t, hsize_t, h5pcreate_f, h5pclose_f, h5pset_obj_track_times_f, &
                  h5screate_simple_f, h5sclose_f, h5dcreate_f, h5dwrite_f, h5dclose_f, &
                  h5p_dataset_create_f, h5t_std_i64le, h5t_std_u8le, h5kind_to_type, &
                  h5_integer_kind
  use kinds, only: i8
  use output_hdf5, only: hdf5_file_t
  implicit none
  private

  public :: write_longs, write_bytes

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

end module output_arrays
