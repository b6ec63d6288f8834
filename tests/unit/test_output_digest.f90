!> Digest and summary of a result file.
module test_output_digest
  use kinds, only: wp
  use errors, only: error_t, exit_io
  use text, only: newline
  use check, only: run, expect, expect_close
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  use result_samples, only: sample_t, new_sample, write_sample
  use output_digest, only: rounded
  use output_info, only: file_info_t, read_info
  implicit none
  private

  public :: run_output_digest_tests

contains

  subroutine run_output_digest_tests()
    call run("digest: numbers", test_numbers)
    call run("digest: small numbers beside large ones", test_floor)
    call run("digest: a file", test_file)
    call run("digest: round-off and signs of zero", test_round_off)
    call run("digest: a processor that rounds differently", test_processor)
    call run("info: a run", test_info)
  end subroutine run_output_digest_tests

  subroutine expect_word(number, digits, scale, word)
    real(wp), intent(in) :: number, scale
    integer, intent(in) :: digits
    character(len=*), intent(in) :: word

    call expect(rounded(number, digits, scale) == word, word//" instead of "// &
                rounded(number, digits, scale))
  end subroutine expect_word

  subroutine test_numbers()
    call expect_word(1.0_wp, 6, 1.0_wp, "1e0")
    call expect_word(-1234.5678_wp, 6, 2000.0_wp, "-1.23457e3")
    call expect_word(0.00099999996_wp, 6, 1.0_wp, "1e-3")
    call expect_word(0.00100000004_wp, 6, 1.0_wp, "1e-3")
    call expect_word(1.25e-130_wp, 3, 1.0e-130_wp, "1.25e-130")
    call expect_word(20.0_wp, 1, 20.0_wp, "2e1")
    call expect_word(0.0_wp, 6, 0.0_wp, "0")
    call expect_word(-0.0_wp, 6, 1.0_wp, "0")
  end subroutine test_numbers

  !> The last digit stands at 1e-9 of the scale, for 6 digits.
  subroutine test_floor()
    call expect_word(-1.0e-10_wp, 6, 1.0_wp, "0")
    call expect_word(1.23456789e-3_wp, 6, 1.0_wp, "1.23457e-3")
    call expect_word(1.23456789e-4_wp, 6, 1.0_wp, "1.23457e-4")
    call expect_word(1.23456789e-5_wp, 6, 1.0_wp, "1.2346e-5")
    call expect_word(1.23456789e-8_wp, 6, 1.0_wp, "1.2e-8")
    call expect_word(1.23456789e-8_wp, 6, 1.0e-3_wp, "1.2346e-8")
  end subroutine test_floor

  subroutine test_file()
    type(sample_t) :: sample
    type(outcome_t) :: outcome

    call new_sample(sample)
    sample%displacement = 0
    sample%displacement(:, 1) = [0.5_wp, -0.25_wp, 1.0_wp/3.0_wp]
    call write_sample(scratch("digest.h5"), sample)
    call run_spar("digest "//scratch("digest.h5")//" --digits 4", outcome)
    call expect(outcome%status == 0, "status 0")
    call expect(index(outcome%output, "/analysis/01_static/nodes/displacement 8 3"//newline// &
                      "  5e-1 -2.5e-1 3.333e-1"//newline//"  0 0 0"//newline) > 0, "a table")
    call expect(index(outcome%output, "/analysis/01_static/step 2"//newline//"  1"//newline// &
                      "  2"//newline) > 0, "whole numbers")
    call expect(index(outcome%output, "material 1"//newline//"  steel"//newline) > 0, "texts")
    call expect(index(outcome%output, "convergence") == 0, "no residuals")
    call run_spar("digest "//scratch("digest.h5")//" --digits 0", outcome)
    call expect(outcome%status == 2, "--digits 0")
    call run_spar("digest "//scratch("missing.h5"), outcome)
    call expect(outcome%status == 5, "no file")
  end subroutine test_file

  !> Files that differ by what another machine makes of them give the same text.
  subroutine test_round_off()
    type(sample_t) :: sample
    type(outcome_t) :: first, second

    call new_sample(sample)
    sample%displacement(1:2, 3) = [0.0_wp, 1.0e-13_wp]
    call write_sample(scratch("digest.h5"), sample)
    call run_spar("digest "//scratch("digest.h5"), first)
    sample%displacement = sample%displacement*(1 + 1.0e-13_wp)
    sample%displacement(1:2, 3) = [-0.0_wp, -3.0e-13_wp]
    sample%reaction(1, 1) = sample%reaction(1, 1) + 1.0e-13_wp
    call write_sample(scratch("digest.h5"), sample)
    call run_spar("digest "//scratch("digest.h5"), second)
    call expect(first%output == second%output, "equal digests")
    sample%displacement(3, 3) = sample%displacement(3, 3)*(1 + 1.0e-4_wp)
    call write_sample(scratch("digest.h5"), sample)
    call run_spar("digest "//scratch("digest.h5"), second)
    call expect(first%output /= second%output, "a changed value shows")
  end subroutine test_round_off

  !> Kernels of BLAS and of the mathematical library without fused products, as on an old
  !> processor (where there is a choice of them): forces beside moments, rigid strains, reactions
  !> beside moments; modes of double eigenvalues, complex ones and such that are cut. compare
  !> agrees.
  subroutine test_processor()
    character(len=32), parameter :: deck(8) = [character(len=32) :: &
      "decks/four_bar", "tests/cases/static/rollup", "tests/cases/path/lateral", &
      "tests/cases/eigen/bent", "tests/cases/kinematic/bricard", &
      "tests/cases/rotating/beck", "tests/cases/eigen/cross", "tests/cases/buckling/dead_moment"]
    character(len=*), parameter :: old = "env OPENBLAS_CORETYPE=NEHALEM "// &
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F"
    type(outcome_t) :: outcome, first, second
    integer :: i

    do i = 1, size(deck)
      call run_spar("run "//trim(deck(i))//".deck --quiet --no-vtk -o "//scratch("new.h5"), outcome)
      call expect(outcome%status == 0, trim(deck(i))//" runs: "//outcome%errors)
      call run_spar("run "//trim(deck(i))//".deck --quiet --no-vtk -o "//scratch("old.h5"), &
                    outcome, front=old)
      call expect(outcome%status == 0, trim(deck(i))//" runs there too: "//outcome%errors)
      call run_spar("digest "//scratch("new.h5"), first)
      call run_spar("digest "//scratch("old.h5"), second)
      call expect(len(first%output) > 1000 .and. first%output == second%output, &
                  trim(deck(i))//": equal digests")
      call run_spar("compare "//scratch("new.h5")//" "//scratch("old.h5"), outcome)
      call expect(outcome%status == 0, trim(deck(i))//": "//outcome%output)
    end do
  end subroutine test_processor

  subroutine test_info()
    type(file_info_t) :: info
    type(error_t), allocatable :: error
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    type(sample_t) :: sample

    path = scratch("info.h5")
    call run_spar("run tests/cases/program/limit.deck --quiet -o "//path, outcome)
    call read_info(path, info, error)
    call expect(.not. allocated(error), "readable")
    if (allocated(error)) return
    call expect(.not. info%complete, "an incomplete run")
    call expect(size(info%analysis) == 1, "one analysis")
    call expect(info%analysis(1)%group == "/analysis/01_static", "its group")
    call expect(info%analysis(1)%steps == 3 .and. .not. info%analysis(1)%complete, "its steps")
    call expect(info%drawn == 3, "as many are drawn")
    call run_spar("info "//path, outcome)
    call expect(outcome%status == 0, "status 0")
    call expect(index(outcome%output, "NOT complete") > 0, "says so")
    call run_spar("info --json "//path, outcome)
    call expect(index(outcome%output, """complete"": false") > 0, "as JSON too")
    call new_sample(sample)
    call write_sample(path, sample)
    call read_info(path, info, error)
    call expect(info%analysis(2)%modes == 3, "modes")
    call expect_close(info%analysis(2)%last, 1.0_wp, 0.0_wp, "first frequency")
    call make_file(path, "no result file")
    call run_spar("info "//path, outcome)
    call expect(outcome%status == 5, "no result file")
  end subroutine test_info

end module test_output_digest
