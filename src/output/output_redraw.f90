!> Fills /VTKHDF of a run that goes on with what was drawn before.
module output_redraw
  use kinds, only: wp, i8
  use errors, only: error_t
  use system_results, only: results_t, joint_strains
  use output_hdf5, only: hdf5_file_t
  use output_reader, only: dataset_t
  use output_schedule, only: drawing_rule_t
  use output_source, only: source_t
  use output_vtkhdf, only: vtk_writer_t
  implicit none
  private

  public :: redraw_before, redraw_motion, redraw_kept

  character(len=*), parameter :: root = "/VTKHDF/", steps_group = root//"Steps/"

contains

  !> The steps of the analyses before the source's.
  subroutine redraw_before(source, file, drawing)
    type(source_t), intent(in) :: source
    type(hdf5_file_t), intent(inout) :: file
    type(vtk_writer_t), intent(inout) :: drawing

    call copy_steps(source, 1, source%point%analysis - 1, [logical ::], file, drawing)
  end subroutine redraw_before

  !> The states of the source's analysis that are to be drawn, from its histories of all nodes and
  !> elements.
  subroutine redraw_motion(source, wanted, file, drawing)
    type(source_t), intent(in) :: source
    logical, intent(in) :: wanted(:)              !< by state
    type(hdf5_file_t), intent(inout) :: file
    type(vtk_writer_t), intent(inout) :: drawing
    type(results_t) :: results
    real(wp), allocatable :: warping(:, :)
    character(len=:), allocatable :: group
    integer(i8) :: before
    integer :: nodes, members, joints, row

    nodes = source%count("nodes")
    members = source%count("elements")
    joints = source%count("joints")
    allocate (warping(1, nodes))
    allocate (results%displacement(3, nodes), results%euler(4, nodes), &
              results%force_p(7, members), results%force_q(7, members), &
              results%joint_stress(joint_strains, joints))
    group = "/analysis/"//source%group
    do row = 1, size(wanted)
      if (.not. wanted(row)) cycle
      before = row - 1
      call source%read_rows(group//"/nodes/displacement", before*nodes, results%displacement)
      call source%read_rows(group//"/nodes/euler", before*nodes, results%euler)
      call source%read_rows(group//"/nodes/warping", before*nodes, warping)
      call source%read_rows(group//"/elements/section_force_p", before*members, results%force_p)
      call source%read_rows(group//"/elements/section_force_q", before*members, results%force_q)
      call source%read_rows(group//"/joints/stress", before*joints, results%joint_stress)
      results%warping = warping(1, :)
      call drawing%add_state(file, source%point%analysis, row - 1, results, .true.)
    end do
  end subroutine redraw_motion

  !> The same where the histories are not of all: those of them that were drawn.
  subroutine redraw_kept(source, wanted, file, drawing)
    type(source_t), intent(in) :: source
    logical, intent(in) :: wanted(:)              !< by state
    type(hdf5_file_t), intent(inout) :: file
    type(vtk_writer_t), intent(inout) :: drawing

    call copy_steps(source, source%point%analysis, source%point%analysis, wanted, file, drawing)
  end subroutine redraw_kept

  !> Copy the drawn steps of analyses; with `wanted`, which concerns the last of them, only those.
  subroutine copy_steps(source, first, last, wanted, file, drawing)
    type(source_t), intent(in) :: source
    integer, intent(in) :: first, last
    logical, intent(in) :: wanted(:)
    type(hdf5_file_t), intent(inout) :: file
    type(vtk_writer_t), intent(inout) :: drawing
    type(dataset_t) :: origin, offset, points, cells
    integer :: steps, k, number, row

    if (.not. source%reader%has(steps_group//"Origin")) return
    if (.not. all([read_it(steps_group//"Origin", origin), &
                   read_it(steps_group//"PointOffsets", offset), &
                   read_it(root//"NumberOfPoints", points), &
                   read_it(root//"NumberOfCells", cells)])) return
    call source%reader%get_number("/VTKHDF/Steps", "NSteps", steps)
    do k = 1, min(steps, size(offset%value))
      number = nint(origin%value(2*k - 1))
      row = nint(origin%value(2*k))
      if (number < first .or. number > last) cycle
      if (size(wanted) > 0) then
        if (row >= size(wanted)) cycle
        if (.not. wanted(row + 1)) cycle
      end if
      call copy_step(source, k, number, row, nint(points%value(1)), nint(cells%value(1)), &
                     nint(offset%value(k), i8)/nint(points%value(1), i8), file, drawing)
    end do

  contains

    logical function read_it(path, dataset)
      character(len=*), intent(in) :: path
      type(dataset_t), intent(out) :: dataset
      type(error_t), allocatable :: error

      call source%reader%read(path, dataset, error)
      read_it = .not. allocated(error)
    end function read_it

  end subroutine copy_steps

  !> Drawn step number `k`, about the set of points number `set`.
  subroutine copy_step(source, k, number, row, points, cells, set, file, drawing)
    type(source_t), intent(in) :: source
    integer, intent(in) :: k, number, row, points, cells
    integer(i8), intent(in) :: set
    type(hdf5_file_t), intent(inout) :: file
    type(vtk_writer_t), intent(inout) :: drawing
    real(wp) :: place(3, points), motion(3, points), turn(3, points), stress(1, points), &
                force(7, cells)
    integer(i8) :: before

    before = k - 1
    call source%read_rows(root//"Points", set*points, place)
    call source%read_rows(root//"PointData/displacement", before*points, motion)
    call source%read_rows(root//"PointData/rotation", before*points, turn)
    call source%read_rows(root//"PointData/axial_stress", before*points, stress)
    call source%read_rows(root//"CellData/section_force", before*cells, force)
    call drawing%add_drawn(file, number, row, set, place, motion, turn, stress(1, :), force)
  end subroutine copy_step

end module output_redraw
