!> Comparison of modes: up to their sign, complex ones up to their phase, those of equal eigenvalues
!> as the space they span, and not at all if the end of the list cuts through these.
module mode_compare
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use kinds, only: wp, i8
  use errors, only: error_t
  use text, only: to_text
  use output_reader, only: reader_t, dataset_t
  use output_differences, only: differences_t, tolerance_t, noise, index_text
  use output_scales, only: column_scales, get_scales
  use mode_clusters, only: clusters_t, get_clusters, group_of
  implicit none
  private

  public :: compare_modes

  real(wp), parameter :: round_off = 16*epsilon(1.0_wp)

  !> A kind of motion that is so small beside the others is no part of the shape.
  real(wp), parameter :: nothing = 1.0e-6_wp

  !> What a mode is known by: its motion.
  character(len=*), parameter :: motions(3) = ["nodes/displacement", "nodes/rotation    ", &
                                               "nodes/warping     "]
  character(len=*), parameter :: quadratic(2) = ["energy        ", "effective_mass"]

  !> How the dataset of imaginary parts is named behind that of the real ones.
  character(len=*), parameter :: imaginary = "_imaginary"

contains

  !> Compare a dataset of modes cluster by cluster.
  subroutine compare_modes(a, b, length, first, second, tolerance, found, error)
    type(reader_t), intent(in) :: a, b
    real(wp), intent(in) :: length                 !< of the model, 0: unknown
    type(dataset_t), intent(in) :: first, second   !< of equal shape
    type(tolerance_t), intent(in) :: tolerance
    type(differences_t), intent(inout) :: found
    type(error_t), allocatable, intent(out) :: error
    type(clusters_t) :: clusters, other
    complex(wp), allocatable :: x(:, :), y(:, :), p(:), q(:)
    real(wp), allocatable :: scale(:)
    integer :: i, modes, k

    call get_clusters(a, group_of(first%path), clusters, error)
    if (.not. allocated(error)) call get_clusters(b, group_of(first%path), other, error)
    if (allocated(error)) return
    modes = size(clusters%first)
    if (modes == 0 .or. size(first%value) == 0) return
    call read_motion(a, b, length, group_of(first%path), modes, x, y, error)
    if (.not. allocated(error)) call get_scales(b, length, second, scale, error)
    if (.not. allocated(error)) call read_parts(a, first%path, p, error)
    if (.not. allocated(error)) call read_parts(b, first%path, q, error)
    if (allocated(error)) return
    if (size(p) /= size(first%value) .or. size(q) /= size(p)) return
    do i = 1, modes
      if (clusters%first(i) < i .or. clusters%cut(i)) cycle
      if (size(other%cut) == modes) then
        if (other%cut(i)) cycle
      end if
      call compare_cluster(pack([(k, k=1, modes)], clusters%first == i), x, y, &
                           reshape(p, [size(p)/modes, modes]), reshape(q, [size(p)/modes, modes]), &
                           first, second, tolerance, noise*scale, found)
    end do
  end subroutine compare_modes

  !> Values of a dataset as complex numbers, whether it is that of their real or imaginary parts.
  subroutine read_parts(reader, path, value, error)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: path
    complex(wp), allocatable, intent(out) :: value(:)
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: name
    type(dataset_t) :: part

    name = path
    if (is_imaginary(path)) name = path(:len(path) - len(imaginary))
    allocate (value(0))
    if (.not. reader%has(name)) return
    call reader%read(name, part, error)
    if (allocated(error)) return
    value = cmplx(part%value, 0.0_wp, wp)
    if (.not. reader%has(name//imaginary)) return
    call reader%read(name//imaginary, part, error)
    if (allocated(error)) return
    if (size(part%value) == size(value)) value = cmplx(real(value), part%value, wp)
  end subroutine read_parts

  pure logical function is_imaginary(path)
    character(len=*), intent(in) :: path

    is_imaginary = .false.
    if (len(path) <= len(imaginary)) return
    is_imaginary = path(len(path) - len(imaginary) + 1:) == imaginary
  end function is_imaginary

  !> Motions of all modes of both files, a column each, every kind scaled by its largest entry or,
  !> where that is round-off, by what the others are with the model's length; no columns if
  !> the files' motions have not the same shape.
  subroutine read_motion(a, b, length, group, modes, x, y, error)
    type(reader_t), intent(in) :: a, b
    real(wp), intent(in) :: length
    character(len=*), intent(in) :: group
    integer, intent(in) :: modes
    complex(wp), allocatable, intent(out) :: x(:, :), y(:, :)
    type(error_t), allocatable, intent(out) :: error
    complex(wp), allocatable :: p(:), q(:)
    real(wp) :: largest(size(motions)), scale, amplitude
    integer :: i

    allocate (x(0, modes), y(0, modes))
    largest = 0
    do i = 1, size(motions)
      call read_both(i)
      if (allocated(error)) return
      if (size(p) == size(q)) largest(i) = maxval(pack(abs([p, q]), ieee_is_finite(abs([p, q]))))
    end do
    amplitude = max(0.0_wp, maxval([(largest(i)*length**(i - 1), i=1, size(motions))]))
    do i = 1, size(motions)
      if (.not. largest(i) > 0) cycle
      scale = largest(i)
      if (length > 0) scale = max(scale, nothing*amplitude/length**(i - 1))
      call read_both(i)
      if (allocated(error)) return
      x = stacked(x, reshape(p/scale, [size(p)/modes, modes]))
      y = stacked(y, reshape(q/scale, [size(q)/modes, modes]))
    end do

  contains

    subroutine read_both(kind)
      integer, intent(in) :: kind

      call read_parts(a, group//"/modes/"//trim(motions(kind)), p, error)
      if (.not. allocated(error)) call read_parts(b, group//"/modes/"//trim(motions(kind)), q, &
                                                  error)
    end subroutine read_both
  end subroutine read_motion

  pure function stacked(upper, lower) result(both)
    complex(wp), intent(in) :: upper(:, :), lower(:, :)
    complex(wp) :: both(size(upper, 1) + size(lower, 1), size(upper, 2))

    both(:size(upper, 1), :) = upper
    both(size(upper, 1) + 1:, :) = lower
  end function stacked

  !> Modes of one eigenvalue: first whether they are the same motion, then the values.
  subroutine compare_cluster(members, x, y, p, q, first, second, tolerance, least, found)
    integer, intent(in) :: members(:)
    complex(wp), intent(in) :: x(:, :), y(:, :)   !< motions, a mode in each column
    complex(wp), intent(in) :: p(:, :), q(:, :)   !< values, a mode in each column
    type(dataset_t), intent(in) :: first, second
    type(tolerance_t), intent(in) :: tolerance
    real(wp), intent(in) :: least(:)  !< by column: the least that entries are measured against
    type(differences_t), intent(inout) :: found
    complex(wp) :: turn(size(members), size(members))
    real(wp) :: mac(size(members))
    integer :: j

    call fit(x(:, members), y(:, members), turn, mac)
    do j = 1, size(members)
      ! 1 - MAC is the square of the error of the shape.
      if (1 - mac(j) <= tolerance%relative**2 + round_off) cycle
      call found%add(first%path, "value", "["//to_text(members(j) - 1)//"]", "1", &
                     to_text(mac(j), 17), sqrt(max(0.0_wp, 1 - mac(j))))
    end do
    if (any(1 - mac > tolerance%relative**2 + round_off)) return
    call compare_values(members, turn, p(:, members), q(:, members), first, second, tolerance, &
                        least, found)
  end subroutine compare_cluster

  !> Matrix that makes the modes x those of y as well as it can, by orthogonalization of x, and
  !> how well: the share of y in the space of x (MAC). One mode is turned by its phase alone, a real
  !> one by its sign.
  pure subroutine fit(x, y, turn, mac)
    complex(wp), intent(in) :: x(:, :), y(:, :)
    complex(wp), intent(out) :: turn(:, :)
    real(wp), intent(out) :: mac(:)
    complex(wp) :: q(size(x, 1), size(x, 2)), r(size(x, 2), size(x, 2)), c(size(x, 2), size(x, 2))
    integer :: i, j, n

    n = size(x, 2)
    r = 0
    turn = 0
    mac = 0
    if (.not. (all(ieee_is_finite(abs(x))) .and. all(ieee_is_finite(abs(y))))) return
    do j = 1, n
      q(:, j) = x(:, j)
      do i = 1, j - 1
        r(i, j) = dot_product(q(:, i), q(:, j))
        q(:, j) = q(:, j) - r(i, j)*q(:, i)
      end do
      r(j, j) = norm2(abs(q(:, j)))
      if (.not. real(r(j, j)) > 0) return
      q(:, j) = q(:, j)/r(j, j)
    end do
    c = matmul(conjg(transpose(q)), y)
    do j = 1, n
      mac(j) = 1
      if (norm2(abs(y(:, j))) > 0) then
        mac(j) = 1 - (norm2(abs(y(:, j) - matmul(q, c(:, j))))/norm2(abs(y(:, j))))**2
      end if
      do i = n, 1, -1
        turn(i, j) = (c(i, j) - sum(r(i, i + 1:)*turn(i + 1:, j)))/r(i, i)
      end do
    end do
    if (n > 1) return
    if (abs(turn(1, 1)) > 0) turn = turn/abs(turn)
  end subroutine fit

  !> The values of the first file, turned into those of the second. Against entries of a mode it is
  !> the mode's largest of their dimension that counts, not less than round-off beside those of all
  !> modes. What is quadratic in the modes adds up to
  !> the same over a cluster (masses) or is left out (shares of the energy).
  subroutine compare_values(members, turn, x, y, first, second, tolerance, least, found)
    integer, intent(in) :: members(:)
    complex(wp), intent(in) :: turn(:, :), x(:, :), y(:, :)
    type(dataset_t), intent(in) :: first, second
    type(tolerance_t), intent(in) :: tolerance
    real(wp), intent(in) :: least(:)  !< by column: the least that entries are measured against
    type(differences_t), intent(inout) :: found
    complex(wp), dimension(size(x, 1), size(members)) :: p, q
    real(wp) :: a, b, allowed
    real(wp), allocatable :: scale(:)
    type(dataset_t) :: one
    integer :: j, k

    p = x
    q = y
    if (is_quadratic(first%path)) then
      if (size(members) > 1 .and. index(first%path, "effective_mass") == 0) return
      p(:, 1) = sum(p, 2)
      q(:, 1) = sum(q, 2)
    else
      p = matmul(p, turn)
    end if
    one = second
    do j = 1, merge(1, size(members), is_quadratic(first%path))
      one%value = abs(q(:, j))
      scale = max(column_scales(one, 0.0_wp), least)
      do k = 1, size(p, 1)
        a = merge(aimag(p(k, j)), real(p(k, j)), is_imaginary(first%path))
        b = merge(aimag(q(k, j)), real(q(k, j)), is_imaginary(first%path))
        allowed = tolerance%absolute + tolerance%relative*scale(1 + modulo(k - 1, size(scale)))
        if (ieee_is_finite(a) .and. ieee_is_finite(b)) then
          if (abs(a - b) <= allowed) cycle
        end if
        call found%add_values(first%path, &
                              index_text(first, int(members(j) - 1, i8)*size(p, 1) + k), a, b)
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
