!> Reads result files in tests.
module result_reader
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc, c_char, c_null_char
  use hdf5, only: hid_t, hsize_t, size_t, h5open_f, h5eset_auto_f, h5fopen_f, h5fclose_f, &
                  h5oopen_f, h5oclose_f, h5dopen_f, h5dclose_f, h5dread_f, h5dget_space_f, &
                  h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, h5sclose_f, &
                  h5aopen_f, h5aclose_f, h5aread_f, h5aget_type_f, h5aget_space_f, &
                  h5tget_size_f, h5tclose_f, h5f_acc_rdonly_f, h5t_native_double, &
                  h5t_native_integer
  use kinds, only: wp
  implicit none
  private

  public :: get_reals, get_integers, get_text, get_numbers

contains

  !> All values of a dataset, the last index of the file fastest, and its extents as the file
  !> has them; no values if it cannot be read.
  subroutine get_reals(path, name, values, extents)
    character(len=*), intent(in) :: path, name
    real(wp), allocatable, target, intent(out) :: values(:)
    integer, allocatable, intent(out) :: extents(:)
    integer(hid_t) :: file, dataset
    type(c_ptr) :: address
    integer :: status

    call open_dataset(path, name, file, dataset, extents)
    allocate (values(product(extents)))
    values = 0.0_wp
    if (size(values) > 0) address = c_loc(values)
    if (size(values) > 0) call h5dread_f(dataset, h5t_native_double, address, status)
    call close_dataset(file, dataset)
  end subroutine get_reals

  !> The same for whole numbers.
  subroutine get_integers(path, name, values, extents)
    character(len=*), intent(in) :: path, name
    integer, allocatable, target, intent(out) :: values(:)
    integer, allocatable, intent(out) :: extents(:)
    integer(hid_t) :: file, dataset
    type(c_ptr) :: address
    integer :: status

    call open_dataset(path, name, file, dataset, extents)
    allocate (values(product(extents)))
    values = 0
    if (size(values) > 0) address = c_loc(values)
    if (size(values) > 0) call h5dread_f(dataset, h5t_native_integer, address, status)
    call close_dataset(file, dataset)
  end subroutine get_integers

  !> A dataset that cannot be opened has the extents [0].
  subroutine open_dataset(path, name, file, dataset, extents)
    character(len=*), intent(in) :: path, name
    integer(hid_t), intent(out) :: file, dataset
    integer, allocatable, intent(out) :: extents(:)
    integer(hid_t) :: space
    integer :: status

    dataset = -1
    call open_file(path, file)
    if (file >= 0) call h5dopen_f(file, name, dataset, status)
    if (dataset < 0) then
      extents = [0]
      return
    end if
    call h5dget_space_f(dataset, space, status)
    call get_extents(space, extents)
  end subroutine open_dataset

  subroutine get_extents(space, extents)
    integer(hid_t), intent(in) :: space
    integer, allocatable, intent(out) :: extents(:)
    integer(hsize_t) :: present(4), largest(4)
    integer :: rank, status, i

    call h5sget_simple_extent_ndims_f(space, rank, status)
    call h5sget_simple_extent_dims_f(space, present, largest, status)
    call h5sclose_f(space, status)
    allocate (extents(rank))
    do i = 1, rank
      extents(i) = int(present(rank + 1 - i))
    end do
  end subroutine get_extents

  subroutine open_file(path, file)
    character(len=*), intent(in) :: path
    integer(hid_t), intent(out) :: file
    integer :: status

    call h5open_f(status)
    call h5eset_auto_f(0, status)
    call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
    if (status < 0) file = -1
  end subroutine open_file

  subroutine close_dataset(file, dataset)
    integer(hid_t), intent(in) :: file, dataset
    integer :: status

    if (dataset >= 0) call h5dclose_f(dataset, status)
    if (file >= 0) call h5fclose_f(file, status)
  end subroutine close_dataset

  !> A text attribute of a group or dataset, without the zeros at its end; "?" if there is none.
  subroutine get_text(path, object, name, text)
    character(len=*), intent(in) :: path, object, name
    character(len=:), allocatable, intent(out) :: text
    character(kind=c_char), allocatable, target :: bytes(:)
    integer(hid_t) :: file, owner, attribute, type
    integer(size_t) :: width
    type(c_ptr) :: address
    integer :: status, i

    text = "?"
    call open_attribute(path, object, name, file, owner, attribute)
    if (attribute >= 0) then
      call h5aget_type_f(attribute, type, status)
      call h5tget_size_f(type, width, status)
      allocate (bytes(width))
      address = c_loc(bytes)
      call h5aread_f(attribute, type, address, status)
      call h5tclose_f(type, status)
      text = ""
      do i = 1, size(bytes)
        if (bytes(i) /= c_null_char) text = text//bytes(i)
      end do
    end if
    call close_attribute(file, owner, attribute)
  end subroutine get_text

  !> A numeric attribute of a group or dataset as whole numbers; none if there is none.
  subroutine get_numbers(path, object, name, values)
    character(len=*), intent(in) :: path, object, name
    integer, allocatable, target, intent(out) :: values(:)
    integer, allocatable :: extents(:)
    integer(hid_t) :: file, owner, attribute, space
    type(c_ptr) :: address
    integer :: status

    call open_attribute(path, object, name, file, owner, attribute)
    if (attribute >= 0) then
      call h5aget_space_f(attribute, space, status)
      call get_extents(space, extents)
      allocate (values(product(extents)))
      address = c_loc(values)
      call h5aread_f(attribute, h5t_native_integer, address, status)
    else
      allocate (values(0))
    end if
    call close_attribute(file, owner, attribute)
  end subroutine get_numbers

  subroutine open_attribute(path, object, name, file, owner, attribute)
    character(len=*), intent(in) :: path, object, name
    integer(hid_t), intent(out) :: file, owner, attribute
    integer :: status

    owner = -1
    attribute = -1
    call open_file(path, file)
    if (file < 0) return
    call h5oopen_f(file, object, owner, status)
    if (status < 0) owner = -1
    if (owner < 0) return
    call h5aopen_f(owner, name, attribute, status)
    if (status < 0) attribute = -1
  end subroutine open_attribute

  subroutine close_attribute(file, owner, attribute)
    integer(hid_t), intent(in) :: file, owner, attribute
    integer :: status

    if (attribute >= 0) call h5aclose_f(attribute, status)
    if (owner >= 0) call h5oclose_f(owner, status)
    if (file >= 0) call h5fclose_f(file, status)
  end subroutine close_attribute

end module result_reader
