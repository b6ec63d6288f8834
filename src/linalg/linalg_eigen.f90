!> Eigenpairs of a large symmetric pencil with constraints, A x = (1/theta) Q x on C x = 0:
!> those with the largest theta of either sign. A is positive definite where C x = 0 and is
!> factorized, with C, by the caller; Q is any symmetric matrix, also a singular one.
!>
!> With few coordinates in Q they are reduced to a dense matrix: A^-1 on these coordinates is
!> factorized with pivoting, A^-1 = L L', and L'Q L has the same theta. With few degrees of freedom
!> likewise, L with L'A L = 1 and C L = 0. With many, Lanczos (ARPACK) on A^-1 Q in the inner
!> product
!> of A.
module linalg_eigen
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text
  use linalg_solver, only: solver_t
  use linalg_symmetric, only: entries_t, compress, multiply
  use linalg_lanczos, only: lanczos, apply, start_vector
  use lapack_interfaces, only: dsyev
  implicit none
  private

  public :: pencil_t, pairs_t, find_pairs, estimate_theta

  !> Coordinates in Q up to which the dense reduction is used.
  integer, parameter, public :: default_dense_pairs = 200
  integer, parameter :: most_dense = 2000

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

contains

  !> Find up to `wanted` pairs with positive and with negative theta.
  subroutine find_pairs(solver, pencil, wanted, pairs, error)
    type(solver_t), intent(inout) :: solver    !< holds the factors of A with C
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: wanted(2)
    type(pairs_t), intent(out) :: pairs
    type(error_t), allocatable, intent(out) :: error
    integer, allocatable :: active(:)
    real(wp), allocatable :: factor(:, :)
    real(wp) :: scale
    integer :: k

    allocate (pairs%theta(sum(wanted)), pairs%vector(pencil%equations, sum(wanted)))
    active = coordinates_of_q(pencil)
    if (size(active) <= pencil%dense_limit) then
      call factor_inverse(solver, pencil, active, factor, error)
    else if (few_freedoms(pencil, maxval(wanted))) then
      active = [(k, k=1, pencil%coordinates)]
      call null_basis(solver, pencil, factor, error)
    end if
    if (allocated(error)) return
    if (allocated(factor)) then
      call find_dense(solver, pencil, active, factor, wanted, pairs, error)
      return
    end if
    scale = 0
    if (.not. pencil%semidefinite) call estimate_theta(solver, pencil, scale, error)
    if (allocated(error)) return
    if (wanted(1) > 0) call find_sparse(solver, pencil, 1, wanted(1), scale, pairs, error)
    if (wanted(2) > 0 .and. .not. allocated(error)) then
      call find_sparse(solver, pencil, 2, wanted(2), scale, pairs, error)
    end if
  end subroutine find_pairs

  !> Whether a basis of all motions is apt: there are few, or a good part of all pairs is wanted.
  pure logical function few_freedoms(pencil, wanted)
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: wanted
    integer :: freedoms

    freedoms = 2*pencil%coordinates - pencil%equations
    few_freedoms = freedoms <= pencil%dense_limit .or. &
                   (freedoms <= most_dense .and. 3*wanted > freedoms)
  end function few_freedoms

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

  !> A lower bound of the largest |theta|, usually near to it, by power iteration; 0: Q is zero.
  !> If Q is semidefinite, A need not be definite.
  subroutine estimate_theta(solver, pencil, theta, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    real(wp), intent(out) :: theta
    type(error_t), allocatable, intent(out) :: error
    integer, parameter :: powers = 8
    type(entries_t) :: q, metric
    real(wp) :: x(pencil%equations), y(pencil%coordinates), size_x
    integer :: i

    theta = 0
    call compress(pencil%row, pencil%column, pencil%q, pencil%coordinates, q)
    call compress(pencil%row, pencil%column, pencil%a, pencil%coordinates, metric)
    if (pencil%semidefinite) metric = q
    x(:pencil%coordinates) = start_vector(pencil%coordinates, 1)
    do i = 0, powers
      y = x(:pencil%coordinates)
      call apply(solver, q, y, x, error)
      if (allocated(error)) return
      call multiply(metric, x(:pencil%coordinates), y)
      size_x = sqrt(max(0.0_wp, dot_product(x(:pencil%coordinates), y)))
      if (i > 0) theta = size_x
      if (.not. size_x > 0) return
      x = x/size_x
    end do
  end subroutine estimate_theta

  !> All pairs of L'Q L, of which the wanted ones are kept.
  subroutine find_dense(solver, pencil, active, factor, wanted, pairs, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(in) :: active(:), wanted(2)
    real(wp), intent(in), contiguous :: factor(:, :)   !< L, (active, rank)
    type(pairs_t), intent(inout) :: pairs
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: reduced(:, :), theta(:), work(:)
    type(entries_t) :: q
    real(wp) :: x(pencil%coordinates)
    logical :: known(pencil%coordinates)
    integer :: n, info, k

    known = .false.
    known(active) = .true.
    call compress(pencil%row, pencil%column, pencil%q, pencil%coordinates, q)
    n = size(factor, 2)
    if (n == 0) return
    call reduce(q, pencil%coordinates, active, factor, reduced)
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
      call keep_pair(solver, q, side, theta(k), x, known, pairs, error)
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

  !> Columns Z with Z'A Z = 1 that span all x with C x = 0, of which there are few: random ones,
  !> taken
  !> to the nearest x, and made orthogonal, twice. The factors of A are found again at the end.
  subroutine null_basis(solver, pencil, basis, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    real(wp), allocatable, intent(out) :: basis(:, :)
    type(error_t), allocatable, intent(out) :: error
    type(entries_t) :: a
    real(wp) :: projection(size(pencil%a)), x(pencil%equations), y(pencil%coordinates)
    integer :: n, j, pass

    n = pencil%coordinates
    allocate (basis(n, 2*n - pencil%equations))
    call compress(pencil%row, pencil%column, pencil%a, n, a)
    projection = merge(pencil%a, 0.0_wp, pencil%row > n)
    where (pencil%row == pencil%column .and. pencil%row <= n) projection = 1
    call solver%factorize(projection, error)
    do j = 1, size(basis, 2)
      if (allocated(error)) return
      x(:n) = start_vector(n, j)
      x(n + 1:) = 0
      call solver%solve(x, error)
      do pass = 1, 2
        call multiply(a, x(:n), y)
        x(:n) = x(:n) - matmul(basis(:, :j - 1), matmul(y, basis(:, :j - 1)))
      end do
      call multiply(a, x(:n), y)
      basis(:, j) = x(:n)/sqrt(max(dot_product(x(:n), y), tiny(1.0_wp)))
    end do
    if (.not. allocated(error)) call solver%factorize(pencil%a, error)
  end subroutine null_basis

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
  pure subroutine reduce(q, coordinates, active, factor, reduced)
    type(entries_t), intent(in) :: q
    integer, intent(in) :: coordinates, active(:)
    real(wp), intent(in), contiguous :: factor(:, :)
    real(wp), allocatable, intent(out) :: reduced(:, :)
    real(wp) :: x(coordinates), y(coordinates)
    integer :: j

    allocate (reduced(size(factor, 2), size(factor, 2)))
    x = 0
    do j = 1, size(factor, 2)
      x(active) = factor(:, j)
      call multiply(q, x, y)
      reduced(:, j) = matmul(y(active), factor)
    end do
  end subroutine reduce

  !> Add a pair whose vector is known on all coordinates or on those of Q: theta x = A^-1 Q x
  !> gives the rest and the multipliers. What is known is kept: round-off of a solution has most of
  !> the softest modes, and much of it for a stiff one.
  subroutine keep_pair(solver, q, side, theta, x, known, pairs, error)
    type(solver_t), intent(inout) :: solver
    type(entries_t), intent(in) :: q
    integer, intent(in) :: side
    real(wp), intent(in) :: theta, x(:)          !< x by coordinate
    logical, intent(in) :: known(:)
    type(pairs_t), intent(inout) :: pairs
    type(error_t), allocatable, intent(out) :: error
    integer :: n

    pairs%found(side) = pairs%found(side) + 1
    n = sum(pairs%found)
    pairs%theta(n) = theta
    associate (vector => pairs%vector(:, n))
      if (size(vector) > size(x) .or. .not. all(known)) then
        call apply(solver, q, x, vector, error)
        vector = vector/theta
      end if
      where (known) vector(:size(x)) = x
    end associate
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
    type(entries_t) :: a, q
    real(wp), allocatable :: v(:, :), d(:)
    integer :: k, found, at(1)
    real(wp) :: sign_of, theta

    call compress(pencil%row, pencil%column, pencil%a, pencil%coordinates, a)
    call compress(pencil%row, pencil%column, pencil%q, pencil%coordinates, q)
    sign_of = merge(1.0_wp, -1.0_wp, side == 1)
    call lanczos(solver, pencil%equations, pencil%coordinates, a, q, sign_of, scale, wanted, d, v, &
                 found, error)
    if (allocated(error)) return
    do k = 1, found
      at = maxloc(d(:found))
      theta = sign_of*(d(at(1)) - scale)
      d(at(1)) = -huge(1.0_wp)
      if (sign_of*theta <= zero_theta*scale) exit
      call keep_pair(solver, q, side, theta, v(:, at(1)), spread(.true., 1, size(v, 1)), pairs, &
                     error)
      if (allocated(error)) return
    end do
  end subroutine find_sparse

end module linalg_eigen
