!> Reads some rows of a dataset.
module output_slab
  use, intrinsic :: iso_c_binding, only: c_ptr
  use hdf5, only: hid_t, hsize_t, h5dopen_f, h5dclose_f, h5dread_f, h5dget_space_f, h5sclose_f, &
                  h5screate_simple_f, h5sselect_hyperslab_f, h5sget_simple_extent_ndims_f, &
                  h5sget_simple_extent_dims_f, h5s_select_set_f
  use kinds, only: i8
  implicit none
  private

  public :: read_slab

contains

  !> Rows of a list, or of a table of so many columns, from row `first`, counted from 0. `status` is
  !> negative if the dataset is not there, has others, or fewer.
  subroutine read_slab(file, path, type, columns, first, rows, values, status)
    integer(hid_t), intent(in) :: file, type       !< type in memory
    character(len=*), intent(in) :: path
    integer, intent(in) :: columns
    integer(i8), intent(in) :: first, rows         !< at least one
    type(c_ptr), intent(in) :: values              !< room for them
    integer, intent(out) :: status
    integer(hid_t) :: dataset, space, memory
    integer(hsize_t) :: extents(2), most(2), start(2), part(2)
    type(c_ptr) :: address
    integer :: rank, k, ignored

    call h5dopen_f(file, path, dataset, status)
    if (status < 0) return
    call h5dget_space_f(dataset, space, status)
    call h5sget_simple_extent_ndims_f(space, rank, status)
    extents = [int(columns, hsize_t), 0_hsize_t]
    k = 3 - rank
    status = -1
    if (k == 1 .or. k == 2) call h5sget_simple_extent_dims_f(space, extents(k:), most(k:), status)
    if (extents(1) /= columns .or. extents(2) < first + rows) status = -1
    if (status >= 0) then
      start = [0_hsize_t, int(first, hsize_t)]
      part = [extents(1), int(rows, hsize_t)]
      call h5sselect_hyperslab_f(space, h5s_select_set_f, start(k:), part(k:), status)
      call h5screate_simple_f(rank, part(k:), memory, status)
      address = values
      call h5dread_f(dataset, type, address, status, memory, space)
      call h5sclose_f(memory, ignored)
    end if
    call h5sclose_f(space, ignored)
    call h5dclose_f(dataset, ignored)
  end subroutine read_slab

end module output_slab
