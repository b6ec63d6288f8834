!> EIGEN of whole decks against closed forms and published frequencies.
module test_eigen
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck
  use mode_results, only: modes_t, mode_kind, energy_kinds
  implicit none
  private

  public :: run_eigen_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_eigen_tests()
    call run("eigen: C column, exact frequencies (EIG-01)", c_column)
    call run("eigen: the paper's table 3", table_3)
    call run("eigen: two consistent elements", two_elements)
    call run("eigen: free and pinned Timoshenko beam (EIG-03)", timoshenko)
    call run("eigen: torsion of an I (EIG-05)", torsion)
    call run("eigen: bending and torsion of a mono-symmetric I (EIG-07)", monosymmetric)
    call run("eigen: stressed column, unstable beyond Euler's load (EIG-11)", stressed)
    call run("eigen: flapping of a rotating cantilever (EIG-09)", flapping)
    call run("eigen: double cross, repeated frequencies (EIG-13)", cross)
    call run("eigen: rigid rod on a massless beam, all its modes", rod)
    call run("eigen: a refined mesh by Lanczos", refined)
    call run("eigen: modes of mass one, effective masses", masses)
    call run("eigen: energy of springs", sprung_tip)
    call run("eigen: centre of mass of a half circle", half_circle)
    call run("eigen: a model without mass", massless)
  end subroutine run_eigen_tests

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

    call run_deck("../eigen/"//name, memory, model, error, settings)
    call expect(.not. allocated(error), name//": no error")
    allocate (modes%frequency(0), modes%energy(energy_kinds, 0))
    if (allocated(error) .or. .not. allocated(memory%spectrum)) return
    if (size(memory%spectrum) == 0) return
    modes = memory%spectrum(1)
    call expect(modes%complete, name//": no frequency is missing")
    if (.not. present(remark)) return
    found = .false.
    do i = 1, size(memory%remarks)
      if (index(memory%remarks(i)%s, remark) == 1) found = .true.
    end do
    call expect(found, "the remark '"//remark//"'")
  end subroutine solve

  !> The first n frequencies whose energy is of some kinds only.
  function of_kind(modes, kinds, n) result(frequency)
    type(modes_t), intent(in) :: modes
    integer, intent(in) :: kinds(:), n
    real(wp) :: frequency(n)
    integer :: i, k

    frequency = huge(1.0_wp)
    k = 0
    do i = 1, modes%modes
      if (sum(modes%energy(kinds, i)) < 0.99_wp .or. k == n) cycle
      k = k + 1
      frequency(k) = modes%frequency(i)
    end do
  end function of_kind

  !> Own 4x4 and 2x2 determinants of the reference: modes 1-6 and the fourth of bending z.
  subroutine c_column()
    real(wp), parameter :: wanted(7) = [33.236_wp, 67.165_wp, 99.034_wp, 102.739_wp, 169.04_wp, &
                                        178.013_wp, &
                                        395.602_wp]
    real(wp), parameter :: vlasov(6) = [38.59018352_wp, 88.37087829_wp, 153.24310379_wp, &
                                        201.97777542_wp, &
                                        342.78908564_wp, 347.86868649_wp]
    type(modes_t) :: modes

    call solve("column", modes, ["n=60"])
    if (modes%modes < 13) return
    call expect_close(modes%frequency([1, 2, 3, 4, 5, 6, 13])/wanted, spread(1.0_wp, 1, 7), &
                      2.0e-3_wp, &
                      "with shear, over the exact ones")
    call solve("column", modes, ["shear=OFF"])
    if (modes%modes < 6) return
    call expect_close(modes%frequency(:6)/vlasov, spread(1.0_wp, 1, 6), 1.0e-3_wp, "rigid in shear")
  end subroutine c_column

  !> Both columns of the paper. Its own element (JONKER, a mass that does not know of the shear
  !> centre, no rotary inertia) to the printed digits where it is rigid in shear, but for its mode
  !> 3, where it prints the analytic value; with shear its bending about z has Dy not rounded.
  !> Cortinez and Piovan have the inertia of warping with shear and not without.
  subroutine table_3()
    character(len=18), parameter :: own(4) = [character(len=18) :: "own=NONE", "other=CONSISTENT", &
                                              "second=JONKER", "rotary=OFF"]
    character(len=18), parameter :: rounded(4) = [character(len=18) :: "dy=2.79e4", "dz=1.58e4", &
                                                  "dw=3.65e9", "dzw=-3.7e6"]
    integer, parameter :: bending(7) = [1, 2, 3, 4, 5, 6, 13]
    type(modes_t) :: modes
    real(wp) :: f(7)

    call solve("column", modes, [own, rounded])
    if (modes%modes < 13) return
    call expect_close(modes%frequency(bending)/[33.18_wp, 67.30_wp, 98.65_wp, 103.01_wp, &
                                                168.65_wp, &
      178.41_wp, 397.28_wp], spread(1.0_wp, 1, 7), 5.0e-3_wp, "SPACAR, with shear")
    call expect_close(modes%frequency([1, 3, 4]), [33.18_wp, 98.65_wp, 103.01_wp], 6.0e-3_wp, &
                      "its digits")
    call solve("column", modes)
    if (modes%modes < 13) return
    call expect_close(modes%frequency(bending)/[33.23_wp, 67.17_wp, 99.03_wp, 102.79_wp, &
                                                169.05_wp, &
      178.01_wp, 395.60_wp], spread(1.0_wp, 1, 7), 5.0e-3_wp, "Cortinez and Piovan, with shear")
    call solve("column", modes, [character(len=18) :: own, "shear=OFF"])
    if (modes%modes < 14) return
    f = modes%frequency([1, 2, 3, 4, 5, 6, 14])  ! the paper leaves out two axial modes
    call expect_close(f/[38.61_wp, 88.85_wp, 153.86_wp, 207.38_wp, 344.37_wp, 355.43_wp, &
                         1421.8_wp], &
                      spread(1.0_wp, 1, 7), 5.0e-3_wp, "SPACAR, rigid in shear")
    call expect_close(f([1, 2, 4, 5]), [38.61_wp, 88.85_wp, 207.38_wp, 344.37_wp], 6.0e-3_wp, &
                      "its digits")
    call solve("column", modes, [character(len=18) :: own, "shear=OFF", "warp=0"])
    if (modes%modes < 14) return
    f = modes%frequency([1, 2, 3, 4, 5, 6, 14])
    call expect_close(f/[38.63_wp, 88.85_wp, 153.86_wp, 207.98_wp, 345.90_wp, 355.42_wp, &
                         1421.67_wp], &
                      spread(1.0_wp, 1, 7), 5.0e-3_wp, "Cortinez and Piovan, rigid in shear")
  end subroutine table_3

  !> First frequency of the column rigid in shear with two elements: 0.12 % (theory 7).
  subroutine two_elements()
    type(modes_t) :: modes

    call solve("column", modes, ["shear=OFF", "n=2      "])
    if (modes%modes == 0) return
    call expect_close(modes%frequency(1)/38.59018352_wp - 1, 0.0012_wp, 1.0e-4_wp, "two elements")
  end subroutine two_elements

  !> EI = rho A = L = 1; bending about both axes, so every frequency twice, torsion far above.
  subroutine timoshenko()
    real(wp), parameter :: free(5) = [20.36561253815713_wp, 49.12229702818994_wp, &
                                      83.68202279541272_wp, &
                                      120.31784870196813_wp, 157.37933033346386_wp]
    real(wp), parameter :: pinned(5) = [9.42302323557539_wp, 33.68558612421998_wp, &
                                        66.09056882863733_wp, &
                                        102.29744469112183_wp, 140.16023055880157_wp]
    type(modes_t) :: modes
    integer :: i

    call solve("timoshenko", modes, remark="6 free motions with frequency zero")
    if (modes%modes < 16) return
    call expect_close(modes%frequency(:6), spread(0.0_wp, 1, 6), 0.0_wp, "six zero frequencies")
    call expect(mode_kind(modes%energy(:, 6)) == "rigid", "of rigid modes")
    call expect_close(2*pi*modes%frequency(7:16)/free([1, 1, 2, 2, 3, 3, 4, 4, 5, 5]), &
                      spread(1.0_wp, 1, 10), &
                      2.0e-3_wp, "free")
    call expect_close(modes%centre, [0.5_wp, 0.0_wp, 0.0_wp], 1.0e-12_wp, "centre of mass")
    call expect_close(modes%rigid_mass, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 1/12.0_wp + 0.0025_wp, &
                                         1/12.0_wp + 0.0025_wp], 1.0e-10_wp, "mass and inertia")
    do i = 1, 6
      call expect_close(sum(modes%effective_mass(i, :6))/modes%rigid_mass(i), 1.0_wp, 1.0e-7_wp, &
                        "the rigid modes carry all mass")
    end do
    call solve("timoshenko", modes, ["x=X", "y=Y", "z=Z"])
    if (modes%modes < 11) return
    call expect_close(2*pi*modes%frequency(2:11)/pinned([1, 1, 2, 2, 3, 3, 4, 4, 5, 5]), &
                      spread(1.0_wp, 1, 10), &
                      2.0e-3_wp, "pinned")
  end subroutine timoshenko

  !> Clamped and free, or on forks; with and without shear of warping.
  subroutine torsion()
    call compare([character(len=9) :: "n=60"], [18.555996487528386_wp, 84.35363188046209_wp, &
                                                215.0588455491382_wp, 403.59312265598305_wp])
    call compare([character(len=9) :: "n=60", "shear=OFF"], [18.588556703712623_wp, &
      85.13735154232796_wp, &
                                                             220.0339995567158_wp, &
                                                             420.75046063186846_wp])
    call compare([character(len=9) :: "n=20", "b=RX", "c=RX"], [40.13966234044608_wp, &
      140.87959033174576_wp, &
                                                        303.26433387665077_wp, &
                                                        521.1147409600092_wp])
    call compare([character(len=9) :: "n=20", "b=RX", "c=RX", "shear=OFF"], [40.23129398765685_wp, &
                 142.48967415679726_wp, 311.29030797838516_wp, 545.3572280837617_wp])
    call compare([character(len=11) :: "n=60", "b=RX", "c=RX", "mass=LUMPED"], &
                 [40.13966234044608_wp, &
                 140.87959033174576_wp, 303.26433387665077_wp, 521.1147409600092_wp])

  contains

    subroutine compare(settings, wanted)
      character(len=*), intent(in) :: settings(:)
      real(wp), intent(in) :: wanted(4)
      type(modes_t) :: modes

      call solve("torsion", modes, settings)
      call expect_close(of_kind(modes, [2, 5], 4)/wanted, spread(1.0_wp, 1, 4), 2.0e-3_wp, &
                        settings(size(settings)))
    end subroutine compare

  end subroutine torsion

  subroutine monosymmetric()
    real(wp), parameter :: wanted(6) = [5.663352124473428_wp, 13.10638431311719_wp, &
                                        19.050053905501848_wp, &
                                        37.418968619676235_wp, 37.91035879531776_wp, &
                                        77.9398020211237_wp]
    type(modes_t) :: modes

    call solve("monosymmetric", modes)
    call expect_close(of_kind(modes, [2, 4, 5], 7)/[wanted(1:5), 62.969_wp, wanted(6)], &
                      spread(1.0_wp, 1, 7), &
                      2.0e-4_wp, "over the exact ones")
    call solve("monosymmetric", modes, ["mass=LUMPED"])
    call expect_close(of_kind(modes, [2, 4, 5], 3)/wanted(:3), spread(1.0_wp, 1, 3), 2.0e-3_wp, &
                      "lumped")
  end subroutine monosymmetric

  !> f = f0 sqrt(1 - P/Pe); beyond Euler's load it is imaginary.
  subroutine stressed()
    real(wp), parameter :: share(6) = [-1.0_wp, -0.5_wp, 0.0_wp, 0.5_wp, 0.9_wp, 1.1_wp]
    character(len=6), parameter :: setting(6) = ["p=-1  ", "p=-0.5", "p=0   ", "p=0.5 ", "p=0.9 ", &
                                                 "p=1.1 "]
    real(wp), parameter :: f(3) = [7.5469151304824855_wp, 30.187660521929942_wp, &
                                   67.92223617434237_wp]
    type(modes_t) :: modes
    integer :: i, n

    do i = 1, 5
      call solve("stressed", modes, setting(i:i))
      call expect_close(of_kind(modes, [4], 3)/(f*sqrt(1 - share(i)/[(n**2, n=1, 3)])), &
                        spread(1.0_wp, 1, 3), &
                        2.0e-3_wp, "weak axis, "//setting(i))
    end do
    call solve("stressed", modes, setting(6:6), &
               "warning: the state is unstable: 1 mode with imaginary")
    if (modes%modes == 0) return
    call expect_close(modes%imaginary(1:2), [f(1)*sqrt(0.1_wp), 0.0_wp], 1.0e-2_wp, "imaginary")
    call expect_close(modes%frequency(1), 0.0_wp, 0.0_wp, "its real part")
    call expect(modes%eigenvalue(1) < 0 .and. all(modes%eigenvalue(2:) > 0), &
                "one negative eigenvalue")
  end subroutine stressed

  !> Exact: arms clamped or hinged at the hub, and twice two modes that move it, 4 (kt + ka) = 0 of
  !> the arms' dynamic stiffness. Eight modes are asked for that end within a cluster.
  subroutine cross()
    real(wp), parameter :: exact(16) = [11.3362_wp, 17.680766_wp, 17.680766_wp, spread(17.7094_wp, &
      1, 5), &
                                        45.3450_wp, 57.074562_wp, 57.074562_wp, spread(57.3897_wp, &
                                        1, 5)]
    type(modes_t) :: modes

    call solve("cross", modes, ["n=10"])
    if (modes%modes /= 16) return
    call expect_close(modes%frequency/exact, spread(1.0_wp, 1, 16), 3.0e-4_wp, "all sixteen")
    call solve("cross", modes, ["n=10   ", "modes=6"])
    call expect(modes%modes == 6, "six, of eight about equal")
    if (modes%modes /= 6) return
    call expect_close(modes%frequency/exact(:6), spread(1.0_wp, 1, 6), 3.0e-4_wp, "the first six")
  end subroutine cross

  !> A rod of mass m and length a moves with the tip: w + x w'.
  subroutine rod()
    type(modes_t) :: modes
    real(wp) :: wanted(5)

    call solve("rod", modes)
    call expect(modes%modes == 5, "five modes, no more")
    if (modes%modes /= 5) return
    wanted(1:2) = bending(2*7.0_wp)
    wanted(3:4) = bending(2*4.0_wp)
    wanted(5) = sqrt(2*50/3.0_wp/(0.8_wp*1.5_wp))
    call expect_close(2*pi*modes%frequency, sorted(wanted), 1.0e-8_wp, "closed form")

  contains

    pure function bending(ei) result(omega)
      real(wp), intent(in) :: ei
      real(wp) :: omega(2), k(3), m(3), p, q, r
      real(wp), parameter :: l = 3, a = 1.5_wp, mass = 0.8_wp*1.5_wp

      k = ei/l**3*[12.0_wp, -6*l, 4*l**2]
      m = mass*[1.0_wp, a/2, a**2/3]
      p = m(1)*m(3) - m(2)**2
      q = k(1)*m(3) + k(3)*m(1) - 2*k(2)*m(2)
      r = k(1)*k(3) - k(2)**2
      omega = sqrt((q + [-1, 1]*sqrt(q**2 - 4*p*r))/(2*p))
    end function bending

    pure function sorted(x) result(y)
      real(wp), intent(in) :: x(:)
      real(wp) :: y(size(x))
      integer :: i

      y(1) = minval(x)
      do i = 2, size(x)
        y(i) = minval(x, x > y(i - 1))
      end do
    end function sorted

  end subroutine rod

  !> Timoshenko's frequencies of the cantilever, and torsion without warping.
  subroutine refined()
    real(wp), parameter :: wanted(10) = [0.835450_wp, 1.670500_wp, 5.233182_wp, 10.448958_wp, &
                                         14.641802_wp, &
      28.659948_wp, 29.168197_wp, 47.308243_wp, 56.905936_wp, 59.434402_wp]
    type(modes_t) :: modes

    call solve("refined", modes)
    if (modes%modes /= 10) return
    call expect_close(modes%frequency/wanted, spread(1.0_wp, 1, 10), 1.0e-6_wp, "frequencies")
    call expect_close(modes%energy([4, 3, 4, 3], 1:4), reshape([1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1, &
      0, 0, 1, 0, 1] &
                                                  *1.0_wp, [4, 4]), 1.0e-3_wp, "kinds in turn")
  end subroutine refined

  !> A uniform cantilever's first mode carries 61.3 % of the mass, the second 18.8 %, and its tip
  !> moves by 2/sqrt(mass): Euler's beam, with 1e-3 for shear and rotary inertia. Strains are those
  !> of the mode's motion: element 1 is bent by the rotation of its end.
  subroutine masses()
    type(modes_t) :: modes
    integer :: tip, n

    call solve("refined", modes, ["n=20"])
    if (modes%modes /= 10) return
    n = size(modes%displacement, 2)
    tip = 2
    call expect_close(modes%rigid_mass(1:3), spread(7850*0.02_wp*10, 1, 3), 1.0e-8_wp*1570, "mass")
    call expect_close(modes%effective_mass(2, [1, 3])/1570, [0.61308_wp, 0.18829_wp], 5.0e-4_wp, &
                      "along Y")
    call expect_close(modes%effective_mass(3, [2, 4])/1570, [0.61308_wp, 0.18829_wp], 5.0e-4_wp, &
                      "along Z")
    call expect_close(modes%displacement(2, tip, 1)*sqrt(1570.0_wp), 2.0_wp, 2.0e-3_wp, &
                      "tip, mass one")
    call expect(all(maxval(maxval(modes%displacement(:, :, 1:9), 1), 1) > 0), "signs")
    call expect_close(modes%strain(6, 1, 1)/(0.5_wp*modes%rotation(3, &
      minloc(abs(modes%displacement(2, :, 1)), 1, &
      modes%displacement(2, :, 1) > 0), 1)*0.5_wp), 1.0_wp, 0.05_wp, "strain of the first element")
    call expect(n == 21, "nodes")
  end subroutine masses

  !> Length 1, radius 1/pi: the centre is 2/pi of the radius from its centre. The line between the
  !> nodes is that of the mass, cubic; without its slopes it would be 0.017 off.
  subroutine half_circle()
    type(modes_t) :: modes

    call solve("bent", modes)
    if (modes%modes == 0) return
    call expect(allocated(modes%lambda), "dead moments on free rotations have no potential")
    call expect_close(modes%centre, [2/pi**2, 0.0_wp, 1/pi], 1.0e-4_wp, "centre of mass")
    call expect_close(modes%rigid_mass(1:3), [1, 1, 1]*1.0_wp, 1.0e-12_wp, "mass")
  end subroutine half_circle

  !> Beam and spring share a deflection, so their energies are as their stiffnesses.
  subroutine sprung_tip()
    type(modes_t) :: modes

    call solve("sprung_tip", modes)
    call expect(modes%modes == 1, "one mode")
    if (modes%modes /= 1) return
    call expect_close(modes%frequency(1), sqrt(8000/2.0_wp)/(2*pi), 1.0e-10_wp, "frequency")
    call expect_close(modes%energy(3, 1), 0.75_wp, 1.0e-10_wp, "three quarters in the beam")
    call expect_close(modes%energy(6, 1), 0.25_wp, 1.0e-10_wp, "a quarter in the spring")
    call expect(mode_kind(modes%energy(:, 1)) == "bending y 75 %, joints 25 %", "in words")
  end subroutine sprung_tip

  subroutine massless()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../eigen/massless", memory, model, error)
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(error%status == exit_deck .and. index(error%message, "EIGEN needs mass") == 1, &
                error%message)
  end subroutine massless

  !> Flap frequencies [rad/s] at the rates 0, 3, 6 and 12 (Wright et al., JAM 49 (1982) 197): in
  !> flapping the centrifugal forces keep their direction, so dead loads do. Their lumping at 40
  !> nodes and the stretch cost less than 1e-3.
  subroutine flapping()
    real(wp), parameter :: wanted(3, 4) = reshape([ &
      3.5160152685001513_wp, 22.03449156466677_wp, 61.697214413549105_wp, &
      4.7972785323630776_wp, 23.320263674295944_wp, 62.984967480682776_wp, &
      7.3603730193100185_wp, 26.80908167849793_wp, 66.68391438150489_wp, &
      13.170150487506177_wp, 37.603112331191866_wp, 79.61447848945721_wp], [3, 4])
    character(len=6), parameter :: rate(4) = ["eta=0 ", "eta=3 ", "eta=6 ", "eta=12"]
    type(modes_t) :: modes
    integer :: i

    do i = 1, 4
      call solve("flap", modes, [rate(i)])
      if (modes%modes < 3) cycle
      call expect_close(2*pi*modes%frequency(:3)/wanted(:, i), [1, 1, 1]*1.0_wp, 2.0e-3_wp, rate(i))
    end do
  end subroutine flapping

end module test_eigen
