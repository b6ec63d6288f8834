!> KINEMATIC of spatial mechanisms, from their decks.
module test_spatial_mechanisms
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck
  use program_runs, only: scratch, run_spar, outcome_t
  use result_reader, only: get_reals, get_numbers
  implicit none
  private

  public :: run_spatial_mechanisms_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_spatial_mechanisms_tests()
    call run("spatial: slider-crank, a full turn (MBD-13)", slider_crank)
    call run("spatial: Bricard mechanism through its range (MBD-11)", bricard)
    call run("spatial: the four-bar linkage of the manual", four_bar)
    call run("spatial: KINEMATIC in the result file", written)
  end subroutine run_spatial_mechanisms_tests

  !> The rod's length gives the slider: s**2 = l**2 - |B|**2, with B the pin in the plane x = 0.
  subroutine slider_crank()
    real(wp), parameter :: r = 0.08_wp, l = 0.3_wp, y = 0.1_wp, z = 0.12_wp, w = 2*pi
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    real(wp) :: t, b(2), db(2), s, ds, dds
    integer :: i

    call run_deck("../kinematic/spatial_slider_crank", memory, model, error)
    call expect(.not. allocated(error), "no error")
    call expect(memory%steps == 361, "the start and 360 steps")
    do i = 1, memory%steps
      t = (i - 1)*pi/180
      b = [y - r*sin(t), z + r*cos(t)]
      db = -r*[cos(t), sin(t)]
      s = sqrt(l**2 - dot_product(b, b))
      ds = -dot_product(b, db)/s
      dds = -(r**2 - dot_product(b, b - [y, z]) + ds**2)/s
      associate (now => memory%results(i))
        call expect_close(model%node(3)%position(1) + now%displacement(1, 3), s, 1.0e-12_wp, &
                          "slider")
        call expect_close(now%velocity(1, 3), w*ds, 1.0e-11_wp*w, "its velocity")
        call expect_close(now%acceleration(1, 3), w**2*dds, 1.0e-10_wp*w**2, "its acceleration")
        call expect_close(now%joint_strain(1, 3), s - model%node(3)%position(1), 1.0e-12_wp, &
                          "slide of the prismatic joint")
        call expect_close(now%displacement(2:3, 2), b - [y, z + r], 1.0e-12_wp, "pin of the crank")
      end associate
      call expect(memory%record(i)%last%constraint <= 1.0e-12_wp, "constraints hold")
    end do
  end subroutine slider_crank

  !> Three and three hinges turn alike. The closure of a threefold-symmetric Bricard mechanism with
  !> right twists is cos a + cos b + cos a cos b = 0, with angles a, b that are 90 degrees as drawn.
  subroutine bricard()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    real(wp) :: a, b, wanted
    integer :: i

    call run_deck("../kinematic/bricard", memory, model, error)
    call expect(.not. allocated(error), "no error")
    call expect(memory%steps == 4 + 51, "all steps of both analyses")
    call expect(size(memory%remarks) == 1, "one constraint is too many")
    if (size(memory%remarks) == 1) call expect(index(memory%remarks(1)%s, &
      "overconstrained once: element") > 0, "what the warning says")
    do i = 1, memory%steps
      wanted = -pi/9*i/4
      if (i > 4) wanted = -pi/9 + 220*pi/180*(i - 5)/50
      associate (strain => memory%results(i)%joint_strain)
        call expect_close(strain(1, 1), wanted, 1.0e-12_wp, "driven hinge")
        a = pi/2 - strain(1, 1)
        b = pi/2 - strain(1, 2)
        call expect_close(cos(a) + cos(b) + cos(a)*cos(b), 0.0_wp, 1.0e-11_wp, "closure")
        call expect_close(strain(1, 3:5:2), strain(1, 1)*[1, 1], 1.0e-11_wp, "like the first")
        call expect_close(strain(1, 4:6:2), strain(1, 2)*[1, 1], 1.0e-11_wp, "like the second")
        call expect(maxval(abs(strain(2:, :))) <= 1.0e-12_wp, "tilts, the redundant one as well")
      end associate
      call expect(maxval(abs(memory%results(i)%strain)) <= 1.0e-12_wp, "lengths of 1")
    end do
  end subroutine bricard

  !> Determinate in space. The drive's power changes the energy of the coupler: over a turn nothing
  !> is left, where the trapezoidal rule is exact but for what 100 points cannot resolve.
  subroutine four_bar()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    real(wp) :: power(100), speed(3)
    integer :: i

    call run_deck("../../../decks/four_bar", memory, model, error)
    call expect(.not. allocated(error), "no error")
    call expect(size(memory%remarks) == 0, "neither too many constraints nor too few")
    call expect(memory%steps == 202, "all steps of both analyses")
    if (memory%steps /= 202) return
    do i = 1, 100
      associate (now => memory%results(102 + i))
        power(i) = -2*pi*now%joint_stress(1, 1)
        speed = now%velocity(1:3, 5)
        call expect_close(power(i), 2*dot_product(speed, now%acceleration(1:3, 5)) &
                          + 2*9.81_wp*speed(2) + 0.01_wp*now%velocity(6, 5) &
                          *now%acceleration(6, 5), 1.0e-9_wp, "power of the drive")
        call expect_close(now%displacement(:, 3), memory%results(1 + i)%displacement(:, 3), &
                          1.0e-12_wp, "the same path")
      end associate
    end do
    call expect_close(sum(power), 0.0_wp, 1.0e-9_wp*maxval(abs(power))*100, "work of a turn")
  end subroutine four_bar

  !> It knows no masses: velocities are there, energies are not.
  subroutine written()
    type(outcome_t) :: outcome
    real(wp), allocatable :: values(:)
    integer, allocatable :: extents(:), complete(:)
    character(len=:), allocatable :: path

    path = scratch("spatial.h5")
    call run_spar("run tests/cases/kinematic/spatial_slider_crank.deck --quiet -o "//path, outcome)
    call expect(outcome%status == 0, "exit status")
    call get_numbers(path, "/analysis/01_turn", "complete", complete)
    call expect(all(complete == [1]), "complete")
    call get_reals(path, "analysis/01_turn/nodes/velocity", values, extents)
    call expect(all(extents == [361*7, 3]), "velocities of seven nodes")
    call get_reals(path, "analysis/01_turn/joints/rate", values, extents)
    call expect(all(extents == [361*3, 6]), "rates of three joints")
    if (size(values) > 0) call expect_close(values(1), 2*pi, 1.0e-12_wp, "rate of the crank")
    call get_reals(path, "analysis/01_turn/energy/kinetic", values, extents)
    call expect(size(values) == 0, "no energies")
  end subroutine written

end module test_spatial_mechanisms
