!> Lanczos with restarts (ARPACK) for A^-1 Q x = theta x on C x = 0, in the inner product of A.
!> Every operation is one solution with the factors of A and C.
module linalg_lanczos
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use linalg_solver, only: solver_t
  use linalg_symmetric, only: entries_t, multiply
  use arpack_interfaces, only: dsaupd, dseupd
  implicit none
  private

  public :: lanczos, apply, start_vector

  !> Residual of a Lanczos vector, relative to its theta; the theta is good to the square.
  real(wp), parameter :: lanczos_tolerance = 1.0e-9_wp
  integer, parameter :: most_restarts = 300

contains

  !> y = A^-1 Q x, multipliers behind.
  subroutine apply(solver, q, x, y, error)
    type(solver_t), intent(inout) :: solver
    type(entries_t), intent(in) :: q
    real(wp), intent(in), contiguous :: x(:)     !< (coordinates)
    real(wp), intent(out), contiguous :: y(:)    !< (equations)
    type(error_t), allocatable, intent(out) :: error

    call multiply(q, x, y(:size(x)))
    y(size(x) + 1:) = 0
    call solver%solve(y, error)
  end subroutine apply

  !> Vector number `seed` of a fixed sequence of random ones, entries between -1 and 1.
  pure function start_vector(n, seed) result(x)
    integer, intent(in) :: n, seed
    real(wp) :: x(n)
    integer(i8), parameter :: factor = 16807_i8, prime = 2147483647_i8
    integer(i8) :: state
    integer :: k

    state = 1 + modulo(int(seed, i8)*48271_i8*factor, prime - 1)
    do k = 1, n
      state = modulo(factor*state, prime)
      x(k) = 2*real(state, wp)/real(prime, wp) - 1
    end do
  end function start_vector

  !> ARPACK's eigenvalues `d` and vectors of sign*A^-1 Q + scale, the largest, in no order.
  subroutine lanczos(solver, equations, n, a, q, sign_of, scale, wanted, d, v, found, error)
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: equations, n      !< unknowns of the solver, coordinates
    type(entries_t), intent(in) :: a, q
    real(wp), intent(in) :: sign_of, scale
    integer, intent(in) :: wanted
    real(wp), allocatable, intent(out) :: d(:), v(:, :)
    integer, intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: resid(:), workd(:), workl(:)
    logical, allocatable :: select(:)
    real(wp) :: y(equations)
    integer :: nev, ncv, ido, info, iparam(11), ipntr(11)

    nev = min(wanted, n - 1)
    ncv = min(n, max(2*nev + 1, 20))
    allocate (d(nev), v(n, ncv), workd(3*n), workl(ncv*(ncv + 8)), select(ncv))
    found = 0
    call apply(solver, q, start_vector(n, 1), y, error)
    if (allocated(error)) return
    resid = y(:n)
    iparam = 0
    iparam([1, 3, 7]) = [1, most_restarts, 3]
    ipntr = 0
    workd = 0
    workl = 0
    v = 0
    ido = 0
    info = 1
    do
      call dsaupd(ido, "G", n, "LA", nev, lanczos_tolerance, resid, ncv, v, n, iparam, ipntr, &
                  workd, workl, size(workl), info)
      if (abs(ido) /= 1 .and. ido /= 2) exit
      call answer(workd(ipntr(1):ipntr(1) + n - 1), workd(ipntr(2):ipntr(2) + n - 1))
      if (allocated(error)) return
    end do
    if (info < 0 .or. info > 2) call fail(error, exit_solve, "dsaupd: info = "//to_text(info))
    found = iparam(5)
    if (allocated(error) .or. found == 0) return
    call dseupd(.true., "A", select, d, v, n, 0.0_wp, "G", n, "LA", nev, lanczos_tolerance, &
                resid, ncv, v, n, iparam, ipntr, workd, workl, size(workl), info)
    if (info /= 0) call fail(error, exit_solve, "dseupd: info = "//to_text(info))
    d(:found) = 1/d(:found)

  contains

    !> What ARPACK asks for: y = A x, or y = (sign A^-1 Q + scale) x, with A x known if ido = 1.
    subroutine answer(x, product)
      real(wp), intent(in) :: x(n)
      real(wp), intent(out) :: product(n)
      real(wp) :: ax(n)

      if (ido == 2) then
        call multiply(a, x, product)
        return
      end if
      call multiply(q, x, y(:n))
      y(:n) = sign_of*y(:n)
      y(n + 1:) = 0
      if (scale > 0) then
        if (ido == 1) then
          ax = workd(ipntr(3):ipntr(3) + n - 1)
        else
          call multiply(a, x, ax)
        end if
        y(:n) = y(:n) + scale*ax
      end if
      call solver%solve(y, error)
      product = y(:n)
    end subroutine answer

  end subroutine lanczos

end module linalg_lanczos
