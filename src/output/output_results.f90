!> The result file: OUT.h5.part while the run goes on, OUT.h5 once it has ended.
module output_results
  use kinds, only: wp
  use errors, only: error_t, fail, exit_io
  use text, only: lower
  use model_data, only: model_t, analysis_t, analysis_names
  use program_version, only: program_name, version
  use recorder, only: step_t, critical_t, critical_name
  use mode_results, only: modes_t
  use system_results, only: results_t
  use output_files, only: file_exists, folder_exists, check_writable, check_unused, &
                          rename_file, remove_file, link_name
  use output_hdf5, only: hdf5_file_t, about_t
  use output_choice, only: labels_of
  use output_compliance, only: write_compliance
  use output_model, only: write_deck, write_model
  use output_modes, only: write_modes
  use output_schedule, only: has_steps, drawing_rule_t, new_rule
  use output_steps, only: step_tables_t
  use output_vtkhdf, only: vtk_writer_t
  implicit none
  private

  public :: result_file_t

  integer, parameter :: layout_version = 1
  type :: result_file_t
    private
    type(hdf5_file_t) :: file
    character(len=:), allocatable :: path
    integer, allocatable :: node(:, :)          !< (3, nodes) row from 0, id, part
    logical :: empty = .true.                   !< no result so far
    real(wp) :: time = 0.0_wp                   !< reached so far [T]
    character(len=:), allocatable :: group      !< of the present analysis
    integer :: number = 0, row = 0              !< of it and, from 0, of its next step
    type(step_tables_t) :: table                !< of it
    type(drawing_rule_t) :: rule                !< which of its steps are drawn
    integer :: critical_points = 0              !< of it
    type(vtk_writer_t) :: drawing
  contains
    procedure :: open => open_results
    procedure :: begin => begin_analysis
    procedure :: step => keep_step
    procedure :: modes => keep_modes
    procedure :: critical_point => keep_critical
    procedure :: compliance => keep_compliance
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
    self%node = labels_of(model%node)
    call self%table%prepare(model)
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
    character(len=:), allocatable :: kind

    kind = lower(trim(analysis_names(analysis%kind)))
    self%number = number
    self%row = 0
    self%critical_points = 0
    self%rule = new_rule(analysis, self%time)
    write (digits, "(i0.2)") number
    self%group = "analysis/"//trim(digits)//"_"//kind
    if (analysis%name /= "") then
      self%group = "analysis/"//trim(digits)//"_"//link_name(trim(analysis%name))
    end if
    call self%file%group(self%group)
    call self%file%set_text(self%group, "kind", kind)
    call self%file%set_number(self%group, "complete", 0)
    if (has_steps(analysis%kind)) then
      call self%table%begin(self%file, self%group, analysis, self%time)
    end if
    call self%file%flush(error)
  end subroutine begin_analysis

  !> Add a converged step; flush, in time once a block of steps is full.
  subroutine keep_step(self, step, results, error)
    class(result_file_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    type(error_t), allocatable, intent(out) :: error
    logical :: written

    call self%table%append(self%file, step, results, written)
    call self%drawing%add_state(self%file, self%number, self%row, results, &
                                self%rule%draws(step%time))
    self%row = self%row + 1
    self%time = max(self%time, step%time)
    if (written) call self%file%flush(error)
    if (.not. allocated(error)) self%empty = .false.
  end subroutine keep_step

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
    call self%drawing%write_pending(self%file)
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
