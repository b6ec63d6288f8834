!> Eigenpairs of a large symmetric pencil with constraints, A x = (1/theta) Q x on C x = 0:
!> those with the largest theta of either sign. A is positive definite where C x = 0 and is
!> factorized, with C, by the caller; Q is any symmetric matrix, also a singular one.
!>
!> With few coordinates in Q they are reduced to a dense matrix: A^-1 on these coordinates, G, is
!> factorized with pivoting, G = L L', and L'Q L has the same theta. With many, Lanczos (ARPACK) on
!> A^-1 Q in the inner product of A.
module linalg_eigen
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use linalg_solver, only: solver_t
  use lapack_interfaces, only: dsyev
  use arpack_interfaces, only: dsaupd, dseupd
  implicit none
  private

  public :: pencil_t, pairs_t, find_pairs, estimate_theta

  !> Coordinates in Q up to which the dense reduction is used.
  integer, parameter, public :: default_dense_pairs = 200

  !> A, Q: lower triangles by entry. The unknowns of the factorized matrix are the coordinates,
  !> then the multipliers.
  type :: pencil_t
    integer :: coordinates = 0
    integer :: equations = 0                     !< coordinates and multipliers
    integer, allocatable :: row(:), column(:)    !< of the entries, row >= column
    real(wp), allocatable :: a(:), q(:)          !< entries; those of multipliers are not used
    logical :: semidefinite = .false.            !< Q is: no theta is negative
    integer :: dense_limit = default_dense_pairs
  end type pencil_t

  !> Pairs in the order of |theta|, falling, the positive ones first.
  type :: pairs_t
    integer :: found(2) = 0                      !< positive, negative
    real(wp), allocatable :: theta(:)
    real(wp), allocatable :: vector(:, :)        !< (equations, pairs), x'A x = 1; and multipliers
  end type pairs_t

  !> A theta this small, relative to the largest, is zero.
  real(wp), parameter :: zero_theta = 1.0e-13_wp

  !> What a pivot of the scaled inverse is in place of zero.
  real(wp), parameter :: zero_pivot = 1.0e-13_wp

  !> Residual of a Lanczos vector, relative to its theta; the theta is good to the square.
  real(wp), parameter :: lanczos_tolerance = 1.0e-10_wp
  integer, parameter :: most_restarts = 300

contains

  !> Find up to `wanted` pairs with positive and with negative theta.
  subroutine find_pairs(solver, pencil, wanted, pairs, error)
    type(solver_t), intent(inout) :: solver    !< holds the factors of A with C
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: wanted(2)
    type(pairs_t), intent(out) :: pairs
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: active(:)
    real(wp) :: scale

    allocate (pairs%theta(sum(wanted)), pairs%vector(pencil%equations, sum(wanted)))
    active = coordinates_of_q(pencil)
    if (size(active) <= pencil%dense_limit) then
      call find_dense(solver, pencil, active, wanted, pairs, error)
      return
    end if
    scale = 0
    if (.not. pencil%semidefinite) call estimate_theta(solver, pencil, scale, error)
    if (allocated(error)) return
    if (wanted(1) > 0) call find_sparse(solver, pencil, 1, wanted(1), scale, pairs, error)
    if (wanted(2) > 0 .and. .not. allocated(error)) &
      call find_sparse(solver, pencil, 2, wanted(2), scale, pairs, error)
  end subroutine find_pairs

  !> Coordinates with entries in Q.
  pure function coordinates_of_q(pencil) result(active)
    type(pencil_t), intent(in) :: pencil
    integer, allocatable :: active(:)
    logical :: used(pencil%equations)
    integer :: k

    used = .false.
    do k = 1, size(pencil%q)
      if (.not. abs(pencil%q(k)) > 0) cycle
      used(pencil%row(k)) = .true.
      used(pencil%column(k)) = .true.
    end do
    active = pack([(k, k=1, pencil%coordinates)], used(:pencil%coordinates))
  end function coordinates_of_q

  !> y = B x with a symmetric matrix given by its lower triangle.
  pure subroutine multiply(pencil, b, x, y)
    type(pencil_t), intent(in) :: pencil
    real(wp), intent(in), contiguous :: b(:)
    real(wp), intent(in) :: x(pencil%coordinates)
    real(wp), intent(out) :: y(pencil%coordinates)
    integer :: k

    y = 0
    do k = 1, size(b)
      associate (i => pencil%row(k), j => pencil%column(k))
        if (i > pencil%coordinates) cycle
        y(i) = y(i) + b(k)*x(j)
        if (i /= j) y(j) = y(j) + b(k)*x(i)
      end associate
    end do
  end subroutine multiply

  !> y = A^-1 Q x, multipliers behind.
  subroutine apply(solver, pencil, x, y, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    real(wp), intent(in) :: x(pencil%coordinates)
    real(wp), intent(out) :: y(pencil%equations)
    type(error_t), allocatable, intent(out) :: error

    call multiply(pencil, pencil%q, x, y(:pencil%coordinates))
    y(pencil%coordinates + 1:) = 0
    call solver%solve(y, error)
  end subroutine apply

  !> A fixed vector without symmetries.
  pure function start_vector(n) result(x)
    integer, intent(in) :: n
    real(wp) :: x(n)
    real(wp), parameter :: golden = 0.6180339887498949_wp
    integer :: k

    do k = 1, n
      x(k) = modulo(k*golden, 1.0_wp) + 0.5_wp*modulo(k*golden**2*0.7_wp, 1.0_wp) - 0.7_wp
    end do
  end function start_vector

  !> A lower bound of the largest |theta|, usually near to it, by power iteration; 0: Q is zero.
  !> If Q is semidefinite, A need not be definite.
  subroutine estimate_theta(solver, pencil, theta, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    real(wp), intent(out) :: theta
    type(error_t), allocatable, intent(out) :: error
    integer, parameter :: powers = 8
    real(wp) :: x(pencil%equations), y(pencil%coordinates), size_x
    integer :: i

    theta = 0
    x(:pencil%coordinates) = start_vector(pencil%coordinates)
    do i = 0, powers
      y = x(:pencil%coordinates)
      call apply(solver, pencil, y, x, error)
      if (allocated(error)) return
      if (pencil%semidefinite) then
        call multiply(pencil, pencil%q, x(:pencil%coordinates), y)
      else
        call multiply(pencil, pencil%a, x(:pencil%coordinates), y)
      end if
      size_x = sqrt(max(0.0_wp, dot_product(x(:pencil%coordinates), y)))
      if (i > 0) theta = size_x
      if (.not. size_x > 0) return
      x = x/size_x
    end do
  end subroutine estimate_theta

  !> All pairs of the dense reduction, of which the wanted ones are kept.
  subroutine find_dense(solver, pencil, active, wanted, pairs, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: active(:), wanted(2)
    type(pairs_t), intent(inout) :: pairs
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: factor(:, :), reduced(:, :), theta(:), work(:)
    real(wp) :: x(pencil%coordinates)
    integer :: n, info, k

    call factor_inverse(solver, pencil, active, factor, error)
    n = size(factor, 2)
    if (allocated(error) .or. n == 0) return
    reduced = reduced_matrix(pencil, active, factor)
    allocate (theta(n), work(max(1, 34*n)))
    call dsyev("V", "L", n, reduced, n, theta, work, size(work), info)
    if (info /= 0) then
      call fail(error, exit_solve, "dsyev: info = "//to_text(info))
      return
    end if
    do k = n, max(1, n - wanted(1) + 1), -1
      if (theta(k) <= zero_theta*maxval(abs(theta))) exit
      call keep(1, k)
      if (allocated(error)) return
    end do
    do k = 1, min(n, wanted(2))
      if (-theta(k) <= zero_theta*maxval(abs(theta))) exit
      call keep(2, k)
      if (allocated(error)) return
    end do

  contains

    subroutine keep(side, k)
      integer, intent(in) :: side, k

      x = 0
      x(active) = matmul(factor, reduced(:, k))
      call keep_pair(solver, pencil, side, theta(k), x, pairs, error)
    end subroutine keep

  end subroutine find_dense

  !> Columns L of A^-1 = L L' on some coordinates: Cholesky's, with the largest pivot next, of the
  !> inverse scaled to a unit diagonal. As many as its rank.
  subroutine factor_inverse(solver, pencil, active, factor, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: active(:)
    real(wp), allocatable, intent(out) :: factor(:, :)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: inverse(size(active), size(active)), scale(size(active)), x(pencil%equations)
    integer :: i, j, n

    n = size(active)
    allocate (factor(n, 0))
    do j = 1, n
      x = 0
      x(active(j)) = 1
      call solver%solve(x, error)
      if (allocated(error)) return
      inverse(:, j) = x(active)
      scale(j) = sqrt(max(0.0_wp, inverse(j, j)))
    end do
    do j = 1, n
      do i = 1, j
        inverse(i, j) = 0.5_wp*(inverse(i, j) + inverse(j, i))/max(scale(i)*scale(j), tiny(1.0_wp))
        if (min(scale(i), scale(j)) <= 0) inverse(i, j) = 0
        inverse(j, i) = inverse(i, j)
      end do
    end do
    call pivoted_cholesky(inverse, factor)
    do j = 1, size(factor, 2)
      factor(:, j) = scale*factor(:, j)
    end do
  end subroutine factor_inverse

  !> B = L L' with the columns of L in the order of falling pivots, down to round-off.
  pure subroutine pivoted_cholesky(b, l)
    real(wp), intent(in), contiguous :: b(:, :)
    real(wp), allocatable, intent(out) :: l(:, :)
    real(wp) :: diagonal(size(b, 1)), columns(size(b, 1), size(b, 1))
    integer :: i, k, pivot

    do i = 1, size(b, 1)
      diagonal(i) = b(i, i)
    end do
    do k = 1, size(b, 1)
      pivot = maxloc(diagonal, 1)
      if (diagonal(pivot) <= zero_pivot) exit
      columns(:, k) = b(:, pivot)
      do i = 1, k - 1
        columns(:, k) = columns(:, k) - columns(pivot, i)*columns(:, i)
      end do
      columns(:, k) = columns(:, k)/sqrt(diagonal(pivot))
      diagonal = diagonal - columns(:, k)**2
      diagonal(pivot) = 0
    end do
    l = columns(:, :k - 1)
  end subroutine pivoted_cholesky

  !> L'Q L.
  pure function reduced_matrix(pencil, active, factor) result(t)
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: active(:)
    real(wp), intent(in), contiguous :: factor(:, :)
    real(wp) :: t(size(factor, 2), size(factor, 2)), q(size(active), size(active))
    integer :: place(pencil%equations), k

    place = 0
    place(active) = [(k, k=1, size(active))]
    q = 0
    do k = 1, size(pencil%q)
      associate (i => place(pencil%row(k)), j => place(pencil%column(k)))
        if (min(i, j) == 0) cycle
        q(i, j) = pencil%q(k)
        q(j, i) = pencil%q(k)
      end associate
    end do
    t = matmul(transpose(factor), matmul(q, factor))
  end function reduced_matrix

  !> Add a pair; one more solution completes it, A^-1 Q x = theta x, and gives the multipliers.
  subroutine keep_pair(solver, pencil, side, theta, x, pairs, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: side
    real(wp), intent(in) :: theta, x(:)
    type(pairs_t), intent(inout) :: pairs
    type(error_t), allocatable, intent(out) :: error
    integer :: n

    pairs%found(side) = pairs%found(side) + 1
    n = sum(pairs%found)
    pairs%theta(n) = theta
    call apply(solver, pencil, x, pairs%vector(:, n), error)
    pairs%vector(:, n) = pairs%vector(:, n)/theta
  end subroutine keep_pair

  !> Lanczos for one sign of theta, on +-A^-1 Q + scale: the shift keeps the many theta near zero
  !> from being hunted for digits.
  subroutine find_sparse(solver, pencil, side, wanted, scale, pairs, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: side, wanted
    real(wp), intent(in) :: scale
    type(pairs_t), intent(inout) :: pairs
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: v(:, :), d(:)
    integer :: k, found, at(1)
    real(wp) :: sign_of, theta

    sign_of = merge(1.0_wp, -1.0_wp, side == 1)
    call lanczos(solver, pencil, sign_of, scale, wanted, d, v, found, error)
    if (allocated(error)) return
    do k = 1, found
      at = maxloc(d(:found))
      theta = sign_of*(d(at(1)) - scale)
      d(at(1)) = -huge(1.0_wp)
      if (sign_of*theta <= zero_theta*scale) exit
      call keep_pair(solver, pencil, side, theta, v(:, at(1)), pairs, error)
      if (allocated(error)) return
    end do
  end subroutine find_sparse

  !> ARPACK's eigenvalues `d` and vectors of sign*A^-1 Q + scale, the largest, in no order.
  subroutine lanczos(solver, pencil, sign_of, scale, wanted, d, v, found, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    real(wp), intent(in) :: sign_of, scale
    integer, intent(in) :: wanted
    real(wp), allocatable, intent(out) :: d(:), v(:, :)
    integer, intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: resid(:), workd(:), workl(:)
    logical, allocatable :: select(:)
    real(wp) :: y(pencil%equations)
    integer :: n, ncv, ido, info, iparam(11), ipntr(11)

    n = pencil%coordinates
    ncv = min(n, max(2*wanted + 1, 20))
    allocate (d(wanted), v(n, ncv), workd(3*n), workl(ncv*(ncv + 8)), select(ncv))
    found = 0
    call apply(solver, pencil, start_vector(n), y, error)
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
      call dsaupd(ido, "G", n, "LA", wanted, lanczos_tolerance, resid, ncv, v, n, iparam, ipntr, &
                  workd, workl, size(workl), info)
      if (abs(ido) /= 1 .and. ido /= 2) exit
      call answer(workd(ipntr(1):ipntr(1) + n - 1), workd(ipntr(2):ipntr(2) + n - 1))
      if (allocated(error)) return
    end do
    if (info < 0 .or. info > 2) call fail(error, exit_solve, "dsaupd: info = "//to_text(info))
    found = iparam(5)
    if (allocated(error) .or. found == 0) return
    call dseupd(.true., "A", select, d, v, n, 0.0_wp, "G", n, "LA", wanted, lanczos_tolerance, &
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
        call multiply(pencil, pencil%a, x, product)
        return
      end if
      call multiply(pencil, pencil%q, x, y(:n))
      y(:n) = sign_of*y(:n)
      y(n + 1:) = 0
      if (scale > 0) then
        ax = workd(ipntr(3):ipntr(3) + n - 1)
        if (ido == -1) call multiply(pencil, pencil%a, x, ax)
        y(:n) = y(:n) + scale*ax
      end if
      call solver%solve(y, error)
      product = y(:n)
    end subroutine answer

  end subroutine lanczos

end module linalg_eigen
