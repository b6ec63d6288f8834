!> How nodes yield to loads, in the result file: of COMPLIANCE once, of STATIC step by step.
module output_compliance
  use kinds, only: wp, i8
  use output_hdf5, only: hdf5_file_t, about_t
  use output_tables, only: table_t
  implicit none
  private

  public :: write_compliance, start_compliance, append_compliance

  character(len=*), parameter :: &
    to_force = " F-1L F-1L F-1L F-1 F-1 F-1", to_moment = " F-1 F-1 F-1 F-1L-1 F-1L-1 F-1L-1", &
    dimensions = to_force//to_force//to_force//to_moment//to_moment//to_moment, &
    description = "displacement and rotation per force and moment, global axes"

contains

  !> The datasets `nodes` and `compliance` of a group.
  subroutine write_compliance(file, group, label, matrix)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    integer, intent(in) :: label(:, :)         !< (3, nodes) row from 0, id, part
    real(wp), intent(in) :: matrix(:, :, :)    !< (6, 6, nodes), see `recorder_t`

    call write_nodes(file, group, label)
    call file%write(group//"/compliance", &
      reshape(as_rows(matrix), shape(matrix)), &
      about_t(adjustl(dimensions), "node; X Y Z RX RY RZ; FX FY FZ MX MY MZ", description))
  end subroutine write_compliance

  !> The group `compliance` with its datasets `nodes` and, still empty, `matrix`.
  subroutine start_compliance(table, file, group, label, steps)
    type(table_t), intent(inout) :: table
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    integer, intent(in) :: label(:, :)         !< (3, nodes) row from 0, id, part
    integer(i8), intent(in) :: steps           !< expected

    call file%group(group//"/compliance")
    call write_nodes(file, group//"/compliance", label)
    call table%start_reals(file, group//"/compliance/matrix", steps*size(label, 2), &
      about_t(adjustl(dimensions), "step*node; X Y Z RX RY RZ by FX FY FZ MX MY MZ", description), &
      36)
  end subroutine start_compliance

  subroutine append_compliance(table, file, matrix)
    type(table_t), intent(inout) :: table
    type(hdf5_file_t), intent(inout) :: file
    real(wp), intent(in) :: matrix(:, :, :)    !< (6, 6, nodes), see `recorder_t`

    call table%append(file, as_rows(matrix))
  end subroutine append_compliance

  subroutine write_nodes(file, group, label)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    integer, intent(in) :: label(:, :)

    call file%write(group//"/nodes", label, &
      about_t("1", "node; row id part", "row of /model/nodes, from 0, and its name"))
  end subroutine write_nodes

  !> Displacements count first, forces behind them.
  pure function as_rows(matrix) result(row)
    real(wp), intent(in) :: matrix(:, :, :)
    real(wp) :: row(36, size(matrix, 3))
    integer :: i

    do i = 1, size(matrix, 3)
      row(:, i) = reshape(transpose(matrix(:, :, i)), [36])
    end do
  end function as_rows

end module output_compliance
