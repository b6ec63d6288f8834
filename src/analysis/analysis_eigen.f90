!> EIGEN: frequencies and modes of small vibrations about the present state,
!> (K + G) x = omega**2 M x (theory 8); complex ones as `complex_modes` finds them.
!>
!> A state that nothing holds, or that is unstable, has frequencies that are zero or imaginary;
!> they are found by a shift below all of them.
module analysis_eigen
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_solve
  use text, only: to_text, plural
  use model_data, only: model_t, analysis_t
  use linalg_solver, only: solver_t
  use linalg_eigen, only: pencil_t, pairs_t, estimate_theta
  use linalg_spectrum, only: find_spectrum, count_between
  use linalg_equality, only: are_equal
  use nodal_state, only: node_coordinates
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_blocks, only: half_t, new_half, fold
  use system_geometric, only: is_conservative
  use system_linear, only: matrices_t, linearize
  use system_loads, only: amplitudes
  use system_rotation, only: spin_at
  use system_inertia, only: masses_t, new_masses, assemble_mass, mass_product, mass_centre, &
                            rigid_motion
  use system_names, only: coordinate_name
  use system_unknowns, only: by_coordinate
  use complex_modes, only: find_complex_modes, say_complex
  use mode_results, only: modes_t, new_modes, add_mode, unit_factor
  use recorder, only: recorder_t
  implicit none
  private

  public :: run_eigen

  real(wp), parameter :: pi = acos(-1.0_wp)

  !> An eigenvalue this small against the lowest elastic one is that of a free motion.
  real(wp), parameter :: zero_eigenvalue = 1.0e-7_wp

  !> Doublings of the shift before a state is given up.
  integer, parameter :: most_shifts = 60

contains

  !> Frequencies about the state of `iterate` under the patterns' `level`.
  subroutine run_eigen(model, system, solver, analysis, level, iterate, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(inout) :: iterate
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(masses_t) :: masses
    type(matrices_t) :: matrices
    type(modes_t) :: modes
    logical :: complex

    if (system%unknowns == 0) then
      call fail(error, exit_deck, "nothing can move: every coordinate is fixed")
      return
    end if
    call assemble(system, level, iterate)
    call new_masses(model, system, masses)
    if (masses%bodies == 0) then
      call fail(error, exit_deck, "EIGEN needs mass: give RHO to a MATERIAL, EM to an element"// &
                " or XM to a node")
      return
    end if
    complex = is_complex(system, analysis, level, iterate)
    if (complex .or. analysis%matrices) then
      call linearize(model, system, masses, level, iterate, analysis%damped, matrices)
    end if
    if (complex) then
      call find_complex_modes(model, system, masses, matrices, analysis, iterate, modes, error)
    else
      call find_real_modes(model, system, solver, masses, analysis, iterate, modes, error)
    end if
    if (allocated(error)) return
    if (analysis%damped) then
      if (.not. any(abs(matrices%c) > 0)) call recorder%remark( &
        "warning: DAMPED, but nothing in the model damps")
    end if
    if (analysis%matrices) call keep_matrices(model, system, matrices, modes)
    call recorder%modes(modes, error)
    if (allocated(error)) return
    if (complex) then
      call say_complex(modes, recorder)
    else
      call say(modes, recorder)
    end if
  end subroutine run_eigen

  !> Whether frequencies are complex: the model turns, is damped, or has loads without a potential.
  pure logical function is_complex(system, analysis, level, iterate)
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(in) :: iterate

    is_complex = analysis%damped .or. any(abs(spin_at(system, level)) > 0)
    if (is_complex .or. system%pattern%symmetric) return
    is_complex = any(abs(amplitudes(system, level)) > 0) .and. &
                 .not. is_conservative(system, iterate)
  end function is_complex

  !> The matrices and the names of their rows, for who records the modes.
  pure subroutine keep_matrices(model, system, matrices, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(matrices_t), intent(in) :: matrices
    type(modes_t), intent(inout) :: modes
    integer :: k

    modes%matrices = matrices
    allocate (modes%unknown(system%unknowns), modes%unknown_of(2, system%unknowns))
    modes%unknown_of = 0
    do k = 1, system%coordinates
      associate (at => system%unknown(k))
        if (at == 0) cycle
        modes%unknown(at) = coordinate_name(model, k)
        if (k > node_coordinates*system%nodes) cycle
        modes%unknown_of(:, at) = [(k - 1)/node_coordinates, modulo(k - 1, node_coordinates)] + 1
      end associate
    end do
  end subroutine keep_matrices

  !> The real problem, with the symmetric part of K where supports make it conservative.
  subroutine find_real_modes(model, system, solver, masses, analysis, iterate, modes, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(masses_t), intent(in) :: masses
    type(analysis_t), intent(in) :: analysis
    type(iterate_t), intent(in) :: iterate
    type(modes_t), intent(out) :: modes
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: own
    type(half_t) :: half
    type(pencil_t) :: pencil
    real(wp) :: mass(size(system%pattern%row))

    call assemble_mass(system, masses, iterate%state, mass)
    call new_half(system%equations(), system%pattern, half)
    pencil%coordinates = system%unknowns
    pencil%equations = system%equations()
    pencil%semidefinite = .true.
    pencil%row = half%row
    pencil%column = half%column
    pencil%a = fold(half, iterate%values)
    pencil%q = fold(half, mass)
    if (system%pattern%symmetric) then
      call find_frequencies(model, system, solver, pencil, masses, analysis, iterate, modes, error)
      return
    end if
    call own%prepare(pencil%equations, half%row, half%column, .true., error)
    if (.not. allocated(error)) then
      call find_frequencies(model, system, own, pencil, masses, analysis, iterate, modes, error)
    end if
    call own%free()
  end subroutine find_real_modes

  !> Solve, name the kinds of the eigenvalues.
  subroutine find_frequencies(model, system, solver, pencil, masses, analysis, iterate, modes, &
                              error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(inout) :: pencil
    type(masses_t), intent(in) :: masses
    type(analysis_t), intent(in) :: analysis
    type(iterate_t), intent(in) :: iterate
    type(modes_t), intent(out) :: modes
    type(error_t), allocatable, intent(out) :: error
    type(pairs_t) :: pairs
    real(wp), allocatable :: value(:)
    real(wp) :: shift
    integer :: n

    call find_shift(model, system, solver, pencil, shift, error)
    if (allocated(error)) return
    n = min(analysis%modes, pencil%coordinates - (pencil%equations - pencil%coordinates))
    call new_modes(system, n, modes)
    call find_spectrum(solver, pencil, [n, 0], &
                       [2*pencil%coordinates - pencil%equations, 0], pairs, modes%complete, error)
    if (allocated(error)) return
    n = min(n, pairs%found(1))
    value = 1/pairs%theta(:pairs%found(1)) + shift
    where (abs(value) <= zero_eigenvalue*abs(shift)) value = 0
    modes%eigenvalue = value(:n)
    if (n > 0 .and. n < size(value)) then
      modes%cut(2) = are_equal(cmplx(value(n), kind=wp), cmplx(value(n + 1), kind=wp))
    end if
    modes%frequency = sqrt(max(0.0_wp, modes%eigenvalue))/(2*pi)
    modes%imaginary = sqrt(max(0.0_wp, -modes%eigenvalue))/(2*pi)
    modes%damping = 0*modes%eigenvalue
    call add_modes(model, system, masses, iterate, pairs, n, modes)
  end subroutine find_frequencies

  !> Modes of mass 1, largest component positive.
  subroutine add_modes(model, system, masses, iterate, pairs, n, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(iterate_t), intent(in) :: iterate
    type(pairs_t), intent(in) :: pairs
    integer, intent(in) :: n
    type(modes_t), intent(inout) :: modes
    real(wp) :: rigid(system%coordinates, 6), moving(system%coordinates, 6)
    real(wp) :: solution(system%equations())
    integer :: i, j

    modes%centre = mass_centre(masses, iterate%state)
    rigid = rigid_motion(masses, iterate%state, modes%centre, system%coordinates)
    call mass_product(masses, iterate%state, rigid, moving)
    allocate (modes%participation(6, n), modes%effective_mass(6, n))
    do j = 1, 6
      modes%rigid_mass(j) = dot_product(rigid(:, j), moving(:, j))
    end do
    do i = 1, n
      solution = pairs%vector(:, i)/sqrt(pairs%theta(i))
      solution = sign(1.0_wp, unit_factor(system, solution))*solution
      call add_mode(model, system, iterate, solution, modes)
      if (abs(modes%eigenvalue(i)) <= 0) modes%energy(:, i) = 0
      modes%participation(:, i) = matmul(by_coordinate(system, solution), moving)
      modes%effective_mass(:, i) = modes%participation(:, i)**2
    end do
  end subroutine add_modes

  !> Factorize A = K - shift M with a shift below all eigenvalues: zero where the state is stable,
  !> else about as far below zero as the lowest frequency of the held body is above.
  subroutine find_shift(model, system, solver, pencil, shift, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(pencil_t), intent(inout) :: pencil
    real(wp), intent(out) :: shift
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: stiffness(:)
    real(wp) :: theta
    integer, allocatable :: singular(:)
    integer :: attempt, below

    shift = 0
    call count_between(solver, pencil, 0.0_wp, below, error)
    if (allocated(error)) return
    allocate (singular, source=solver%null_pivots())
    if (below == 0 .and. size(singular) == 0) return
    call estimate_theta(solver, pencil, theta, error)
    if (allocated(error)) return
    if (.not. theta > 0) then
      call fail(error, exit_solve, "EIGEN: nothing that has mass can move")
      return
    end if
    shift = -1/theta
    stiffness = pencil%a
    do attempt = 1, most_shifts
      pencil%a = stiffness - shift*pencil%q
      call count_between(solver, pencil, 0.0_wp, below, error)
      if (allocated(error)) return
      singular = solver%null_pivots()
      if (below == 0 .and. size(singular) == 0) return
      shift = 2*shift
    end do
    call fail(error, exit_solve, "EIGEN: a motion without mass has no stiffness")
    if (size(singular) == 0) return
    error%message = error%message//": "//unknown_name(model, system, singular(1))
  end subroutine find_shift

  !> Name of an unknown.
  pure function unknown_name(model, system, unknown) result(name)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: unknown
    character(len=:), allocatable :: name

    name = "a constraint"
    if (unknown <= system%unknowns) then
      name = coordinate_name(model, findloc(system%unknown, unknown, 1))
    end if
  end function unknown_name

  !> What the user has to know of the spectrum.
  subroutine say(modes, recorder)
    type(modes_t), intent(in) :: modes
    class(recorder_t), intent(inout) :: recorder
    integer :: unstable, free

    unstable = count(modes%eigenvalue < 0)
    free = count(abs(modes%eigenvalue) <= 0)
    if (unstable > 0) call recorder%remark("warning: the state is unstable: "// &
      plural(unstable, "mode")//" with imaginary frequency")
    if (free > 0) call recorder%remark(plural(free, "free motion")//" with frequency zero")
    if (modes%complete) then
      call recorder%remark("no frequency is missing up to mode "//to_text(modes%modes))
    else
      call recorder%remark("warning: frequencies may be missing below that of mode "// &
                           to_text(modes%modes))
    end if
  end subroutine say

end module analysis_eigen
