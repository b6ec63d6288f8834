!> Equilibration of a sparse matrix in coordinate form: powers of two, so that nothing is rounded,
!> chosen by Ruiz' iteration until the largest entry of every row and column is about one.
!> A scale on entry is the starting point: pass ones first, the last result afterwards.
module linalg_scaling
  use kinds, only: wp
  implicit none
  private

  public :: scale_symmetric, scale_general

  !> A pivot of an equilibrated matrix is null up to this size. Round-off leaves 1e-16 in place
  !> of an exact zero in small systems and up to some 1e-14 in chains of hundreds of elements; the
  !> smallest true pivot of a member of n equal beam elements is about n**(-3)/4.
  real(wp), parameter, public :: null_tolerance = 1.0e-13_wp

  integer, parameter :: sweeps = 12  !< enough for entries from 1e-300 to 1e300

contains

  !> scaled = S A S with the symmetric A given by one triangle.
  pure subroutine scale_symmetric(row, column, values, s, scaled)
    integer, intent(in), contiguous :: row(:), column(:)  !< where the entries are
    real(wp), intent(in), contiguous :: values(:)         !< the entries
    real(wp), intent(inout), contiguous :: s(:)           !< diagonal of S
    real(wp), intent(out), contiguous :: scaled(:)        !< entries of S A S
    real(wp) :: largest(size(s)), size_k
    integer :: sweep, k
    logical :: balanced

    do sweep = 1, sweeps
      largest = 0.0_wp
      do k = 1, size(values)
        scaled(k) = s(row(k))*values(k)*s(column(k))
        size_k = abs(scaled(k))
        largest(row(k)) = max(largest(row(k)), size_k)
        largest(column(k)) = max(largest(column(k)), size_k)
      end do
      if (sweep == sweeps) exit
      call improve(largest, s, balanced)
      if (balanced) exit
    end do
  end subroutine scale_symmetric

  !> scaled = R A C.
  pure subroutine scale_general(row, column, values, r, c, scaled)
    integer, intent(in), contiguous :: row(:), column(:)  !< where the entries are
    real(wp), intent(in), contiguous :: values(:)         !< the entries
    real(wp), intent(inout), contiguous :: r(:), c(:)     !< diagonals of R and C
    real(wp), intent(out), contiguous :: scaled(:)        !< entries of R A C
    real(wp) :: in_row(size(r)), in_column(size(c)), size_k
    integer :: sweep, k
    logical :: balanced(2)

    do sweep = 1, sweeps
      in_row = 0.0_wp
      in_column = 0.0_wp
      do k = 1, size(values)
        scaled(k) = r(row(k))*values(k)*c(column(k))
        size_k = abs(scaled(k))
        in_row(row(k)) = max(in_row(row(k)), size_k)
        in_column(column(k)) = max(in_column(column(k)), size_k)
      end do
      if (sweep == sweeps) exit
      call improve(in_row, r, balanced(1))
      call improve(in_column, c, balanced(2))
      if (all(balanced)) exit
    end do
  end subroutine scale_general

  !> Divide each scale by about the square root of the largest entry it now gives;
  !> balanced, and nothing changed, if all of these lie in [1/4, 2) or are zero.
  pure subroutine improve(largest, s, balanced)
    real(wp), intent(in), contiguous :: largest(:)
    real(wp), intent(inout), contiguous :: s(:)
    logical, intent(out) :: balanced
    integer :: i, half

    balanced = .true.
    do i = 1, size(s)
      if (.not. largest(i) > 0.0_wp .or. (largest(i) >= 0.25_wp .and. largest(i) < 2.0_wp)) cycle
      half = exponent(largest(i))/2
      balanced = .false.
      s(i) = scale(s(i), -half)
    end do
  end subroutine improve

end module linalg_scaling
