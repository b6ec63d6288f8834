!> The recorder of a run: result file, terminal and interruptions together.
module output_recorder
  use kinds, only: wp
  use errors, only: error_t
  use model_data, only: model_t, analysis_t
  use system_results, only: results_t
  use recorder, only: recorder_t, step_t, iteration_t, critical_t, critical_line
  use mode_results, only: modes_t
  use restart_point, only: point_t
  use output_source, only: source_t
  use output_results, only: result_file_t
  use output_log, only: run_log_t, log_normal
  use output_signals, only: signal_watch_t
  implicit none
  private

  public :: run_recorder_t, run_options_t

  !> What the user may choose.
  type :: run_options_t
    character(len=:), allocatable :: deck, output   !< paths
    character(len=:), allocatable :: restart        !< file to go on from; not allocated: none
    logical :: overwrite = .true.
    logical :: progress = .true.
    logical :: drawn = .true.                       !< with /VTKHDF
    integer :: level = log_normal                   !< one of `log_*`
  end type run_options_t

  type, extends(recorder_t) :: run_recorder_t
    private
    character(len=:), allocatable :: path
    type(result_file_t) :: file
    type(run_log_t) :: log
    type(signal_watch_t) :: signals
    type(source_t), allocatable :: source           !< what the run goes on from, until it does
  contains
    procedure :: get_point
    procedure :: open => open_recorder
    procedure :: close => close_recorder
    procedure :: begin => record_begin
    procedure :: iteration => record_iteration
    procedure :: remark => record_remark
    procedure :: step => record_step
    procedure :: modes => record_modes
    procedure :: critical_point => record_critical
    procedure :: compliance => record_compliance
    procedure :: wants_point => ask_point
    procedure :: keep_point => record_point
    procedure :: finish => record_finish
    procedure :: interrupted => ask_interrupted
  end type run_recorder_t

contains

  !> Start the result file and the log.
  subroutine open_recorder(self, options, model, error)
    class(run_recorder_t), intent(inout) :: self
    type(run_options_t), intent(in) :: options
    type(model_t), intent(in) :: model
    type(error_t), allocatable, intent(out) :: error

    self%path = options%output
    call self%signals%start()
    if (allocated(options%restart)) then
      allocate (self%source)
      call self%source%open(options%restart, error)
      if (allocated(error)) return
    end if
    call self%file%open(options%output, options%overwrite, options%drawn, model, error, self%source)
    if (allocated(error)) return
    call self%log%open(options%level, options%progress, options%deck, model)
    if (allocated(self%source)) call self%log%resume(options%restart, self%source%point)
  end subroutine open_recorder

  !> Where the run is to go on; not allocated: at its start.
  subroutine get_point(self, point)
    class(run_recorder_t), intent(in) :: self
    type(point_t), allocatable, intent(out) :: point

    if (allocated(self%source)) allocate (point, source=self%source%point)
  end subroutine get_point

  !> End the result file and print the summary.
  subroutine close_recorder(self, complete, error)
    class(run_recorder_t), intent(inout) :: self
    logical, intent(in) :: complete   !< the run came to its end
    type(error_t), allocatable, intent(out) :: error
    logical :: kept

    call self%file%close(complete, kept, error)
    if (kept) then
      call self%log%close(self%path)
    else
      call self%log%close("")
    end if
  end subroutine close_recorder

  subroutine record_begin(self, number, analysis, error)
    class(run_recorder_t), intent(inout) :: self
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis
    type(error_t), allocatable, intent(out) :: error

    call self%log%begin(number, analysis)
    call self%file%begin(number, analysis, error, self%source)
    if (.not. allocated(self%source)) return
    call self%source%reader%close()
    deallocate (self%source)
  end subroutine record_begin

  subroutine record_iteration(self, iteration)
    class(run_recorder_t), intent(inout) :: self
    type(iteration_t), intent(in) :: iteration

    call self%log%iteration(iteration)
  end subroutine record_iteration

  subroutine record_remark(self, text)
    class(run_recorder_t), intent(inout) :: self
    character(len=*), intent(in) :: text

    call self%log%remark(text)
  end subroutine record_remark

  subroutine record_step(self, step, results, error)
    class(run_recorder_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    type(error_t), allocatable, intent(out) :: error

    call self%file%step(step, results, error)
    if (.not. allocated(error)) call self%log%step(step, results)
  end subroutine record_step

  subroutine record_modes(self, modes_found, error)
    class(run_recorder_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes_found
    type(error_t), allocatable, intent(out) :: error

    call self%file%modes(modes_found, error)
    if (.not. allocated(error)) call self%log%modes(modes_found)
  end subroutine record_modes

  subroutine record_critical(self, point, error)
    class(run_recorder_t), intent(inout) :: self
    type(critical_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error

    call self%remark(critical_line(point))
    call self%file%critical_point(point, error)
  end subroutine record_critical

  subroutine record_compliance(self, node, matrix, error)
    class(run_recorder_t), intent(inout) :: self
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: matrix(:, :, :)
    type(error_t), allocatable, intent(out) :: error

    call self%file%compliance(node, matrix, error)
    if (.not. allocated(error)) call self%log%compliance(node, matrix)
  end subroutine record_compliance

  logical function ask_point(self)
    class(run_recorder_t), intent(inout) :: self

    ask_point = self%file%wants_point()
  end function ask_point

  subroutine record_point(self, point, error)
    class(run_recorder_t), intent(inout) :: self
    type(point_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error

    call self%file%keep_point(point, error)
  end subroutine record_point

  subroutine record_finish(self, complete, error)
    class(run_recorder_t), intent(inout) :: self
    logical, intent(in) :: complete
    type(error_t), allocatable, intent(out) :: error

    call self%log%finish(complete)
    call self%file%finish(complete, error)
  end subroutine record_finish

  logical function ask_interrupted(self)
    class(run_recorder_t), intent(inout) :: self

    ask_interrupted = self%signals%raised()
  end function ask_interrupted

end module output_recorder
