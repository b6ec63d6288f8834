!> Critical points of loaded states against closed forms and exact boundary-value problems.
module test_stability
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck
  use recorder, only: critical_bifurcation
  use program_runs, only: run_spar, scratch, outcome_t
  use result_reader, only: get_reals, get_integers, get_text
  implicit none
  private

  public :: run_stability_tests

contains

  subroutine run_stability_tests()
    call run("stability: lateral buckling at the loaded state (STB-07)", lateral)
    call run("stability: narrow strips (STB-11)", strips)
    call run("stability: L bracket (STB-15)", bracket)
    call run("stability: a critical mode is that of the theory", mode_shape)
    call run("stability: a column buckles and is followed to 120 degrees", column)
    call run("stability: an imperfect column (IMPERFECTION)", imperfect)
    call run("stability: beyond its Euler loads a column is said to be unstable", straight)
    call run("stability: critical points are kept in the result file", result_file)
  end subroutine run_stability_tests

  !> The first critical point of a deck over its reference, and that it is a bifurcation.
  subroutine expect_bifurcation(name, wanted, tolerance, settings)
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: wanted, tolerance
    character(len=*), intent(in), optional :: settings(:)
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../path/"//name, memory, model, error, settings)
    call expect(.not. allocated(error), name//": no error")
    if (allocated(error)) return
    call expect(size(memory%critical) > 0, name//": a critical point")
    if (size(memory%critical) == 0) return
    call expect(memory%critical(1)%kind == critical_bifurcation, name//": a bifurcation")
    call expect(memory%critical(1)%before == 0 .and. memory%critical(1)%behind == 1, &
                name//": one mode becomes unstable")
    call expect_close(memory%critical(1)%factor/wanted, 1.0_wp, tolerance, name)
  end subroutine expect_bifurcation

  !> In one plane beyond 1, in both beyond 2, the ratio of the stiffnesses.
  subroutine straight()
    character(len=*), parameter :: part(3) = ["part=0.99", "part=1.01", "part=2.02"]
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: k

    do k = 1, 3
      call run_deck("straight_column", memory, model, error, part(k:k))
      call expect(.not. allocated(error), "no error")
      if (allocated(error)) return
      call expect(size(memory%remarks) == merge(0, 1, k == 1), "a remark if it is unstable")
      if (size(memory%remarks) == 0) cycle
      call expect(index(memory%remarks(1)%s, "unstable ("//achar(k - 1 + iachar("0"))) > 0, &
                  "how many modes")
    end do
  end subroutine straight

  !> With pre-buckling deflection, factor 1/sqrt((1 - Iz/Iy)(1 - GIt/EIy ...)): 78364.56 Nm.
  subroutine lateral()
    call expect_bifurcation("lateral", 78.3645627396273_wp, 1.0e-3_wp)
  end subroutine lateral

  !> P L**2/sqrt(EIz GIt): twice the first zero of J(-1/4), and Timoshenko & Gere's 16.936, 28.315.
  !> Elements without warping twist uniformly, which costs (1/n)**2 times about one: 1e-3 at 32.
  subroutine strips()
    call expect_bifurcation("strip_cantilever", 4.012599343578898_wp, 1.0e-3_wp)
    call expect_bifurcation("strip_middle", 16.936_wp, 1.0e-3_wp)
    call expect_bifurcation("strip_weight", 28.315_wp, 1.0e-3_wp)
  end subroutine strips

  !> Exact boundary-value problems for both directions of the load.
  subroutine bracket()
    call expect_bifurcation("bracket", 1.087518237823576_wp, 5.0e-3_wp)
    call expect_bifurcation("bracket", 0.6804275693499096_wp, 5.0e-3_wp, ["f=-1"])
  end subroutine bracket

  !> The strip on forks buckles sideways and twists symmetrically: no vertical displacement.
  subroutine mode_shape()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: i, mirror

    call run_deck("../path/strip_middle", memory, model, error)
    if (allocated(error)) return
    if (size(memory%critical) == 0) return
    associate (mode => memory%critical(1)%mode)
      call expect(maxval(abs(mode(3, :))) <= 1.0e-4_wp*maxval(abs(mode(2, :))), &
                  "no vertical displacement")
      do i = 1, size(model%node)
        mirror = minloc(abs(model%node%position(1) - (1 - model%node(i)%position(1))), 1)
        call expect_close([mode(2, i) - mode(2, mirror), mode(4, i) - mode(4, mirror)] &
                          /maxval(abs(mode(2:4, :))), [0, 0]*1.0_wp, 1.0e-4_wp, "symmetric mode")
      end do
    end associate
  end subroutine mode_shape

  !> The elastica: P/Pcr = (2 K(k)/pi)**2 with k = sin(60 degrees), 1.884805; the tip is at
  !> x/L = 2 E(k)/K(k) - 1 = 0.1234 and y/L = 2 k/K(k) = 0.8032.
  subroutine column()
    real(wp), parameter :: k = 0.8660254037844386_wp, complete_k = 2.156515647499643_wp, &
                           complete_e = 1.2110560275684594_wp, pi = acos(-1.0_wp)
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: tip

    call run_deck("../path/column", memory, model, error)
    call expect(.not. allocated(error), "no error")
    if (allocated(error)) return
    call expect(size(memory%critical) > 0, "the column buckles")
    if (size(memory%critical) == 0) return
    call expect_close(memory%critical(1)%factor, 1.0_wp, 1.0e-3_wp, "Euler's load")
    call expect(memory%critical(1)%kind == critical_bifurcation, "a bifurcation")
    tip = findloc(model%node%id == 2, .true., 1)
    associate (n => memory%steps)
      call expect_close(abs(2*asin(memory%results(n)%euler(3, tip))), 2*pi/3, 1.0e-7_wp, &
                        "tip rotation")
      call expect_close(memory%record(n)%factor, (2*complete_k/pi)**2, 2.0e-3_wp, "load")
      call expect_close(1 + memory%results(n)%displacement(3, tip), 2*complete_e/complete_k - 1, &
                        2.0e-3_wp, "height of the tip")
      call expect_close(abs(memory%results(n)%displacement(1, tip)), 2*k/complete_k, 2.0e-3_wp, &
                        "sideways displacement of the tip")
    end associate
  end subroutine column

  !> A column whose shape is its first mode, amplitude a, deflects by a f/(1 - f) at the factor f of
  !> Euler's load (Timoshenko & Gere 1.12). Ten straight elements in place of the curve cost
  !> (pi/20)**2/12 = 0.2 %, finite slopes (w/L)**2 and less.
  subroutine imperfect()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: i, tip

    call run_deck("../path/imperfect", memory, model, error)
    call expect(.not. allocated(error), "no error")
    if (allocated(error) .or. memory%steps /= 9) return
    tip = findloc(model%node%id == 2, .true., 1)
    do i = 1, 9
      associate (f => memory%record(i)%factor)
        call expect_close(abs(memory%results(i)%displacement(1, tip))/(1.0e-3_wp*f/(1 - f)), &
                          1.0_wp, 4.0e-3_wp, "deflection")
      end associate
    end do
  end subroutine imperfect

  !> Williams' toggle as a user runs it: limit points with load factor and mode.
  subroutine result_file()
    character(len=*), parameter :: group = "/analysis/01_static/critical/0001"
    character(len=:), allocatable :: path, kind
    type(outcome_t) :: outcome
    real(wp), allocatable :: factor(:), mode(:)
    integer, allocatable :: extents(:), unstable(:)

    path = scratch("critical.h5")
    call run_spar("run tests/cases/path/williams.deck -o "//path, outcome)
    call expect(outcome%status == 0, "the run ends well")
    call get_reals(path, group//"/load_factor", factor, extents)
    call expect(size(factor) == 1, "a critical point")
    if (size(factor) /= 1) return
    call expect_close(factor/33.86123304140249_wp, [1.0_wp], 3.0e-3_wp, "the first limit load")
    call get_text(path, group, "kind", kind)
    call expect(kind == "limit point", "a limit point, not '"//kind//"'")
    call get_reals(path, group//"/displacement", mode, extents)
    call expect(all(extents == [17, 3]), "a mode for 17 nodes")
    call expect(maxloc(abs(mode), 1) == 6, "the apex, node 2, moves most and vertically")
    call get_integers(path, "/analysis/01_static/convergence/unstable_modes", unstable, extents)
    call expect(all(unstable == [0, 0, 1, 0, 0, 0, 0]), "unstable modes of each step")
  end subroutine result_file

end module test_stability
