!> What the entries of a dataset are measured against: how large others of their kind are. Below
!> that by many digits they are round-off, which no two machines have in common.
module output_scales
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp, i8
  use errors, only: error_t
  use text, only: string_t
  use output_reader, only: reader_t, dataset_t
  implicit none
  private

  public :: get_length, get_scales, column_scales

  !> Least scale of what has to do with places alone, in powers of the model's length.
  real(wp), parameter :: little = 1.0e-5_wp

  !> Rows of the attribute `dimension`.
  integer, parameter :: of_force = 1, of_length = 2, of_time = 3, of_mass = 4

  character(len=*), parameter :: imaginary = "_imaginary", imbalance = "/energy/imbalance", &
                                 reaction = "/nodes/reaction"
  character(len=*), parameter :: motions(3) = ["displacement", "rotation    ", "warping     "]

contains

  !> The model's largest extent; 0 if the file does not say or it has none.
  subroutine get_length(reader, length, error)
    type(reader_t), intent(in) :: reader
    real(wp), intent(out) :: length
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: place
    integer :: k

    length = 0
    if (.not. reader%has("/model/nodes/position")) return
    call reader%read("/model/nodes/position", place, error)
    if (allocated(error)) return
    do k = 1, merge(3, 0, size(place%value) > 0)
      length = max(length, maxval(place%value(k::3)) - minval(place%value(k::3)))
    end do
  end subroutine get_length

  !> By column: the largest entry of the dataset, and of those that it has its round-off from: of
  !> real parts beside imaginary ones, of energies beside their sum, of loads beside reactions, of
  !> rotations beside displacements. Of modes those that are shared may be left out.
  subroutine get_scales(reader, length, dataset, scale, error, shared)
    type(reader_t), intent(in) :: reader
    real(wp), intent(in) :: length      !< of the model, 0: unknown
    type(dataset_t), intent(in) :: dataset
    real(wp), allocatable, intent(out) :: scale(:)
    type(error_t), allocatable, intent(out) :: error
    logical, intent(in), optional :: shared(:)   !< by mode
    type(string_t), allocatable :: paths(:)
    type(dataset_t) :: own, other
    integer :: i

    own = dataset
    if (present(shared)) call clear_shared(shared, own)
    scale = column_scales(own, length)
    call get_companions(reader, dataset%path, paths)
    do i = 1, size(paths)
      if (.not. reader%has(paths(i)%s)) cycle
      call reader%read(paths(i)%s, other, error)
      if (allocated(error)) return
      if (present(shared)) call clear_shared(shared, other)
      scale = max(scale, scales_from(other, dataset, length))
    end do
  end subroutine get_scales

  !> Zero in place of the values of modes that are shared.
  pure subroutine clear_shared(shared, dataset)
    logical, intent(in) :: shared(:)   !< by mode
    type(dataset_t), intent(inout) :: dataset
    integer :: rows, k

    rows = size(dataset%value)/max(1, size(shared))
    do k = 1, size(shared)
      if (shared(k)) dataset%value((k - 1)*rows + 1:k*rows) = 0
    end do
  end subroutine clear_shared

  subroutine get_companions(reader, path, paths)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path
    type(string_t), allocatable, intent(out) :: paths(:)
    integer :: i

    if (ends_with(path, imbalance)) then
      call reader%list(path(:index(path, "/", back=.true.) - 1), paths)
    else if (ends_with(path, reaction)) then
      allocate (paths(1))
      paths(1)%s = path(:len(path) - len(reaction))//"/nodes/load"
    else if (ends_with(path, imaginary)) then
      allocate (paths(1))
      paths(1)%s = path(:len(path) - len(imaginary))
    else if (index(path, "/modes/nodes/") > 0) then
      allocate (paths(size(motions)))
      do i = 1, size(motions)
        paths(i)%s = path(:index(path, "/", back=.true.))//trim(motions(i))
      end do
    else
      allocate (paths(0))
    end if
  end subroutine get_companions

  pure logical function ends_with(path, tail)
    character(len=*), intent(in) :: path, tail

    ends_with = len(path) > len(tail)
    if (ends_with) ends_with = path(len(path) - len(tail) + 1:) == tail
  end function ends_with

  !> By column: the largest entry of all columns of its dimension, or of one that the model's length
  !> makes of it: a force times that is a moment.
  pure function column_scales(dataset, length) result(scale)
    type(dataset_t), intent(in) :: dataset
    real(wp), intent(in) :: length      !< 0: unknown
    real(wp), allocatable :: scale(:)
    integer :: dimension(4, dataset%columns()), k

    scale = scales_from(dataset, dataset, length)
    if (.not. length > 0 .or. size(dataset%dimension) == 0) return
    dimension = dimensions(dataset)
    do k = 1, size(scale)
      if (any(dimension([of_force, of_time, of_mass], k) /= 0)) cycle
      scale(k) = max(scale(k), little*length**dimension(of_length, k))
    end do
  end function column_scales

  !> The largest entries of a dataset as they would stand in the columns of another.
  pure function scales_from(dataset, target, length) result(scale)
    type(dataset_t), intent(in) :: dataset, target
    real(wp), intent(in) :: length      !< 0: unknown
    real(wp), allocatable :: scale(:)
    real(wp) :: largest(dataset%columns())
    integer :: own(4, dataset%columns()), other(4, target%columns()), powers, k, j

    largest = largest_entries(dataset)
    own = dimensions(dataset)
    other = dimensions(target)
    allocate (scale(size(other, 2)), source=0.0_wp)
    do k = 1, size(scale)
      do j = 1, size(largest)
        associate (rest => [of_force, of_time, of_mass])
          if (any(own(rest, j) /= other(rest, k))) cycle
        end associate
        powers = other(of_length, k) - own(of_length, j)
        if (powers == 0) then
          scale(k) = max(scale(k), largest(j))
        else if (length > 0) then
          scale(k) = max(scale(k), largest(j)*length**powers)
        end if
      end do
    end do
  end function scales_from

  !> Dimensions of all columns.
  pure function dimensions(dataset)
    type(dataset_t), intent(in) :: dataset
    integer :: dimensions(4, dataset%columns())

    dimensions = 0
    if (size(dataset%dimension, 2) == size(dimensions, 2)) then
      dimensions = dataset%dimension
    else if (size(dataset%dimension, 2) == 1) then
      dimensions = spread(dataset%dimension(:, 1), 2, size(dimensions, 2))
    end if
  end function dimensions

  pure function largest_entries(dataset) result(largest)
    type(dataset_t), intent(in) :: dataset
    real(wp) :: largest(dataset%columns())
    integer(i8) :: i
    integer :: k

    largest = 0
    do i = 1, size(dataset%value, kind=i8)
      k = 1 + int(modulo(i - 1, int(size(largest), i8)))
      if (ieee_is_finite(dataset%value(i))) largest(k) = max(largest(k), abs(dataset%value(i)))
    end do
  end function largest_entries

end module output_scales
