!> EIGEN where frequencies are complex: of a model that turns, that is damped or that has loads
!> without a potential, M x'' + C x' + (K + G - N) x = 0 (theory 8).
module complex_modes
  use kinds, only: wp
  use errors, only: error_t
  use text, only: to_text, plural
  use model_data, only: model_t, analysis_t
  use linalg_solver, only: solver_t
  use linalg_quadratic, only: quadratic_t, spectrum_t, find_complex
  use system_data, only: system_t, masses_t
  use system_assembly, only: iterate_t
  use system_inertia, only: mass_centre, rigid_motion, mass_product
  use system_linear, only: matrices_t
  use system_unknowns, only: by_coordinate
  use mode_results, only: modes_t, new_modes, add_complex_mode, largest_component
  use recorder, only: recorder_t
  implicit none
  private

  public :: find_complex_modes, say_complex

  real(wp), parameter :: pi = acos(-1.0_wp)

  !> A damping ratio below this is round-off: double eigenvalues split that far.
  real(wp), parameter :: undamped = 1.0e-6_wp

contains

  !> The analysis' modes from the matrices of its state.
  subroutine find_complex_modes(model, system, masses, matrices, analysis, iterate, modes, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(matrices_t), intent(in) :: matrices
    type(analysis_t), intent(in) :: analysis
    type(iterate_t), intent(in) :: iterate
    type(modes_t), intent(out) :: modes
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver
    type(quadratic_t) :: problem
    type(spectrum_t) :: spectrum
    integer :: i

    problem%coordinates = matrices%unknowns
    problem%equations = matrices%equations
    problem%row = matrices%row
    problem%column = matrices%column
    problem%k = matrices%k + matrices%g - matrices%n
    problem%g = matrices%c
    problem%m = matrices%m
    call solver%prepare(problem%equations, problem%row, problem%column, .false., error)
    if (.not. allocated(error)) then
      call find_complex(solver, problem, min(analysis%modes, 2*problem%coordinates), spectrum, &
                        error)
    end if
    call solver%free()
    if (allocated(error)) return
    call new_modes(system, spectrum%found, modes)
    call set_eigenvalues(spectrum, modes)
    call set_masses(system, masses, iterate, modes)
    do i = 1, modes%modes
      call normalize(system, masses, iterate, spectrum%vector(:, i))
    end do
    modes%modes = 0
    do i = 1, spectrum%found
      call add_complex_mode(model, system, iterate, spectrum%vector(:, i), modes)
    end do
  end subroutine find_complex_modes

  !> Frequencies and damping ratios from lambda = omega (-ratio +- i sqrt(1 - ratio**2)).
  pure subroutine set_eigenvalues(spectrum, modes)
    type(spectrum_t), intent(in) :: spectrum
    type(modes_t), intent(inout) :: modes
    integer :: n

    n = spectrum%found
    modes%modes = n
    modes%complete = spectrum%complete
    modes%cut(2) = spectrum%cut
    modes%lambda = spectrum%lambda(:n)
    allocate (modes%damping(n))
    modes%damping = -real(modes%lambda)/max(abs(modes%lambda), tiny(1.0_wp))
    where (abs(modes%damping) <= undamped)
      modes%lambda = cmplx(0.0_wp, aimag(modes%lambda), wp)
      modes%damping = 0
    end where
    modes%frequency = aimag(modes%lambda)/(2*pi)
    modes%imaginary = max(0.0_wp, real(modes%lambda))/(2*pi)
  end subroutine set_eigenvalues

  !> Mass, its centre and its inertia about that.
  pure subroutine set_masses(system, masses, iterate, modes)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(iterate_t), intent(in) :: iterate
    type(modes_t), intent(inout) :: modes
    real(wp), dimension(system%coordinates, 6) :: rigid, moving
    integer :: j

    modes%centre = mass_centre(masses, iterate%state)
    rigid = rigid_motion(masses, iterate%state, modes%centre, system%coordinates)
    call mass_product(masses, iterate%state, rigid, moving)
    do j = 1, 6
      modes%rigid_mass(j) = dot_product(rigid(:, j), moving(:, j))
    end do
  end subroutine set_masses

  !> Mass 1 (largest component 1 if nothing with mass moves), largest component real and positive.
  pure subroutine normalize(system, masses, iterate, x)
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    type(iterate_t), intent(in) :: iterate
    complex(wp), intent(inout) :: x(:)
    real(wp), dimension(system%coordinates, 2) :: motion, moving
    real(wp) :: mass
    integer :: at

    at = largest_component(system, abs(x))
    if (at == 0) return
    x = x*conjg(x(at))/abs(x(at))**2
    motion(:, 1) = by_coordinate(system, real(x))
    motion(:, 2) = by_coordinate(system, aimag(x))
    call mass_product(masses, iterate%state, motion, moving)
    mass = sum(motion*moving)
    if (mass > epsilon(1.0_wp)*masses%total) x = x/sqrt(mass)
  end subroutine normalize

  !> What the user has to know of the spectrum.
  subroutine say_complex(modes, recorder)
    type(modes_t), intent(in) :: modes
    class(recorder_t), intent(inout) :: recorder
    integer :: growing, free

    growing = count(real(modes%lambda) > 0)
    free = count(.not. abs(modes%lambda) > 0)
    if (growing > 0) call recorder%remark("warning: the state is unstable: "// &
      plural(growing, "growing mode")//", the fastest as exp("// &
      to_text(maxval(real(modes%lambda)), 4)//" t)")
    if (free > 0) call recorder%remark(plural(free, "free motion")//" with frequency zero")
    if (modes%complete) then
      call recorder%remark("no frequency is missing up to mode "//to_text(modes%modes))
    else
      call recorder%remark("found by iteration; complex frequencies are not counted")
    end if
  end subroutine say_complex

end module complex_modes
