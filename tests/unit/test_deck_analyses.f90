!> Analysis cards, the patterns that the analyses take, and SPACAR's run modes.
module test_deck_analyses
  use check, only: run, expect, expect_close
  use kinds, only: wp
  use text, only: to_text, newline
  use diagnostics, only: report_t, severity_note
  use model_data, only: model_t, analysis_static, analysis_buckling, analysis_eigen, &
                        analysis_transient, analysis_kinematic, analysis_inverse, &
                        analysis_compliance
  use deck_samples, only: read_sample, read_sound, frame
  use program_runs, only: outcome_t, run_spar, scratch, make_file, file_there
  implicit none
  private

  public :: run_deck_analyses_tests

  !> A fixed beam of three parts: nodes 1, 2, 7.1, 7.2; elements 1, 7.1 to 7.3.
  character(len=*), parameter :: divided = frame// &
    "NODE 3 9 0 0|BEAMW 7 2 3 0 1 0 SECTION bar MATERIAL steel DIVIDE 3|FIX 1|"
  character(len=*), parameter :: held = frame//"FIX 1|", force = "XF 2 0 0 1|"

contains

  subroutine run_deck_analyses_tests()
    call run("analyses: TRANSIENT", transient)
    call run("analyses: KINEMATIC and INVERSE", given_motion)
    call run("analyses: times go on", times)
    call run("analyses: COMPLIANCE", compliance)
    call run("analyses: EIGEN, DAMP", eigen)
    call run("analyses: OUTPUT", output)
    call run("analyses: what takes which pattern", patterns)
    call run("analyses: DELXF and time", additional)
    call run("analyses: SPACAR's modes", spacar_modes)
    call run("analyses: modes without loads, without TIMESTEP", bare_modes)
    call run("analyses: SPACAR's cards that are ignored", ignored)
    call run("analyses: spar run --mode", mode_option)
  end subroutine run_deck_analyses_tests

  subroutine transient()
    type(model_t) :: model

    call read_sound(held//force//"TRANSIENT TEND 2 STEP 0.01|TRANSIENT MAXITER 7 NAME slow "// &
                    "RHOINF 0 EVERY 0.5 TOL 1e-3 TEND 4|"// &
                    "TRANSIENT TEND 5 TOL 1e-5 STABILISED OFF RHOINF 1", model)
    call expect(size(model%analysis) == 3, "three")
    if (size(model%analysis) /= 3) return
    call expect(all(model%analysis%kind == analysis_transient), "TRANSIENT")
    call expect(all(model%analysis%stabilised .eqv. [.true., .true., .false.]), "STABILISED")
    call expect_close(model%analysis%end_time, [2.0_wp, 4.0_wp, 5.0_wp], 0.0_wp, "TEND")
    call expect_close(model%analysis%time_step, [0.01_wp, 0.0_wp, 0.0_wp], 0.0_wp, "STEP")
    call expect_close(model%analysis%tolerance, [0.0_wp, 1.0e-3_wp, 1.0e-5_wp], 0.0_wp, "TOL")
    call expect_close(model%analysis%every, [0.0_wp, 0.5_wp, 0.0_wp], 0.0_wp, "EVERY")
    call expect_close(model%analysis%spectral_radius, [0.9_wp, 0.0_wp, 1.0_wp], 0.0_wp, "RHOINF")
    call expect(all(model%analysis%iterations == [0, 7, 0]), "MAXITER")
    call expect(model%analysis(2)%name == "slow", "NAME")
    call expect(all(model%analysis(:2)%steps == [200, 4]), "how many steps to expect")
    call read_sound(held//force//"ITERSTEP 9 5 1e-4|TRANSIENT TEND 2 STEP 1|"// &
                    "TRANSIENT TEND 3 TOL 1e-6", model)
    call expect_close(model%analysis%tolerance, [1.0e-4_wp, 1.0e-6_wp], 0.0_wp, &
                      "ITERSTEP's tolerance, of Newton, does not replace TOL")
    call expect(all(model%analysis%iterations == 9), "ITERSTEP's iterations")
  end subroutine transient

  subroutine given_motion()
    type(model_t) :: model

    call read_sound(held//force//"KINEMATIC TEND 1 STEP 0.25 NAME a|"// &
                    "INVERSE EVERY 0.5 STEP 0.1 TEND 2", model)
    call expect(all(model%analysis%kind == [analysis_kinematic, analysis_inverse]), "kinds")
    call expect_close(model%analysis%end_time, [1.0_wp, 2.0_wp], 0.0_wp, "TEND")
    call expect_close(model%analysis%time_step, [0.25_wp, 0.1_wp], 0.0_wp, "STEP")
    call expect_close(model%analysis%every, [0.0_wp, 0.5_wp], 0.0_wp, "EVERY")
    call expect(model%analysis(1)%name == "a", "NAME")
    call expect(all(model%analysis%steps == [4, 2]), "how many steps to expect")
  end subroutine given_motion

  !> TEND is absolute: STATIC between two motions takes no time.
  subroutine times()
    type(model_t) :: model
    type(report_t) :: report

    call read_sound(held//force//"INVERSE TEND 1 STEP 1|STATIC|TRANSIENT TEND 1.5 STEP 0.5", model)
    call expect(model%analysis(3)%steps == 1, "one step from 1 to 1.5")
    call read_sample(held//force//"INVERSE TEND 1 STEP 1|STATIC|TRANSIENT TEND 1 STEP 0.5", model, &
                     report)
    call expect(report%errors() == 1, "no time is left")
    call read_sample(held//force//"INVERSE TEND 1 STEP 1|TRANSIENT TEND 1.5 STEP 0.75", model, &
                     report)
    call expect(report%errors() == 1, "a step longer than the half second that is left")
  end subroutine times

  subroutine compliance()
    type(model_t) :: model
    type(report_t) :: report

    call read_sound(divided//"GROUP inner NODES 7.1 7.2|COMPLIANCE 2 inner 2 NAME c|"// &
                    "COMPLIANCE ALL", model)
    call expect(all(model%analysis%kind == analysis_compliance), "kind")
    call expect(model%analysis(1)%name == "c", "NAME")
    call expect(named(model, model%analysis(1)%node) == " 2.0 7.1 7.2", "each node once")
    call expect(size(model%analysis(2)%node) == size(model%node), "ALL")
    call read_sound(divided//"COMPLIANCE 2|XF 2 0 0 1|DELXF 2 0 1 0|STATIC|COMPLIANCE 7.2", model)
    call expect(named(model, model%analysis(1)%node)//named(model, model%analysis(4)%node) == &
                " 2.0 7.2", "beside an implied STATIC")
    call read_sample("MATERIAL s E 2 G 1|SECTION b CONSTANTS A 1 IY 2 IZ 3 IT 4|"// &
                     "NODE 1 0 0 0|NODE 2 4 0 0|BEAMW 1 1 11 21 2 12 22 SECTION b MATERIAL s|"// &
                     "FIX 1|FIX 11|FIX 21|COMPLIANCE ALL|COMPLIANCE 12", model, report)
    call expect(named(model, model%analysis(1)%node) == " 1.0 2.0", "ALL passes over rotations")
    call expect(report%errors() == 1, "a rotational node is an error")
  end subroutine compliance

  !> ` id.part` of each node.
  function named(model, index) result(names)
    type(model_t), intent(in) :: model
    integer, intent(in) :: index(:)
    character(len=:), allocatable :: names
    integer :: i

    names = ""
    do i = 1, size(index)
      names = names//" "//to_text(model%node(index(i))%id)//"."//to_text(model%node(index(i))%part)
    end do
  end function named

  subroutine eigen()
    type(model_t) :: model

    call read_sound(held//"DAMP 0.2 1e-4|EIGEN|EIGEN MATRICES ON NAME a MODES 3 DAMPED|"// &
                    "EIGEN MATRICES OFF", model)
    call expect(all(model%analysis%damped .eqv. [.false., .true., .false.]), "DAMPED")
    call expect(all(model%analysis%matrices .eqv. [.false., .true., .false.]), "MATRICES")
    call expect(model%analysis(2)%modes == 3 .and. model%analysis(2)%name == "a", "the rest")
    call expect_close(model%rayleigh, [0.2_wp, 1.0e-4_wp], 0.0_wp, "DAMP")
  end subroutine eigen

  subroutine output()
    type(model_t) :: model
    integer :: i

    call read_sound(divided//"GROUP legs ELEMENTS 7.3 1|OUTPUT NODES 7.2 2|EIGEN|"// &
                    "OUTPUT NODES 2 7.1|OUTPUT ELEMENTS legs|OUTPUT ELEMENTS 7.1", model)
    call expect(named(model, model%kept_node) == " 2.0 7.1 7.2", "nodes, each once")
    call expect(size(model%kept_member) == 3, "elements")
    if (size(model%kept_member) /= 3) return
    call expect(all([(model%member(model%kept_member(i))%id == merge(1, 7, i == 1), i=1, 3)]) &
                .and. model%member(model%kept_member(3))%part == 3, "in their order")
    call read_sound(divided//"OUTPUT ELEMENTS 7|EIGEN", model)
    call expect(size(model%kept_member) == 3 .and. size(model%kept_node) == 0, "all parts; none")
  end subroutine output

  !> Which pattern each analysis has, and how many loads each pattern.
  subroutine expect_patterns(cards, pattern, loads)
    character(len=*), intent(in) :: cards
    integer, intent(in) :: pattern(:), loads(:)
    type(model_t) :: model

    call read_sound(held//cards, model)
    call expect(size(model%analysis) == size(pattern), cards//": the analyses")
    call expect(size(model%pattern) == size(loads), cards//": the patterns")
    if (size(model%analysis) /= size(pattern) .or. size(model%pattern) /= size(loads)) return
    call expect(all(model%analysis%pattern == pattern), cards//": the pattern of each")
    call expect(all(model%pattern%loads == loads), cards//": the loads of each")
  end subroutine expect_patterns

  subroutine patterns()
    character(len=*), parameter :: t1 = "TRANSIENT TEND 1 STEP 1|", &
      t2 = "KINEMATIC TEND 2 STEP 1|", t3 = "INVERSE TEND 3 STEP 1|"

    call expect_patterns(force//t1//force//force//t2//t3//force//"STATIC", [1, 2, 0, 3], [1, 2, 1])
    call expect_patterns(force//"STATIC|"//t1, [1, 0], [1])
    call expect_patterns(t1//force//"STATIC|"//t2, [0, 1, 0], [1])
    call expect_patterns(force//t1//"STATIC", [1, 1], [1])
    call expect_patterns(force//t1//"BUCKLING", [1, 1], [1])
    call expect_patterns(force//"EIGEN|"//force//t1, [1, 1], [2])
    call expect_patterns(force//"COMPLIANCE 2|"//force//t1//force//t2, [1, 1, 2], [2, 1])
    call expect_patterns(force//"BUCKLING|"//t1, [1, 1], [1])
    call expect_patterns("GRAVITY 0 0 -1|"//t1//"GRAVITY 0 0 -2|"//t2, [1, 2], [0, 0])
  end subroutine patterns

  !> XF before DELXF is applied by an implied STATIC, whatever follows.
  subroutine additional()
    character(len=*), parameter :: more = "DELXF 2 0 1 0|", t1 = "TRANSIENT TEND 1 STEP 0.5|"
    type(model_t) :: model

    call read_sound(held//force//more//t1, model)
    call expect(all(model%analysis%kind == [analysis_static, analysis_transient]), "kinds")
    call expect(all(model%analysis%steps == [10, 2]), "steps")
    call expect_patterns(more//t1, [1], [1])
    call expect_patterns(more//"EIGEN|"//force//"STATIC", [1, 2, 1], [1, 1])
    call expect_patterns(force//more//"EIGEN|"//t1, [1, 2, 2], [1, 1])
  end subroutine additional

  !> Kinds and patterns of the analyses that a mode implies.
  subroutine expect_mode(cards, mode, kind, pattern, model)
    character(len=*), intent(in) :: cards
    integer, intent(in) :: mode, kind(:), pattern(:)
    type(model_t), intent(out) :: model
    character(len=:), allocatable :: name

    name = "mode "//to_text(mode)//", "//cards
    call read_sound(held//cards, model, mode)
    call expect(size(model%analysis) == size(kind), name//": the analyses")
    if (size(model%analysis) /= size(kind)) return
    call expect(all(model%analysis%kind == kind), name//": the kind of each")
    call expect(all(model%analysis%pattern == pattern), name//": the pattern of each")
    call expect(all(model%analysis%place%line == 0), name//": no card made them")
  end subroutine expect_mode

  subroutine spacar_modes()
    character(len=*), parameter :: time = "TIMESTEP 2 50|", more = "DELXF 2 0 1 0|", &
      both = force//more//"ITERSTEP 20 7 1e-6 0 0 3|"//time
    type(model_t) :: model

    call expect_mode(force//time, 1, [analysis_transient], [1], model)
    call expect_close([model%analysis%end_time, model%analysis%time_step], [2.0_wp, 0.04_wp], &
                      1.0e-16_wp, "TIMESTEP")
    call expect(all(model%analysis%steps == 50), "TIMESTEP's steps")
    call expect_mode(both, 1, [analysis_static, analysis_transient], [1, 2], model)
    call expect(all(model%analysis%steps == [3, 50]), "steps of base loads, then of time")
    call expect_mode(both, 2, [analysis_static, analysis_inverse], [1, 2], model)
    call expect_mode(both, 7, [analysis_static, analysis_static, analysis_eigen], [1, 2, 2], model)
    call expect(all(model%analysis(:2)%steps == [3, 7]), "steps of base and additional loads")
    call expect_mode(force, 7, [analysis_static, analysis_eigen], [1, 1], model)
    call expect_mode(both, 8, [analysis_static, analysis_buckling], [1, 2], model)
    call expect_mode(force, 8, [analysis_buckling], [1], model)
    call expect_mode(more, 8, [analysis_buckling], [1], model)
    call expect_mode(both, 10, [analysis_static, analysis_static], [1, 2], model)
    call expect_mode(force, 0, [analysis_static], [1], model)
  end subroutine spacar_modes

  subroutine bare_modes()
    type(model_t) :: model
    type(report_t) :: report
    integer :: mode

    call expect_mode("", 7, [analysis_eigen], [0], model)
    call expect_mode("TIMESTEP 1 4", 1, [analysis_transient], [0], model)
    do mode = 1, 2
      call read_sample(held//force, model, report, mode=mode)
      call expect(report%errors() == 1, "TIMESTEP is missing")
    end do
  end subroutine bare_modes

  subroutine ignored()
    type(model_t) :: model
    type(report_t) :: report
    character(len=*), parameter :: cards(5) = &
      [character(len=8) :: "DYNX", "INPUTF", "OUTX", "OUTXP", "TIMESTEP"]
    integer :: i, k
    logical :: noted

    call read_sample(held//force//"DYNX 2 1|END|INPUTF 1 2 1|OUTX 1 2 1 3|OUTXP 2|"// &
                     "TIMESTEP 1 2|STATIC|OUTX 2", model, report)
    call expect(report%errors() == 0, "no errors")
    do i = 1, size(cards)
      noted = .false.
      do k = 1, report%items
        noted = noted .or. (report%item(k)%severity == severity_note .and. &
                            index(report%item(k)%message, trim(cards(i))//" is ") == 1)
      end do
      call expect(noted, "a note of "//trim(cards(i)))
    end do
  end subroutine ignored

  !> Write a deck for the program.
  function deck_file(cards) result(path)
    character(len=*), intent(in) :: cards
    character(len=:), allocatable :: path, text
    integer :: i

    path = scratch("mode.deck")
    text = cards//"|"
    do i = 1, len(text)
      if (text(i:i) == "|") text(i:i) = newline
    end do
    call make_file(path, text)
  end function deck_file

  !> Run the program; its exit status and words in what it prints.
  subroutine expect_run(cards, options, status, words)
    character(len=*), intent(in) :: cards, options, words
    integer, intent(in) :: status
    type(outcome_t) :: outcome

    call run_spar("run "//deck_file(cards)//" -o "//scratch("mode.h5")//" "//options, outcome)
    call expect(outcome%status == status, options//": status "//to_text(outcome%status)// &
                newline//outcome%errors)
    call expect(index(outcome%output//outcome%errors, words) > 0, options//": '"//words// &
                "' in:"//newline//outcome%output//outcome%errors)
  end subroutine expect_run

  subroutine mode_option()
    character(len=*), parameter :: plain = "MATERIAL steel E 200 NU 0.25 RHO 1|"// &
      "SECTION bar CONSTANTS A 1 IY 2 IZ 3 IT 4|NODE 1 0 0 0|NODE 2 40 0 0|"// &
      "BEAMW 1 1 2 SECTION bar MATERIAL steel|FIX 1|XF 2 -1 0 0"

    call expect_run(plain, "", 0, "no analysis given: STATIC STEPS 10")
    call expect_run(plain, "--mode 10", 0, "1 STATIC")
    call expect_run(plain, "--mode 7", 0, "2 EIGEN")
    call expect_run(plain, "--mode 8", 0, "1 BUCKLING")
    call execute_command_line("rm -f "//scratch("mode.h5"))
    call expect_run(plain, "--mode 0", 0, "nothing moves freely")
    call expect(file_there(scratch("mode.h5")), "free motions, as spar check -o writes them")
    call expect_run(plain//"|RLSE 1 1", "--mode 0", 3, "moves freely")
    call expect_run(plain, "--mode 1", 3, "--mode 1 needs a TIMESTEP card")
    call expect_run(plain//"|STATIC", "--mode 10", 2, "without analysis cards")
    call expect_run(plain//"|EIGEN", "--mode 0", 2, "without analysis cards")
    call expect_run(plain, "--mode 3", 2, "not available yet")
    call expect_run(plain, "--mode 4", 2, "not available yet")
    call expect_run(plain, "--mode 9", 2, "not available yet")
    call expect_run(plain, "--mode 5", 2, "no mode")
    call expect_run(plain, "--mode -1", 2, "no mode")
    call expect_run(plain, "--mode 1.0", 2, "no mode")
    call expect_run(plain, "--mode 7e0", 2, "no mode")
    call expect_run(plain, "--mode", 2, "needs a value")
    call expect_run(plain, "--mode 7 --mode 8", 2, "given twice")
  end subroutine mode_option

end module test_deck_analyses
