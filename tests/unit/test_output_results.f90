!> The result file against its description, docs/results.md, and against mechanics.
module test_output_results
  use hdf5, only: hid_t, h5open_f, h5fopen_f, h5fclose_f, h5gn_members_f, &
                  h5gget_obj_info_idx_f, h5f_acc_rdonly_f, h5g_group_f
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use output_dimensions, only: get_powers
  use model_data, only: model_t
  use history_samples, only: get_history_model, write_history
  use program_runs, only: outcome_t, run_spar, scratch, read_text
  use result_reader, only: get_reals, get_integers, get_text, get_numbers
  implicit none
  private

  public :: run_output_results_tests

  character(len=*), parameter :: marker = "markers/NAME"
  character(len=*), parameter :: static = "analysis/01_static", history = "analysis/01_transient"
  character(len=*), parameter :: drawing = "drawings/NAME/"
  character(len=*), parameter :: decks(3) = ["tests/cases/program/cantilever.deck", &
                                             "decks/spacar.deck                  ", &
                                             "tests/cases/program/drawing.deck   "]

contains

  subroutine run_output_results_tests()
    call run("results: the file is as docs/results.md says", test_documentation)
    call run("results: motions in time are as docs/results.md says", test_history)
    call run("results: modes are as docs/results.md says", test_modes)
    call run("results: reactions balance the loads", test_balance)
    call run("results: the model", test_model)
  end subroutine run_output_results_tests

  !> Every row of the page is in one of the files at least, and agrees with it wherever it is; the
  !> files hold nothing else in their first analysis.
  subroutine test_documentation()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: page, path
    integer :: described(3), i

    call read_text("docs/results.md", page)
    do i = 1, 3
      path = scratch("documented.h5")
      call run_spar("run "//trim(decks(i))//" -D parts=3 --quiet -o "//path, outcome)
      if (i > 1) call run_spar("run "//trim(decks(i))//" --quiet -o "//path, outcome)
      call expect(outcome%status == 0, trim(decks(i))//" runs")
      call compare_rows(page, path, described(i))
      call expect(described(i) == datasets(path, "/deck") + datasets(path, "/model") &
                  + datasets(path, "/analysis/01_static") + drawn(path), &
                  "every dataset is described")
    end do
    call expect(described(1) > 40, "the page was read")
    call expect(described(2) == described(1) + 1, "ESTIFF and EM give two more, MARKER one")
    call expect(described(3) == described(1) + 15, "a drawing nine more, its stresses five and one")
  end subroutine test_documentation

  !> The same for a motion in time, where OUTPUT chooses, and COMPLIANCE; the rows of STATIC go for
  !> it too.
  subroutine test_history()
    type(model_t) :: model
    character(len=:), allocatable :: page, path
    integer :: described

    call read_text("docs/results.md", page)
    path = scratch("documented_history.h5")
    call get_history_model(5, model)
    model%kept_node = [2]
    model%kept_member = [1, 3]
    call write_history(path, model, 5)
    call compare_rows(page, path, described)
    call expect(described == datasets(path, "/deck") + datasets(path, "/model") &
                + datasets(path, "/analysis") + drawn(path), "every dataset is described")
    call expect(described > 100, "the page was read")
  end subroutine test_history

  !> The same for modes: complex ones with matrices, those of joints, real ones, and BUCKLING.
  subroutine test_modes()
    character(len=21), parameter :: deck(4) = [character(len=21) :: "rotating/proportional", &
                                               "eigen/sprung_arm", "eigen/flap", "buckling/column"]
    type(outcome_t) :: outcome
    character(len=:), allocatable :: page, path
    integer :: described, i, analyses

    call read_text("docs/results.md", page)
    path = scratch("documented_modes.h5")
    do i = 1, 4
      call run_spar("run tests/cases/"//trim(deck(i))//".deck --quiet -o "//path, outcome)
      call expect(outcome%status == 0, trim(deck(i))//" runs")
      call compare_rows(page, path, described)
      select case (i)
      case (1)
        analyses = datasets(path, "/analysis/02_eigen")
      case (2, 3)
        analyses = datasets(path, "/analysis")
      case default
        analyses = 2
      end select
      call expect(described == datasets(path, "/deck") + datasets(path, "/model") + analyses &
                  + drawn(path), trim(deck(i))//": every dataset is described")
    end do
    call expect(analyses == 2, "the page was read")
  end subroutine test_modes

  !> Datasets of /VTKHDF that are no mere matter of its format; stresses belong to outlines.
  integer function drawn(path)
    character(len=*), intent(in) :: path
    integer, allocatable :: powers(:)

    call get_numbers(path, "VTKHDF/PointData/axial_stress", "dimension", powers)
    drawn = merge(7, 6, size(powers) > 0)
  end function drawn

  !> Rows `| `/path` | shape | `dimension` | axes | content |`.
  subroutine compare_rows(page, path, found)
    character(len=*), intent(in) :: page, path
    integer, intent(out) :: found     !< rows that are in the file
    character(len=:), allocatable :: line
    integer :: first, length

    found = 0
    first = 1
    do while (first <= len(page))
      length = index(page(first:), new_line("a")) - 1
      if (length < 0) length = len(page) - first + 1
      line = page(first:first + length - 1)
      if (index(line, "| `/") == 1) call compare_row(line, path, found)
      first = first + length + 1
    end do
  end subroutine compare_rows

  subroutine compare_row(line, path, found)
    character(len=*), intent(in) :: line, path
    integer, intent(inout) :: found
    character(len=:), allocatable :: name, axes, description
    integer, allocatable :: powers(:), wanted(:, :), time(:)
    integer :: at

    name = bare(cell(line, 1))
    call get_numbers(path, history//"/time", "dimension", time)
    at = index(name, static)
    if (at > 0 .and. size(time) > 0) name = name(:at - 1)//history//name(at + len(static):)
    at = index(name, marker)
    if (at > 0) name = name(:at - 1)//"markers/tip"
    at = index(name, drawing)
    if (at > 0) name = name(:at - 1)//"drawings/angle/"//name(at + len(drawing):)
    call get_numbers(path, name, "dimension", powers)
    if (size(powers) == 0) return
    found = found + 1
    call get_powers(bare(cell(line, 3)), wanted)
    call expect(size(powers) == size(wanted), name//": number of dimensions")
    if (size(powers) == size(wanted)) then
      call expect(all(powers == reshape(wanted, [size(wanted)])), name//": dimension")
    end if
    call get_text(path, name, "axes", axes)
    call expect(axes == cell(line, 4), name//": axes '"//axes//"'")
    call get_text(path, name, "description", description)
    call expect(description == cell(line, 5), name//": description '"//description//"'")
    call compare_shape(path, name, cell(line, 2), axes)
  end subroutine compare_row

  !> Rank and number of columns, and as many names of columns where each has one.
  subroutine compare_shape(path, name, shape_text, axes)
    character(len=*), intent(in) :: path, name, shape_text, axes
    integer, allocatable :: values(:), extents(:)
    integer :: columns, comma, rank, i

    call get_integers(path, name, values, extents)
    comma = index(shape_text, ",")
    if (shape_text == "scalar") then
      call expect(size(extents) == 0, name//": scalar")
    else if (comma == 0) then
      call expect(size(extents) == 1, name//": one index")
    else
      read (shape_text(comma + 1:len(shape_text) - 1), *) columns
      rank = 1 + count([(shape_text(i:i) == ",", i=1, len(shape_text))])
      call expect(size(extents) == rank, name//": number of indices")
      call expect(extents(size(extents)) == columns, name//": "//shape_text)
      call expect(index(axes, ";") > 0, name//": axes of both")
    end if
  end subroutine compare_shape

  !> A cell of a row, without the blanks around it.
  function cell(line, number)
    character(len=*), intent(in) :: line
    integer, intent(in) :: number
    character(len=:), allocatable :: cell
    integer :: i, first

    first = 1
    do i = 1, number
      first = first + index(line(first:), "|")
    end do
    cell = trim(adjustl(line(first:first + index(line(first:), "|") - 2)))
  end function cell

  function bare(word)
    character(len=*), intent(in) :: word
    character(len=:), allocatable :: bare

    bare = word(2:len(word) - 1)
  end function bare

  !> Number of datasets in a group and below.
  integer function datasets(path, group)
    character(len=*), intent(in) :: path, group
    integer(hid_t) :: file
    integer :: status

    call h5open_f(status)
    call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
    datasets = count_datasets(file, group)
    call h5fclose_f(file, status)
  end function datasets

  recursive integer function count_datasets(file, group) result(datasets)
    integer(hid_t), intent(in) :: file
    character(len=*), intent(in) :: group
    character(len=100) :: name
    integer :: members, kind, i, status

    datasets = 0
    members = 0
    call h5gn_members_f(file, group, members, status)
    do i = 0, members - 1
      call h5gget_obj_info_idx_f(file, group, i, name, kind, status)
      if (kind == h5g_group_f) then
        datasets = datasets + count_datasets(file, group//"/"//trim(name))
      else
        datasets = datasets + 1
      end if
    end do
  end function count_datasets

  !> A cantilever carries force and moment of its loads in the deformed state.
  subroutine test_balance()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    real(wp), allocatable :: reaction(:), load(:), u(:), x(:), forces(:)
    integer, allocatable :: extents(:)
    real(wp) :: r(7), arm(3), f(3)
    integer, parameter :: nodes = 4, steps = 4

    path = scratch("balance.h5")
    call run_spar("run "//trim(decks(1))//" -D parts=3 --quiet -o "//path, outcome)
    call get_reals(path, "analysis/01_static/nodes/reaction", reaction, extents)
    call expect(all(extents == [nodes*steps, 7]), "a row for each step and node")
    call get_reals(path, "analysis/01_static/nodes/load", load, extents)
    call get_reals(path, "analysis/01_static/nodes/displacement", u, extents)
    call get_reals(path, "model/nodes/position", x, extents)
    call get_reals(path, "analysis/01_static/elements/section_force_p", forces, extents)
    if (size(reaction) /= 7*nodes*steps) return
    r = reaction(7*nodes*(steps - 1) + 1:7*nodes*(steps - 1) + 7)
    f = load(7*(nodes*(steps - 1) + 1) + 1:7*(nodes*(steps - 1) + 1) + 3)
    arm = x(4:6) + u(3*(nodes*(steps - 1) + 1) + 1:3*(nodes*(steps - 1) + 1) + 3)
    call expect_close(f, [0.0_wp, 1.0_wp, -10.0_wp], 1.0e-12_wp, "load at node 2, last step")
    call expect_close(r(1:3), -f, 1.0e-7_wp, "reaction force")
    call expect_close(r(4:6), -[arm(2)*f(3) - arm(3)*f(2), arm(3)*f(1) - arm(1)*f(3), &
                                arm(1)*f(2) - arm(2)*f(1)], 1.0e-6_wp, "reaction moment")
    call expect_close(forces(7*3*(steps - 1) + 1:7*3*(steps - 1) + 6), -r(1:6), 1.0e-7_wp, &
                      "section forces at the clamp")
  end subroutine test_balance

  subroutine test_model()
    type(outcome_t) :: outcome
    character(len=:), allocatable :: path
    real(wp), allocatable :: values(:)
    integer, allocatable :: whole(:), extents(:)

    path = scratch("model.h5")
    call run_spar("run "//trim(decks(1))//" -D parts=2 --quiet -o "//path, outcome)
    call get_integers(path, "model/nodes/id", whole, extents)
    call expect(all(whole == [1, 2, 1]), "two nodes and the inner node of element 1")
    call get_integers(path, "model/nodes/part", whole, extents)
    call expect(all(whole == [0, 0, 1]), "parts of nodes")
    call get_integers(path, "model/elements/nodes", whole, extents)
    call expect(all(whole == [0, 0, 0, 2, 2, 2, 2, 2, 2, 1, 1, 1]), "rows of nodes, from 0")
    call get_reals(path, "model/nodes/position", values, extents)
    call expect_close(values, [0.0_wp, 0.0_wp, 0.0_wp, 5.0_wp, 0.0_wp, 0.0_wp, 2.5_wp, 0.0_wp, &
                               0.0_wp], 1.0e-15_wp, "positions")
    call get_integers(path, "model/degrees_of_freedom", whole, extents)
    call expect(all(whole(1:7) == 2), "node 1 is fixed")
    call expect(all(whole(8:20) == 1), "the others are free")
    call get_integers(path, "model/constraints/component", whole, extents)
    call expect(all(whole == [1, 2, 3, 4, 5, 6, 7]), "fixed components")
    call get_reals(path, "model/materials/constants", values, extents)
    call expect_close(values, [1000.0_wp, 400.0_wp, 2.0_wp, 0.0_wp], 0.0_wp, "material")
    call get_reals(path, "model/sections/constants", values, extents)
    call expect_close(values(:4), [10.0_wp, 1.0_wp, 2.0_wp, 1.0_wp], 0.0_wp, "section")
  end subroutine test_model

end module test_output_results
