!> COMPLIANCE of cantilevers against closed forms.
module test_compliance
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_solve
  use model_data, only: model_t, analysis_kinematic, analysis_compliance
  use memory_recorder, only: memory_t, run_deck
  use mechanism_kit, only: make_four_bar, add_analysis, run_mechanism
  implicit none
  private

  public :: run_compliance_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: e = 210e9_wp, g = 80e9_wp, length = 2
  real(wp), parameter :: a = 1e-3_wp, iy = 4e-7_wp, iz = 9e-8_wp, it = 2e-7_wp
  real(wp), parameter :: dy = 7e-4_wp, dz = 5e-4_wp

contains

  subroutine run_compliance_tests()
    call run("compliance: tip of a cantilever", cantilever)
    call run("compliance: cantilever under compression", column)
    call run("compliance: at a singular position", critical)
  end subroutine run_compliance_tests

  subroutine solve(settings, matrix)
    character(len=*), intent(in) :: settings(:)
    real(wp), intent(out) :: matrix(6, 6)
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    matrix = 0
    call run_deck("compliance", memory, model, error, settings)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    if (.not. allocated(memory%compliances)) return
    call expect(all(shape(memory%compliances) == [6, 6, 1]), "one matrix")
    matrix = memory%compliances(:, :, 1)
  end subroutine solve

  !> One element is exact.
  subroutine cantilever()
    real(wp) :: matrix(6, 6), wanted(6, 6)
    real(wp), parameter :: l = length

    call solve(["P=0"], matrix)
    wanted = 0
    wanted(1, 1) = l/(e*a)
    wanted(2, 2) = l**3/(3*e*iz) + l/(g*dy)
    wanted(3, 3) = l**3/(3*e*iy) + l/(g*dz)
    wanted(4, 4) = l/(g*it)
    wanted(5, 5) = l/(e*iy)
    wanted(6, 6) = l/(e*iz)
    wanted(2, 6) = l**2/(2*e*iz)
    wanted(3, 5) = -l**2/(2*e*iy)
    wanted(6, 2) = wanted(2, 6)
    wanted(5, 3) = wanted(3, 5)
    call expect_close(scaled(matrix), scaled(wanted), 1.0e-9_wp, "compliance over the bending ones")
  end subroutine cantilever

  !> Beam-column with k**2 = P/(E I), shear-rigid, next to incompressible.
  subroutine column()
    real(wp), parameter :: p = 0.4_wp*pi**2*e*iz/(4*length**2)
    real(wp) :: matrix(6, 6), wanted(6, 6), k, l
    character(len=32) :: setting

    write (setting, "('P=', es22.15)") p
    call solve([setting, "shear=OFF                       ", &
                "area=10                         ", "parts=16                        "], matrix)
    l = length
    wanted = 0
    k = sqrt(p/(e*iz))
    wanted(2, 2) = (tan(k*l)/k - l)/p
    wanted(2, 6) = (1/cos(k*l) - 1)/p
    wanted(6, 2) = wanted(2, 6)
    wanted(6, 6) = tan(k*l)*k/p
    k = sqrt(p/(e*iy))
    wanted(3, 3) = (tan(k*l)/k - l)/p
    wanted(3, 5) = -(1/cos(k*l) - 1)/p
    wanted(5, 3) = wanted(3, 5)
    wanted(5, 5) = tan(k*l)*k/p
    wanted(1, 1) = length/(10*e)
    wanted(4, 4) = matrix(4, 4)  ! with the Wagner effect, not asked here
    ! each of 16 elements errs by (k l/16)**4/720 of its stiffness
    call expect_close(scaled(matrix), scaled(wanted), 1.0e-6_wp, "compliance over the bending ones")
    call expect_close(scaled(matrix), scaled(transpose(matrix)), 1.0e-12_wp, "symmetry")
  end subroutine column

  !> Relative to that of bending.
  pure function scaled(matrix)
    real(wp), intent(in) :: matrix(6, 6)
    real(wp) :: scaled(6, 6), unit(6)
    integer :: i

    unit = sqrt([length/(e*a), length**3/(3*e*iz), length**3/(3*e*iy), length/(g*it), &
                 length/(e*iy), length/(e*iz)])
    do i = 1, 6
      scaled(:, i) = matrix(:, i)/(unit*unit(i))
    end do
  end function scaled

  !> A parallelogram that KINEMATIC left flattened: its coupler may turn either way.
  subroutine critical()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: b, c

    call make_four_bar(2.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 0.5_wp*pi, model, b, c)
    call add_analysis(model, analysis_kinematic, 0.5_wp*pi, 0.05_wp*pi)
    call add_analysis(model, analysis_compliance, 0.0_wp, 0.0_wp)
    model%analysis(2)%node = [c]
    call run_mechanism(model, memory, error)
    call expect(memory%steps == 11, "all steps")
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(error%status == exit_solve, "status of a singular state")
    call expect(index(error%message, "COMPLIANCE: the present state is singular") == 1, &
                "what is singular, got: "//error%message)
  end subroutine critical

end module test_compliance
