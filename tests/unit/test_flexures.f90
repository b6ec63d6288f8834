!> Leaf-spring mechanisms against closed forms and against leaf springs integrated without elements
!> (tools/flexure_reference.py).
module test_flexures
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck
  use program_runs, only: scratch, run_spar, make_file, outcome_t
  use result_reader, only: get_reals, get_integers
  implicit none
  private

  public :: run_flexures_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: e = 210000, g = e/2.6_wp, length = 100, h = 50, b = 0.5_wp
  real(wp), parameter :: area = h*b, i_thin = h*b**3/12, i_wide = b*h**3/12

contains

  subroutine run_flexures_tests()
    call run("flexures: parallel guide, small motion", guide_small)
    call run("flexures: parallel guide, support stiffness over the stroke", guide_stroke)
    call run("flexures: parallel guide with restrained warping", guide_warping)
    call run("flexures: cross-hinge by 20 degrees", cross_hinge)
    call run("flexures: overconstrained cross-hinge and its release", overconstrained)
    call run("flexures: compliance of each step in the result file", written)
  end subroutine run_flexures_tests

  subroutine solve(deck, settings, memory)
    character(len=*), intent(in) :: deck, settings(:)
    type(memory_t), intent(out) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck(deck, memory, model, error, settings)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
    call expect(memory%steps == 8, "all steps")
  end subroutine solve

  !> 24 EI/L**3; across EA and, in the wide direction, cantilevers of bending and shear.
  subroutine guide_small()
    type(memory_t) :: memory
    real(wp), parameter :: way = 0.01_wp, shear = 10*1.3_wp/(12 + 11*0.3_wp)
    real(wp), parameter :: wide = length**3/(3*e*i_wide) + length/(g*area*shear)

    call solve("leaf_guide", [character(len=16) :: "stroke=0.01"], memory)
    if (memory%steps /= 8) return
    ! the axial force of some (way/b)**2 and the shuttle's tilt, (b/W)**2 each
    call expect_close(memory%results(8)%reaction(2, 5)/way, 24*e*i_thin/length**3, &
                      4.0e-4_wp*2.625_wp, "guiding stiffness")
    associate (c => memory%record(8)%compliance(:, :, 1))
      call expect_close(c(1, 1), length/(2*e*area), 1.0e-4_wp*length/(e*area), "along the springs")
      call expect_close(c(3, 3), wide/2, 1.0e-4_wp*wide, "across them")
      call expect(all(abs([c(:, 2), c(2, :)]) <= 1.0e-12_wp*c(1, 1)), &
                  "nothing where the motion is prescribed")
    end associate
  end subroutine guide_small

  !> The tangent of the deflected guide. Of the second-order beam: L/(2EA) (1 + way**2 A/(700 I)).
  !> Torsion by the wide direction's force is constant in an element and errs by about 4.7/n**2;
  !> from 16 and 32 elements what is left of that is 1e-3.
  subroutine guide_stroke()
    integer, parameter :: step(3) = [1, 4, 8]
    real(wp), parameter :: force(3) = [6.5649975_wp, 26.4812117_wp, 54.4272673_wp]
    real(wp), parameter :: along(3) = [1.36197566e-5_wp, 7.58347814e-5_wp, 2.85191466e-4_wp]
    real(wp), parameter :: across(3) = [3.41598079e-4_wp, 2.73593637e-3_wp, 1.03050971e-2_wp]
    type(memory_t) :: coarse, fine
    real(wp) :: c, way
    integer :: i

    call solve("leaf_guide", [character(len=16) :: "n=16"], coarse)
    call solve("leaf_guide", [character(len=16) :: "n=32"], fine)
    if (coarse%steps /= 8 .or. fine%steps /= 8) return
    do i = 1, 3
      associate (now => fine%record(step(i))%compliance(:, :, 1))
        call expect_close(fine%results(step(i))%reaction(2, 5), force(i), 1.0e-5_wp*force(i), &
                          "force")
        call expect_close(now(1, 1), along(i), 1.0e-4_wp*along(i), "along the springs")
        c = (4*now(3, 3) - coarse%record(step(i))%compliance(3, 3, 1))/3
        call expect_close(c, across(i), 1.0e-3_wp*across(i), "across them")
        call expect_close(now, transpose(now), 1.0e-9_wp*maxval(now), "symmetry")
        way = 2.5_wp*step(i)
        ! the shuttle's tilt and the arc's shortening, some (way/L)**2, are not in it
        call expect_close(now(1, 1), length/(2*e*area)*(1 + way**2*area/(700*i_thin)), &
                          2*(way/length)**2*along(i) + 1.0e-3_wp*along(i), "second-order beam")
      end associate
    end do
  end subroutine guide_stroke

  !> Warping held at the ends lowers the compliance by torsion: Vlasov's equation integrated along
  !> the bent springs, at small strokes, where their forces do not matter yet.
  subroutine guide_warping()
    real(wp), parameter :: across(2) = [2.26710023e-4_wp, 3.62337705e-4_wp]
    type(memory_t) :: memory

    call solve("leaf_guide_warping", [character(len=16) :: "n=32"], memory)
    if (memory%steps /= 8) return
    call expect_close([memory%record(1)%compliance(3, 3, 1), &
                       memory%record(2)%compliance(3, 3, 1)], across, 1.0e-3_wp*across(2), "across")
    call expect_close(memory%record(8)%compliance(1, 1, 1), 2.85191466e-4_wp, 3.0e-8_wp, "along")
  end subroutine guide_warping

  !> At first 2EI/L about the crossing, also where the loads are so small that round-off of the
  !> constraints' forces is more than the tolerance of them; at 20 degrees moment and way of the
  !> point that was there.
  subroutine cross_hinge()
    type(memory_t) :: memory
    real(wp), parameter :: angle(4) = [1.0e-3_wp, 9.0e-4_wp, 5.0e-4_wp, 1.0e-5_wp]
    character(len=16) :: setting
    integer :: i

    do i = 1, size(angle)
      write (setting, "('angle=', es9.3)") angle(i)
      call solve("cross_hinge", [setting], memory)
      if (memory%steps /= 8) return
      call expect_close(memory%results(8)%reaction(6, 5)/angle(i), 2*e*i_thin/length, &
                        1.0e-4_wp*2*e*i_thin/length, "stiffness")
    end do
    call solve("cross_hinge", [character(len=16) :: "n=16"], memory)
    if (memory%steps /= 8) return
    associate (now => memory%results(8), c => memory%record(8)%compliance(:, :, 1))
      call expect_close(now%reaction(6, 5), 778.765842_wp, 1.0e-5_wp*778.8_wp, "moment")
      call expect_close(now%displacement(:2, 5), [-0.246604371_wp, 1.39856288_wp], 1.0e-4_wp, &
                        "drift of the pivot")
      call expect_close([c(1, 1), c(2, 2)], [1.60761778e-3_wp, 1.53645614e-3_wp], 3.0e-6_wp, &
                        "support compliance")
    end associate
  end subroutine cross_hinge

  !> Springs that only bend in one plane and twist: one constraint too many, which no planar motion
  !> disturbs. A released bending in the stiff plane makes the hinge statically determinate; both
  !> turn alike, by the moment of inextensible springs.
  subroutine overconstrained()
    type(memory_t) :: rigid, released
    type(outcome_t) :: outcome

    call solve("cross_hinge_rigid", [character(len=16) :: "n=16"], rigid)
    call solve("cross_hinge_released", [character(len=16) :: "n=16"], released)
    if (rigid%steps /= 8 .or. released%steps /= 8) return
    call expect(size(rigid%remarks) == 1, "a warning")
    call expect(size(released%remarks) == 0, "none after the release")
    call expect_close(rigid%results(8)%reaction(:, 5), released%results(8)%reaction(:, 5), &
                      1.0e-7_wp, "the same moment")
    call expect_close(rigid%results(8)%reaction(6, 5), 778.765842_wp, 1.0e-3_wp*778.8_wp, "moment")
    call expect(all(abs(rigid%results(8)%strain(3:4, :)) <= 1.0e-10_wp), "stiff modes are rigid")
    call run_spar("check tests/cases/static/cross_hinge_rigid.deck", outcome)
    call expect(index(outcome%output, "overconstrained once: element") > 0, "check names it")
    call run_spar("check tests/cases/static/cross_hinge_released.deck", outcome)
    call expect(index(outcome%output, "overconstrained") == 0, "and is content with the release")
  end subroutine overconstrained

  !> Steps of a path by its arc; the last matrix is that of COMPLIANCE behind it.
  subroutine written()
    character(len=1), parameter :: newline = new_line("a")
    type(outcome_t) :: outcome
    real(wp), allocatable :: steps(:), last(:)
    integer, allocatable :: nodes(:), extents(:)
    character(len=:), allocatable :: deck, path

    deck = scratch("compliance.deck")
    path = scratch("compliance.h5")
    call make_file(deck, "MATERIAL m E 1e5 NU 0.3"//newline//"SECTION s RECT H 2 B 1"//newline// &
                   "NODE 1:3 {10*i} 0 0"//newline//"BEAM 1:2 {i} {i+1} SECTION s MATERIAL m"// &
                   newline//"FIX 1"//newline//"XF 3 -60 0 0.3"//newline// &
                   "STATIC CONTROL ARC MAXSTEPS 3 COMPLIANCE 2:3"//newline//"COMPLIANCE 3 2"// &
                   newline)
    call run_spar("run "//deck//" --quiet -o "//path, outcome)
    call expect(outcome%status == 0, "exit status, "//outcome%errors)
    call get_integers(path, "analysis/01_static/compliance/nodes", nodes, extents)
    call expect(all(extents == [2, 3]) .and. all(nodes == [1, 2, 0, 2, 3, 0]), &
                "nodes by row and id")
    call get_reals(path, "analysis/01_static/compliance/matrix", steps, extents)
    call expect(all(extents == [6, 36]), "three steps of two nodes")
    call get_reals(path, "analysis/02_compliance/compliance", last, extents)
    call expect(all(extents == [2, 6, 6]), "two nodes")
    if (size(steps) /= 216 .or. size(last) /= 72) return
    call expect_close(steps(145:), last, 1.0e-9_wp*maxval(abs(last)), "the last state")
    call expect(abs(steps(15) - last(15)) > 1.0e-6_wp*last(15), "and not the first")
  end subroutine written

end module test_flexures
