!> Comparison of modes: up to their sign, those of equal eigenvalues as the space they span.
module mode_compare
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp, i8
  use errors, only: error_t
  use text, only: to_text
  use output_reader, only: reader_t, dataset_t
  use output_differences, only: differences_t, tolerance_t, noise, index_text
  use output_scales, only: column_scales, get_scales
  implicit none
  private

  public :: is_mode_dataset, compare_modes

  !> Eigenvalues this near to each other, relatively, count as equal.
  real(wp), parameter :: cluster = 1.0e-6_wp

  real(wp), parameter :: round_off = 16*epsilon(1.0_wp)

  !> A kind of motion that is so small beside the others is no part of the shape.
  real(wp), parameter :: nothing = 1.0e-6_wp

  !> What a mode is known by: its motion.
  character(len=*), parameter :: motions(3) = ["nodes/displacement", "nodes/rotation    ", &
                                               "nodes/warping     "]
  character(len=*), parameter :: eigenvalues(3) = ["multiplier", "eigenvalue", "frequency "]
  character(len=*), parameter :: quadratic(2) = ["energy        ", "effective_mass"]

contains

  !> Whether a dataset depends on sign and mixture of modes: those by mode with further entries.
  logical function is_mode_dataset(reader, dataset)
    type(reader_t), intent(in) :: reader
    type(dataset_t), intent(in) :: dataset
    character(len=:), allocatable :: group

    is_mode_dataset = .false.
    if (index(dataset%axes, "mode*") /= 1 .and. index(dataset%axes, "mode;") /= 1) return
    if (index(dataset%axes, "real imaginary") > 0) return
    group = group_of(dataset%path)
    if (group == "") return
    if (eigenvalue_name(reader, group) == "") return
    is_mode_dataset = reader%has(group//"/modes/"//trim(motions(1)))
  end function is_mode_dataset

  !> The group of the analysis, as in "/analysis/02_eigen".
  pure function group_of(path) result(group)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: group
    integer :: at

    group = ""
    if (index(path, "/analysis/") /= 1) return
    at = len("/analysis/")
    at = at + index(path(at + 1:), "/")
    group = path(:at - 1)
  end function group_of

  function eigenvalue_name(reader, group) result(name)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: group
    character(len=:), allocatable :: name
    integer :: i

    name = ""
    do i = size(eigenvalues), 1, -1
      if (reader%has(group//"/"//trim(eigenvalues(i)))) name = group//"/"//trim(eigenvalues(i))
    end do
  end function eigenvalue_name

  !> Compare a dataset of modes cluster by cluster.
  subroutine compare_modes(a, b, length, first, second, tolerance, found, error)
    type(reader_t), intent(in) :: a, b
    real(wp), intent(in) :: length                 !< of the model, 0: unknown
    type(dataset_t), intent(in) :: first, second   !< of equal shape
    type(tolerance_t), intent(in) :: tolerance
    type(differences_t), intent(inout) :: found
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: values
    real(wp), allocatable :: x(:, :), y(:, :), scale(:)
    integer, allocatable :: members(:)
    integer :: i, modes, k

    call a%read(eigenvalue_name(a, group_of(first%path)), values, error)
    if (allocated(error)) return
    modes = size(values%value)
    if (modes == 0 .or. size(first%value) == 0) return
    call read_motion(a, b, length, group_of(first%path), modes, x, y, error)
    if (.not. allocated(error)) call get_scales(b, length, second, scale, error)
    if (allocated(error)) return
    do i = 1, modes
      members = pack([(k, k=1, modes)], equal_to(values%value, i))
      if (members(1) < i) cycle
      call compare_cluster(members, x, y, first, second, size(first%value)/modes, &
                           tolerance, noise*scale, found)
    end do
  end subroutine compare_modes

  pure function equal_to(value, i) result(equal)
    real(wp), intent(in) :: value(:)
    integer, intent(in) :: i
    logical :: equal(size(value))

    equal = .false.
    equal(i) = .true.
    if (.not. ieee_is_finite(value(i))) return
    where (ieee_is_finite(value)) equal = abs(value - value(i)) <= cluster*abs(value(i))
  end function equal_to

  !> Motions of all modes of both files, a column each, every kind scaled by its largest entry or,
  !> where that is round-off, by what the others are with the model's length; no columns if
  !> the files' motions have not the same shape.
  subroutine read_motion(a, b, length, group, modes, x, y, error)
    type(reader_t), intent(in) :: a, b
    real(wp), intent(in) :: length
    character(len=*), intent(in) :: group
    integer, intent(in) :: modes
    real(wp), allocatable, intent(out) :: x(:, :), y(:, :)
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: p(size(motions)), q(size(motions))
    real(wp) :: largest(size(motions)), scale, amplitude
    integer :: i

    allocate (x(0, modes), y(0, modes))
    largest = 0
    amplitude = 0
    do i = 1, size(motions)
      associate (path => group//"/modes/"//trim(motions(i)))
        if (.not. a%has(path)) cycle
        if (.not. b%has(path)) cycle
        call a%read(path, p(i), error)
        if (.not. allocated(error)) call b%read(path, q(i), error)
        if (allocated(error)) return
      end associate
      if (size(p(i)%value) /= size(q(i)%value)) cycle
      largest(i) = max(maxval(abs(pack(p(i)%value, ieee_is_finite(p(i)%value)))), &
                       maxval(abs(pack(q(i)%value, ieee_is_finite(q(i)%value)))))
      amplitude = max(amplitude, largest(i)*length**(i - 1))
    end do
    do i = 1, size(motions)
      if (.not. largest(i) > 0) cycle
      scale = largest(i)
      if (length > 0) scale = max(scale, nothing*amplitude/length**(i - 1))
      x = stacked(x, reshape(p(i)%value/scale, [size(p(i)%value)/modes, modes]))
      y = stacked(y, reshape(q(i)%value/scale, [size(q(i)%value)/modes, modes]))
    end do
  end subroutine read_motion

  pure function stacked(upper, lower) result(both)
    real(wp), intent(in) :: upper(:, :), lower(:, :)
    real(wp) :: both(size(upper, 1) + size(lower, 1), size(upper, 2))

    both(:size(upper, 1), :) = upper
    both(size(upper, 1) + 1:, :) = lower
  end function stacked

  !> Modes of one eigenvalue: first whether they are the same motion, then the values.
  subroutine compare_cluster(members, x, y, first, second, rows, tolerance, least, found)
    integer, intent(in) :: members(:)
    real(wp), intent(in) :: x(:, :), y(:, :)
    type(dataset_t), intent(in) :: first, second
    integer, intent(in) :: rows       !< entries of a mode
    type(tolerance_t), intent(in) :: tolerance
    real(wp), intent(in) :: least(:)  !< by column: the least that entries are measured against
    type(differences_t), intent(inout) :: found
    real(wp) :: turn(size(members), size(members)), mac(size(members))
    integer :: j

    call fit(x(:, members), y(:, members), turn, mac)
    do j = 1, size(members)
      ! 1 - MAC is the square of the error of the shape.
      if (1 - mac(j) <= tolerance%relative**2 + round_off) cycle
      call found%add(first%path, "value", "["//to_text(members(j) - 1)//"]", "1", &
                     to_text(mac(j), 17), sqrt(max(0.0_wp, 1 - mac(j))))
    end do
    if (any(1 - mac > tolerance%relative**2 + round_off)) return
    call compare_values(members, turn, first, second, rows, tolerance, least, found)
  end subroutine compare_cluster

  !> Matrix that makes the modes x those of y as well as it can, by orthogonalization of x, and
  !> how well: the share of y in the space of x (MAC). One mode is turned by its sign alone.
  pure subroutine fit(x, y, turn, mac)
    real(wp), intent(in) :: x(:, :), y(:, :)
    real(wp), intent(out) :: turn(:, :), mac(:)
    real(wp) :: q(size(x, 1), size(x, 2)), r(size(x, 2), size(x, 2)), c(size(x, 2), size(x, 2))
    integer :: i, j, n

    n = size(x, 2)
    r = 0
    turn = 0
    mac = 0
    if (.not. (all(ieee_is_finite(x)) .and. all(ieee_is_finite(y)))) return
    do j = 1, n
      q(:, j) = x(:, j)
      do i = 1, j - 1
        r(i, j) = dot_product(q(:, i), q(:, j))
        q(:, j) = q(:, j) - r(i, j)*q(:, i)
      end do
      r(j, j) = norm2(q(:, j))
      if (.not. r(j, j) > 0) return
      q(:, j) = q(:, j)/r(j, j)
    end do
    c = matmul(transpose(q), y)
    do j = 1, n
      mac(j) = 1
      if (norm2(y(:, j)) > 0) mac(j) = 1 - (norm2(y(:, j) - matmul(q, c(:, j)))/norm2(y(:, j)))**2
      do i = n, 1, -1
        turn(i, j) = (c(i, j) - dot_product(r(i, i + 1:), turn(i + 1:, j)))/r(i, i)
      end do
    end do
    if (n == 1) turn = sign(1.0_wp, turn)
  end subroutine fit

  !> The values of the first file, turned into those of the second. Against entries of a mode it is
  !> the mode's largest of their dimension that counts, not less than round-off beside those of all
  !> modes. What is quadratic in the modes adds up to
  !> the same over a cluster (masses) or is left out (shares of the energy).
  subroutine compare_values(members, turn, first, second, rows, tolerance, least, found)
    integer, intent(in) :: members(:)
    real(wp), intent(in) :: turn(:, :)
    type(dataset_t), intent(in) :: first, second
    integer, intent(in) :: rows       !< entries of a mode
    type(tolerance_t), intent(in) :: tolerance
    real(wp), intent(in) :: least(:)  !< by column: the least that entries are measured against
    type(differences_t), intent(inout) :: found
    real(wp) :: p(rows, size(members)), q(rows, size(members)), allowed
    real(wp), allocatable :: scale(:)
    type(dataset_t) :: one
    integer(i8) :: at
    integer :: j, k

    do j = 1, size(members)
      p(:, j) = first%value((members(j) - 1)*rows + 1:members(j)*rows)
      q(:, j) = second%value((members(j) - 1)*rows + 1:members(j)*rows)
    end do
    if (is_quadratic(first%path)) then
      if (size(members) > 1 .and. index(first%path, "effective_mass") == 0) return
      p(:, 1) = sum(p, 2)
      q(:, 1) = sum(q, 2)
    else
      p = matmul(p, turn)
    end if
    one = second
    do j = 1, merge(1, size(members), is_quadratic(first%path))
      one%value = q(:, j)
      scale = max(column_scales(one, 0.0_wp), least)
      do k = 1, rows
        at = int(members(j) - 1, i8)*rows + k
        allowed = tolerance%absolute + tolerance%relative*scale(1 + modulo(k - 1, size(scale)))
        if (ieee_is_finite(p(k, j)) .and. ieee_is_finite(q(k, j))) then
          if (abs(p(k, j) - q(k, j)) <= allowed) cycle
        end if
        call found%add_values(first%path, index_text(first, at), p(k, j), q(k, j))
      end do
    end do
  end subroutine compare_values

  pure logical function is_quadratic(path)
    character(len=*), intent(in) :: path
    integer :: i

    is_quadratic = .false.
    do i = 1, size(quadratic)
      if (index(path, "/"//trim(quadratic(i))) > 0) is_quadratic = .true.
    end do
  end function is_quadratic

end module mode_compare
