!> The lowest eigenvalues of A x = nu Q x, C x = 0, without a gap: what Lanczos finds is counted
!> against Sylvester's law of inertia, the number of negative pivots of A - nu Q.
module linalg_spectrum
  use kinds, only: wp
  use errors, only: error_t
  use linalg_solver, only: solver_t
  use linalg_eigen, only: pencil_t, pairs_t, find_pairs
  implicit none
  private

  public :: find_spectrum, count_between

  !> Eigenvalues closer than this, relatively, are taken for one: no shift is put between them.
  real(wp), parameter :: cluster = 1.0e-3_wp

  !> Up to so many times the first eigenvalue there are none where fewer than wanted were found.
  real(wp), parameter :: far = 1.0e11_wp
  integer, parameter :: extra_pairs = 2, most_extra = 50

contains

  !> Number of eigenvalues nu between 0 and `shift`, of either sign; leaves the factors there.
  subroutine count_between(solver, pencil, shift, number, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    real(wp), intent(in) :: shift
    integer, intent(out) :: number
    type(error_t), allocatable, intent(out) :: error

    number = 0
    call solver%factorize(pencil%a - shift*pencil%q, error)
    if (.not. allocated(error)) then
      number = solver%negative_pivots() - (pencil%equations - pencil%coordinates)
    end if
  end subroutine count_between

  !> The pairs nearest zero, `wanted` of positive and of negative nu out of those available, and
  !> some more, and whether none is missing up to the last one wanted. More pairs are computed
  !> until the count agrees: a cluster that the last one belongs to is found whole.
  subroutine find_spectrum(solver, pencil, wanted, available, pairs, complete, error)
    type(solver_t), intent(inout) :: solver      !< holds the factors of A on entry
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: wanted(2), available(2)
    type(pairs_t), intent(out) :: pairs
    logical, intent(out) :: complete
    type(error_t), allocatable, intent(out) :: error
    integer :: extra, goal(2), side
    logical :: sound(2)

    extra = extra_pairs
    do
      goal = merge(min(wanted + extra, available), 0, wanted > 0)
      call find_pairs(solver, pencil, goal, pairs, error)
      if (allocated(error)) return
      sound = .true.
      do side = 1, 2
        if (min(wanted(side), available(side)) == 0) cycle
        call check_side(solver, pencil, side, wanted(side), available(side), pairs, sound(side), &
                        error)
        if (allocated(error)) return
      end do
      complete = all(sound)
      extra = 4*extra
      if (complete .or. extra > most_extra .or. all(goal == available .or. wanted == 0)) return
      call solver%factorize(pencil%a, error)
      if (allocated(error)) return
    end do
  end subroutine find_spectrum

  !> Whether as many pairs of a sign were found as there are below a shift in the first gap at or
  !> behind the last wanted one; if fewer were found than wanted, whether these are all.
  subroutine check_side(solver, pencil, side, wanted, available, pairs, sound, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: side, wanted, available
    type(pairs_t), intent(in) :: pairs
    logical, intent(out) :: sound
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: nu(pairs%found(side)), shift
    integer :: n, k, number

    n = pairs%found(side)
    nu = 1/pairs%theta((side - 1)*pairs%found(1) + 1:(side - 1)*pairs%found(1) + n)
    sound = n > 0
    if (n == 0) return
    k = min(wanted, n)
    do while (k < n)
      if (abs(nu(k + 1) - nu(k)) > cluster*abs(nu(k + 1))) exit
      k = k + 1
    end do
    shift = nu(k)*(1 + cluster)
    if (k < n) shift = 0.5_wp*(nu(k) + nu(k + 1))
    if (n < min(wanted, available)) shift = far*nu(1)
    call count_between(solver, pencil, shift, number, error)
    sound = number == k
  end subroutine check_side

end module linalg_spectrum
