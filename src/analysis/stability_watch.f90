!> Stability of equilibria: unstable modes from the inertia of the tangent, and the critical points
!> between two equilibria, located by bisection.
module stability_watch
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text, plural
  use nodal_state, only: coordinate_number, node_coordinates
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_constraints, only: coordinate_scale
  use system_newton, only: pattern_direction
  use system_unknowns, only: by_coordinate, by_unknown
  use newton_method, only: newton_t, newton_outcome_t, find_equilibrium, newton_converged
  use path_control, only: control_t
  use equilibrium_path, only: safe_t, keep_safe, go_back
  use model_data, only: control_displacement, control_arc, stability_off, stability_required
  use recorder, only: recorder_t, iteration_t, critical_t, critical_limit, critical_bifurcation
  implicit none
  private

  public :: watch_t, start_watch, watch_step, warn_of_unstable

  !> Bisections until the load factors of the bracket agree to 1e-6, halving a step each time.
  integer, parameter :: most_bisections = 40
  real(wp), parameter :: factor_accuracy = 1.0e-6_wp

  !> A mode whose scaled product with the loads is smaller than this is orthogonal to them:
  !> inverse iteration at a load within 1e-6 of the critical one leaves about 1e-6.
  real(wp), parameter :: orthogonal = 1.0e-4_wp

  !> What the watch knows.
  type :: watch_t
    integer :: stability = stability_off  !< what the analysis asks for, one of `stability_*`
    integer :: unstable = -1              !< unstable modes at the last equilibrium; -1: not counted
    logical :: branch = .false.           !< stop at the first bifurcation
    logical :: at_branch = .false.        !< the present state is that bifurcation, `point`
    type(critical_t) :: point
  end type watch_t

contains

  !> Count the unstable modes of the state the path starts from.
  subroutine start_watch(system, solver, stability, level, iterate, watch, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: stability
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    type(watch_t), intent(out) :: watch
    type(error_t), allocatable, intent(out) :: error

    watch%stability = stability
    if (stability == stability_off) return
    call assemble(system, level, iterate)
    call count_unstable(system, solver, iterate, watch%unstable, error)
  end subroutine start_watch

  !> Look at the equilibrium that an increment of `control` has reached from `before`: report the
  !> critical points between them. Stability REQUIRED and lost is an error; the state is then that
  !> of `before`. A bifurcation where the path is to branch becomes the present state.
  subroutine watch_step(system, solver, options, control, before, step, watch, level, iterate, &
                        recorder, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(newton_t), intent(in) :: options
    type(control_t), intent(in) :: control
    type(safe_t), intent(in) :: before
    integer, intent(in) :: step
    type(watch_t), intent(inout) :: watch
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(critical_t) :: point
    type(safe_t) :: reached
    integer :: unstable

    if (watch%stability == stability_off) return
    call count_unstable(system, solver, iterate, unstable, error)
    if (allocated(error)) return
    if (watch%at_branch) then
      watch%at_branch = .false.
      watch%branch = .false.
      watch%unstable = unstable
    end if
    if (unstable == watch%unstable) return
    call keep_safe(iterate, level, reached)
    call locate_critical(system, solver, options, control, before, watch%unstable, level, iterate, &
                         recorder, point, error)
    if (allocated(error)) return
    point%step = step
    point%before = watch%unstable
    point%behind = unstable
    call recorder%critical_point(point, error)
    if (allocated(error)) return
    if (watch%branch .and. point%kind == critical_bifurcation) then
      watch%at_branch = .true.
      watch%point = point
      return
    end if
    call go_back(reached, iterate, level)
    if (watch%stability == stability_required .and. unstable > 0) then
      call go_back(before, iterate, level)
      call fail(error, exit_solve, "stability is REQUIRED and lost at load factor "// &
                to_text(point%factor, 8))
      return
    end if
    watch%unstable = unstable
    call assemble(system, level, iterate)
  end subroutine watch_step

  !> Unstable modes of an assembled equilibrium: negative pivots beyond those of the constraints.
  !> With an unsymmetric tangent only the sign of the determinant is known: 0 or 1 then.
  subroutine count_unstable(system, solver, iterate, unstable, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(in) :: iterate
    integer, intent(out) :: unstable
    type(error_t), allocatable, intent(out) :: error
    integer :: parity

    unstable = 0
    call solver%factorize(iterate%values, error)
    if (allocated(error)) return
    if (system%pattern%symmetric) then
      unstable = solver%negative_pivots() - system%multipliers
    else
      parity = 1 - 2*modulo(system%multipliers, 2)
      if (solver%determinant_sign()*parity < 0) unstable = 1
    end if
  end subroutine count_unstable

  !> Where nobody watches: a warning if the present equilibrium, assembled, is unstable. Tells
  !> nothing of a tangent that is not symmetric, nor of a model that turns: gyroscopic forces may
  !> hold it.
  subroutine warn_of_unstable(system, solver, iterate, recorder, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(in) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    integer :: unstable

    if (.not. system%pattern%symmetric .or. size(system%rotor) > 0) return
    call count_unstable(system, solver, iterate, unstable, error)
    if (allocated(error) .or. unstable <= 0) return
    call recorder%remark("warning: the equilibrium reached is unstable ("// &
                         plural(unstable, "unstable mode")//"); STABILITY ON finds where that "// &
                         "began")
  end subroutine warn_of_unstable

  !> The first point between the equilibrium `before`, with `unstable` modes, and the present one
  !> where that number changes. `control` is that of the increment between them. The iterate is
  !> left at the critical point, on its far side.
  subroutine locate_critical(system, solver, options, control, before, unstable, level, iterate, &
                             recorder, point, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(newton_t), intent(in) :: options
    type(control_t), intent(in) :: control
    type(safe_t), intent(in) :: before
    integer, intent(in) :: unstable
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(critical_t), intent(out) :: point
    type(error_t), allocatable, intent(out) :: error
    type(safe_t) :: far
    real(wp) :: low, high, middle, near_factor, here
    integer :: count, i
    logical :: found

    low = 0
    high = 1
    near_factor = before%level(control%pattern)
    call keep_safe(iterate, level, far)
    do i = 1, most_bisections
      middle = 0.5_wp*(low + high)
      call probe(system, solver, options, control, before, middle, level, iterate, recorder, &
                 found, error)
      if (allocated(error)) return
      if (.not. found) exit
      call count_unstable(system, solver, iterate, count, error)
      if (allocated(error)) return
      here = level(control%pattern)
      if (count == unstable) then
        low = middle
        near_factor = here
      else
        high = middle
        call keep_safe(iterate, level, far)
      end if
      if (i > 2 .and. abs(far%level(control%pattern) - near_factor) <= &
          0.5_wp*factor_accuracy*abs(here) .and. high - low < 1.0e-3_wp) exit
    end do
    call go_back(far, iterate, level)
    call describe(system, solver, control%pattern, level, iterate, point, error)
  end subroutine locate_critical

  !> Equilibrium at a fraction of the increment from `before`; `control` knows the whole.
  subroutine probe(system, solver, options, control, before, fraction, level, iterate, &
                   recorder, found, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(newton_t), intent(in) :: options
    type(control_t), intent(in) :: control
    type(safe_t), intent(in) :: before
    real(wp), intent(in) :: fraction
    real(wp), intent(inout) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    logical, intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    type(newton_outcome_t) :: outcome
    type(control_t) :: part
    real(wp) :: start

    call go_back(before, iterate, level)
    part = control
    select case (control%kind)
    case (control_arc)
      part%arc = fraction*control%arc
      part%total = 0
    case (control_displacement)
      start = control%measure%value(before%state)
      part%target = start + fraction*(control%target - start)
    case default
      start = level(control%pattern)
      level(control%pattern) = start + fraction*(control%target - start)
    end select
    if (allocated(part%total)) part%total = 0
    call find_equilibrium(system, solver, options, part, level, iteration_t(), iterate, recorder, &
                          outcome, error)
    found = outcome%status == newton_converged
  end subroutine probe

  !> Kind and mode of the critical point at the present state: the mode by inverse iteration, in
  !> coordinates scaled to the model; a limit point's mode does work on the loads.
  subroutine describe(system, solver, pattern, level, iterate, point, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: pattern
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    type(critical_t), intent(inout) :: point
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: mode(system%coordinates)
    real(wp), dimension(system%equations()) :: solution, direction, scale
    integer :: k, i

    call assemble(system, level, iterate)
    call solver%factorize(iterate%values, error)
    if (allocated(error)) return
    call inverse_iteration(system, solver, mode, solution, error)
    if (allocated(error)) return
    direction = pattern_direction(system, iterate%state, level, pattern)
    scale = 1
    do k = 1, system%coordinates
      if (system%unknown(k) > 0) scale(system%unknown(k)) = coordinate_scale(system, k)
    end do
    if (system%multipliers > 0) then
      scale(system%unknowns + 1:) = maxval(abs(solution(system%unknowns + 1:)))
    end if
    point%kind = critical_bifurcation
    if (abs(dot_product(direction, solution)) > orthogonal*norm2(direction*scale)) then
      point%kind = critical_limit
    end if
    point%factor = level(pattern)
    mode = [(mode(k)*coordinate_scale(system, k), k=1, system%coordinates)]
    allocate (point%mode(node_coordinates, system%nodes))
    do i = 1, system%nodes
      point%mode(:, i) = mode(coordinate_number(i, 1):coordinate_number(i, node_coordinates))
    end do
  end subroutine describe

  !> The eigenvector of the smallest eigenvalue, scaled to length one and a positive largest entry,
  !> from a fixed start; held coordinates are zero.
  subroutine inverse_iteration(system, solver, mode, x, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    real(wp), intent(out) :: mode(:)
    real(wp), intent(out) :: x(:)      !< the same by unknown, not scaled, with the multipliers
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: length, scale(size(mode))
    integer :: k, sweep

    scale = [(coordinate_scale(system, k), k=1, size(mode))]
    do k = 1, system%coordinates
      mode(k) = 1 + 0.5_wp*sin(real(k, wp))
    end do
    do sweep = 1, 4
      x = by_unknown(system, mode/scale)
      call solver%solve(x, error)
      if (allocated(error)) return
      mode = by_coordinate(system, x)/scale
      length = sign(norm2(mode), mode(maxloc(abs(mode), 1)))
      mode = mode/length
      x = x/length
    end do
  end subroutine inverse_iteration

end module stability_watch
