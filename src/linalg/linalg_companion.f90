!> The operator behind quadratic eigenvalues, M x'' + G x' + K x = 0 on C x = 0: with theta = 1/mu
!> and u = theta x it is (x, u) -> (u, -K^-1 (M x + G u)), whose eigenvalues are theta. Only K, with
!> C, is factorized. Its largest eigenvalues, those mu nearest zero, by Arnoldi (ARPACK), or all of
!> them, dense.
!>
!> It acts on the coordinates that M and G know, each in units of its own inertia, and time is in
!> units of the slowest motion.
module linalg_companion
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use linalg_solver, only: solver_t
  use linalg_symmetric, only: entries_t, compress, multiply_general
  use linalg_lanczos, only: start_vector
  use lapack_interfaces, only: dgeev
  use arpack_interfaces, only: dnaupd, dneupd
  implicit none
  private

  public :: companion_t, new_companion, find_all, find_largest

  real(wp), parameter :: tolerance = 1.0e-12_wp  !< of the residual of a vector
  integer, parameter :: most_restarts = 300
  integer, parameter :: powers = 8

  !> Scaled matrices, numbered by active coordinate.
  type :: companion_t
    integer :: equations = 0                   !< of the factorized matrix
    real(wp) :: time = 0.0_wp                  !< unit of time; 0: nothing that has mass moves
    integer, allocatable :: active(:)          !< coordinates in M or G
    real(wp), allocatable :: weight(:)         !< by active coordinate: weight*x are pure numbers
    type(entries_t) :: m, g
  end type companion_t

contains

  !> From the entries of M and G, all of them, among `coordinates`; the solver holds the factors
  !> of K with C.
  subroutine new_companion(solver, equations, coordinates, row, column, m, g, self, error)
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: equations, coordinates
    integer, intent(in) :: row(:), column(:)
    real(wp), intent(in) :: m(:), g(:)
    type(companion_t), intent(out) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: inertia(coordinates), resistance(coordinates)
    integer :: number(coordinates), k

    inertia = 0
    resistance = 0
    number = 0
    do k = 1, size(row)
      if (max(row(k), column(k)) > coordinates) cycle
      if (.not. max(abs(m(k)), abs(g(k))) > 0) cycle
      number([row(k), column(k)]) = 1
      if (row(k) /= column(k)) cycle
      inertia(row(k)) = abs(m(k))
      resistance(row(k)) = abs(g(k))
    end do
    self%equations = equations
    self%active = pack([(k, k=1, coordinates)], number == 1)
    number(self%active) = [(k, k=1, size(self%active))]
    call compress(row, column, m, coordinates, self%m)
    call compress(row, column, g, coordinates, self%g)
    self%m%row = number(self%m%row)
    self%m%column = number(self%m%column)
    self%g%row = number(self%g%row)
    self%g%column = number(self%g%column)
    self%weight = sqrt(inertia(self%active))
    call find_time(solver, self, error)
    if (allocated(error) .or. .not. self%time > 0) return
    where (.not. self%weight > 0) self%weight = sqrt(self%time*resistance(self%active))
    where (.not. self%weight > 0) self%weight = 1
    self%m%value = self%m%value/(self%weight(self%m%row)*self%weight(self%m%column)*self%time**2)
    self%g%value = self%g%value/(self%weight(self%g%row)*self%weight(self%g%column)*self%time)
  end subroutine new_companion

  !> The unit of time: root of the largest eigenvalue of K^-1 M, about, by power iteration. Weights
  !> are roots of inertia here.
  subroutine find_time(solver, self, error)
    type(solver_t), intent(inout) :: solver
    type(companion_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%active)) :: x, force
    real(wp) :: y(self%equations), length
    integer :: i

    x = start_vector(size(x), 1)
    do i = 0, powers
      call multiply_general(self%m, x, force)
      y = 0
      y(self%active) = force
      call solver%solve(y, error)
      if (allocated(error)) return
      x = y(self%active)
      length = norm2(self%weight*x)
      if (i > 0) self%time = sqrt(length)
      if (.not. length > 0) return
      x = x/length
    end do
  end subroutine find_time

  !> The operator.
  subroutine apply(solver, self, x, y, error)
    type(solver_t), intent(inout) :: solver
    type(companion_t), intent(in) :: self
    real(wp), intent(in) :: x(:)     !< twice the active coordinates
    real(wp), intent(out) :: y(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%active)) :: inertial, viscous
    real(wp) :: z(self%equations)
    integer :: n

    n = size(self%active)
    call multiply_general(self%m, x(:n), inertial)
    call multiply_general(self%g, x(n + 1:), viscous)
    z = 0
    z(self%active) = -self%weight*(inertial + viscous)
    call solver%solve(z, error)
    y(:n) = x(n + 1:)
    y(n + 1:) = self%weight*z(self%active)
  end subroutine apply

  !> All eigenvalues mu in units of 1/time, without those of theta = 0; of conjugate pairs the one
  !> with the positive imaginary part.
  subroutine find_all(solver, self, mu, vector, error)
    type(solver_t), intent(inout) :: solver
    type(companion_t), intent(in) :: self
    complex(wp), allocatable, intent(out) :: mu(:), vector(:, :)   !< (active, eigenvalues)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: unit(2*size(self%active)), none(1, 1)
    real(wp), allocatable :: matrix(:, :), z(:, :), work(:), re(:), im(:)
    integer :: n, j, info

    n = 2*size(self%active)
    allocate (matrix(n, n), z(n, n), work(34*n), re(n), im(n))
    do j = 1, n
      unit = 0
      unit(j) = 1
      call apply(solver, self, unit, matrix(:, j), error)
      if (allocated(error)) return
    end do
    call dgeev("N", "V", n, matrix, n, re, im, none, 1, z, n, work, size(work), info)
    if (info /= 0) call fail(error, exit_solve, "dgeev: info = "//to_text(info))
    if (.not. allocated(error)) call collect(self, re, im, z, mu, vector)
  end subroutine find_all

  !> The eigenvalues mu nearest zero, `wanted` of them with their conjugates, likewise.
  subroutine find_largest(solver, self, wanted, mu, vector, error)
    type(solver_t), intent(inout) :: solver
    type(companion_t), intent(in) :: self
    integer, intent(in) :: wanted
    complex(wp), allocatable, intent(out) :: mu(:), vector(:, :)
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: resid(:), workd(:), workl(:), v(:, :), z(:, :), re(:), im(:), workev(:)
    real(wp), allocatable :: y(:)
    logical, allocatable :: select(:)
    integer :: n, nev, ncv, ido, info, iparam(11), ipntr(14)

    n = 2*size(self%active)
    nev = min(wanted, n - 2)
    ncv = min(n, max(2*nev + 1, 20))
    allocate (resid(n), workd(3*n), workl(3*ncv*(ncv + 2)), v(n, ncv), z(n, nev + 1), y(n))
    allocate (re(nev + 1), im(nev + 1), workev(3*ncv), select(ncv))
    call apply(solver, self, start_vector(n, 1), resid, error)
    if (allocated(error)) return
    iparam = 0
    iparam([1, 3, 7]) = [1, most_restarts, 1]
    ipntr = 0
    workd = 0
    workl = 0
    v = 0
    ido = 0
    info = 1
    do
      call dnaupd(ido, "I", n, "LM", nev, tolerance, resid, ncv, v, n, iparam, ipntr, workd, &
                  workl, size(workl), info)
      if (abs(ido) /= 1) exit
      call apply(solver, self, workd(ipntr(1):ipntr(1) + n - 1), y, error)
      if (allocated(error)) return
      workd(ipntr(2):ipntr(2) + n - 1) = y
    end do
    if (info < 0 .or. info > 2) call fail(error, exit_solve, "dnaupd: info = "//to_text(info))
    if (allocated(error)) return
    call dneupd(.true., "A", select, re, im, z, n, 0.0_wp, 0.0_wp, workev, "I", n, "LM", nev, &
                tolerance, resid, ncv, v, n, iparam, ipntr, workd, workl, size(workl), info)
    if (info /= 0) then
      call fail(error, exit_solve, "dneupd: info = "//to_text(info))
      return
    end if
    n = min(iparam(5), size(re))
    call collect(self, re(:n), im(:n), z, mu, vector)
  end subroutine find_largest

  !> From theta and vectors as LAPACK and ARPACK leave them, a real one or two columns for a pair.
  pure subroutine collect(self, re, im, z, mu, vector)
    type(companion_t), intent(in) :: self
    real(wp), intent(in) :: re(:), im(:), z(:, :)
    complex(wp), allocatable, intent(out) :: mu(:), vector(:, :)
    integer, allocatable :: at(:)
    integer :: n, j, k

    n = size(self%active)
    at = pack([(j, j=1, size(re))], im <= 0 .and. hypot(re, im) > 0)
    at = merge(at - 1, at, im(at) < 0)  ! the second of a pair: its column is the first's
    allocate (mu(size(at)), vector(n, size(at)))
    do k = 1, size(at)
      j = at(k)
      mu(k) = 1/cmplx(re(j), -abs(im(j)), wp)
      if (abs(im(j)) > 0) then
        vector(:, k) = cmplx(z(:n, j), -z(:n, j + 1), wp)
      else
        vector(:, k) = cmplx(z(:n, j), 0.0_wp, wp)
      end if
      vector(:, k) = vector(:, k)/self%weight
    end do
  end subroutine collect

end module linalg_companion
