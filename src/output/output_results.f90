!> The result file: OUT.h5.part while the run goes on, OUT.h5 once it has ended.
module output_results
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_io
  use text, only: lower, string_t
  use model_data, only: model_t, analysis_t, analysis_names, analysis_transient
  use model_statement, only: statement_t, get_statements, topics
  use program_version, only: program_name, version
  use recorder, only: step_t, critical_t, critical_name
  use mode_results, only: modes_t
  use system_results, only: results_t
  use output_files, only: file_exists, folder_exists, check_writable, check_unused, &
                          rename_file, remove_file, link_name, same_file
  use output_hdf5, only: hdf5_file_t, about_t
  use output_choice, only: labels_of
  use output_compliance, only: write_compliance
  use output_model, only: write_deck, write_model
  use output_modes, only: write_modes
  use output_schedule, only: has_steps, drawing_rule_t, new_rule
  use output_steps, only: step_tables_t
  use restart_point, only: point_t
  use output_restart, only: restart_writer_t, restart_root
  use output_source, only: source_t
  use output_redraw, only: redraw_before, redraw_motion, redraw_kept
  use output_vtkhdf, only: vtk_writer_t
  implicit none
  private

  public :: result_file_t

  integer, parameter :: layout_version = 1
  type :: result_file_t
    private
    type(hdf5_file_t) :: file
    character(len=:), allocatable :: path
    character(len=:), allocatable :: partial    !< where the file stands until it is complete
    character(len=:), allocatable :: leftover   !< of an older run, contained in this one
    integer, allocatable :: node(:, :)          !< (3, nodes) row from 0, id, part
    logical :: empty = .true.                   !< no result so far
    real(wp) :: time = 0.0_wp                   !< reached so far [T]
    character(len=:), allocatable :: group      !< of the present analysis
    integer :: number = 0, row = 0              !< of it and, from 0, of its next step
    type(step_tables_t) :: table                !< of it
    type(drawing_rule_t) :: rule                !< which of its steps are drawn
    integer :: critical_points = 0              !< of it
    type(vtk_writer_t) :: drawing
    type(restart_writer_t) :: restart
    type(statement_t), allocatable :: statement(:, :)   !< of TRANSIENT: by topic and analysis
    logical :: block_written = .false.          !< with the last step
  contains
    procedure :: open => open_results
    procedure :: begin => begin_analysis
    procedure :: step => keep_step
    procedure :: modes => keep_modes
    procedure :: critical_point => keep_critical
    procedure :: compliance => keep_compliance
    procedure :: wants_point
    procedure :: keep_point
    procedure :: finish => finish_analysis
    procedure :: close => close_results
  end type result_file_t

contains

  !> Start the file with the model and, if the run goes on from a `source`, with the results before
  !> its analysis; nothing is left of it after an error.
  subroutine open_results(self, path, overwrite, drawn, model, error, source)
    class(result_file_t), intent(inout) :: self
    character(len=*), intent(in) :: path
    logical, intent(in) :: overwrite   !< else an existing file is an error
    logical, intent(in) :: drawn       !< with /VTKHDF
    type(model_t), intent(in) :: model
    type(error_t), allocatable, intent(out) :: error
    type(source_t), intent(inout), optional :: source
    integer :: i
    logical :: new

    self%path = path
    self%partial = path//".part"
    if (present(source)) then
      if (same_file(source%reader%path, self%partial)) self%partial = path//".restart.part"
    end if
    new = .not. file_exists(self%partial)
    call check_place(self, overwrite, error)
    if (allocated(error)) return
    self%node = labels_of(model%node)
    call self%table%prepare(model)
    allocate (self%statement(topics, size(model%analysis)))
    do i = 1, size(model%analysis)
      if (model%analysis(i)%kind /= analysis_transient) cycle
      call get_statements(model, i, self%statement(:, i))
    end do
    call self%file%create(self%partial, error)
    if (allocated(error)) then
      if (new) call remove_file(self%partial)
      return
    end if
    call write_head(self%file, model)
    call write_deck(self%file, model)
    call write_model(self%file, model)
    call self%file%group("analysis")
    if (any(model%analysis%kind == analysis_transient)) call self%file%group(restart_root)
    if (drawn) call self%drawing%start(self%file, model)
    if (present(source)) call take_up(self, model, source, error)
    if (.not. allocated(error)) call self%file%flush(error)
    if (allocated(error)) call discard(self)
  end subroutine open_results

  !> Whether files can be written there.
  subroutine check_place(self, overwrite, error)
    type(result_file_t), intent(in) :: self
    logical, intent(in) :: overwrite
    type(error_t), allocatable, intent(out) :: error

    if (file_exists(self%path) .and. .not. overwrite) then
      call fail(error, exit_io, "'"//self%path//"' exists and --no-overwrite is given")
    else if (folder_exists(self%path)) then
      call fail(error, exit_io, "cannot write '"//self%path//"': it is a folder")
    else if (index(self%path, "/dev/") == 1) then
      call fail(error, exit_io, "cannot write '"//self%path//"': it is no place for a file")
    else
      call check_writable(self%partial, error)
      if (.not. allocated(error)) call check_unused(self%partial, error)
    end if
  end subroutine check_place

  !> The run goes on from a file of the same model, whose earlier analyses are copied.
  subroutine take_up(self, model, source, error)
    type(result_file_t), intent(inout) :: self
    type(model_t), intent(in) :: model
    type(source_t), intent(inout) :: source
    type(error_t), allocatable, intent(out) :: error
    type(string_t) :: names(size(model%analysis))
    integer :: i

    call source%check_model(self%file, model, error)
    if (allocated(error)) return
    call source%check_deck(model, self%statement(:, source%point%analysis), error)
    if (allocated(error)) return
    do i = 1, size(names)
      names(i)%s = group_name(i, model%analysis(i))
    end do
    call source%copy_before(self%file, names)
    call redraw_before(source, self%file, self%drawing)
    self%time = source%point%start
    associate (old => source%reader%path, at => self%path)
      if (any([same_file(old, at//".part"), same_file(old, at//".restart.part")])) then
        self%leftover = old
      end if
    end associate
  end subroutine take_up

  subroutine write_head(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model

    call file%set_text("/", "program", program_name)
    call file%set_text("/", "version", version)
    call file%set_number("/", "layout_version", layout_version)
    call file%set_text("/", "title", model%title)
    call file%set_number("/", "complete", 0)
  end subroutine write_head

  !> Make the group of an analysis with its empty datasets; if it goes on from a `source`, with what
  !> that holds of it.
  subroutine begin_analysis(self, number, analysis, error, source)
    class(result_file_t), intent(inout) :: self
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis
    type(error_t), allocatable, intent(out) :: error
    type(source_t), intent(in), optional :: source

    self%number = number
    self%row = 0
    self%critical_points = 0
    self%rule = new_rule(analysis, self%time)
    self%group = "analysis/"//group_name(number, analysis)
    call self%file%group(self%group)
    call self%file%set_text(self%group, "kind", lower(trim(analysis_names(analysis%kind))))
    call self%file%set_number(self%group, "complete", 0)
    if (has_steps(analysis%kind)) then
      call self%table%begin(self%file, self%group, analysis, self%time)
    end if
    call self%restart%begin(group_name(number, analysis), self%statement(:, number))
    if (present(source)) call take_up_analysis(self, source, error)
    if (.not. allocated(error)) call self%file%flush(error)
  end subroutine begin_analysis

  !> Name of the group of an analysis.
  function group_name(number, analysis) result(name)
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis
    character(len=:), allocatable :: name
    character(len=12) :: digits

    write (digits, "(i0.2)") number
    name = trim(digits)//"_"//lower(trim(analysis_names(analysis%kind)))
    if (analysis%name /= "") name = trim(digits)//"_"//link_name(trim(analysis%name))
  end function group_name

  !> Begin with the states before a restart point.
  subroutine take_up_analysis(self, source, error)
    type(result_file_t), intent(inout) :: self
    type(source_t), intent(in) :: source
    type(error_t), allocatable, intent(out) :: error
    type(results_t) :: last
    real(wp) :: time(1, source%point%states)
    logical :: wanted(source%point%states)
    character(len=:), allocatable :: group
    integer :: i

    group = "/analysis/"//source%group
    call source%check_choice(self%file, self%group, error)
    if (allocated(error)) return
    call self%table%copy(self%file, source%reader%file, group, source%point%states)
    call source%read_rows(group//"/time", 0_i8, time)
    call source%check_times(time(1, :), error)
    if (allocated(error)) return
    do i = 1, size(wanted)
      wanted(i) = self%rule%draws(time(1, i))
    end do
    if (self%table%keeps_all()) then
      call redraw_motion(source, wanted, self%file, self%drawing)
    else
      call redraw_kept(source, wanted, self%file, self%drawing)
    end if
    last%displacement = source%point%state%displacement
    last%euler = source%point%state%euler
    last%warping = source%point%state%warping
    self%row = source%point%states
    call self%drawing%add_state(self%file, self%number, self%row - 1, last, .false.)
    self%time = source%point%time
    self%empty = .false.
    call self%file%flush(error)
  end subroutine take_up_analysis

  !> Add a converged step; flush, in time once a block of steps is full.
  subroutine keep_step(self, step, results, error)
    class(result_file_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    type(error_t), allocatable, intent(out) :: error

    call self%table%append(self%file, step, results, self%block_written)
    call self%drawing%add_state(self%file, self%number, self%row, results, &
                                self%rule%draws(step%time))
    self%row = self%row + 1
    self%time = max(self%time, step%time)
    if (self%block_written) call self%file%flush(error)
    if (.not. allocated(error)) self%empty = .false.
  end subroutine keep_step

  !> Whether it is time for a restart point: all states are in the file.
  logical function wants_point(self)
    class(result_file_t), intent(inout) :: self

    wants_point = self%block_written
    self%block_written = .false.
    if (wants_point) call self%drawing%write_pending(self%file)
  end function wants_point

  !> Write a restart point of the present analysis.
  subroutine keep_point(self, point, error)
    class(result_file_t), intent(inout) :: self
    type(point_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error
    type(point_t) :: numbered

    numbered = point
    numbered%analysis = self%number
    call self%restart%keep(self%file, numbered, error)
  end subroutine keep_point

  !> Write the modes of the analysis and flush.
  subroutine keep_modes(self, modes, error)
    class(result_file_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes
    type(error_t), allocatable, intent(out) :: error

    call write_modes(self%file, self%group, modes)
    call self%drawing%add_modes(self%file, self%number, modes)
    call self%file%flush(error)
    if (.not. allocated(error)) self%empty = .false.
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

  !> Write how nodes yield to loads, and flush.
  subroutine keep_compliance(self, node, matrix, error)
    class(result_file_t), intent(inout) :: self
    integer, intent(in) :: node(:)             !< indices
    real(wp), intent(in) :: matrix(:, :, :)    !< (6, 6, nodes), see `recorder_t`
    type(error_t), allocatable, intent(out) :: error

    call write_compliance(self%file, self%group, self%node(:, node), matrix)
    call self%file%flush(error)
    if (.not. allocated(error)) self%empty = .false.
  end subroutine keep_compliance

  !> Write what is left of the analysis.
  subroutine finish_analysis(self, complete, error)
    class(result_file_t), intent(inout) :: self
    logical, intent(in) :: complete
    type(error_t), allocatable, intent(out) :: error

    call self%table%finish(self%file)
    call self%drawing%end_analysis(self%file, self%number)
    call self%restart%finish(self%file)
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
    if (self%empty .and. .not. complete) then
      call discard(self)
      return
    end if
    if (complete) call self%file%set_number("/", "complete", 1)
    call self%file%close(error)
    if (.not. allocated(error)) call rename_file(self%partial, self%path, error)
    kept = .not. allocated(error)
    if (.not. kept) call discard(self)
    if (kept .and. allocated(self%leftover)) call remove_file(self%leftover)
  end subroutine close_results

  !> Remove what was written.
  subroutine discard(self)
    type(result_file_t), intent(inout) :: self
    type(error_t), allocatable :: error

    call self%file%close(error)
    call remove_file(self%partial)
  end subroutine discard

end module output_results
