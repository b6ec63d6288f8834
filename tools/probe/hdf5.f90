!> Proves HDF5 from Fortran: writes a compressed dataset to the file named by the first
!> argument, reads it back and compares.
program probe_hdf5
  use, intrinsic :: iso_fortran_env, only: real64
  use hdf5, only: h5open_f, h5close_f, h5fcreate_f, h5fopen_f, h5fclose_f, h5screate_simple_f, &
                  h5sclose_f, h5pcreate_f, h5pclose_f, h5pset_chunk_f, h5pset_shuffle_f, &
                  h5pset_deflate_f, h5pset_fletcher32_f, h5dcreate_f, h5dopen_f, h5dwrite_f, &
                  h5dread_f, h5dclose_f, hid_t, hsize_t, h5f_acc_trunc_f, h5f_acc_rdonly_f, &
                  h5p_dataset_create_f, h5t_native_double
  implicit none

  integer, parameter :: n = 1000
  real(real64) :: written(n), found(n)
  character(len=4096) :: path
  integer :: status, i

  call get_command_argument(1, path)
  written = [(sqrt(real(i, real64)), i=1, n)]
  found = 0.0_real64
  call h5open_f(status)
  call check("h5open_f")
  call write_file()
  call read_file()
  call h5close_f(status)
  call check("h5close_f")
  if (maxval(abs(found - written)) > 0.0_real64) error stop "hdf5: read other values than written"

contains

  subroutine write_file()
    integer(hid_t) :: file, space, list, dataset
    integer(hsize_t), parameter :: extent(1) = [int(n, hsize_t)], chunk(1) = [100_hsize_t]

    call h5fcreate_f(trim(path), h5f_acc_trunc_f, file, status)
    call check("h5fcreate_f")
    call h5screate_simple_f(1, extent, space, status)
    call h5pcreate_f(h5p_dataset_create_f, list, status)
    call h5pset_chunk_f(list, 1, chunk, status)
    call h5pset_shuffle_f(list, status)
    call h5pset_deflate_f(list, 4, status)
    call check("h5pset_deflate_f")
    call h5pset_fletcher32_f(list, status)
    call h5dcreate_f(file, "roots", h5t_native_double, space, dataset, status, dcpl_id=list)
    call check("h5dcreate_f")
    call h5dwrite_f(dataset, h5t_native_double, written, extent, status)
    call check("h5dwrite_f")
    call h5dclose_f(dataset, status)
    call h5pclose_f(list, status)
    call h5sclose_f(space, status)
    call h5fclose_f(file, status)
    call check("h5fclose_f")
  end subroutine write_file

  subroutine read_file()
    integer(hid_t) :: file, dataset
    integer(hsize_t), parameter :: extent(1) = [int(n, hsize_t)]

    call h5fopen_f(trim(path), h5f_acc_rdonly_f, file, status)
    call check("h5fopen_f")
    call h5dopen_f(file, "roots", dataset, status)
    call check("h5dopen_f")
    call h5dread_f(dataset, h5t_native_double, found, extent, status)
    call check("h5dread_f")
    call h5dclose_f(dataset, status)
    call h5fclose_f(file, status)
  end subroutine read_file

  subroutine check(routine)
    character(len=*), intent(in) :: routine

    if (status >= 0) return
    print "(a)", routine//" failed"
    error stop
  end subroutine check

end program probe_hdf5
