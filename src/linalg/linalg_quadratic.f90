!> Eigenvalues of (lambda^2 M + lambda G + K) x = 0 on C x = 0, complex in general: those nearest
!> zero. K, G, M are any matrices, M and G also singular: motions without mass and resistance
!> follow the others.
!>
!> Where K is singular lambda = mu + shift: M, G + 2 shift M, K + shift G + shift^2 M.
module linalg_quadratic
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use linalg_solver, only: solver_t
  use linalg_symmetric, only: entries_t, compress, multiply_general
  use linalg_equality, only: are_equal
  use linalg_companion, only: companion_t, new_companion, find_all, find_largest
  implicit none
  private

  public :: quadratic_t, spectrum_t, find_complex

  !> Coordinates in M and G up to which all eigenvalues are found.
  integer, parameter, public :: default_dense_coordinates = 120

  !> Eigenvalues more of which the iteration finds than are wanted.
  integer, parameter :: extra = 6

  !> A vector that the matrices change by more than this is of theta = 0, not found.
  real(wp), parameter :: lost = 1.0e-2_wp

  !> An eigenvalue this small against the shift is zero: double ones split that far.
  real(wp), parameter :: zero = 1.0e-4_wp

  !> Free motions are others if they differ so much.
  real(wp), parameter :: independent = 1.0e-3_wp

  !> Far more than round-off, far less than a gap.
  real(wp), parameter :: tie = 1.0e-8_wp

  integer, parameter :: most_shifts = 60

  !> All entries of the matrices in one square sparsity.
  type :: quadratic_t
    integer :: coordinates = 0
    integer :: equations = 0                     !< coordinates and multipliers
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: k(:)                !< with C and its transpose
    real(wp), allocatable :: g(:), m(:)
    integer :: dense_limit = default_dense_coordinates
  end type quadratic_t

  !> Eigenvalues in the order of their distance from zero; of conjugate pairs one, with positive
  !> imaginary part; of zeros those that move differently: two of a free motion are one.
  type :: spectrum_t
    integer :: found = 0
    complex(wp), allocatable :: lambda(:)        !< [1/T]
    complex(wp), allocatable :: vector(:, :)     !< (equations, found), and multipliers
    logical :: complete = .false.                !< all eigenvalues are known
    logical :: cut = .false.                     !< the last one has an equal that is left out
  end type spectrum_t

contains

  !> Find the `wanted` eigenvalues nearest zero, or all if there are fewer. The solver is prepared
  !> for the sparsity.
  subroutine find_complex(solver, problem, wanted, spectrum, error)
    type(solver_t), intent(inout) :: solver
    type(quadratic_t), intent(in) :: problem
    integer, intent(in) :: wanted
    type(spectrum_t), intent(out) :: spectrum
    type(error_t), allocatable, intent(out) :: error
    type(companion_t) :: companion
    complex(wp), allocatable :: mu(:), vector(:, :)
    real(wp) :: shift
    integer :: n

    call find_shift(solver, problem, companion, shift, error)
    if (allocated(error)) return
    n = size(companion%active)
    spectrum%complete = n <= problem%dense_limit .or. 2*(wanted + extra) >= 2*n - 1
    if (spectrum%complete) then
      call find_all(solver, companion, mu, vector, error)
    else
      call find_largest(solver, companion, 2*(wanted + extra), mu, vector, error)
    end if
    if (allocated(error)) return
    call keep_nearest(solver, problem, companion, shift, wanted, mu/companion%time, vector, &
                      spectrum, error)
  end subroutine find_complex

  !> Factorize K, or K shifted so that it is regular by about the lowest eigenvalue of what it
  !> holds.
  subroutine find_shift(solver, problem, companion, shift, error)
    type(solver_t), intent(inout) :: solver
    type(quadratic_t), intent(in) :: problem
    type(companion_t), intent(out) :: companion
    real(wp), intent(out) :: shift
    type(error_t), allocatable, intent(out) :: error
    integer :: attempt

    shift = 0
    do attempt = 0, most_shifts
      call solver%factorize(problem%k + shift*(problem%g + shift*problem%m), error)
      if (allocated(error)) return
      if (attempt == 0 .or. size(solver%null_pivots()) == 0) then
        call new_companion(solver, problem%equations, problem%coordinates, problem%row, &
                           problem%column, problem%m, problem%g + 2*shift*problem%m, companion, &
                           error)
        if (allocated(error)) return
        if (size(solver%null_pivots()) == 0) exit
      end if
      if (attempt > 0) then
        shift = 2*shift
      else if (companion%time > 0) then
        shift = 0.5_wp/companion%time
      else
        shift = own_rate(problem)
      end if
    end do
    if (size(solver%null_pivots()) > 0) then
      call fail(error, exit_solve, "EIGEN: a motion without mass has no stiffness")
    else if (.not. companion%time > 0) then
      call fail(error, exit_solve, "EIGEN: nothing that has mass can move")
    end if
  end subroutine find_shift

  !> A rate that damping and mass set where nothing is stiff.
  pure real(wp) function own_rate(problem) result(rate)
    type(quadratic_t), intent(in) :: problem

    rate = 1
    if (any(abs(problem%g) > 0) .and. any(abs(problem%m) > 0)) then
      rate = maxval(abs(problem%g))/maxval(abs(problem%m))
    end if
  end function own_rate

  !> Sort, complete the vectors, leave out what is not an eigenvalue.
  subroutine keep_nearest(solver, problem, companion, shift, wanted, mu, vector, spectrum, error)
    type(solver_t), intent(inout) :: solver
    type(quadratic_t), intent(in) :: problem
    type(companion_t), intent(in) :: companion
    real(wp), intent(in) :: shift
    integer, intent(in) :: wanted
    complex(wp), intent(in) :: mu(:), vector(:, :)
    type(spectrum_t), intent(inout) :: spectrum
    type(error_t), allocatable, intent(out) :: error
    complex(wp) :: lambda(size(mu)), x(problem%equations)
    real(wp) :: distance(size(mu)), change
    integer :: i, k
    type(entries_t) :: m, g

    call compress(problem%row, problem%column, problem%m, problem%coordinates, m)
    call compress(problem%row, problem%column, problem%g + 2*shift*problem%m, &
                  problem%coordinates, g)
    lambda = mu + shift
    where (abs(lambda) <= zero*abs(shift)) lambda = 0
    distance = abs(lambda) - tie*real(lambda)  ! of equal ones those that grow come first
    allocate (spectrum%lambda(min(wanted, size(mu))))
    allocate (spectrum%vector(problem%equations, size(spectrum%lambda)))
    do i = 1, size(mu)
      k = minloc(distance, 1)
      distance(k) = huge(1.0_wp)
      if (spectrum%found > 0) spectrum%cut = are_equal(lambda(k), spectrum%lambda(spectrum%found))
      if (spectrum%found == size(spectrum%lambda) .and. .not. spectrum%cut) return
      if (.not. abs(lambda(k)) > 0) then
        if (depends(vector(:, k), spectrum%vector(companion%active, :spectrum%found), &
                    companion%weight)) cycle
      end if
      if (spectrum%found == size(spectrum%lambda)) return
      call complete_vector(solver, companion, m, g, mu(k), vector(:, k), x, change, error)
      if (allocated(error)) return
      if (.not. change <= lost) cycle
      spectrum%found = spectrum%found + 1
      spectrum%lambda(spectrum%found) = lambda(k)
      spectrum%vector(:, spectrum%found) = x
    end do
    spectrum%cut = .false.
  end subroutine keep_nearest

  !> Whether a vector is, all but a thousandth, a sum of others.
  pure logical function depends(x, others, weight)
    complex(wp), intent(in) :: x(:), others(:, :)
    real(wp), intent(in) :: weight(:)
    complex(wp) :: q(size(x), size(others, 2) + 1)
    integer :: i, j

    q(:, size(q, 2)) = weight*x
    do i = 1, size(q, 2)
      if (i < size(q, 2)) q(:, i) = weight*others(:, i)
      q(:, i) = q(:, i)/norm2(abs(q(:, i)))
      do j = 1, i - 1
        q(:, i) = q(:, i) - dot_product(q(:, j), q(:, i))*q(:, j)
      end do
      if (i < size(q, 2)) q(:, i) = q(:, i)/norm2(abs(q(:, i)))
    end do
    depends = norm2(abs(q(:, size(q, 2)))) <= independent
  end function depends

  !> The coordinates that M and G do not know, and multipliers: x = -K^-1 (mu^2 M + mu G) x; what
  !> is known is kept. `change` is what that differs by, relatively.
  subroutine complete_vector(solver, companion, m, g, mu, known, x, change, error)
    type(solver_t), intent(inout) :: solver
    type(companion_t), intent(in) :: companion
    type(entries_t), intent(in) :: m, g
    complex(wp), intent(in) :: mu, known(:)
    complex(wp), intent(out) :: x(:)
    real(wp), intent(out) :: change
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(x)) :: part, inertial, viscous
    complex(wp) :: force(size(x))
    integer :: i

    associate (active => companion%active, weight => companion%weight)
      force = 0
      do i = 1, 2
        part = 0
        part(active) = merge(real(known), aimag(known), i == 1)
        inertial = 0
        viscous = 0
        call multiply_general(m, part, inertial)
        call multiply_general(g, part, viscous)
        force = force - merge((1.0_wp, 0.0_wp), (0.0_wp, 1.0_wp), i == 1)* &
                mu*(mu*inertial + viscous)
      end do
      part = real(force)
      call solver%solve(part, error)
      if (allocated(error)) return
      viscous = aimag(force)
      call solver%solve(viscous, error)
      x = cmplx(part, viscous, wp)
      change = norm2(weight*abs(x(active) - known))/max(norm2(weight*abs(known)), tiny(1.0_wp))
      x(active) = known
    end associate
  end subroutine complete_vector

end module linalg_quadratic
