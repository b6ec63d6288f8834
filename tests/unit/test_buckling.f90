!> BUCKLING of whole decks against closed forms, published numbers and an independent program.
module test_buckling
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck, exit_solve
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck
  use mode_results, only: modes_t
  implicit none
  private

  public :: run_buckling_tests

contains

  subroutine run_buckling_tests()
    call run("buckling: the paper's table 2 and CONSISTENT (STB-01)", table_2)
    call run("buckling: I column, weak and strong axis, torsion (STB-05)", i_column)
    call run("buckling: four end conditions (STB-03)", end_conditions)
    call run("buckling: I beam under end moments (STB-07)", end_moments)
    call run("buckling: load at top, shear centre, bottom (STB-08)", load_height)
    call run("buckling: narrow strip (STB-11)", strip)
    call run("buckling: equal angle, central and eccentric load (STB-13)", angle)
    call run("buckling: mono-symmetric I, both signs", monosymmetric)
    call run("buckling: about loaded states", preloaded)
    call run("buckling: rigid parts and the multipliers' stresses", rigid_parts)
    call run("buckling: what is refused", refused)
    call run("buckling: a moment that is not conservative is named", dead_moment)
  end subroutine run_buckling_tests

  !> Multipliers of a deck's only BUCKLING.
  subroutine solve(name, modes, settings)
    character(len=*), intent(in) :: name
    type(modes_t), intent(out) :: modes
    character(len=*), intent(in), optional :: settings(:)
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../buckling/"//name, memory, model, error, settings)
    call expect(.not. allocated(error), name//": no error")
    allocate (modes%multiplier(0))
    if (allocated(error) .or. .not. allocated(memory%spectrum)) return
    if (size(memory%spectrum) == 0) return
    modes = memory%spectrum(size(memory%spectrum))
    call expect(modes%complete, name//": no multiplier is missing")
  end subroutine solve

  !> The positive multiplier nearest zero, and the negative one.
  pure real(wp) function first(modes, negative)
    type(modes_t), intent(in) :: modes
    logical, intent(in), optional :: negative

    first = minval([modes%multiplier, huge(1.0_wp)], [modes%multiplier, 1.0_wp] > 0)
    if (present(negative)) first = maxval([modes%multiplier, -huge(1.0_wp)], [modes%multiplier, &
      -1.0_wp] < 0)
  end function first

  !> Theory 10, in 10**3 kN; the paper prints 12.86, 11.90, 18.34, 16.67 for its own element.
  subroutine table_2()
    integer, parameter :: elements(5) = [2, 4, 8, 16, 32]
    real(wp), parameter :: wanted(5, 4) = reshape([ &
      12.859_wp, 11.898_wp, 11.647_wp, 11.583_wp, 11.567_wp, &
      18.341_wp, 16.675_wp, 16.258_wp, 16.154_wp, 16.128_wp, &
      12.392_wp, 12.012_wp, 11.922_wp, 11.900_wp, 11.895_wp, &
      16.239_wp, 16.128_wp, 16.120_wp, 16.120_wp, 16.120_wp], [5, 4])
    character(len=18), parameter :: option(2, 4) = reshape([character(len=18) :: &
      "second=JONKER", "shear=ON", "second=JONKER", "shear=OFF", &
      "second=CONSISTENT", "shear=ON", "second=CONSISTENT", "shear=OFF"], [2, 4])
    type(modes_t) :: modes
    character(len=18) :: n
    integer :: i, j

    do j = 1, 4
      do i = 1, 5
        write (n, "('n=', i0)") elements(i)
        call solve("column", modes, [n, option(:, j)])
        call expect_close(first(modes), wanted(i, j), 5.1e-4_wp, trim(option(1, &
          j))//" "//trim(option(2, j)))
      end do
    end do
    call solve("column", modes, [character(len=18) :: "n=16", "dy=2.769231e4", "dz=1.598901e4", &
                                 "dw=3.693654e9", "dzw=-3.814757e6"])
    call expect_close(first(modes)/11.940604_wp, 1.0_wp, 1.0e-3_wp, "section constants not rounded")
  end subroutine table_2

  !> Euler or Engesser about both axes, torsion with and without warping shear; the kinds of the
  !> modes by their energy.
  subroutine i_column()
    real(wp), parameter :: rigid(3) = [323846.3944107445_wp, 4450479.465518194_wp, &
                                       1065348.6035093023_wp]
    real(wp), parameter :: shear(3) = [323327.83776002994_wp, 4327501.188731425_wp, &
                                       1064687.29413331_wp]
    type(modes_t) :: modes

    call solve("i_column", modes)
    call compare(rigid)
    if (modes%modes < 2) return
    call expect_close([maxval(modes%displacement(:, :, 1)), maxval(modes%rotation(:, :, 2))], &
                      [1, 1]*1.0_wp, 1.0e-12_wp, "largest displacement, else largest rotation")
    call solve("i_column", modes, ["shear=ON"])
    call compare(shear)

  contains

    subroutine compare(wanted)
      real(wp), intent(in) :: wanted(3)
      real(wp) :: got(3)

      got = huge(1.0_wp)
      if (modes%modes > 0) then
        associate (e => modes%energy(:, :modes%modes), lambda => modes%multiplier)
          got(1) = minval(lambda, e(4, :) > 0.999_wp)
          got(2) = minval(lambda, e(3, :) > 0.999_wp)
          got(3) = minval(lambda, e(2, :) + e(5, :) > 0.999_wp)
        end associate
      end if
      call expect_close(got/wanted, [1, 1, 1]*1.0_wp, 1.0e-4_wp, "about z, about y, torsion")
    end subroutine compare

  end subroutine i_column

  subroutine end_conditions()
    call compare("a=RX", "b=RX", "y=Y ", 323846.3944107445_wp)
    call compare("a=RZ", "b=RX", "y=RX", 80961.59860268612_wp)
    call compare("a=RZ", "b=RX", "y=Y ", 662508.2807577485_wp)
    call compare("a=RZ", "b=RZ", "y=Y ", 1295385.577642978_wp)

  contains

    subroutine compare(a, b, y, wanted)
      character(len=4), intent(in) :: a, b, y
      real(wp), intent(in) :: wanted
      type(modes_t) :: modes

      call solve("i_column", modes, [a, b, y])
      if (modes%modes == 0) return
      call expect_close(minval(modes%multiplier, modes%energy(4, :modes%modes) > 0.9_wp)/wanted, &
                        1.0_wp, 1.0e-4_wp, a//" "//b//" "//y)
    end subroutine compare

  end subroutine end_conditions

  subroutine end_moments()
    type(modes_t) :: modes

    call solve("i_lateral", modes, ["m=1"])
    call expect_close(first(modes)/75418.72220520547_wp, 1.0_wp, 1.0e-4_wp, "positive")
    call expect_close(first(modes, .true.)/75418.72220520547_wp, -1.0_wp, 1.0e-4_wp, "negative")
  end subroutine end_moments

  !> Ritz solution with 32 sine terms; the flanges' midlines are at +-0.145 m.
  subroutine load_height()
    real(wp), parameter :: top = 48443.94082408417_wp, centre = 68465.51159876246_wp, &
                           bottom = 96207.08936105469_wp
    type(modes_t) :: modes

    call solve("i_lateral", modes, ["f=1"])
    call expect_close([first(modes), -first(modes, .true.)]/centre, [1, 1]*1.0_wp, 1.0e-4_wp, &
                      "shear centre")
    call solve("i_lateral", modes, ["f=1    ", "z=0.145"])
    call expect_close([first(modes)/top, -first(modes, .true.)/bottom], [1, 1]*1.0_wp, 1.0e-4_wp, &
                      "top, and lifted there")
    call solve("i_lateral", modes, ["f=1     ", "z=-0.145"])
    call expect_close([first(modes)/bottom, -first(modes, .true.)/top], [1, 1]*1.0_wp, 1.0e-4_wp, &
                      "bottom")
  end subroutine load_height

  !> Prandtl and Michell; twist is linear along an element without warping, error of order h**2.
  subroutine strip()
    character(len=8), parameter :: forks(5) = ["ry=RX   ", "rz=RX   ", "y=Y     ", "z=Z     ", &
                                               "rx=RX   "]
    type(modes_t) :: modes

    call solve("strip", modes, ["n=32"])
    call expect_close(first(modes)/4.012599343578898_wp, 1.0_wp, 5.0e-4_wp, &
                      "cantilever, load at the tip")
    call solve("strip", modes, [forks, "n=32    ", "tip=0   ", "middle=1"])
    call expect_close(first(modes)/16.936_wp, 1.0_wp, 1.0e-3_wp, "forks, load in the middle")
    call solve("strip", modes, [forks, "n=32    ", "tip=0   ", "weight=1"])
    call expect_close(first(modes)/28.315_wp, 1.0_wp, 1.0e-3_wp, "forks, weight")
  end subroutine strip

  !> code_aster SSLL103; its first value of the second case is -1.479e6.
  subroutine angle()
    type(modes_t) :: modes

    call solve("angle", modes, ["modes=25"])
    call expect_close(first(modes)/692531.7100781159_wp, 1.0_wp, 1.0e-4_wp, "torsion and bending y")
    call expect_close(nearest_to(modes, 1504873.88_wp, 4), 1504873.88_wp, 1504.0_wp, "bending z")
    call expect_close(nearest_to(modes, 10058988.55_wp, 0), 10058988.55_wp, 10058.0_wp, &
                      "coupled, second root")
    call solve("angle", modes, ["e=1"])
    call expect_close(first(modes)/1504873.88_wp, 1.0_wp, 1.0e-4_wp, "shear centre: bending z")
    call expect_close(first(modes, .true.)/1.479e6_wp, -1.0_wp, 1.0e-3_wp, "shear centre: pulled")
    call expect_close(nearest_to(modes, 5998123.15_wp, 3), 5998123.15_wp, 5998.0_wp, &
                      "shear centre: bending y")
  end subroutine angle

  !> The multiplier nearest a value among the modes of a kind; 0: of all.
  pure real(wp) function nearest_to(modes, value, kind)
    type(modes_t), intent(in) :: modes
    real(wp), intent(in) :: value
    integer, intent(in) :: kind
    integer :: i

    nearest_to = huge(1.0_wp)
    do i = 1, modes%modes
      if (kind > 0) then
        if (modes%energy(max(kind, 1), i) < 0.99_wp) cycle
      end if
      if (abs(modes%multiplier(i) - value) < abs(nearest_to - value)) nearest_to = &
        modes%multiplier(i)
    end do
  end function nearest_to

  !> Closed form 258.660 and 675.818 kNm (theory 10); dead moments whose forks hold the twist. The
  !> larger with the top flange compressed, which the positive moment does.
  subroutine monosymmetric()
    type(modes_t) :: modes

    call solve("monosymmetric", modes)
    call expect_close([first(modes, .true.)/258.660_wp, first(modes)/675.818_wp], [-1, 1]*1.0_wp, &
                      1.0e-4_wp, &
                      "eight elements")
    call solve("monosymmetric", modes, ["n=2"])
    call expect_close([-first(modes, .true.), first(modes)], [259.47_wp, 679.76_wp], 5.1e-3_wp, &
                      "two elements")
    call solve("monosymmetric", modes, ["n=16         ", "second=JONKER"])
    call expect_close([-first(modes, .true.), first(modes)], [286.69_wp, 609.68_wp], 5.1e-3_wp, &
                      "JONKER")
  end subroutine monosymmetric

  !> Euler's load acts as the only load, as the rest of it, and another half of it on top.
  subroutine preloaded()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../buckling/preloaded", memory, model, error)
    call expect(.not. allocated(error), "no error")
    call expect(size(memory%spectrum) == 4, "four sets of modes")
    if (size(memory%spectrum) /= 4) return
    associate (s => memory%spectrum)
      call expect_close(s(1)%multiplier, [1.0_wp], 1.0e-5_wp, "unloaded")
      call expect_close(s(2)%multiplier, [0.6_wp], 3.0e-4_wp, "the same pattern, from 0.4")
      call expect_close(s(2)%load_factor, 0.4_wp + s(2)%multiplier, 1.0e-12_wp, "load factor")
      call expect_close(s(4)%multiplier, [1.2_wp], 6.0e-4_wp, "a second pattern of half the load")
      call expect_close(s(4)%load_factor, s(4)%multiplier, 1.0e-12_wp, "which stands at zero")
    end associate
  end subroutine preloaded

  !> A rigid bar on a hinge, held upright by a spring of bending stiffness 3EI/l at its foot: the
  !> load acts as a multiplier, not as a strain. P = (3EI/l)/h.
  subroutine rigid_parts()
    type(modes_t) :: modes

    call solve("rigid_bar", modes)
    call expect_close(first(modes), 3*5/2.0_wp/4, 1.0e-9_wp, "load at the top of the rigid bar")
  end subroutine rigid_parts

  subroutine refused()
    call expect_failure("no_load", exit_deck, "BUCKLING needs a load")
    call expect_failure("function", exit_deck, "BUCKLING cannot scale a load with FUNCTION 'soft'")
    call expect_failure("unstable", exit_solve, "the present one has 1 unstable mode")
  end subroutine refused

  subroutine expect_failure(name, status, message)
    character(len=*), intent(in) :: name, message
    integer, intent(in) :: status
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../buckling/"//name, memory, model, error)
    call expect(allocated(error), name//": an error")
    if (.not. allocated(error)) return
    call expect(error%status == status, name//": its status")
    call expect(index(error%message, message) > 0, "'"//message//"', got '"//error%message//"'")
  end subroutine expect_failure

  !> A cantilever under a semitangential moment buckles at pi sqrt(EIz GIt)/L (Argyris 1978).
  subroutine dead_moment()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../buckling/dead_moment", memory, model, error, ["n=64"])
    call expect(.not. allocated(error), "no error")
    call expect(size(memory%remarks) > 0 .and. size(memory%spectrum) == 1, "a remark and modes")
    if (size(memory%remarks) == 0 .or. size(memory%spectrum) == 0) return
    call expect(index(memory%remarks(1)%s, "warning: dead moments on free rotations") == 1, &
                "the warning")
    call expect_close(first(memory%spectrum(1)), acos(-1.0_wp), 1.0e-3_wp, "semitangential moment")
  end subroutine dead_moment

end module test_buckling
