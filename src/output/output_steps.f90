!> The datasets of an analysis that grow step by step. In time they are written in blocks, and hold
!> what OUTPUT keeps of nodes and elements.
module output_steps
  use hdf5, only: hid_t
  use kinds, only: wp, i8
  use model_data, only: model_t, analysis_t, name_length, components, analysis_kinematic
  use recorder, only: step_t
  use system_results, only: results_t, result_modes, joint_strains
  use system_stress, only: stress_parts
  use output_choice, only: choices_t, all_of, kept_of, labels_of
  use output_compliance, only: start_compliance, append_compliance
  use output_files, only: link_name
  use output_hdf5, only: hdf5_file_t, about_t
  use output_motion, only: motion_tables_t
  use output_schedule, only: in_time, expected_steps, block_size
  use output_tables, only: table_t
  implicit none
  private

  public :: step_tables_t

  integer, parameter :: step_number = 1, load_factor = 2, time = 3, time_step = 4, &
    displacement = 5, euler = 6, warping = 7, reaction = 8, load = 9, &
    strain = 10, stress = 11, force_p = 12, force_q = 13, point_stress = 14, &
    joint_strain = 15, joint_stress = 16, joint_rate = 17, &
    iterations = 18, cutbacks = 19, unstable = 20, arc_length = 21, residual = 22, &
    increment = 23, constraint = 24, compliance = 25, tables = compliance

  type :: step_tables_t
    private
    character(len=:), allocatable :: group
    type(choices_t) :: all, of_time, now           !< kept: all, in time, in the present analysis
    integer, allocatable :: label(:, :)            !< (3, nodes) row from 0, id, part
    integer :: joints = 0
    character(len=name_length), allocatable :: marker(:)
    logical :: timed = .false.
    integer(i8) :: steps = 0                       !< expected
    integer :: block = 1, pending = 0              !< steps written together, not yet written
    type(table_t) :: table(tables)
    type(motion_tables_t) :: motion                !< of motions in time
    type(table_t), allocatable :: marker_table(:)
  contains
    procedure :: prepare
    procedure :: begin
    procedure :: append => append_step
    procedure :: copy => copy_steps
    procedure :: keeps_all
    procedure :: finish
  end type step_tables_t

contains

  !> What there is in the model, and what of it OUTPUT keeps.
  subroutine prepare(self, model)
    class(step_tables_t), intent(inout) :: self
    type(model_t), intent(in) :: model

    self%all = all_of(model)
    self%of_time = kept_of(model)
    self%label = labels_of(model%node)
    self%joints = size(model%joint)
    self%marker = model%marker%name
  end subroutine prepare

  !> Make the datasets of an analysis, empty.
  subroutine begin(self, file, group, analysis, start)
    class(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: start             !< time before it [T]
    integer :: i

    self%group = group
    self%timed = in_time(analysis%kind)
    self%steps = expected_steps(analysis, start)
    self%now = self%all
    if (self%timed) self%now = self%of_time
    call start_steps(self, file)
    call start_nodes(self, file)
    call start_elements(self, file)
    call self%now%write(file, group)
    call start_markers(self, file)
    call start_joints(self, file)
    call start_convergence(self, file)
    if (allocated(analysis%node)) call start_compliance(self%table(compliance), file, group, &
                                                        self%label(:, analysis%node), self%steps)
    if (self%timed) call self%motion%start(file, group, self%now%node, self%steps, &
                                           analysis%kind /= analysis_kinematic)
    self%block = 1
    if (self%timed) self%block = block_size(bytes_of_step(self))
    self%pending = 0
    do i = 1, tables
      call self%table(i)%gather(self%block)
    end do
    do i = 1, size(self%motion%table)
      call self%motion%table(i)%gather(self%block)
    end do
    do i = 1, size(self%marker)
      call self%marker_table(i)%gather(self%block)
    end do
  end subroutine begin

  !> About what a step in time takes: five vectors of seven by node, four of about as many by
  !> element, three of six by joint.
  pure integer(i8) function bytes_of_step(self)
    type(step_tables_t), intent(in) :: self

    bytes_of_step = 8*(36_i8*self%now%node%rows + 30_i8*self%now%member%rows &
                       + 4_i8*self%now%place%rows + 18_i8*self%joints &
                       + 3_i8*size(self%marker) + 20)
  end function bytes_of_step

  subroutine start_steps(self, file)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file

    call start_whole(self, file, step_number, "step", "number of the recorded step")
    if (self%timed) then
      call start_list(self, file, time, "time", "T", "time of the state")
      call start_list(self, file, time_step, "time_step", "T", "last step of the integration")
    else
      call start_list(self, file, load_factor, "load_factor", "1", "factor of the load pattern")
    end if
  end subroutine start_steps

  !> A whole number for each step.
  subroutine start_whole(self, file, which, name, description)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: which
    character(len=*), intent(in) :: name, description

    call self%table(which)%start_integers(file, self%group//"/"//name, self%steps, &
                                          about_t("1", "step", description))
  end subroutine start_whole

  !> A real number for each step.
  subroutine start_list(self, file, which, name, dimension, description)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: which
    character(len=*), intent(in) :: name, dimension, description

    call self%table(which)%start_reals(file, self%group//"/"//name, self%steps, &
                                       about_t(dimension, "step", description))
  end subroutine start_list

  !> So many rows of so many columns for each step.
  subroutine start_table(self, file, which, name, rows, columns, about)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: which, rows, columns
    character(len=*), intent(in) :: name
    type(about_t), intent(in) :: about

    call self%table(which)%start_reals(file, self%group//"/"//name, self%steps*rows, about, columns)
  end subroutine start_table

  subroutine start_nodes(self, file)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), parameter :: of_all = "step*node; X Y Z RX RY RZ W", &
                                   dual = "F F F FL FL FL FL2"

    call file%group(self%group//"/nodes")
    associate (n => self%now%node%rows)
      call start_table(self, file, displacement, "nodes/displacement", n, 3, &
        about_t("L", "step*node; X Y Z", "from the initial position"))
      call start_table(self, file, euler, "nodes/euler", n, 4, &
        about_t("1", "step*node; e0 e1 e2 e3", "Euler parameters of the rotation, scalar first"))
      call self%table(warping)%start_reals(file, self%group//"/nodes/warping", self%steps*n, &
        about_t("L-1", "step*node", "warping coordinate, a rate of twist"))
      call start_table(self, file, reaction, "nodes/reaction", n, components, &
        about_t(dual, of_all, "forces, moments, bimoment of supports, 0 where nothing is fixed"))
      call start_table(self, file, load, "nodes/load", n, components, &
        about_t(dual, of_all, "forces, moments, bimoment applied"))
    end associate
  end subroutine start_nodes

  subroutine start_markers(self, file)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer :: i

    if (.not. allocated(self%marker_table)) allocate (self%marker_table(size(self%marker)))
    if (size(self%marker) == 0) return
    call file%group(self%group//"/markers")
    do i = 1, size(self%marker)
      call self%marker_table(i)%start_reals(file, &
        self%group//"/markers/"//link_name(trim(self%marker(i))), self%steps, &
        about_t("L", "step; X Y Z", "displacement of the marker"), 3)
    end do
  end subroutine start_markers

  subroutine start_elements(self, file)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), parameter :: forces = "step*element; N Vy Vz T My Mz B", &
                                   dual = "F F F FL FL FL FL2"

    call file%group(self%group//"/elements")
    associate (n => self%now%member%rows, at => self%now%place%rows)
      call start_table(self, file, strain, "elements/strain", n, result_modes, &
        about_t("L", "step*element; mode 1 to 8", "generalized strains"))
      call start_table(self, file, stress, "elements/stress", n, result_modes, &
        about_t("F", "step*element; mode 1 to 8", "stress resultants of the strains"))
      call start_table(self, file, force_p, "elements/section_force_p", n, 7, &
        about_t(dual, forces, "in the section at end p, positive face, its axes"))
      call start_table(self, file, force_q, "elements/section_force_q", n, 7, &
        about_t(dual, forces, "in the section at end q, positive face, its axes"))
      if (at > 0) call start_table(self, file, point_stress, "elements/point_stress", at, &
        stress_parts, about_t("FL-2", "step*place; total axial bending warping", &
                              "axial stress at the places of /model/stress_points"))
    end associate
  end subroutine start_elements

  !> Strains of joints are lengths or angles, by their type.
  subroutine start_joints(self, file)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), parameter :: axes = "step*joint; mode 1 to 6"

    if (self%joints == 0) return
    call file%group(self%group//"/joints")
    call start_table(self, file, joint_strain, "joints/strain", self%joints, joint_strains, &
      about_t("1", axes, "angles or lengths L, by the joint's type; 0 behind its last mode"))
    call start_table(self, file, joint_stress, "joints/stress", self%joints, joint_strains, &
      about_t("FL", axes, "moments or, of lengths, forces F; 0 behind the last mode"))
    if (self%timed) call start_table(self, file, joint_rate, "joints/rate", self%joints, &
      joint_strains, about_t("T-1", axes, "change of the strain with time, of lengths LT-1"))
  end subroutine start_joints

  subroutine start_convergence(self, file)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file

    call file%group(self%group//"/convergence")
    call start_whole(self, file, iterations, "convergence/iterations", &
                     "Newton iterations, those of cut-backs included")
    call start_whole(self, file, cutbacks, "convergence/cutbacks", &
                     "times the increment was halved")
    if (.not. self%timed) then
      call start_whole(self, file, unstable, "convergence/unstable_modes", &
                       "unstable modes of the equilibrium; -1 where STABILITY is OFF")
      call start_list(self, file, arc_length, "convergence/arc_length", "1", &
                      "arc of the step, mean motion in model lengths and radians; 0 else")
    end if
    call start_list(self, file, residual, "convergence/residual", "1", &
                    "largest unbalanced force, relative to the forces")
    call start_list(self, file, increment, "convergence/increment", "1", &
                    "largest change in the last iteration, relative to the motion")
    call start_list(self, file, constraint, "convergence/constraint", "1", &
                    "largest fixed strain, relative to the model's length")
  end subroutine start_convergence

  !> Add a step; `written`: what was kept is in the file now.
  subroutine append_step(self, file, step, results, written)
    class(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    logical, intent(out) :: written
    integer :: i

    call append_numbers(self%table, file, step)
    call append_state(self, file, results)
    if (allocated(step%compliance)) call append_compliance(self%table(compliance), file, &
                                                           step%compliance)
    if (self%timed) then
      call self%table(joint_rate)%append(file, results%joint_rate)
      call self%motion%append(file, self%now%node, results)
    end if
    do i = 1, size(self%marker)
      call self%marker_table(i)%append(file, results%marker(:, i:i))
    end do
    self%pending = modulo(self%pending + 1, self%block)
    written = self%pending == 0
  end subroutine append_step

  !> Whether the present analysis keeps all nodes and elements.
  pure logical function keeps_all(self)
    class(step_tables_t), intent(in) :: self

    keeps_all = self%now%node%all .and. self%now%member%all
  end function keeps_all

  !> Begin with the steps of the same analysis in another file.
  subroutine copy_steps(self, file, source, group, steps)
    class(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(hid_t), intent(in) :: source        !< the other file
    character(len=*), intent(in) :: group       !< of the analysis there
    integer, intent(in) :: steps
    integer :: i

    do i = 1, tables
      call copy_one(self%table(i))
    end do
    do i = 1, size(self%motion%table)
      call copy_one(self%motion%table(i))
    end do
    do i = 1, size(self%marker)
      call copy_one(self%marker_table(i))
    end do
    self%pending = modulo(steps, self%block)

  contains

    subroutine copy_one(table)
      type(table_t), intent(inout) :: table

      if (.not. allocated(table%path)) return
      call table%copy(file, source, group//table%path(len(self%group) + 1:), steps, self%steps)
    end subroutine copy_one

  end subroutine copy_steps

  subroutine append_numbers(table, file, step)
    type(table_t), intent(inout) :: table(:)
    type(hdf5_file_t), intent(inout) :: file
    type(step_t), intent(in) :: step

    call table(step_number)%append(file, step%step)
    call table(load_factor)%append(file, step%factor)
    call table(time)%append(file, step%time)
    call table(time_step)%append(file, step%size)
    call table(iterations)%append(file, step%iterations)
    call table(cutbacks)%append(file, step%cutbacks)
    call table(unstable)%append(file, step%unstable)
    call table(arc_length)%append(file, step%arc)
    call table(residual)%append(file, step%last%residual)
    call table(increment)%append(file, step%last%increment)
    call table(constraint)%append(file, step%last%constraint)
  end subroutine append_numbers

  subroutine append_state(self, file, results)
    type(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(results_t), intent(in) :: results

    associate (t => self%table, node => self%now%node, member => self%now%member)
      call node%append(file, t(displacement), results%displacement)
      call node%append(file, t(euler), results%euler)
      call node%append(file, t(warping), reshape(results%warping, [1, size(results%warping)]))
      call node%append(file, t(reaction), results%reaction)
      call node%append(file, t(load), results%load)
      call member%append(file, t(strain), results%strain)
      call member%append(file, t(stress), results%stress)
      call member%append(file, t(force_p), results%force_p)
      call member%append(file, t(force_q), results%force_q)
      call self%now%place%append(file, t(point_stress), results%point_stress)
      call t(joint_strain)%append(file, results%joint_strain)
      call t(joint_stress)%append(file, results%joint_stress)
    end associate
  end subroutine append_state

  !> Write what is kept and close the datasets.
  subroutine finish(self, file)
    class(step_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer :: i

    do i = 1, tables
      call self%table(i)%finish(file)
    end do
    do i = 1, size(self%motion%table)
      call self%motion%table(i)%finish(file)
    end do
    if (.not. allocated(self%marker_table)) return
    do i = 1, size(self%marker)
      call self%marker_table(i)%finish(file)
    end do
  end subroutine finish

end module output_steps
