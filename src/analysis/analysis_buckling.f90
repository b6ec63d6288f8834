!> BUCKLING: by how much a load pattern has to grow until the state becomes unstable, linearized,
!> (K + lambda G) x = 0 (theory 8).
!>
!> K is the tangent of the present state, unloaded or after STATIC; G comes from the stresses that
!> a unit more of the pattern causes there, and from the loads themselves.
module analysis_buckling
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_solve
  use text, only: to_text, plural
  use model_data, only: model_t, analysis_t
  use linalg_solver, only: solver_t
  use linalg_eigen, only: pencil_t, pairs_t, estimate_theta
  use linalg_spectrum, only: find_spectrum, count_between
  use linalg_equality, only: are_equal
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_blocks, only: half_t, new_half, fold
  use system_geometric, only: stress_increments, assemble_geometric, is_conservative
  use system_newton, only: pattern_direction
  use mode_results, only: modes_t, new_modes, add_mode, unit_factor, symmetric_part
  use recorder, only: recorder_t
  implicit none
  private

  public :: run_buckling

  !> Multipliers this many times the smallest are not looked for.
  real(wp), parameter :: reach = 1.0e4_wp

contains

  !> Multipliers of the analysis' pattern from the state of `iterate` under the patterns' `level`.
  subroutine run_buckling(model, system, solver, analysis, level, iterate, recorder, modes, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(modes_t), intent(out) :: modes
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: own
    type(half_t) :: half
    type(pencil_t) :: pencil
    real(wp) :: geometric(size(system%pattern%row))

    call check_pattern(system, analysis%pattern, error)
    if (allocated(error)) return
    call assemble(system, level, iterate)
    call load_stiffness(system, solver, analysis%pattern, level, iterate, geometric, error)
    if (allocated(error)) return
    call new_half(system%equations(), system%pattern, half)
    pencil%coordinates = system%unknowns
    pencil%equations = system%equations()
    pencil%row = half%row
    pencil%column = half%column
    pencil%a = fold(half, iterate%values)
    pencil%q = -fold(half, geometric)
    if (system%pattern%symmetric) then
      call find_multipliers(model, system, solver, pencil, analysis, level, iterate, recorder, &
                            modes, error)
      return
    end if
    if (.not. is_conservative(system, iterate)) call recorder%remark("warning: "//symmetric_part)
    call own%prepare(pencil%equations, half%row, half%column, .true., error)
    if (.not. allocated(error)) then
      call find_multipliers(model, system, own, pencil, analysis, level, iterate, recorder, modes, &
                            error)
    end if
    call own%free()
  end subroutine run_buckling

  !> There is a pattern, and its loads are in proportion to its factor.
  subroutine check_pattern(system, pattern, error)
    type(system_t), intent(in) :: system
    integer, intent(in) :: pattern
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    if (pattern == 0) call fail(error, exit_deck, "BUCKLING needs a load: none is given before it")
    do i = 1, size(system%load)
      if (system%load(i)%pattern /= pattern .or. system%load(i)%function == 0) cycle
      call fail(error, exit_deck, "BUCKLING cannot scale a load with FUNCTION '"// &
                trim(system%function(system%load(i)%function)%name)//"'")
      return
    end do
  end subroutine check_pattern

  !> G, by entry of the system's pattern.
  subroutine load_stiffness(system, solver, pattern, level, iterate, geometric, error)
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    integer, intent(in) :: pattern
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(out) :: geometric(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(system%equations()), stress(size(system%multiplier))

    call solver%factorize(iterate%values, error)
    if (allocated(error)) return
    solution = pattern_direction(system, iterate%state, level, pattern)
    call solver%solve(solution, error)
    if (allocated(error)) return
    call stress_increments(system, iterate, solution, stress)
    call assemble_geometric(system, iterate, stress, pattern, size(level), geometric)
  end subroutine load_stiffness

  !> Solve and record, the multipliers in rising order.
  subroutine find_multipliers(model, system, solver, pencil, analysis, level, iterate, recorder, &
                              modes, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(in) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(modes_t), intent(out) :: modes
    type(error_t), allocatable, intent(out) :: error
    type(pairs_t) :: pairs
    integer :: available(2), kept(2), k

    call count_multipliers(solver, pencil, available, error)
    if (allocated(error)) return
    kept = min(analysis%modes, available)
    call new_modes(system, sum(kept), modes)
    allocate (modes%multiplier(0))
    if (sum(kept) > 0) then
      call find_spectrum(solver, pencil, kept, available, pairs, modes%complete, error)
      if (allocated(error)) return
      kept = min(kept, pairs%found)
      modes%cut = [cut_behind(pairs%found(1) + kept(2), sum(pairs%found)), &
                   cut_behind(kept(1), pairs%found(1))]
    end if
    do k = pairs%found(1) + kept(2), pairs%found(1) + 1, -1
      call add_pair(k)
    end do
    do k = 1, kept(1)
      call add_pair(k)
    end do
    modes%load_factor = level(analysis%pattern) + modes%multiplier
    call recorder%modes(modes, error)
    if (.not. allocated(error)) call say(modes, available, recorder)

  contains

    !> Whether pair k, the last one kept of its sign, has an equal among those behind.
    logical function cut_behind(k, last)
      integer, intent(in) :: k, last

      cut_behind = .false.
      if (k > 0 .and. k < last) cut_behind = are_equal(cmplx(pairs%theta(k), kind=wp), &
                                                       cmplx(pairs%theta(k + 1), kind=wp))
    end function cut_behind

    subroutine add_pair(k)
      integer, intent(in) :: k

      modes%multiplier = [modes%multiplier, 1/pairs%theta(k)]
      call add_mode(model, system, iterate, unit_factor(system, pairs%vector(:, k))* &
                    pairs%vector(:, k), modes)
    end subroutine add_pair

  end subroutine find_multipliers

  !> Factorize A, which must be stable, and count the multipliers of each sign within reach; the
  !> factors of A are left.
  subroutine count_multipliers(solver, pencil, available, error)
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(in) :: pencil
    integer, intent(out) :: available(2)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: theta
    integer :: unstable

    available = 0
    call count_between(solver, pencil, 0.0_wp, unstable, error)
    if (allocated(error)) return
    if (unstable > 0 .or. size(solver%null_pivots()) > 0) then
      call fail(error, exit_solve, "BUCKLING needs a stable state: the present one has "// &
                plural(max(1, unstable), "unstable mode"))
      return
    end if
    call estimate_theta(solver, pencil, theta, error)
    if (allocated(error) .or. .not. theta > 0) return
    call count_between(solver, pencil, reach/theta, available(1), error)
    if (.not. allocated(error)) call count_between(solver, pencil, -reach/theta, available(2), &
                                                   error)
    if (.not. allocated(error)) call solver%factorize(pencil%a, error)
  end subroutine count_multipliers

  !> What the user has to know of the multipliers.
  subroutine say(modes, available, recorder)
    type(modes_t), intent(in) :: modes
    integer, intent(in) :: available(2)
    class(recorder_t), intent(inout) :: recorder
    integer :: side
    character(len=8), parameter :: sign_name(2) = ["positive", "negative"]

    do side = 1, 2
      if (available(side) == 0) call recorder%remark("there is no "//sign_name(side)// &
        " multiplier, within "//to_text(nint(reach))//" times the smallest")
    end do
    if (sum(available) == 0) return
    if (modes%complete) then
      call recorder%remark("no multiplier is missing between these")
    else
      call recorder%remark("warning: multipliers may be missing between these")
    end if
  end subroutine say

end module analysis_buckling
