!> What numbers of result files are measured against where they may be round-off.
module test_output_scales
  use kinds, only: wp
  use errors, only: error_t
  use text, only: string_t
  use check, only: run, expect
  use program_runs, only: scratch
  use output_compare, only: compare_files
  use output_differences, only: differences_t, tolerance_t
  use output_hdf5, only: hdf5_file_t, about_t
  implicit none
  private

  public :: run_output_scales_tests

  character(len=*), parameter :: static = "/analysis/01_static/"

contains

  subroutine run_output_scales_tests()
    call run("compare: round-off beside what a number follows from", test_scales)
  end subroutine run_output_scales_tests

  !> A model 4 long: forces are measured against moments/4, reactions against loads, strains
  !> against 1e-5*4; with the tolerance 1e-6 each by 1e-9.
  subroutine test_scales()
    type(differences_t) :: found

    call write_forces("first.h5", 0.0_wp, 0.0_wp, 0.0_wp)
    call write_forces("second.h5", 2.0e-8_wp, 0.9e-7_wp, 3.0e-14_wp)
    call compare_written(found)
    call expect(found%all == 0, "round-off")
    call write_forces("second.h5", 3.0e-8_wp, 0.0_wp, 0.0_wp)
    call compare_written(found)
    call expect_one(found, "forces")
    call write_forces("second.h5", 0.0_wp, 1.1e-7_wp, 0.0_wp)
    call compare_written(found)
    call expect_one(found, "nodes/reaction")
    call write_forces("second.h5", 0.0_wp, 0.0_wp, 5.0e-14_wp)
    call compare_written(found)
    call expect_one(found, "strain")
  end subroutine test_scales

  !> Two nodes, a moment of 100 beside a force, a load of 100 beside a reaction, and a strain.
  subroutine write_forces(name, force, reaction, strain)
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: force, reaction, strain
    type(hdf5_file_t) :: file
    type(error_t), allocatable :: error

    call file%create(scratch(name), error)
    call file%group("model")
    call file%group("model/nodes")
    call file%write("model/nodes/position", reshape([0, 0, 0, 0, 4, 3]*1.0_wp, [3, 2]), &
                    about_t("L", "node; X Y Z", ""))
    call file%group("analysis")
    call file%group("analysis/01_static")
    call file%group(static//"nodes")
    call file%write(static//"forces", reshape([force, 100.0_wp], [2, 1]), about_t("F FL", "", ""))
    call file%write(static//"nodes/reaction", [reaction], about_t("F", "", ""))
    call file%write(static//"nodes/load", [100.0_wp], about_t("F", "", ""))
    call file%write(static//"strain", [strain], about_t("L", "", ""))
    call file%close(error)
    call expect(.not. allocated(error), "it is written")
  end subroutine write_forces

  subroutine compare_written(found)
    type(differences_t), intent(out) :: found
    type(error_t), allocatable :: error

    call compare_files(scratch("first.h5"), scratch("second.h5"), tolerance_t(), [string_t ::], &
                       found, error)
    call expect(.not. allocated(error), "they are read")
  end subroutine compare_written

  !> One difference, in this dataset.
  subroutine expect_one(found, name)
    type(differences_t), intent(in) :: found
    character(len=*), intent(in) :: name

    call expect(found%all == 1, "one difference for "//name)
    if (found%listed == 1) call expect(found%item(1)%path == static//name, "it is that")
  end subroutine expect_one

end module test_output_scales
