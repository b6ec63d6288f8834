!> Result files of motions in time: what the recorder is given comes back, block by block.
module test_output_history
  use kinds, only: wp, i8
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use recorder, only: compliance_line
  use output_hdf5, only: hdf5_file_t, about_t
  use output_recorder, only: run_recorder_t
  use output_schedule, only: block_size
  use output_tables, only: table_t
  use program_runs, only: outcome_t, run_spar, scratch, same_bytes, file_there
  use result_reader, only: get_reals, get_integers, get_numbers
  use history_samples, only: get_history_model, write_history, record_steps, open_history, &
    sample_value, yields, of_displacement, of_euler, of_warping, of_reaction, of_load, of_strain, &
    of_stress, of_force_p, of_force_q, of_places, of_marker, of_joint_strain, of_joint_stress, &
    of_joint_rate, of_velocity, of_acceleration, of_energy, of_momentum
  implicit none
  private

  public :: run_output_history_tests

  character(len=*), parameter :: group = "analysis/01_transient/"
  integer, parameter :: nodes = 4, members = 3, places = 18, joints = 4
  integer, parameter :: steps = 600     !< two blocks and a part of one

contains

  subroutine run_output_history_tests()
    call run("history: tables write their blocks", test_blocks)
    call run("history: all numbers come back", test_numbers)
    call run("history: what OUTPUT keeps", test_choice)
    call run("history: an interrupted run has all its steps", test_interrupted)
    call run("history: full blocks are in the unfinished file", test_unfinished)
    call run("history: equal runs, equal bytes", test_bytes)
    call run("history: joints and masses of the model", test_model)
    call run("history: compliance", test_compliance)
    call run("history: compare, digest and info", test_commands)
  end subroutine run_output_history_tests

  !> Three appends a block: nothing is in the file before, all of it after `write` or `finish`.
  subroutine test_blocks()
    type(hdf5_file_t) :: file
    type(table_t) :: table, other, absent
    type(error_t), allocatable :: error
    real(wp), allocatable :: values(:)
    integer, allocatable :: extents(:), counted(:)
    character(len=:), allocatable :: path, copy
    integer, parameter :: wanted(8) = [0, 0, 3, 3, 3, 6, 6, 6]
    integer :: i

    path = scratch("blocks.h5")
    copy = scratch("blocks_copy.h5")
    call file%create(path, error)
    call table%start_reals(file, "table", 8_i8, about_t("1", "row; a b", ""), 2)
    call other%start_integers(file, "other", 8_i8, about_t("1", "row", ""))
    call table%gather(3)
    do i = 1, 8
      call table%append(file, reshape([10.0_wp*i, 10.0_wp*i + 1, -1.0_wp, 1.0_wp*i], [2, 2]))
      call other%append(file, i)
      call absent%append(file, 1.0_wp)
      call file%flush(error)
      call execute_command_line("cp "//path//" "//copy)
      call get_reals(copy, "table", values, extents)
      call expect(extents(1) == 2*wanted(i), "whole blocks are in the file")
      call get_integers(copy, "other", counted, extents)
      call expect(extents(1) == i, "without a block each append")
    end do
    call table%write(file)
    call file%flush(error)
    call execute_command_line("cp "//path//" "//copy)
    call get_reals(copy, "table", values, extents)
    call expect(extents(1) == 16, "what was kept is written")
    call table%append(file, reshape([5.0_wp, 6.0_wp], [2, 1]))
    call table%finish(file)
    call file%close(error)
    call expect(.not. allocated(error), "no error")
    call get_reals(path, "table", values, extents)
    call expect(all(extents == [17, 2]), "and the rest at the end")
    call expect_close(values, [([10.0_wp*i, 10.0_wp*i + 1, -1.0_wp, 1.0_wp*i], i=1, 8), 5.0_wp, &
                               6.0_wp], 0.0_wp, "rows in order")
  end subroutine test_blocks

  !> A dataset holds columns `from` on of made-up results of so many rows a step.
  subroutine expect_rows(path, name, what, rows, columns, from, last)
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: what, rows(:), columns, from, last   !< `rows`: of the model, from 1
    real(wp), allocatable :: values(:)
    integer, allocatable :: extents(:)
    integer :: s, j, i, n

    call get_reals(path, group//name, values, extents)
    call expect(extents(1) == (last + 1)*size(rows), name//": rows")
    call expect(size(values) == (last + 1)*size(rows)*columns, name//": shape")
    if (size(values) /= (last + 1)*size(rows)*columns) return
    n = 0
    do s = 0, last
      do j = 1, size(rows)
        do i = from, from + columns - 1
          n = n + 1
          if (abs(values(n) - sample_value(what, s, rows(j), i)) > 0) exit
        end do
        if (i < from + columns) exit
      end do
      if (j <= size(rows)) exit
    end do
    call expect(s > last, name//": values")
  end subroutine expect_rows

  subroutine test_numbers()
    type(model_t) :: model
    character(len=:), allocatable :: path
    real(wp), allocatable :: time(:), length(:)
    integer, allocatable :: whole(:), extents(:)
    integer :: i

    path = scratch("history.h5")
    call get_history_model(steps, model)
    call write_history(path, model, steps)
    call expect_all(path, [(i, i=1, nodes)], [(i, i=1, members)], [(i, i=1, places)], steps)
    call get_integers(path, group//"step", whole, extents)
    call expect(all(whole == [(i, i=0, steps)]), "steps")
    call get_reals(path, group//"time", time, extents)
    call expect_close(time, [(0.001_wp*i, i=0, steps)], 1.0e-15_wp, "times")
    call get_reals(path, group//"time_step", length, extents)
    call expect_close(length, [(0.0005_wp, i=0, steps)], 0.0_wp, "lengths of steps")
    call get_integers(path, group//"convergence/iterations", whole, extents)
    call expect(all(whole == [(modulo(i, 7), i=0, steps)]), "iterations")
    call get_numbers(path, group//"load_factor", "dimension", whole)
    call expect(size(whole) == 0, "no load factor")
    call get_numbers(path, group//"nodes/index", "dimension", whole)
    call expect(size(whole) == 0, "no index where all is kept")
    call get_numbers(path, "/", "complete", whole)
    call expect(all(whole == [1]), "complete")
  end subroutine test_numbers

  !> All fields of these rows of the model.
  subroutine expect_all(path, node, member, place, last)
    character(len=*), intent(in) :: path
    integer, intent(in) :: node(:), member(:), place(:), last
    character(len=*), parameter :: energy(6) = ["kinetic   ", "strain    ", "loads     ", &
                                                "motion    ", "dissipated", "imbalance "]
    integer :: joint(joints), i

    joint = [(i, i=1, joints)]
    call expect_rows(path, "nodes/displacement", of_displacement, node, 3, 1, last)
    call expect_rows(path, "nodes/euler", of_euler, node, 4, 1, last)
    call expect_rows(path, "nodes/warping", of_warping, node, 1, 1, last)
    call expect_rows(path, "nodes/reaction", of_reaction, node, 7, 1, last)
    call expect_rows(path, "nodes/load", of_load, node, 7, 1, last)
    call expect_rows(path, "nodes/velocity", of_velocity, node, 3, 1, last)
    call expect_rows(path, "nodes/angular_velocity", of_velocity, node, 3, 4, last)
    call expect_rows(path, "nodes/warping_rate", of_velocity, node, 1, 7, last)
    call expect_rows(path, "nodes/acceleration", of_acceleration, node, 3, 1, last)
    call expect_rows(path, "nodes/angular_acceleration", of_acceleration, node, 3, 4, last)
    call expect_rows(path, "nodes/warping_acceleration", of_acceleration, node, 1, 7, last)
    call expect_rows(path, "elements/strain", of_strain, member, 8, 1, last)
    call expect_rows(path, "elements/stress", of_stress, member, 8, 1, last)
    call expect_rows(path, "elements/section_force_p", of_force_p, member, 7, 1, last)
    call expect_rows(path, "elements/section_force_q", of_force_q, member, 7, 1, last)
    call expect_rows(path, "elements/point_stress", of_places, place, 4, 1, last)
    call expect_rows(path, "joints/strain", of_joint_strain, joint, 6, 1, last)
    call expect_rows(path, "joints/stress", of_joint_stress, joint, 6, 1, last)
    call expect_rows(path, "joints/rate", of_joint_rate, joint, 6, 1, last)
    call expect_rows(path, "markers/tip", of_marker, [1], 3, 1, last)
    call expect_rows(path, "momentum/linear", of_momentum, [1], 3, 1, last)
    call expect_rows(path, "momentum/angular", of_momentum, [1], 3, 4, last)
    do i = 1, size(energy)
      call expect_rows(path, "energy/"//trim(energy(i)), of_energy, [1], 1, i, last)
    end do
  end subroutine expect_all

  !> Node 2 and the second inner node, the last part: its six places of stresses.
  subroutine test_choice()
    type(model_t) :: model
    character(len=:), allocatable :: path
    integer, allocatable :: whole(:), extents(:)
    integer :: i

    path = scratch("choice.h5")
    call get_history_model(9, model)
    model%kept_node = [2, 4]
    model%kept_member = [3]
    call write_history(path, model, 9)
    call expect_all(path, [2, 4], [3], [(i, i=13, 18)], 9)
    call get_integers(path, group//"nodes/index", whole, extents)
    call expect(all(extents == [2, 3]), "a row for each kept node")
    call expect(all(whole == [1, 2, 0, 3, 1, 2]), "row, id, part of nodes 2 and 1.2")
    call get_integers(path, group//"elements/index", whole, extents)
    call expect(all(whole == [2, 1, 3]), "row, id, part of element 1.3")
    call get_integers(path, group//"elements/place", whole, extents)
    call expect(all(whole == [(i, i=12, 17)]), "rows of the places")
    call expect_drawing(path, 10)
  end subroutine test_choice

  !> The drawing has all elements: three beams of three pieces with eight corners, the truss, and
  !> the three nodes of the hinges.
  subroutine expect_drawing(path, drawn)
    character(len=*), intent(in) :: path
    integer, intent(in) :: drawn
    real(wp), allocatable :: motion(:)
    integer, allocatable :: extents(:)

    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call expect(extents(1) == drawn*(3*4*8 + 2 + 3), "all points are drawn")
  end subroutine expect_drawing

  subroutine test_interrupted()
    type(model_t) :: model
    type(run_recorder_t) :: recorder
    type(error_t), allocatable :: error
    character(len=:), allocatable :: path
    integer, allocatable :: whole(:)
    integer :: i

    path = scratch("interrupted.h5")
    call get_history_model(steps, model)
    call open_history(path, model, recorder)
    call record_steps(model, 0, 300, recorder)
    call recorder%finish(.false., error)
    call recorder%close(.false., error)
    call expect(.not. allocated(error), "no error")
    call expect_all(path, [(i, i=1, nodes)], [(i, i=1, members)], [(i, i=1, places)], 300)
    call get_numbers(path, "/", "complete", whole)
    call expect(all(whole == [0]), "not complete")
  end subroutine test_interrupted

  !> What a reader finds while the program runs, or after it was killed.
  subroutine test_unfinished()
    type(model_t) :: model
    type(run_recorder_t) :: recorder
    type(error_t), allocatable :: error
    character(len=:), allocatable :: path, copy
    integer :: i

    path = scratch("unfinished.h5")
    call execute_command_line("rm -f "//path)
    call get_history_model(steps, model)
    call open_history(path, model, recorder)
    call record_steps(model, 0, 300, recorder)
    call expect(.not. file_there(path), "unfinished")
    copy = scratch("unfinished_copy.h5")
    call execute_command_line("cp "//path//".part "//copy)
    call expect_all(copy, [(i, i=1, nodes)], [(i, i=1, members)], [(i, i=1, places)], &
                    block_size(1_i8) - 1)
    call recorder%finish(.false., error)
    call recorder%close(.false., error)
    call expect(block_size(1_i8) == 256, "a block of small steps")
    call expect(block_size(2_i8**40) == 1, "large steps are written at once")
    call expect(block_size(2_i8**15) == 64, "so many that they fill 2 MB")
  end subroutine test_unfinished

  subroutine test_bytes()
    type(model_t) :: model

    call get_history_model(300, model)
    call write_history(scratch("once.h5"), model, 300)
    call execute_command_line("sleep 1.1")
    call write_history(scratch("twice.h5"), model, 300)
    call expect(same_bytes(scratch("once.h5"), scratch("twice.h5")), "the same bytes")
  end subroutine test_bytes

  subroutine test_model()
    type(model_t) :: model
    character(len=:), allocatable :: path
    integer, allocatable :: whole(:), extents(:)
    real(wp), allocatable :: values(:)

    path = scratch("joints.h5")
    call get_history_model(3, model)
    call write_history(path, model, 3)
    call get_integers(path, "model/joints/id", whole, extents)
    call expect(all(whole == [11, 12, 13, 14]), "ids")
    call get_integers(path, "model/joints/nodes", whole, extents)
    call expect(all(whole == [0, -1, 1, -1, -1, 0, -1, 2, -1, 2, -1, 3, -1, -1, -1, -1]), "nodes")
    call get_integers(path, "model/joints/mode_status", whole, extents)
    call expect(all(extents == [4, 6]), "six modes")
    call expect(all(whole == [1, -1, -1, -1, -1, -1, 2, 0, 0, -1, -1, -1, 0, 0, 0, -1, -1, -1, &
                              0, -1, -1, -1, -1, -1]), "status")
    call get_integers(path, "model/joints/gear", whole, extents)
    call expect(all(whole == [-1, -1, -1, -1, -1, -1, 1, 2]), "the gear's hinges")
    call get_reals(path, "model/joints/ratio", values, extents)
    call expect_close(values(4), -2.5_wp, 0.0_wp, "ratio")
    call get_reals(path, "model/joints/axes", values, extents)
    call expect_close(values(7:15), [0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                                     1.0_wp, 0.0_wp], 0.0_wp, "axes of the hinges")
    call get_integers(path, "model/masses/node", whole, extents)
    call expect(all(whole == [1]), "the mass is at node 2")
    call get_reals(path, "model/masses/inertia", values, extents)
    call expect_close(values, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], 0.0_wp, "inertia")
  end subroutine test_model

  !> Row by displacement, column by load; a dimension for each of the 36.
  subroutine test_compliance()
    type(model_t) :: model
    character(len=:), allocatable :: path
    real(wp), allocatable :: values(:)
    integer, allocatable :: whole(:), extents(:)
    real(wp) :: matrix(6, 6)

    path = scratch("compliance.h5")
    call get_history_model(3, model)
    call write_history(path, model, 3)
    call get_integers(path, "analysis/02_compliance/nodes", whole, extents)
    call expect(all(whole == [1, 2, 0, 3, 1, 2]), "row, id, part of both nodes")
    call get_reals(path, "analysis/02_compliance/compliance", values, extents)
    call expect(size(extents) == 3, "three indices")
    call expect(all(extents == [2, 6, 6]), "a matrix for each node")
    matrix = yields(2)
    call expect_close(values(37:42), matrix(1, :), 0.0_wp, "X by all loads comes first")
    call expect_close(values(43:48), matrix(2, :), 0.0_wp, "then Y")
    call get_numbers(path, "analysis/02_compliance/compliance", "dimension", whole)
    call expect(size(whole) == 4*36, "36 dimensions")
    if (size(whole) /= 4*36) return
    call expect(all(whole(1:4) == [-1, 1, 0, 0]), "X by FX: length over force")
    call expect(all(whole(13:16) == [-1, 0, 0, 0]), "X by MX: length over moment")
    call expect(all(whole(4*18 + 1:4*18 + 4) == [-1, 0, 0, 0]), "RX by FX: angle over force")
    call expect(all(whole(4*35 + 1:) == [-1, -1, 0, 0]), "RZ by MZ: angle over moment")
    call expect(compliance_line("n", matrix) == "n: X 211 Y 222 Z 233 RX 244 RY 255 RZ 266", &
                "a line of the diagonal")
  end subroutine test_compliance

  !> One number of 600 steps differs: compare finds it, digest prints it, info counts.
  subroutine test_commands()
    type(model_t) :: model
    type(outcome_t) :: outcome
    character(len=:), allocatable :: one, other

    one = scratch("one.h5")
    other = scratch("other.h5")
    call get_history_model(steps, model)
    call write_history(one, model, steps)
    model%joint(4)%ratio = 4
    call write_history(other, model, steps)
    call run_spar("compare "//one//" "//one, outcome)
    call expect(outcome%status == 0, "a file equals itself")
    call run_spar("compare "//one//" "//other, outcome)
    call expect(outcome%status == 1, "another ratio")
    call expect(index(outcome%output, "/model/joints/ratio[3]") > 0, "is found")
    call expect(index(outcome%output, "1 difference") > 0, "alone")
    call run_spar("digest "//one, outcome)
    call expect(outcome%status == 0, "digest works")
    call expect(index(outcome%output, "/analysis/02_compliance/compliance 2 6 6"//new_line("a")// &
                      "  1.11e2 1.12e2") > 0, "with compliances")
    call expect(index(outcome%output, "/analysis/01_transient/energy/strain 601") > 0, "energies")
    call run_spar("info "//one, outcome)
    call expect(index(outcome%output, "transient, 601 steps, time 0.6") > 0, "steps and time")
    call expect(index(outcome%output, "compliance") > 0 .and. &
                index(outcome%output, "201 steps") > 0, "compliance, drawn steps")
  end subroutine test_commands

end module test_output_history
