!> STATIONARY, and EIGEN of models that turn, are damped or have follower loads, against closed
!> forms and published numbers.
module test_complex_modes
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use diagnostics, only: report_t
  use deck_reader, only: read_deck
  use nodal_state, only: state_t, new_state, coordinate_number
  use rotation, only: cross, skew
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_inertia, only: mass_centre
  use system_rotation, only: add_rotation, spin_at
  use model_data, only: model_t, setting_t
  use memory_recorder, only: memory_t, run_deck
  use mode_results, only: modes_t
  implicit none
  private

  public :: run_complex_modes_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_complex_modes_tests()
    call run("turning: the channel cantilever (theory 10)", channel)
    call run("turning: rates of patterns add, forces go with their square", rates)
    call run("turning: centrifugal forces and their tangent by differences", tangent)
    call run("turning: whirl of an overhung disk (EIG-15)", disk)
    call run("turning: critical speeds of the disk (EIG-15)", critical)
    call run("turning: rigid rotor on two bearings (EIG-17)", rotor)
    call run("turning: flapping and lagging of a cantilever (EIG-09)", blade)
    call run("damped: two free masses", pair)
    call run("damped: a damper and a spring without mass between", oscillator)
    call run("damped: proportional damping", proportional)
    call run("follower: Beck's column", beck)
  end subroutine run_complex_modes_tests

  !> The last spectrum of a deck of tests/cases/rotating.
  subroutine solve(name, modes, settings, remark)
    character(len=*), intent(in) :: name
    type(modes_t), intent(out) :: modes
    character(len=*), intent(in), optional :: settings(:)
    character(len=*), intent(in), optional :: remark   !< must begin one of the remarks
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    logical :: found
    integer :: i

    call run_deck("../rotating/"//name, memory, model, error, settings)
    call expect(.not. allocated(error), name//": no error")
    allocate (modes%frequency(0))
    if (allocated(error)) return
    if (size(memory%spectrum) == 0) return
    modes = memory%spectrum(1)
    if (.not. present(remark)) return
    found = .false.
    do i = 1, size(memory%remarks)
      if (index(memory%remarks(i)%s, remark) == 1) found = .true.
    end do
    call expect(found, name//": the remark '"//remark//"'")
  end subroutine solve

  !> Whether there are so many modes; fewer are a failure.
  logical function enough(modes, n)
    type(modes_t), intent(in) :: modes
    integer, intent(in) :: n

    enough = modes%modes >= n
    call expect(enough, "modes are found")
  end function enough

  !> Load factors at 30, 90 and 210 cm with lumped inertia; the consistent one is near to it.
  subroutine channel()
    real(wp), parameter :: wanted(3) = [8.9698_wp, 10.7786_wp, 16.5885_wp]
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../rotating/channel", memory, model, error)
    call expect(.not. allocated(error), "no error")
    if (allocated(error)) return
    call expect_close(memory%record([12, 32, 72])%factor, wanted, 5.1e-5_wp, "load factors")
    call run_deck("../rotating/channel", memory, model, error, ["mass=CONSISTENT"])
    call expect(.not. allocated(error), "no error with the consistent mass")
    if (allocated(error)) return
    call expect_close(memory%record([12, 32, 72])%factor/wanted, [1, 1, 1]*1.0_wp, 2.0e-3_wp, &
                      "consistent inertia")
  end subroutine channel

  !> A bar that turns: the tip moves by rho W**2 L**3/(3 E), the support holds m W**2 L/2.
  subroutine rates()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    real(wp), parameter :: tip = 1.0e-6_wp/3, force = 0.5_wp
    real(wp) :: level(6)
    integer :: i

    call run_deck("../rotating/bar", memory, model, error)
    call expect(.not. allocated(error), "no error")
    if (allocated(error)) return
    level = [0.5_wp, 1.0_wp, 1.5_wp, 2.0_wp, 2.0_wp, 2.0_wp]
    do i = 1, 6
      call expect_close(memory%results(i)%displacement(1, 11), tip*level(i)**2, &
                        1.0e-3_wp*tip*level(i)**2, "tip")
      call expect_close(memory%results(i)%reaction(1, 1), -force*level(i)**2, 1.0e-5_wp, "reaction")
    end do
  end subroutine rates

  !> About an axis beside the origin, of a deformed model: the forces are those of the mass at its
  !> centre, the tangent is their derivative and half the skew of the moments (theory 1).
  subroutine tangent()
    type(model_t) :: model
    type(report_t) :: report
    type(error_t), allocatable :: error
    type(system_t) :: system
    type(state_t) :: state
    type(setting_t) :: setting(1)
    real(wp), allocatable :: total(:), values(:), found(:, :), wanted(:, :), move(:)
    real(wp) :: spin(3), level(1), sums(3), arm(3)
    real(wp), parameter :: h = 1.0e-4_wp
    integer :: i, k, at(3)

    setting(1) = setting_t("rate", "3")
    call read_deck("tests/cases/rotating/proportional.deck", setting, model, report, error)
    call build_system(model, system)
    call find_system_pattern(system, unsymmetric=.true.)
    call new_state(system%nodes, 0, 0, state)
    call state%move([(0.3_wp*sin(1.7_wp*k), k=1, system%coordinates)])
    level = 0.7_wp
    spin = spin_at(system, level)
    call expect_close(spin, 0.7_wp*3*[0.0_wp, 0.6_wp, 0.8_wp], 1.0e-14_wp, "rate")
    allocate (values(size(system%pattern%row)), wanted(system%unknowns, system%unknowns))
    allocate (found, mold=wanted)
    call forces(state, total, values)
    sums = [(sum(total(i::7)), i=1, 3)]
    arm = mass_centre(system%masses, state) - [-1.0_wp, 0.0_wp, 0.0_wp]
    call expect_close(sums, -system%masses%total*cross(spin, cross(spin, arm)), 1.0e-10_wp, &
                      "forces")
    found = 0
    do i = 1, size(values)
      if (max(system%pattern%row(i), system%pattern%column(i)) > system%unknowns) cycle
      found(system%pattern%row(i), system%pattern%column(i)) = values(i)
    end do
    do k = 1, system%coordinates
      if (system%unknown(k) == 0) cycle
      move = 0*total
      move(k) = h
      wanted(:, system%unknown(k)) = pack(change(2*move) - 8*change(move), &
                                          system%unknown > 0)/(12*h)
    end do
    do i = 1, system%nodes
      at = system%unknown(coordinate_number(i, [4, 5, 6]))
      if (any(at == 0)) cycle
      wanted(at, at) = wanted(at, at) - 0.5_wp*skew(total(coordinate_number(i, [4, 5, 6])))
    end do
    call expect_close(found, wanted, 1.0e-9_wp, "tangent")
    call expect_close(found, transpose(found), 1.0e-12_wp, "a Hessian")
    call expect(maxval(abs(total(4::7))) > 1.0e-4_wp, "with moments")
    call system%free()

  contains

    subroutine forces(place, total, values)
      type(state_t), intent(in) :: place
      real(wp), allocatable, intent(out) :: total(:)
      real(wp), intent(out) :: values(:)

      allocate (total(system%coordinates))
      total = 0
      values = 0
      call add_rotation(system, place, spin, total, values)
    end subroutine forces

    function change(move)
      real(wp), intent(in) :: move(:)
      real(wp) :: change(size(move)), unused(size(values))
      real(wp), allocatable :: ahead(:), behind(:)
      type(state_t) :: place

      place = state
      call place%move(move)
      call forces(place, ahead, unused)
      place = state
      call place%move(-move)
      call forces(place, behind, unused)
      change = ahead - behind
    end function change
  end subroutine tangent

  !> Closed form of Stodola and Green in an inertial frame, forward positive; in the turning frame
  !> less by the rate. In the disk's plane e^(i w t) turns forward where Y lags X by 90 degrees.
  subroutine disk()
    real(wp), parameter :: rate(3) = [0.0_wp, 100.0_wp, 300.0_wp]
    character(len=8), parameter :: setting(3) = ["rate=0  ", "rate=100", "rate=300"]
    real(wp), parameter :: whirl(4, 3) = reshape([ &
      -1181.92873358668_wp, -138.435837909089_wp, 138.435837909089_wp, 1181.92873358668_wp, &
      -1090.93257300190_wp, -133.998636533817_wp, 142.844662558543_wp, 1282.08654697718_wp, &
      -935.694859881940_wp, -125.134407796297_wp, 151.489157082473_wp, 1509.34011059576_wp], &
      [4, 3])
    type(modes_t) :: modes
    real(wp) :: found(4)
    integer :: i, k

    call solve("disk", modes, [setting(1)])
    if (.not. enough(modes, 4)) return
    call expect_close(2*pi*modes%frequency([1, 3]), whirl(3:4, 1), 1.0e-6_wp*1182, "at rest")
    do i = 2, 3
      call solve("disk", modes, [setting(i)], "no frequency is missing")
      if (.not. enough(modes, 4)) cycle
      do k = 1, 4
        associate (x => modes%displacement(1:2, 2, k), &
                   y => modes%quadrature%displacement(1:2, 2, k))
          call expect_close(norm2(y)/norm2(x), 1.0_wp, 1.0e-6_wp, "a circle")
          found(k) = rate(i) + sign(2*pi*modes%frequency(k), x(2)*y(1) - x(1)*y(2))
        end associate
      end do
      call expect_close(sorted(found)/whirl(:, i), [1, 1, 1, 1]*1.0_wp, 1.0e-6_wp, setting(i))
    end do
  end subroutine disk

  pure function sorted(x) result(y)
    real(wp), intent(in) :: x(:)
    real(wp) :: y(size(x))
    logical :: left(size(x))
    integer :: i, at

    left = .true.
    do i = 1, size(x)
      at = minloc(x, 1, left)
      left(at) = .false.
      y(i) = x(at)
    end do
  end function sorted

  !> Forward whirl that keeps up with the shaft is at rest in its frame, a frequency zero; backward
  !> whirl at that rate has twice the rate. EI is given with six digits.
  subroutine critical()
    type(modes_t) :: modes

    call solve("disk", modes, ["rate=144.804808708"])
    if (enough(modes, 1)) call expect_close(2*pi*modes%frequency(1)/144.8_wp, 0.0_wp, 1.0e-4_wp, &
                                           "forward")
    call solve("disk", modes, ["rate=132.552059365"])
    if (enough(modes, 2)) call expect_close(pi*modes%frequency(2)/132.552059365_wp, 1.0_wp, &
                                           1.0e-6_wp, "backward")
    call solve("disk", modes, ["rate=712.676958208"])
    if (enough(modes, 4)) call expect(minval(abs(pi*modes%frequency/712.676958208_wp - 1)) &
                                     < 1.0e-6_wp, "backward, of the second pair")
  end subroutine critical

  !> 447.2136 either way, -500 and 1250 in an inertial frame, the rate is 500.
  subroutine rotor()
    real(wp), parameter :: translation = 447.21359549995793_wp
    type(modes_t) :: modes

    call solve("rotor", modes, remark="no frequency is missing up to mode 4")
    call expect(modes%modes == 4, "four modes")
    if (modes%modes /= 4) return
    call expect_close(2*pi*modes%frequency, [500 - translation, 750.0_wp, 500 + translation, &
                                             1000.0_wp], 1.0e-6_wp, "frequencies")
    call expect_close(modes%damping, [0, 0, 0, 0]*1.0_wp, 0.0_wp, "undamped")
  end subroutine rotor

  !> Wright et al., JAM 49 (1982) 197; in the plane of rotation the square is less by that of the
  !> rate. By all eigenvalues and by iteration.
  subroutine blade()
    real(wp), parameter :: flap(3, 3) = reshape([ &
      4.7972785323630776_wp, 23.320263674295944_wp, 62.984967480682776_wp, &
      7.3603730193100185_wp, 26.80908167849793_wp, 66.68391438150489_wp, &
      13.170150487506177_wp, 37.603112331191866_wp, 79.61447848945721_wp], [3, 3])
    character(len=6), parameter :: setting(3) = ["eta=3 ", "eta=6 ", "eta=12"]
    real(wp), parameter :: eta(3) = [3.0_wp, 6.0_wp, 12.0_wp]
    type(modes_t) :: modes
    real(wp) :: both(6)
    integer :: i

    do i = 1, 3
      both(2::2) = flap(:, i)
      both(1::2) = sqrt(flap(:, i)**2 - eta(i)**2)
      call solve("blade", modes, [character(len=6) :: setting(i), "n=12"])
      if (.not. enough(modes, 6)) cycle
      call expect(modes%complete, "dense")
      call expect_close(2*pi*modes%frequency/both, spread(1.0_wp, 1, 6), 1.0e-3_wp, setting(i))
      call solve("blade", modes, [character(len=6) :: setting(i), "n=40"])
      if (.not. enough(modes, 6)) cycle
      call expect(.not. modes%complete, "by iteration")
      call expect_close(2*pi*modes%frequency/both, spread(1.0_wp, 1, 6), 2.0e-4_wp, setting(i))
    end do
  end subroutine blade

  !> Reduced mass 1.2, stiffness 50, resistance c/2; five motions are free, and where damping is
  !> more than critical each of the two rates is a mode.
  subroutine pair()
    type(modes_t) :: modes
    complex(wp) :: root, rest(2)

    call solve("pair", modes, remark="5 free motions with frequency zero")
    call expect(modes%modes == 6, "six modes")
    if (modes%modes /= 6) return
    root = closed(0.5_wp, 1.0_wp)
    call expect_close(abs(modes%lambda(6) - root), 0.0_wp, 1.0e-8_wp, "eigenvalue")
    call expect_close(modes%frequency(6), aimag(root)/(2*pi), 1.0e-8_wp, "frequency")
    call expect_close(modes%damping(6), 0.25_wp/sqrt(50*1.2_wp), 1.0e-8_wp, "damping ratio")
    call solve("pair", modes, ["c=50"])
    call expect(modes%modes == 7, "seven modes")
    if (modes%modes /= 7) return
    rest = [closed(25.0_wp, 1.0_wp), closed(25.0_wp, -1.0_wp)]
    call expect_close(abs(modes%lambda(6:7) - rest), [0, 0]*1.0_wp, 1.0e-7_wp, "real eigenvalues")
    call expect_close(modes%damping(6:7), [1, 1]*1.0_wp, 0.0_wp, "no oscillation")
    call expect_close(modes%frequency(6:7), [0, 0]*1.0_wp, 0.0_wp, "no frequency")
  end subroutine pair

  !> Root of 1.2 s**2 + c s + 50 = 0 on either side.
  pure complex(wp) function closed(c, side)
    real(wp), intent(in) :: c, side

    closed = (-c + side*sqrt(cmplx(c**2 - 4*1.2_wp*50, 0.0_wp, wp)))/(2*1.2_wp)
  end function closed

  !> (m s**2 + c s + k)(cs s + ks) + ks cs s = 0: two motions of the mass, one without.
  subroutine oscillator()
    type(modes_t) :: modes
    complex(wp) :: s
    integer :: i

    call solve("oscillator", modes)
    call expect(modes%modes == 2, "a pair and a real eigenvalue")
    if (modes%modes /= 2) return
    do i = 1, 2
      s = modes%lambda(i)
      call expect_close(abs((2*s**2 + 0.4_wp*s + 50)*(2*s + 30) + 60*s), 0.0_wp, 1.0e-8_wp, &
                        "characteristic polynomial")
    end do
    call expect(aimag(modes%lambda(1)) > 1 .and. real(modes%lambda(2)) < -1, "both kinds")
  end subroutine oscillator

  !> ratio = (alpha/omega + beta omega)/2 without stresses; MATERIAL DAMPING adds to beta. By all
  !> eigenvalues and by iteration. Behind the fifth come overdamped ones, all near -1/beta.
  subroutine proportional()
    character(len=14), parameter :: more(3) = ["n=8           ", "material=1e-3 ", "n=30          "]
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    real(wp) :: omega(5), ratio(5), beta
    integer :: i

    do i = 1, 3
      call run_deck("../rotating/proportional", memory, model, error, &
                    [character(len=14) :: "f=0", more(i)])
      call expect(.not. allocated(error), "no error")
      if (allocated(error)) cycle
      call expect(memory%spectrum(1)%complete .eqv. i < 3, "dense")
      beta = merge(3.0e-3_wp, 2.0e-3_wp, i == 2)
      omega = 2*pi*memory%spectrum(2)%frequency(:5)
      ratio = 0.5_wp*(0.3_wp/omega + beta*omega)
      associate (modes => memory%spectrum(1))
        call expect_close(modes%damping(:5)/ratio, spread(1.0_wp, 1, 5), 1.0e-7_wp, "ratio")
        call expect_close(abs(modes%lambda(:5))/omega, spread(1.0_wp, 1, 5), 1.0e-7_wp, "undamped")
        call expect_close(2*pi*modes%frequency(:5)/(omega*sqrt(1 - ratio**2)), &
                          spread(1.0_wp, 1, 5), &
                          1.0e-7_wp, "damped")
      end associate
    end do
  end subroutine proportional

  !> Flutter at 20.0509 EI/L**2 (Beck 1952); ten elements are 1e-4 off at most.
  subroutine beck()
    character(len=8), parameter :: below(2) = ["p=20.04 ", "p=20.05 "]
    type(modes_t) :: modes
    integer :: i

    do i = 1, 2
      call solve("beck", modes, below(i:i))
      if (enough(modes, 6)) call expect_close(modes%damping, spread(0.0_wp, 1, 6), 0.0_wp, below(i))
    end do
    call solve("beck", modes, ["p=20.055"], "warning: the state is unstable: 2 growing modes")
    if (.not. enough(modes, 6)) return
    call expect(all(modes%damping(1:2) < 0) .and. all(modes%imaginary(1:2) > 0), "they grow")
    call expect_close(modes%damping(3:4), -modes%damping(1:2), 1.0e-6_wp, "two others decay")
  end subroutine beck

end module test_complex_modes
