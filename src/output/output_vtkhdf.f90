!> Group /VTKHDF of the result file: the model as a mesh and how it moves, as VTK's readers
!> (ParaView, PyVista) take it: an UnstructuredGrid of version 2.0 with steps.
!>
!> A step for each recorded state, for each mode and, behind the states of a path, for each of its
!> critical points. Points and displacement together are where a step's points are drawn: the points
!> are those of the undeformed model or, for a mode about a deformed state, those of that state,
!> written behind the former.
module output_vtkhdf
  use kinds, only: wp, sp, i8
  use rotation, only: no_rotation
  use model_data, only: model_t, mode_analyses, stability_off
  use system_results, only: results_t, result_modes
  use mode_results, only: modes_t
  use output_hdf5, only: hdf5_file_t
  use output_fields, only: field_writer_t
  use output_schedule, only: in_time, has_steps, expected_steps, drawn_intervals
  use beam_mesh, only: mesh_t, new_mesh, line_cell
  use beam_drawing, only: posture_t, draw_motion, draw_mode, draw_forces, draw_stress, mode_forces
  implicit none
  private

  public :: vtk_writer_t

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
    integer :: joints = 0                       !< of the model, drawn or not
    real(wp), allocatable :: motion(:, :), turn(:, :)   !< (3, points) displacement and rotation
    real(sp), allocatable :: stress(:), force(:, :)     !< (points), (7, cells)
    type(field_writer_t) :: fields
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

    call new_mesh(model, self%mesh)
    self%active = size(self%mesh%kind) > 0
    if (.not. self%active) return
    self%joints = size(model%joint)
    call make_room(self, size(model%node))
    call self%fields%start(file, self%mesh, drawn_steps(model), self%stressed, has_modes(model))
  end subroutine start

  !> Whether modes may be drawn: they are about deformed states.
  pure logical function has_modes(model)
    type(model_t), intent(in) :: model
    integer :: i

    has_modes = any(model%analysis%stability /= stability_off)
    do i = 1, size(model%analysis)
      has_modes = has_modes .or. any(mode_analyses == model%analysis(i)%kind)
    end do
  end function has_modes

  subroutine make_room(self, nodes)
    type(vtk_writer_t), intent(inout) :: self
    integer, intent(in) :: nodes

    allocate (self%posture%displacement(3, nodes), self%posture%warping(nodes))
    self%posture%displacement = 0
    self%posture%euler = spread(no_rotation, 2, nodes)
    self%posture%warping = 0
    self%stressed = any(self%mesh%kind > line_cell)   ! surfaces
    associate (points => size(self%mesh%position, 2), cells => size(self%mesh%kind))
      allocate (self%motion(3, points), self%turn(3, points), self%stress(points), &
                self%force(7, cells))
    end associate
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
    allocate (point%mode%joint_stress(1, self%joints, 1))
    point%mode%stress = 0
    point%mode%joint_stress = 0
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
    integer(i8) :: set
    integer :: i

    call add_points(self, file, set)
    do i = 1, modes%modes
      call draw_mode(self%mesh, self%posture, modes%displacement(:, :, i), &
                     modes%rotation(:, :, i), modes%warping(:, i), self%motion, self%turn)
      call mode_forces(self%mesh, modes%stress(:, :, i), force_p, force_q)
      associate (joint_stress => modes%joint_stress(:, :, i))
        call draw_forces(self%mesh, force_p, force_q, joint_stress, self%force)
        if (self%stressed) call draw_stress(self%mesh, force_p, force_q, joint_stress, self%stress)
      end associate
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
    integer(i8) :: written

    if (.not. self%active) return
    if (set == self%fields%point_sets) call self%fields%add_points(file, points, written)
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
    if (any(abs(self%motion) > 0)) then
      call self%fields%add_points(file, self%mesh%position + self%motion, set)
    end if
  end subroutine add_points

  !> Add what was drawn as a step.
  subroutine add_step(self, file, number, row, set)
    type(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: number, row
    integer(i8), intent(in) :: set   !< of points

    call self%fields%add_step(file, [number, row], set, self%motion, self%turn, self%stress, &
                              self%force)
  end subroutine add_step

  !> Write what was gathered.
  subroutine write_pending(self, file)
    class(vtk_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file

    call self%fields%write_pending(file)
  end subroutine write_pending

end module output_vtkhdf
