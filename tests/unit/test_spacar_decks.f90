!> Decks in SPACAR's own form, run in its modes, against closed forms.
module test_spacar_decks
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use mechanism_kit, only: slider_jet
  use program_runs, only: scratch, run_spar, outcome_t
  use result_reader, only: get_reals
  implicit none
  private

  public :: run_spacar_decks_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  character(len=*), parameter :: folder = "tests/cases/spacar/"

contains

  subroutine run_spacar_decks_tests()
    call run("spacar: mode 0, degrees of freedom", checked)
    call run("spacar: mode 1, a pendulum", pendulum)
    call run("spacar: mode 2, torque on a slider-crank", slider_crank)
    call run("spacar: mode 7, frequencies of a pressed column", frequencies)
    call run("spacar: mode 8, buckling upon a base load", buckling)
    call run("spacar: mode 10, an end moved across and further", guided)
  end subroutine run_spacar_decks_tests

  !> Run a deck in a mode and read a dataset, in its columns.
  subroutine solve(deck, mode, name, columns, values)
    character(len=*), intent(in) :: deck, name
    integer, intent(in) :: mode, columns
    real(wp), allocatable, intent(out) :: values(:, :)
    type(outcome_t) :: outcome
    real(wp), allocatable :: flat(:)
    integer, allocatable :: extents(:)
    character(len=2) :: number

    write (number, "(i0)") mode
    call run_spar("run "//deck//".deck --quiet --mode "//number//" -o "//scratch("spacar.h5"), &
                  outcome)
    call expect(outcome%status == 0 .and. outcome%errors == "", "no complaint: "//outcome%errors)
    call get_reals(scratch("spacar.h5"), "analysis/"//name, flat, extents)
    call expect(size(flat) > 0, name)
    allocate (values(columns, size(flat)/columns))
    values(:, :) = reshape(flat, shape(values))
  end subroutine solve

  subroutine checked()
    type(outcome_t) :: outcome

    call run_spar("run decks/spacar_crank.deck --mode 0", outcome)
    call expect(outcome%status == 0, "exit status")
    ! 17 constraints: rigid modes 6 + 6, tilts 2 + 2, the driven angle
    call expect(index(outcome%output, "constraint equations                            17") > 0, &
                "count of constraints")
    call expect(index(outcome%output, "degrees of freedom                               0") > 0, &
                "driven")
    call run_spar("run tests/cases/spacar/pendulum.deck --mode 0", outcome)
    call expect(index(outcome%output, "degrees of freedom                               1") > 0, &
                "free")
  end subroutine checked

  !> Energy, and half the period, which is 2 K(k)/omega by the arithmetic-geometric mean.
  subroutine pendulum()
    real(wp), parameter :: g = 9.81_wp, l = 0.8_wp, start = 1/l, omega = sqrt(g/l), step = 1.0e-3_wp
    real(wp), allocatable :: angle(:, :), rate(:, :)
    real(wp) :: a, b, k, half, zero
    integer :: i

    call solve(folder//"pendulum", 1, "01_transient/joints/strain", 6, angle)
    call solve(folder//"pendulum", 1, "01_transient/joints/rate", 6, rate)
    call expect(size(angle, 2) == 1001, "TIMESTEP's steps")
    ! generalized-alpha errs by some (omega h)**2
    call expect_close(0.5_wp*(rate(1, :)*l)**2 - g*l*cos(angle(1, :)), &
                      spread(0.5_wp*(start*l)**2 - g*l, 1, size(rate, 2)), &
                      (omega*step)**2*(start*l)**2, "energy")
    k = start/(2*omega)
    a = 1
    b = sqrt(1 - k**2)
    do i = 1, 6
      half = 0.5_wp*(a + b)
      b = sqrt(a*b)
      a = half
    end do
    half = pi/(a*omega)
    i = 1 + floor(half/step)
    zero = step*(i - 1 + angle(1, i)/(angle(1, i) - angle(1, i + 1)))
    call expect_close(zero/half, 1.0_wp, (omega*step)**2, "half the period")
  end subroutine pendulum

  !> Only the slider has mass: the torque times the crank's speed is the power of its inertia. The
  !> stress of a driven mode is the negative of the drive's torque.
  subroutine slider_crank()
    real(wp), parameter :: r = 0.15_wp, l = 0.3_wp, m = 0.5_wp, w = 150
    real(wp), allocatable :: torque(:, :), place(:, :)
    real(wp) :: jet(0:2)
    integer :: i

    call solve("decks/spacar_crank", 2, "01_inverse/joints/stress", 12, torque)
    call solve("decks/spacar_crank", 2, "01_inverse/nodes/displacement", 24, place)
    call expect(size(torque, 2) == 81, "TIMESTEP's steps")
    do i = 1, size(torque, 2)
      jet = slider_jet(r, l, w*0.0005_wp*(i - 1))
      call expect_close(place(7, i) + r + l, jet(0), 1.0e-10_wp, "slider, the third node")
      call expect_close(-torque(1, i), m*w**2*jet(2)*jet(1), 1.0e-8_wp*m*(w*r)**2, "torque")
    end do
  end subroutine slider_crank

  !> Cantilever under a dead axial load, clamped and free, exact to the mesh.
  subroutine frequencies()
    real(wp), allocatable :: found(:, :)
    integer :: i
    real(wp), parameter :: rigidity(2) = [1200, 2000]

    call solve(folder//"column", 7, "03_eigen/frequency", 1, found)
    do i = 1, 2
      call expect_close(found(1, i), exact(rigidity(i)), 1.0e-4_wp*found(1, i), "frequency")
    end do

  contains

    !> The first root of the frequency determinant, by halving.
    real(wp) function exact(ei)
      real(wp), intent(in) :: ei
      real(wp) :: below, above
      integer :: j

      below = 0.1_wp
      above = 4*pi
      if (ei > 1500) above = 7*pi
      do j = 1, 60
        exact = 0.5_wp*(below + above)
        if (determinant(ei, below)*determinant(ei, exact) <= 0) then
          above = exact
        else
          below = exact
        end if
      end do
      exact = exact/(2*pi)
    end function exact

    !> y'''' + a y'' = b y with y = y' = 0 at the clamp, y'' = y''' + a y' = 0 at the free end.
    pure real(wp) function determinant(ei, w)
      real(wp), intent(in) :: ei, w
      real(wp), parameter :: length = 2, density = 3, load = 400
      real(wp) :: a, b, s, c, m(2, 2)

      a = load/ei
      b = density*w**2/ei
      s = sqrt(-a/2 + sqrt(a**2/4 + b))
      c = sqrt(a/2 + sqrt(a**2/4 + b))
      ! y = cosh s x - cos c x and sinh s x/s - sin c x/c
      m(:, 1) = [s**2*cosh(s*length) + c**2*cos(c*length), &
                 (s**2 + a)*s*sinh(s*length) - (c**2 - a)*c*sin(c*length)]
      m(:, 2) = [s*sinh(s*length) + c*sin(c*length), &
                 (s**2 + a)*cosh(s*length) + (c**2 - a)*cos(c*length)]
      determinant = m(1, 1)*m(2, 2) - m(1, 2)*m(2, 1)
    end function determinant
  end subroutine frequencies

  !> The additional load at Euler's load, 300 N being there.
  subroutine buckling()
    real(wp), allocatable :: multiplier(:, :)
    real(wp) :: wanted(2)

    call solve(folder//"column", 8, "02_buckling/multiplier", 1, multiplier)
    wanted = (pi**2*[1200, 2000]/16 - 300)/100
    call expect_close(multiplier(1, :2), wanted, 1.0e-4_wp*wanted(2), "multipliers")
  end subroutine buckling

  !> 12 EI/L**3 times the way, after both parts of it.
  subroutine guided()
    real(wp), allocatable :: reaction(:, :), base(:, :)
    real(wp), parameter :: stiffness = 12*1.1e5_wp/1.0e6_wp

    call solve(folder//"guided", 10, "01_static/nodes/reaction", 28, base)
    call solve(folder//"guided", 10, "02_static/nodes/reaction", 28, reaction)
    call expect(size(base, 2) == 1 .and. size(reaction, 2) == 2, "steps of ITERSTEP")
    if (size(base, 2) < 1 .or. size(reaction, 2) < 2) return
    ! moved by 3e-4 of the length; the elongation relaxes the stretch
    call expect_close([base(9, 1), reaction(9, :)], stiffness*[0.02_wp, 0.025_wp, 0.03_wp], &
                      1.0e-6_wp*stiffness*0.03_wp, "reaction at the second node")
  end subroutine guided

end module test_spacar_decks
