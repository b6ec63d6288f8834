!> Group /VTKHDF of the result file: the model as a mesh and how it moves, as VTK's readers
!> (ParaView, PyVista) take it: an UnstructuredGrid of version 2.0 with steps.
!>
!> A step for each recorded state, for each mode and, behind the states of a path, for each of its
!> critical points. Points and displacement together are where a step's points are drawn: the points
!> are those of the undeformed model or, for a mode about a deformed state, those of that state,
!> written behind the former.
module output_vtkhdf
  use hdf5, only: h5lcreate_hard_f
  use kinds, only: wp, sp, i8
  use rotation, only: no_rotation
  use model_data, only: model_t, mode_analyses
  use system_results, only: results_t, result_modes
  use mode_results, only: modes_t
  use output_hdf5, only: hdf5_file_t, about_t
  use output_arrays, only: write_longs, write_bytes, set_longs, set_ascii
  use output_schedule, only: in_time, has_steps, expected_steps, drawn_intervals
  use output_tables, only: table_t
  use beam_mesh, only: mesh_t, new_mesh, line_cell
  use beam_drawing, only: posture_t, draw_motion, draw_mode, draw_forces, draw_stress, mode_forces
  implicit none
  private

  public :: vtk_writer_t

  character(len=*), parameter :: root = "VTKHDF", steps_group = root//"/Steps"

  !> Tables of long whole numbers, a row for each step.
  integer, parameter :: part_offsets = 1, parts = 2, point_offsets = 3, cell_offsets = 4, &
                        field_offsets = 5, cell_field_offsets = 6, longs = 6

  !> Points gathered before they are written: files of small models would rather wait for the disk.
  integer, parameter :: gathered_points = 8192

  !> The mode of a critical point, and the state recorded before it.
  type :: critical_mode_t
    type(posture_t) :: about
    type(modes_t) :: mode
  end type critical_mode_t

  type :: vtk_writer_t
    private
    logical :: active = .false.
    type(mesh_t) :: mesh
    type(posture_t) :: posture                  !< of the last recorded state
    type(critical_mode_t), allocatable :: critical(:)   !< of the present analysis
    logical :: stressed = .false.               !< a section has an outline
    integer :: points = 0, cells = 0            !< of the mesh
    integer :: joints = 0                       !< of the model, drawn or not
    integer :: steps = 0                        !< written
    integer :: pending = 0, most_pending = 1    !< gathered
    integer(i8) :: point_sets = 1               !< written: undeformed, then about which modes are
    real(wp), allocatable :: motion(:, :), turn(:, :)   !< (3, points) displacement and rotation
    real(sp), allocatable :: stress(:), force(:, :)     !< (points), (7, cells)
    type(table_t) :: point_table, values, origin_table, long(longs), &
                     motion_table, rotation_table, stress_table, force_table
  contains
    procedure :: start
    procedure :: add_state
    procedure :: add_modes
    procedure :: add_drawn
    procedure :: add_critical
    procedure :: end_analysis
    procedure :: write_pending
  end type vtk_writer_t

contains

  !> Write the mesh and make the tables, if there is something to draw.
  subroutine start(self, file, model)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    integer(i8) :: steps

    call new_mesh(model, self%mesh)
    self%active = size(self%mesh%kind) > 0
    if (.not. self%active) return
    self%joints = size(model%joint)
    call make_room(self, size(model%node))
    steps = drawn_steps(model)
    call write_head(file)
    call write_mesh(self, file)
    call start_fields(self, file, steps)
    call start_steps(self, file, steps)
    call gather_steps(self)
  end subroutine start

  subroutine make_room(self, nodes)
    type(vtk_writer_t), intent(inout) :: self
    integer, intent(in) :: nodes

    allocate (self%posture%displacement(3, nodes), self%posture%warping(nodes))
    self%posture%displacement = 0
    self%posture%euler = spread(no_rotation, 2, nodes)
    self%posture%warping = 0
    self%stressed = any(self%mesh%kind /= line_cell)
    self%points = size(self%mesh%position, 2)
    self%cells = size(self%mesh%kind)
    self%most_pending = max(1, gathered_points/self%points)
    allocate (self%motion(3, self%points), self%turn(3, self%points), self%stress(self%points), &
              self%force(7, self%cells))
  end subroutine make_room

  !> About how many steps there will be.
  pure integer(i8) function drawn_steps(model)
    type(model_t), intent(in) :: model
    integer(i8) :: steps
    integer :: i

    drawn_steps = 0
    do i = 1, size(model%analysis)
      associate (a => model%analysis(i))
        steps = 0
        if (has_steps(a%kind)) steps = expected_steps(a, 0.0_wp)
        if (in_time(a%kind)) steps = min(steps, int(drawn_intervals, i8))
        if (any(mode_analyses == a%kind)) steps = a%modes
        drawn_steps = drawn_steps + steps
      end associate
    end do
    drawn_steps = max(1_i8, drawn_steps)
  end function drawn_steps

  !> All that grows by the step is written together.
  subroutine gather_steps(self)
    type(vtk_writer_t), intent(inout) :: self
    integer :: i

    call self%motion_table%gather(self%most_pending)
    call self%rotation_table%gather(self%most_pending)
    call self%stress_table%gather(self%most_pending)
    call self%force_table%gather(self%most_pending)
    call self%values%gather(self%most_pending)
    call self%origin_table%gather(self%most_pending)
    do i = 1, longs
      call self%long(i)%gather(self%most_pending)
    end do
  end subroutine gather_steps

  !> The group and its attributes: the type is plain ASCII, the version long whole numbers.
  subroutine write_head(file)
    type(hdf5_file_t), intent(inout) :: file

    call file%group(root)
    call file%group(steps_group)
    call file%group(root//"/PointData")
    call file%group(root//"/CellData")
    call file%group(steps_group//"/PointDataOffsets")
    call file%group(steps_group//"/CellDataOffsets")
    call file%set_number(steps_group, "NSteps", 0)
    call set_longs(file, root, "Version", [2, 0])
    call set_ascii(file, root, "Type", "UnstructuredGrid")
  end subroutine write_head

  subroutine write_mesh(self, file)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file

    associate (mesh => self%mesh)
      call write_longs(file, root//"/NumberOfPoints", [size(mesh%position, 2)])
      call write_longs(file, root//"/NumberOfCells", [size(mesh%kind)])
      call write_longs(file, root//"/NumberOfConnectivityIds", [size(mesh%corners)])
      call write_longs(file, root//"/Connectivity", mesh%corners)
      call write_longs(file, root//"/Offsets", mesh%offset)
      call write_bytes(file, root//"/Types", mesh%kind)
      call self%point_table%start_reals(file, root//"/Points", size(mesh%position, 2, i8), &
        about_t("L", "point; X Y Z", "positions of the undeformed model"), 3)
      call self%point_table%append(file, mesh%position)
    end associate
  end subroutine write_mesh

  subroutine start_fields(self, file, steps)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(in) :: steps

    associate (points => steps*size(self%mesh%position, 2), cells => steps*size(self%mesh%kind))
      call self%motion_table%start_reals(file, root//"/PointData/displacement", points, &
        about_t("L", "step*point; X Y Z", "from Points; of modes as in /analysis"), 3)
      call self%rotation_table%start_singles(file, root//"/PointData/rotation", points, &
        about_t("1", "step*point; X Y Z", "rotation vector of the section in radians"), 3)
      if (self%stressed) call self%stress_table%start_singles(file, &
        root//"/PointData/axial_stress", points, about_t("FL-2", "step*point", &
        "from section forces linear along the beam; of modes too"))
      call self%force_table%start_singles(file, root//"/CellData/section_force", cells, &
        about_t("F F F FL FL FL FL2", "step*cell; N Vy Vz T My Mz B", &
                "linear along the beam; of modes to first order, of critical points 0"), 7)
    end associate
  end subroutine start_fields

  !> Tables with a row for each step. VTK wants to know where in the tables a step's rows begin.
  subroutine start_steps(self, file, steps)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(in) :: steps

    call self%values%start_reals(file, steps_group//"/Values", steps, &
      about_t("1", "step", "number of the step, from 1"))
    call self%origin_table%start_longs(file, steps_group//"/Origin", steps, &
      about_t("1", "step; analysis row", "number of the group in /analysis; of the state or"// &
              " mode in it, from 0; -1, -2, ... for critical/0001, ..."), 2)
    call start_long(self, file, part_offsets, "PartOffsets", steps)
    call start_long(self, file, parts, "NumberOfParts", steps)
    call start_long(self, file, point_offsets, "PointOffsets", steps)
    call start_long(self, file, cell_offsets, "CellOffsets", steps, 1)
    call start_long(self, file, field_offsets, "PointDataOffsets/displacement", steps)
    call start_long(self, file, cell_field_offsets, "CellDataOffsets/section_force", steps)
    call link(file, "CellOffsets", "ConnectivityIdOffsets")
    call link(file, "PointDataOffsets/displacement", "PointDataOffsets/rotation")
    if (self%stressed) call link(file, "PointDataOffsets/displacement", &
                                 "PointDataOffsets/axial_stress")
  end subroutine start_steps

  subroutine start_long(self, file, which, name, steps, columns)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: which
    character(len=*), intent(in) :: name
    integer(i8), intent(in) :: steps
    integer, intent(in), optional :: columns

    call self%long(which)%start_longs(file, steps_group//"/"//name, steps, columns=columns)
  end subroutine start_long

  !> A second name of a dataset.
  subroutine link(file, old, new)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: old, new
    integer :: status

    if (allocated(file%failure)) return
    call h5lcreate_hard_f(file%id, steps_group//"/"//old, file%id, steps_group//"/"//new, status)
    call file%check(status, "h5lcreate_hard_f")
  end subroutine link

  !> A recorded state of analysis `number`; `row`: its place there, from 0.
  subroutine add_state(self, file, number, row, results, drawn)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number, row
    type(results_t), intent(in) :: results
    logical, intent(in) :: drawn      !< else modes may be about it, no more

    if (.not. self%active) return
    self%posture%displacement = results%displacement
    self%posture%euler = results%euler
    self%posture%warping = results%warping
    if (.not. drawn) return
    call draw_motion(self%mesh, self%posture, self%motion, self%turn)
    call draw_forces(self%mesh, results%force_p, results%force_q, results%joint_stress, self%force)
    if (self%stressed) call draw_stress(self%mesh, results%force_p, results%force_q, &
                                        results%joint_stress, self%stress)
    call add_step(self, file, number, row, 0_i8)
  end subroutine add_state

  !> The modes of analysis `number`, about the state recorded last.
  subroutine add_modes(self, file, number, modes)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number
    type(modes_t), intent(in) :: modes

    if (self%active .and. modes%modes > 0) call draw_modes(self, file, number, 0, modes)
  end subroutine add_modes

  !> Keep a critical point of the path, which is drawn behind its states: who plays them wants to
  !> see no mode between them.
  subroutine add_critical(self, mode)
    class(vtk_writer_t), intent(inout) :: self
    real(wp), intent(in) :: mode(:, :)   !< (7, nodes) X Y Z RX RY RZ W
    type(critical_mode_t) :: point
    integer :: nodes

    if (.not. self%active) return
    nodes = size(mode, 2)
    point%about = self%posture
    point%mode%modes = 1
    point%mode%displacement = reshape(mode(1:3, :), [3, nodes, 1])
    point%mode%rotation = reshape(mode(4:6, :), [3, nodes, 1])
    point%mode%warping = reshape(mode(7, :), [nodes, 1])
    allocate (point%mode%stress(result_modes, size(self%mesh%beam), 1))
    point%mode%stress = 0
    if (.not. allocated(self%critical)) allocate (self%critical(0))
    self%critical = [self%critical, point]
  end subroutine add_critical

  !> Draw the critical points of analysis `number`, write what was gathered.
  subroutine end_analysis(self, file, number)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number
    type(posture_t) :: last
    integer :: i

    call self%write_pending(file)
    if (.not. allocated(self%critical)) return
    last = self%posture
    do i = 1, size(self%critical)
      self%posture = self%critical(i)%about
      call draw_modes(self, file, number, -i, self%critical(i)%mode)
    end do
    self%posture = last
    deallocate (self%critical)
  end subroutine end_analysis

  !> Modes about the present posture; the first is row `first` of its analysis.
  subroutine draw_modes(self, file, number, first, modes)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number, first
    type(modes_t), intent(in) :: modes
    real(wp), dimension(7, size(self%mesh%beam)) :: force_p, force_q
    real(wp) :: no_stress(1, self%joints)
    integer(i8) :: set
    integer :: i

    no_stress = 0
    call add_points(self, file, set)
    do i = 1, modes%modes
      call draw_mode(self%mesh, self%posture, modes%displacement(:, :, i), &
                     modes%rotation(:, :, i), modes%warping(:, i), self%motion, self%turn)
      call mode_forces(self%mesh, modes%stress(:, :, i), force_p, force_q)
      call draw_forces(self%mesh, force_p, force_q, no_stress, self%force)
      if (self%stressed) call draw_stress(self%mesh, force_p, force_q, no_stress, self%stress)
      call add_step(self, file, number, first + i - 1, set)
    end do
    call write_pending(self, file)
  end subroutine draw_modes

  !> A step that was drawn for another file of the same model. `points`: those of the steps from
  !> here on about set number `set`, if that is new; none else.
  subroutine add_drawn(self, file, number, row, set, points, motion, turn, stress, force)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number, row
    integer(i8), intent(in) :: set
    real(wp), intent(in), contiguous :: points(:, :)
    real(wp), intent(in) :: motion(:, :), turn(:, :), stress(:), force(:, :)

    if (.not. self%active) return
    if (set == self%point_sets) then
      call self%point_table%append(file, points)
      self%point_sets = set + 1
    end if
    self%motion = motion
    self%turn = turn
    self%stress = real(stress, sp)
    self%force = real(force, sp)
    call add_step(self, file, number, row, set)
  end subroutine add_drawn

  !> The points of a deformed state, for the modes about it; `set`: its number, 0 if undeformed.
  subroutine add_points(self, file, set)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(out) :: set

    set = 0
    call draw_motion(self%mesh, self%posture, self%motion, self%turn)
    if (.not. any(abs(self%motion) > 0)) return
    call self%point_table%append(file, self%mesh%position + self%motion)
    set = self%point_sets
    self%point_sets = set + 1
  end subroutine add_points

  !> A step has been drawn: where its rows begin in the tables, points first.
  subroutine add_step(self, file, number, row, set)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number, row
    integer(i8), intent(in) :: set   !< of points
    integer(i8) :: before, entry(longs)
    integer :: i

    before = self%steps + self%pending
    entry = [0_i8, 1_i8, set*self%points, 0_i8, before*self%points, before*self%cells]
    call self%motion_table%append(file, self%motion)
    call self%rotation_table%append(file, real(self%turn, sp))
    call self%stress_table%append(file, self%stress)
    call self%force_table%append(file, self%force)
    do i = 1, longs
      call self%long(i)%append(file, entry(i:i))
    end do
    call self%origin_table%append(file, [int(number, i8), int(row, i8)])
    call self%values%append(file, real(before + 1, wp))
    self%pending = self%pending + 1
    if (self%pending == self%most_pending) call write_pending(self, file)
  end subroutine add_step

  !> Write what was gathered; the count of steps comes last, when all they need is there.
  subroutine write_pending(self, file)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer :: i

    if (self%pending == 0) return
    call self%motion_table%write(file)
    call self%rotation_table%write(file)
    call self%stress_table%write(file)
    call self%force_table%write(file)
    do i = 1, longs
      call self%long(i)%write(file)
    end do
    call self%origin_table%write(file)
    call self%values%write(file)
    self%steps = self%steps + self%pending
    self%pending = 0
    call file%set_number(steps_group, "NSteps", self%steps)
  end subroutine write_pending

end module output_vtkhdf
