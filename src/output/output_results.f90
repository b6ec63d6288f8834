!> The result file: OUT.h5.part while the run goes on, OUT.h5 once it has ended.
module output_results
  use kinds, only: i8
  use errors, only: error_t, fail, exit_io
  use model_data, only: model_t, analysis_t, analysis_static, name_length, control_arc
  use program_version, only: program_name, version
  use recorder, only: step_t, critical_t, critical_name
  use mode_results, only: modes_t
  use system_results, only: results_t, result_modes
  use system_stress, only: stress_places, stress_parts
  use output_files, only: file_exists, folder_exists, check_writable, check_unused, &
                          rename_file, remove_file, link_name
  use output_hdf5, only: hdf5_file_t, about_t
  use output_tables, only: table_t
  use output_model, only: write_deck, write_model
  use output_modes, only: write_modes
  use output_vtkhdf, only: vtk_writer_t
  implicit none
  private

  public :: result_file_t

  integer, parameter :: layout_version = 1
  character(len=*), parameter :: kind_names(3) = ["static  ", "buckling", "eigen   "]

  integer, parameter :: load_factor = 1, displacement = 2, euler = 3, warping = 4, reaction = 5, &
                        load = 6, strain = 7, stress = 8, force_p = 9, force_q = 10, &
                        residual = 11, increment = 12, constraint = 13, point_stress = 14, &
                        arc_length = 15, reals = 15
  integer, parameter :: step_number = 1, iterations = 2, cutbacks = 3, unstable = 4, wholes = 4

  type :: result_file_t
    private
    type(hdf5_file_t) :: file
    character(len=:), allocatable :: path
    character(len=name_length), allocatable :: marker(:)
    integer :: nodes = 0, members = 0
    integer :: stress_places = 0                !< points where stresses are kept
    integer :: steps = 0                        !< kept so far, in all analyses
    character(len=:), allocatable :: group      !< of the present analysis
    logical :: stepping = .true.                !< it has steps, else modes
    integer :: number = 0                       !< of the present analysis
    type(vtk_writer_t) :: drawing
    integer :: critical_points = 0              !< of the present analysis
    type(table_t) :: real_table(reals), whole_table(wholes)
    type(table_t), allocatable :: marker_table(:)
  contains
    procedure :: open => open_results
    procedure :: begin => begin_analysis
    procedure :: step => keep_step
    procedure :: modes => keep_modes
    procedure :: critical_point => keep_critical
    procedure :: finish => finish_analysis
    procedure :: close => close_results
  end type result_file_t

contains

  !> Start the file with the model; nothing is left of it after an error.
  subroutine open_results(self, path, overwrite, drawn, model, error)
    class(result_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    logical, intent(in) :: overwrite   !< else an existing file is an error
    logical, intent(in) :: drawn       !< with /VTKHDF
    type(model_t), intent(in) :: model
    type(error_t), allocatable, intent(out) :: error
    logical :: exists, new

    self%path = path
    exists = file_exists(path)
    new = .not. file_exists(partial(self))
    if (exists .and. .not. overwrite) then
      call fail(error, exit_io, "'"//path//"' exists and --no-overwrite is given")
    else if (folder_exists(path)) then
      call fail(error, exit_io, "cannot write '"//path//"': it is a folder")
    else if (index(path, "/dev/") == 1) then
      call fail(error, exit_io, "cannot write '"//path//"': it is no place for a file")
    else
      call check_writable(partial(self), error)
      if (.not. allocated(error)) call check_unused(partial(self), error)
    end if
    if (allocated(error)) return
    self%nodes = size(model%node)
    self%members = size(model%member)
    self%stress_places = size(stress_places(model))
    self%marker = model%marker%name
    call self%file%create(partial(self), error)
    if (allocated(error)) then
      if (new) call remove_file(partial(self))
      return
    end if
    call write_head(self%file, model)
    call write_deck(self%file, model)
    call write_model(self%file, model)
    call self%file%group("analysis")
    if (drawn) call self%drawing%start(self%file, model)
    call self%file%flush(error)
    if (allocated(error)) call discard(self)
  end subroutine open_results

  !> Where the file stands until it is complete.
  pure function partial(self)
    type(result_file_t), intent(in) :: self
    character(len=:), allocatable :: partial

    partial = self%path//".part"
  end function partial

  subroutine write_head(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model

    call file%set_text("/", "program", program_name)
    call file%set_text("/", "version", version)
    call file%set_number("/", "layout_version", layout_version)
    call file%set_text("/", "title", model%title)
    call file%set_number("/", "complete", 0)
  end subroutine write_head

  !> Make the group of an analysis with its empty datasets.
  subroutine begin_analysis(self, number, analysis, error)
    class(result_file_t), intent(inout) :: self
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis
    type(error_t), allocatable, intent(out) :: error
    character(len=12) :: digits
    integer(i8) :: steps

    steps = merge(analysis%most_steps, analysis%steps, analysis%control == control_arc)
    self%number = number
    write (digits, "(i0.2)") number
    self%group = "analysis/"//trim(digits)//"_"//trim(kind_names(analysis%kind))
    if (analysis%name /= "") then
      self%group = "analysis/"//trim(digits)//"_"//link_name(trim(analysis%name))
    end if
    call self%file%group(self%group)
    call self%file%set_text(self%group, "kind", trim(kind_names(analysis%kind)))
    call self%file%set_number(self%group, "complete", 0)
    self%critical_points = 0
    self%stepping = analysis%kind == analysis_static
    if (.not. self%stepping) return
    call start_steps(self, steps)
    call start_nodes(self, steps)
    call start_markers(self, steps)
    call start_elements(self, steps)
    call start_convergence(self, steps)
    call self%file%flush(error)
  end subroutine begin_analysis

  subroutine start_steps(self, steps)
    type(result_file_t), intent(inout) :: self
    integer(i8), intent(in) :: steps

    call self%whole_table(step_number)%start_integers(self%file, self%group//"/step", steps, &
      about_t("1", "step", "number of the recorded step, from 1"))
    call self%real_table(load_factor)%start_reals(self%file, self%group//"/load_factor", steps, &
      about_t("1", "step", "factor of the load pattern"))
  end subroutine start_steps

  subroutine start_nodes(self, steps)
    type(result_file_t), intent(inout) :: self
    integer(i8), intent(in) :: steps
    character(len=*), parameter :: of_all = "step*node; X Y Z RX RY RZ W", &
                                   dual = "F F F FL FL FL FL2"

    call self%file%group(self%group//"/nodes")
    call start_table(self, displacement, "nodes/displacement", steps*self%nodes, 3, &
      about_t("L", "step*node; X Y Z", "from the initial position"))
    call start_table(self, euler, "nodes/euler", steps*self%nodes, 4, &
      about_t("1", "step*node; e0 e1 e2 e3", "Euler parameters of the rotation, scalar first"))
    call self%real_table(warping)%start_reals(self%file, self%group//"/nodes/warping", &
      steps*self%nodes, about_t("L-1", "step*node", "warping coordinate, a rate of twist"))
    call start_table(self, reaction, "nodes/reaction", steps*self%nodes, 7, &
      about_t(dual, of_all, "forces, moments, bimoment of supports, 0 where nothing is fixed"))
    call start_table(self, load, "nodes/load", steps*self%nodes, 7, &
      about_t(dual, of_all, "forces, moments, bimoment applied"))
  end subroutine start_nodes

  subroutine start_markers(self, steps)
    type(result_file_t), intent(inout) :: self
    integer(i8), intent(in) :: steps
    integer :: i

    if (.not. allocated(self%marker_table)) allocate (self%marker_table(size(self%marker)))
    if (size(self%marker) == 0) return
    call self%file%group(self%group//"/markers")
    do i = 1, size(self%marker)
      call self%marker_table(i)%start_reals(self%file, &
        self%group//"/markers/"//link_name(trim(self%marker(i))), steps, &
        about_t("L", "step; X Y Z", "displacement of the marker"), 3)
    end do
  end subroutine start_markers

  subroutine start_elements(self, steps)
    type(result_file_t), intent(inout) :: self
    integer(i8), intent(in) :: steps
    character(len=*), parameter :: forces = "step*element; N Vy Vz T My Mz B"

    call self%file%group(self%group//"/elements")
    call start_table(self, strain, "elements/strain", steps*self%members, result_modes, &
      about_t("L", "step*element; mode 1 to 8", "generalized strains"))
    call start_table(self, stress, "elements/stress", steps*self%members, result_modes, &
      about_t("F", "step*element; mode 1 to 8", "stress resultants of the strains"))
    call start_table(self, force_p, "elements/section_force_p", steps*self%members, 7, &
      about_t("F F F FL FL FL FL2", forces, "in the section at end p, positive face, its axes"))
    call start_table(self, force_q, "elements/section_force_q", steps*self%members, 7, &
      about_t("F F F FL FL FL FL2", forces, "in the section at end q, positive face, its axes"))
    if (self%stress_places == 0) return
    call start_table(self, point_stress, "elements/point_stress", steps*self%stress_places, &
      stress_parts, about_t("FL-2", "step*place; total axial bending warping", &
      "axial stress at the places of /model/stress_points"))
  end subroutine start_elements

  subroutine start_convergence(self, steps)
    type(result_file_t), intent(inout) :: self
    integer(i8), intent(in) :: steps
    character(len=:), allocatable :: group

    group = self%group//"/convergence"
    call self%file%group(group)
    call self%whole_table(iterations)%start_integers(self%file, group//"/iterations", steps, &
      about_t("1", "step", "Newton iterations, those of cut-backs included"))
    call self%whole_table(cutbacks)%start_integers(self%file, group//"/cutbacks", steps, &
      about_t("1", "step", "times the increment was halved"))
    call self%whole_table(unstable)%start_integers(self%file, group//"/unstable_modes", steps, &
      about_t("1", "step", "unstable modes of the equilibrium; -1 where STABILITY is OFF"))
    call self%real_table(arc_length)%start_reals(self%file, group//"/arc_length", steps, &
      about_t("1", "step", "arc of the step, mean motion in model lengths and radians; 0 else"))
    call self%real_table(residual)%start_reals(self%file, group//"/residual", steps, &
      about_t("1", "step", "largest unbalanced force, relative to the forces"))
    call self%real_table(increment)%start_reals(self%file, group//"/increment", steps, &
      about_t("1", "step", "largest change in the last iteration, relative to the motion"))
    call self%real_table(constraint)%start_reals(self%file, group//"/constraint", steps, &
      about_t("1", "step", "largest fixed strain, relative to the model's length"))
  end subroutine start_convergence

  subroutine start_table(self, which, name, rows, columns, about)
    type(result_file_t), intent(inout) :: self
    integer, intent(in) :: which, columns
    integer(i8), intent(in) :: rows
    character(len=*), intent(in) :: name
    type(about_t), intent(in) :: about

    call self%real_table(which)%start_reals(self%file, self%group//"/"//name, rows, about, columns)
  end subroutine start_table

  !> Add a converged step and flush.
  subroutine keep_step(self, step, results, error)
    class(result_file_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    associate (file => self%file, table => self%real_table, whole => self%whole_table)
      call whole(step_number)%append(file, step%step)
      call whole(iterations)%append(file, step%iterations)
      call whole(cutbacks)%append(file, step%cutbacks)
      call whole(unstable)%append(file, step%unstable)
      call table(arc_length)%append(file, step%arc)
      call table(load_factor)%append(file, step%factor)
      call table(residual)%append(file, step%last%residual)
      call table(increment)%append(file, step%last%increment)
      call table(constraint)%append(file, step%last%constraint)
      call table(displacement)%append(file, results%displacement)
      call table(euler)%append(file, results%euler)
      call table(warping)%append(file, results%warping)
      call table(reaction)%append(file, results%reaction)
      call table(load)%append(file, results%load)
      call table(strain)%append(file, results%strain)
      call table(stress)%append(file, results%stress)
      call table(force_p)%append(file, results%force_p)
      call table(force_q)%append(file, results%force_q)
      if (self%stress_places > 0) call table(point_stress)%append(file, results%point_stress)
      do i = 1, size(self%marker)
        call self%marker_table(i)%append(file, results%marker(:, i:i))
      end do
      call self%drawing%add_state(file, self%number, step%step - 1, results)
      call file%flush(error)
    end associate
    if (.not. allocated(error)) self%steps = self%steps + 1
  end subroutine keep_step

  !> Write the modes of the analysis and flush.
  subroutine keep_modes(self, modes, error)
    class(result_file_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes
    type(error_t), allocatable, intent(out) :: error

    call write_modes(self%file, self%group, modes)
    call self%drawing%add_modes(self%file, self%number, modes)
    call self%file%flush(error)
    if (.not. allocated(error)) self%steps = self%steps + 1
  end subroutine keep_modes

  !> Write a critical point, with its mode, and flush.
  subroutine keep_critical(self, point, error)
    class(result_file_t), intent(inout) :: self
    type(critical_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: group
    character(len=4) :: number

    if (self%critical_points == 0) call self%file%group(self%group//"/critical")
    self%critical_points = self%critical_points + 1
    write (number, "(i4.4)") self%critical_points
    group = self%group//"/critical/"//number
    call self%file%group(group)
    call self%file%set_text(group, "kind", trim(critical_name(point%kind)))
    call self%file%set_number(group, "step", point%step)
    call self%file%set_number(group, "unstable_before", point%before)
    call self%file%set_number(group, "unstable_behind", point%behind)
    call self%file%write(group//"/load_factor", [point%factor], &
      about_t("1", "point", "load factor of the critical point"))
    call self%file%write(group//"/displacement", point%mode(1:3, :), &
      about_t("L", "node; X Y Z", "displacement of the critical mode"))
    call self%file%write(group//"/rotation", point%mode(4:6, :), &
      about_t("1", "node; RX RY RZ", "small rotation of the critical mode, global axes"))
    call self%file%write(group//"/warping", point%mode(7, :), &
      about_t("L-1", "node", "warping coordinate of the critical mode"))
    call self%drawing%add_critical(point%mode)
    call self%file%flush(error)
  end subroutine keep_critical

  !> Close the datasets of the analysis.
  subroutine finish_analysis(self, complete, error)
    class(result_file_t), intent(inout) :: self
    logical, intent(in) :: complete
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    do i = 1, merge(reals, 0, self%stepping)
      if (i == point_stress .and. self%stress_places == 0) cycle
      call self%real_table(i)%finish(self%file)
    end do
    do i = 1, merge(wholes, 0, self%stepping)
      call self%whole_table(i)%finish(self%file)
    end do
    do i = 1, merge(size(self%marker), 0, self%stepping)
      call self%marker_table(i)%finish(self%file)
    end do
    call self%drawing%end_analysis(self%file, self%number)
    if (complete) call self%file%set_number(self%group, "complete", 1)
    call self%file%flush(error)
  end subroutine finish_analysis

  !> Close the file and give it its name, if it holds anything and was written without error.
  subroutine close_results(self, complete, kept, error)
    class(result_file_t), intent(inout) :: self
    logical, intent(in) :: complete   !< the run came to its end
    logical, intent(out) :: kept      !< the result file exists
    type(error_t), allocatable, intent(out) :: error

    kept = .false.
    if (self%steps == 0 .and. .not. complete) then
      call discard(self)
      return
    end if
    if (complete) call self%file%set_number("/", "complete", 1)
    call self%file%close(error)
    if (.not. allocated(error)) call rename_file(partial(self), self%path, error)
    kept = .not. allocated(error)
    if (.not. kept) call discard(self)
  end subroutine close_results

  !> Remove what was written.
  subroutine discard(self)
    type(result_file_t), intent(inout) :: self
    type(error_t), allocatable :: error

    call self%file%close(error)
    call remove_file(partial(self))
  end subroutine discard

end module output_results
