!> Comparison of result files: every kind of difference is found, what means the same is accepted.
module test_output_compare
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use kinds, only: wp
  use errors, only: error_t, exit_usage, exit_io
  use text, only: string_t
  use check, only: run, expect, expect_close
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  use result_samples, only: sample_t, new_sample, write_sample
  use output_compare, only: compare_files
  use output_differences, only: differences_t, tolerance_t
  implicit none
  private

  public :: run_output_compare_tests

  character(len=*), parameter :: static = "/analysis/01_static/", eigen = "/analysis/02_eigen/"

contains

  subroutine run_output_compare_tests()
    call run("compare: equal files", test_equal)
    call run("compare: one changed value", test_value)
    call run("compare: round-off beside large entries of its dimension", test_round_off)
    call run("compare: round-off in a mode that does not strain", test_idle_mode)
    call run("compare: whole numbers and texts are exact", test_exact)
    call run("compare: missing and extra datasets", test_missing)
    call run("compare: one more step", test_step)
    call run("compare: wrong shape", test_shape)
    call run("compare: NaN equals nothing", test_nan)
    call run("compare: complex numbers by their size", test_pairs)
    call run("compare: swapped modes of different frequency", test_swapped)
    call run("compare: flipped signs of modes", test_flipped)
    call run("compare: rotated modes of a double frequency", test_rotated)
    call run("compare: a mode outside the space of a double frequency", test_outside)
    call run("compare: a changed stress of a mode", test_mode_stress)
    call run("compare: --only", test_only)
    call run("compare: the program", test_program)
  end subroutine run_output_compare_tests

  !> Differences between two samples.
  subroutine compare(first, second, found, relative)
    type(sample_t), intent(in) :: first, second
    type(differences_t), intent(out) :: found
    real(wp), intent(in), optional :: relative
    type(tolerance_t) :: tolerance
    type(string_t) :: none(0)
    type(error_t), allocatable :: error

    if (present(relative)) tolerance%relative = relative
    call write_sample(scratch("first.h5"), first)
    call write_sample(scratch("second.h5"), second)
    call compare_files(scratch("first.h5"), scratch("second.h5"), tolerance, none, found, error)
    call expect(.not. allocated(error), "both files can be read")
  end subroutine compare

  !> One difference, of this kind and place.
  subroutine expect_one(found, path, kind, place)
    type(differences_t), intent(in) :: found
    character(len=*), intent(in) :: path, kind, place

    call expect(found%all == 1, "one difference")
    if (found%listed < 1) return
    call expect(found%item(1)%path == path, "path "//found%item(1)%path)
    call expect(found%item(1)%kind == kind, "kind "//found%item(1)%kind)
    call expect(found%item(1)%place == place, "place "//found%item(1)%place)
  end subroutine expect_one

  !> Number of differences in a dataset.
  pure integer function count_at(found, path)
    type(differences_t), intent(in) :: found
    character(len=*), intent(in) :: path
    integer :: i

    count_at = 0
    do i = 1, found%listed
      if (found%item(i)%path == path) count_at = count_at + 1
    end do
  end function count_at

  subroutine test_equal()
    type(sample_t) :: sample
    type(differences_t) :: found

    call new_sample(sample)
    call compare(sample, sample, found, 0.0_wp)
    call expect(found%all == 0, "no differences")
  end subroutine test_equal

  subroutine test_value()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    second%displacement(2, 5) = first%displacement(2, 5)*(1 + 1.0e-4_wp)
    call compare(first, second, found)
    call expect_one(found, static//"nodes/displacement", "value", "[4, 1]")
    if (found%listed == 1) call expect_close(found%item(1)%error, 1.0e-4_wp, 1.0e-8_wp, &
                                             "relative error")
    call compare(first, second, found, 1.1e-4_wp)
    call expect(found%all == 0, "within a larger tolerance")
    call compare(first, second, found, 0.9e-4_wp)
    call expect(found%all == 1, "not within a smaller one")
  end subroutine test_value

  !> 1e-10 beside forces of 1, not beside bimoments of 1e-8.
  subroutine test_round_off()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    first%reaction(3, 4) = 1.0e-10_wp
    second%reaction(3, 4) = -2.0e-10_wp
    second%residual = 2*first%residual
    call compare(first, second, found)
    call expect(found%all == 0, "round-off, and a residual, are no differences")
    second%reaction(3, 4) = 2.0e-9_wp
    call compare(first, second, found)
    call expect_one(found, static//"nodes/reaction", "value", "[3, 2]")
    second%reaction(3, 4) = first%reaction(3, 4)
    second%reaction(7, 4) = first%reaction(7, 4) + 1.0e-10_wp
    call compare(first, second, found)
    call expect_one(found, static//"nodes/reaction", "value", "[3, 6]")
  end subroutine test_round_off

  subroutine test_exact()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    first%step = [1, 2000000]
    second%step = [1, 2000001]
    call compare(first, second, found)
    call expect_one(found, static//"step", "value", "[1]")
    second%step = first%step
    second%word = "steal"
    call compare(first, second, found)
    call expect_one(found, static//"material", "text", "[0]")
  end subroutine test_exact

  !> Entries that are round-off throughout a mode are measured against those of all modes: 1e-9 of
  !> the largest is equal, 1e-8 is not.
  subroutine test_idle_mode()
    type(sample_t) :: first, second
    type(differences_t) :: found
    real(wp) :: largest

    call new_sample(first)
    call new_sample(second)
    largest = maxval(abs(second%modes%strain))
    first%modes%strain(:, :, 1) = 1.0e-17_wp
    second%modes%strain(:, :, 1) = -3.0e-17_wp
    call compare(first, second, found)
    call expect(found%all == 0, "round-off of either sign")
    second%modes%strain(2, 1, 1) = 1.0e-8_wp*largest
    call compare(first, second, found)
    call expect_one(found, eigen//"modes/elements/strain", "value", "[0, 1]")
  end subroutine test_idle_mode

  subroutine test_missing()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    second%with_reaction = .false.
    call compare(first, second, found)
    call expect_one(found, static//"nodes/reaction", "missing", "")
    second%with_reaction = .true.
    second%with_more = .true.
    call compare(first, second, found)
    call expect_one(found, static//"more", "extra", "")
  end subroutine test_missing

  subroutine test_step()
    type(sample_t) :: first, second
    type(differences_t) :: found
    integer :: i

    call new_sample(first)
    call new_sample(second)
    second%step = [1, 2, 3]
    second%displacement = reshape([first%displacement, first%displacement(:, 5:8)], [3, 12])
    second%reaction = reshape([first%reaction, first%reaction(:, 5:8)], [7, 12])
    call compare(first, second, found)
    call expect(found%all == 3, "three tables are longer")
    do i = 1, found%listed
      call expect(found%item(i)%kind == "shape", "a difference of shape")
    end do
  end subroutine test_step

  subroutine test_shape()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    second%displacement = reshape(first%displacement, [2, 12])
    call compare(first, second, found)
    call expect_one(found, static//"nodes/displacement", "shape", "")
    if (found%listed == 1) call expect(found%item(1)%second == "(12, 2)", "the shape is named")
  end subroutine test_shape

  !> A file with NaN differs from itself.
  subroutine test_nan()
    type(sample_t) :: sample
    type(differences_t) :: found

    call new_sample(sample)
    sample%displacement(1, 1) = ieee_value(1.0_wp, ieee_quiet_nan)
    call compare(sample, sample, found, 1.0_wp)
    call expect_one(found, static//"nodes/displacement", "value", "[0, 0]")
    call new_sample(sample)
    sample%modes%strain(1, 1, 2) = ieee_value(1.0_wp, ieee_quiet_nan)
    call compare(sample, sample, found, 1.0_wp)
    call expect_one(found, eigen//"modes/elements/strain", "value", "[3, 0]")
    call new_sample(sample)
    sample%modes%displacement(1, 1, 1) = ieee_value(1.0_wp, ieee_quiet_nan)
    call compare(sample, sample, found)
    call expect(found%all > 0, "NaN in a mode's motion")
  end subroutine test_nan

  !> A small real part beside a large imaginary part is no measure of its own.
  subroutine test_pairs()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    second%pole(1, 1) = first%pole(1, 1) + 1.0e-6_wp
    call compare(first, second, found)
    call expect(found%all == 0, "1e-6 against 2")
    second%pole(1, 1) = first%pole(1, 1) + 3.0e-6_wp
    call compare(first, second, found)
    call expect_one(found, static//"pole", "value", "[0, 0]")
    if (found%listed == 1) call expect_close(found%item(1)%error, 1.5e-6_wp, 1.0e-9_wp, "error")
  end subroutine test_pairs

  !> Shapes alone, and shapes with their frequencies.
  subroutine test_swapped()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    call mix(second, [0.0_wp, 1.0_wp], [1.0_wp, 0.0_wp])
    call compare(first, second, found)
    call expect(count_at(found, eigen//"modes/nodes/displacement") == 2, &
                "swapped shapes are found for both modes")
    second%modes%frequency([1, 2]) = first%modes%frequency([2, 1])
    second%modes%eigenvalue([1, 2]) = first%modes%eigenvalue([2, 1])
    call compare(first, second, found)
    call expect(count_at(found, eigen//"frequency") == 2, &
                "swapped frequencies are found")
  end subroutine test_swapped

  !> Modes 1 and 2 in place of which come a(1) times 1 and a(2) times 2, b likewise.
  subroutine mix(sample, a, b)
    type(sample_t), intent(inout) :: sample
    real(wp), intent(in) :: a(2), b(2)
    type(sample_t) :: old

    old = sample
    associate (m => sample%modes, o => old%modes)
      m%displacement(:, :, 1) = a(1)*o%displacement(:, :, 1) + a(2)*o%displacement(:, :, 2)
      m%displacement(:, :, 2) = b(1)*o%displacement(:, :, 1) + b(2)*o%displacement(:, :, 2)
      m%rotation(:, :, 1) = a(1)*o%rotation(:, :, 1) + a(2)*o%rotation(:, :, 2)
      m%rotation(:, :, 2) = b(1)*o%rotation(:, :, 1) + b(2)*o%rotation(:, :, 2)
      m%warping(:, 1) = a(1)*o%warping(:, 1) + a(2)*o%warping(:, 2)
      m%warping(:, 2) = b(1)*o%warping(:, 1) + b(2)*o%warping(:, 2)
      m%strain(:, :, 1) = a(1)*o%strain(:, :, 1) + a(2)*o%strain(:, :, 2)
      m%strain(:, :, 2) = b(1)*o%strain(:, :, 1) + b(2)*o%strain(:, :, 2)
      m%stress(:, :, 1) = a(1)*o%stress(:, :, 1) + a(2)*o%stress(:, :, 2)
      m%stress(:, :, 2) = b(1)*o%stress(:, :, 1) + b(2)*o%stress(:, :, 2)
      m%participation(:, 1) = a(1)*o%participation(:, 1) + a(2)*o%participation(:, 2)
      m%participation(:, 2) = b(1)*o%participation(:, 1) + b(2)*o%participation(:, 2)
      m%effective_mass = m%participation**2
    end associate
  end subroutine mix

  subroutine test_flipped()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    call mix(second, [-1.0_wp, 0.0_wp], [0.0_wp, -1.0_wp])
    call compare(first, second, found)
    call expect(found%all == 0, "signs do not count")
    call mix(second, [2.0_wp, 0.0_wp], [0.0_wp, 1.0_wp])
    call compare(first, second, found)
    call expect(found%all > 0, "the size does")
  end subroutine test_flipped

  subroutine test_rotated()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call make_double(first)
    second = first
    call mix(second, [0.6_wp, 0.8_wp], [-0.8_wp, 0.6_wp])
    call compare(first, second, found)
    call expect(found%all == 0, "a rotation within equal frequencies does not count")
    call new_sample(first)
    call new_sample(second)
    call mix(second, [0.6_wp, 0.8_wp], [-0.8_wp, 0.6_wp])
    call compare(first, second, found)
    call expect(found%all > 0, "between different frequencies it does")
  end subroutine test_rotated

  subroutine make_double(sample)
    type(sample_t), intent(inout) :: sample

    sample%modes%frequency(2) = sample%modes%frequency(1)*(1 + 1.0e-12_wp)
    sample%modes%eigenvalue(2) = sample%modes%eigenvalue(1)*(1 + 2.0e-12_wp)
  end subroutine make_double

  !> sin(a) of the third mode in the second: MAC 1 - sin(a)**2 times what is new in the third.
  subroutine test_outside()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call make_double(first)
    second = first
    associate (u => second%modes%displacement)
      u(:, :, 2) = u(:, :, 2) + 1.0e-3_wp*u(:, :, 3)
    end associate
    call compare(first, second, found)
    call expect(count_at(found, eigen//"modes/nodes/displacement") == 1, &
                "found, for one mode")
    if (found%listed > 0) call expect(found%item(1)%error > 1.0e-4_wp .and. &
                                      found%item(1)%error < 2.0e-3_wp, "by its size")
  end subroutine test_outside

  subroutine test_mode_stress()
    type(sample_t) :: first, second
    type(differences_t) :: found

    call new_sample(first)
    call new_sample(second)
    call mix(second, [-1.0_wp, 0.0_wp], [0.0_wp, 1.0_wp])
    second%modes%stress(4, 2, 1) = second%modes%stress(4, 2, 1) + 0.01_wp
    call compare(first, second, found)
    call expect_one(found, eigen//"modes/elements/stress", "value", "[1, 3]")
  end subroutine test_mode_stress

  subroutine test_only()
    type(sample_t) :: first, second
    type(differences_t) :: found
    type(error_t), allocatable :: error
    type(string_t) :: only(1)

    call new_sample(first)
    call new_sample(second)
    second%displacement(1, 1) = 7
    second%reaction(1, 1) = 7
    second%residual = 1
    call compare(first, second, found)
    call expect(found%all == 2, "two differences in all")
    only(1)%s = "analysis/01_static/nodes/reaction"
    call compare_files(scratch("first.h5"), scratch("second.h5"), tolerance_t(), only, found, error)
    call expect_one(found, static//"nodes/reaction", "value", "[0, 0]")
    only(1)%s = static//"convergence/"
    call compare_files(scratch("first.h5"), scratch("second.h5"), tolerance_t(), only, found, error)
    call expect_one(found, static//"convergence/residual", "value", "[0]")
    only(1)%s = static//"nodes/reactio"
    call compare_files(scratch("first.h5"), scratch("second.h5"), tolerance_t(), only, found, error)
    call expect(allocated(error), "a path that is not there")
    if (allocated(error)) call expect(error%status == exit_usage, "is an error of usage")
  end subroutine test_only

  subroutine test_program()
    type(outcome_t) :: outcome
    type(sample_t) :: first, second
    type(differences_t) :: found
    character(len=:), allocatable :: files

    call new_sample(first)
    call new_sample(second)
    second%displacement(2, 5) = 0.5_wp
    call compare(first, second, found)
    files = scratch("first.h5")//" "//scratch("second.h5")
    call expect_status("compare "//files, 1, outcome)
    call expect(index(outcome%output, static//"nodes/displacement[4, 1]  ") == 1, &
                "path and index:"//outcome%output)
    call expect(outcome%errors == "", "no further words")
    call expect_status("compare --json "//files, 1, outcome)
    call expect(index(outcome%output, """index"": [4, 1]") > 0, "JSON: "//outcome%output)
    call expect_status("compare --rtol 2 "//files, 0, outcome)
    call expect_status("compare --atol 2 "//files, 0, outcome)
    call expect_status("compare "//files//" --only analysis/02_eigen --only "//static//"step", 0, &
                       outcome)
    call expect_status("compare "//scratch("first.h5"), 2, outcome)
    call expect_status("compare --rtol -1 "//files, 2, outcome)
    call expect_status("compare "//files//" third.h5", 2, outcome)
    call expect_status("compare "//files//" --only nothing", 2, outcome)
    call make_file(scratch("third.h5"), "no result file")
    call expect_status("compare "//scratch("first.h5 ")//scratch("third.h5"), 5, outcome)
    call expect_status("compare "//scratch("first.h5 ")//scratch("fourth.h5"), 5, outcome)
  end subroutine test_program

  subroutine expect_status(arguments, status, outcome)
    character(len=*), intent(in) :: arguments
    integer, intent(in) :: status
    type(outcome_t), intent(out) :: outcome

    call run_spar(arguments, outcome)
    call expect(outcome%status == status, "status of: spar "//arguments)
  end subroutine expect_status

end module test_output_compare
