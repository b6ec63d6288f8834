!> The interface to HDF5: what is written is read back by HDF5 itself.
module test_output_hdf5
  use kinds, only: wp, i8
  use errors, only: error_t, exit_io
  use check, only: run, expect, expect_close
  use output_dimensions, only: get_powers
  use output_hdf5, only: hdf5_file_t, about_t
  use output_tables, only: table_t
  use program_runs, only: scratch, same_bytes
  use result_reader, only: get_reals, get_integers, get_text, get_numbers
  implicit none
  private

  public :: run_output_hdf5_tests

contains

  subroutine run_output_hdf5_tests()
    call run("output: dimensions as powers", test_dimensions)
    call run("output: datasets read back", test_datasets)
    call run("output: attributes", test_attributes)
    call run("output: tables grow over many pieces", test_growth)
    call run("output: flushed rows are in an open file", test_flush)
    call run("output: equal contents, equal bytes", test_bytes)
    call run("output: failures name file and routine", test_failure)
  end subroutine run_output_hdf5_tests

  subroutine test_dimensions()
    integer, allocatable :: powers(:, :)

    call get_powers("FL2", powers)
    call expect(all(powers(:, 1) == [1, 2, 0, 0]), "FL2 is force times length squared")
    call get_powers("1", powers)
    call expect(all(powers == 0) .and. size(powers, 2) == 1, "1 has no dimension")
    call get_powers("FL-2 ML-3 T 1 L", powers)
    call expect(size(powers, 2) == 5, "five words")
    call expect(all(powers == reshape([1, -2, 0, 0, 0, -3, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, &
                                       0, 1, 0, 0], [4, 5])), "FL-2 ML-3 T 1 L")
  end subroutine test_dimensions

  subroutine test_datasets()
    type(hdf5_file_t) :: file
    type(error_t), allocatable :: error
    real(wp), allocatable :: reals(:)
    integer, allocatable :: whole(:), extents(:)
    character(len=:), allocatable :: path

    path = scratch("datasets.h5")
    call file%create(path, error)
    call file%group("a")
    call file%group("a/b")
    call file%write("a/b/table", reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], &
                                         [3, 2]), about_t("L", "row; X Y Z", "a table"))
    call file%write("a/whole", [7, -8], about_t("1", "row", "a list"))
    call file%write("a/none", [real(wp) ::], about_t("1", "row", "nothing"))
    call file%write("a/whole_table", reshape([1, 2, 3, 4], [1, 4]), about_t("1", "row; x", ""))
    call file%close(error)
    call expect(.not. allocated(error), "no error")
    call get_reals(path, "a/b/table", reals, extents)
    call expect(size(extents) == 2, "rank 2")
    call expect(all(extents == [2, 3]), "two rows of three columns")
    call expect_close(reals, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], 0.0_wp, "table")
    call get_integers(path, "a/whole", whole, extents)
    call expect(all(whole == [7, -8]), "whole numbers")
    call get_reals(path, "a/none", reals, extents)
    call expect(size(reals) == 0, "an empty dataset")
    call get_integers(path, "a/whole_table", whole, extents)
    call expect(all(extents == [4, 1]) .and. all(whole == [1, 2, 3, 4]), "a table of one column")
  end subroutine test_datasets

  subroutine test_attributes()
    type(hdf5_file_t) :: file
    type(error_t), allocatable :: error
    integer, allocatable :: numbers(:)
    character(len=:), allocatable :: path, text

    path = scratch("attributes.h5")
    call file%create(path, error)
    call file%set_number("/", "complete", 0)
    call file%set_text("/", "title", "")
    call file%group("g")
    call file%set_text("g", "kind", "static")
    call file%write("g/x", [1.0_wp], about_t("F FL", "step; N M", "force and moment"))
    call file%write("g/words", ["one  ", "three"], about_t("L-1", "word", "texts"))
    call file%set_number("/", "complete", 1)
    call file%close(error)
    call expect(.not. allocated(error), "no error")
    call get_numbers(path, "/", "complete", numbers)
    call expect(size(numbers) == 1 .and. all(numbers == 1), "complete is set anew")
    call get_text(path, "/", "title", text)
    call expect(text == "", "an empty text")
    call get_text(path, "g", "kind", text)
    call expect(text == "static", "attribute of a group")
    call get_text(path, "g/x", "axes", text)
    call expect(text == "step; N M", "axes of a dataset")
    call get_text(path, "g/x", "description", text)
    call expect(text == "force and moment", "description of a dataset")
    call get_numbers(path, "g/x", "dimension", numbers)
    call expect(size(numbers) == 8, "a dimension for each column")
    call expect(all(numbers == [1, 0, 0, 0, 1, 1, 0, 0]), "force, force times length")
    call get_numbers(path, "g/words", "dimension", numbers)
    call expect(size(numbers) == 4 .and. all(numbers == [0, -1, 0, 0]), "one dimension for all")
  end subroutine test_attributes

  !> 3000 appends of 7 rows of 5: several pieces of the file.
  subroutine test_growth()
    type(hdf5_file_t) :: file
    type(table_t) :: table, list, count
    type(error_t), allocatable :: error
    real(wp), allocatable :: values(:)
    integer, allocatable :: whole(:), extents(:)
    character(len=:), allocatable :: path
    integer, parameter :: steps = 3000
    integer :: i, k

    path = scratch("growth.h5")
    call file%create(path, error)
    call table%start_reals(file, "table", 100_i8, about_t("L", "row; 1 to 5", "table"), 5)
    call list%start_reals(file, "list", 1_i8, about_t("L", "row", "list"))
    call count%start_integers(file, "count", 1000000_i8, about_t("1", "row", "count"))
    do i = 1, steps
      call table%append(file, reshape([(real(35*(i - 1) + k, wp), k=1, 35)], [5, 7]))
      call list%append(file, [real(2*i - 1, wp), real(2*i, wp)])
      call count%append(file, i)
    end do
    call table%finish(file)
    call list%finish(file)
    call count%finish(file)
    call file%close(error)
    call expect(.not. allocated(error), "no error")
    call get_reals(path, "table", values, extents)
    call expect(all(extents == [7*steps, 5]), "all rows of the table")
    call expect_close(values, [(real(i, wp), i=1, 35*steps)], 0.0_wp, "table")
    call get_reals(path, "list", values, extents)
    call expect_close(values, [(real(i, wp), i=1, 2*steps)], 0.0_wp, "list")
    call get_integers(path, "count", whole, extents)
    call expect(size(whole) == steps .and. all(whole == [(i, i=1, steps)]), "count")
  end subroutine test_growth

  !> What `kill -9` would leave: a copy of the file as it is on the disk.
  subroutine test_flush()
    type(hdf5_file_t) :: file
    type(table_t) :: table
    type(error_t), allocatable :: error
    real(wp), allocatable :: values(:)
    integer, allocatable :: extents(:)
    character(len=:), allocatable :: path, copy

    path = scratch("flush.h5")
    copy = scratch("flush_copy.h5")
    call file%create(path, error)
    call table%start_reals(file, "table", 10_i8, about_t("L", "row", "table"))
    call table%append(file, [1.0_wp, 2.0_wp])
    call file%flush(error)
    call expect(.not. allocated(error), "flushed without error")
    call execute_command_line("cp "//path//" "//copy)
    call table%append(file, 3.0_wp)
    call get_reals(copy, "table", values, extents)
    call expect_close(values, [1.0_wp, 2.0_wp], 0.0_wp, "rows before the flush")
    call file%close(error)
  end subroutine test_flush

  subroutine test_bytes()
    call write_sample(scratch("first.h5"), 1.0_wp)
    call execute_command_line("sleep 1.1")
    call write_sample(scratch("second.h5"), 1.0_wp)
    call write_sample(scratch("third.h5"), 2.0_wp)
    call expect(same_bytes(scratch("first.h5"), scratch("second.h5")), &
                "no trace of the time in the file")
    call expect(.not. same_bytes(scratch("first.h5"), scratch("third.h5")), &
                "other values, other bytes")
  end subroutine test_bytes

  subroutine write_sample(path, value)
    character(len=*), intent(in) :: path
    real(wp), intent(in) :: value
    type(hdf5_file_t) :: file
    type(table_t) :: table
    type(error_t), allocatable :: error
    integer :: i

    call file%create(path, error)
    call file%group("g")
    call file%write("g/fixed", [value], about_t("L", "row", "fixed"))
    call file%write("g/text", "words", about_t("1", "", "text"))
    call table%start_reals(file, "g/growing", 5_i8, about_t("L", "row; 1 2", "growing"), 2)
    do i = 1, 12
      call table%append(file, reshape([value, real(i, wp)], [2, 1]))
      call file%flush(error)
    end do
    call file%close(error)
  end subroutine write_sample

  subroutine test_failure()
    type(hdf5_file_t) :: nowhere, file
    type(error_t), allocatable :: error

    call nowhere%create(scratch("missing/folder.h5"), error)
    call expect(allocated(error), "an error for a missing folder")
    if (.not. allocated(error)) return
    call expect(error%status == exit_io, "exit status of files")
    call expect(index(error%message, "missing/folder.h5") > 0, "the file's name")
    call expect(index(error%message, "h5fcreate_f") > 0, "the routine's name")
    call file%create(scratch("failure.h5"), error)
    call expect(.not. allocated(error), "another file still works")
    call file%group("no/parent")
    call file%write("late", [1.0_wp], about_t())
    call file%flush(error)
    call expect(allocated(error), "the failure stays until it is asked for")
    if (allocated(error)) call expect(index(error%message, "h5gcreate_f") > 0, "the first failure")
    call file%close(error)
    call expect(allocated(error), "and beyond")
  end subroutine test_failure

end module test_output_hdf5
