!> A recorder that keeps everything in memory, and a deck run with it.
module memory_recorder
  use kinds, only: wp
  use check, only: expect
  use errors, only: error_t
  use model_data, only: model_t, analysis_t, setting_t
  use diagnostics, only: report_t
  use deck_reader, only: read_deck
  use recorder, only: recorder_t, iteration_t, step_t, critical_t
  use system_results, only: results_t
  use mode_results, only: modes_t
  use analysis_run, only: run_analyses
  use text, only: string_t
  implicit none
  private

  public :: memory_t, run_deck, run_sound, run_model, node_index

  type, extends(recorder_t) :: memory_t
    integer :: steps = 0
    integer :: iterations = 0
    integer :: stop_after = huge(1)           !< say "interrupted" after so many iterations
    type(step_t), allocatable :: record(:)
    type(results_t), allocatable :: results(:)
    type(string_t), allocatable :: remarks(:)
    logical, allocatable :: completed(:)      !< by analysis
    type(modes_t), allocatable :: spectrum(:) !< of BUCKLING and EIGEN, in their order
    type(critical_t), allocatable :: critical(:)
    real(wp), allocatable :: compliances(:, :, :)  !< of the last COMPLIANCE
  contains
    procedure :: begin => memory_begin
    procedure :: iteration => memory_iteration
    procedure :: remark => memory_remark
    procedure :: critical_point => memory_critical
    procedure :: compliance => memory_compliance
    procedure :: step => memory_step
    procedure :: modes => memory_modes
    procedure :: finish => memory_finish
    procedure :: interrupted => memory_interrupted
  end type memory_t

contains

  !> Read and run a deck of tests/cases/static; `settings`: as -D "name=value".
  subroutine run_deck(name, memory, model, error, settings)
    character(len=*), intent(in) :: name
    type(memory_t), intent(inout) :: memory
    type(model_t), intent(out) :: model
    type(error_t), allocatable, intent(out) :: error
    character(len=*), intent(in), optional :: settings(:)
    type(setting_t), allocatable :: override(:)
    type(report_t) :: report
    integer :: i, at

    allocate (override(0))
    if (present(settings)) then
      deallocate (override)
      allocate (override(size(settings)))
      do i = 1, size(settings)
        at = index(settings(i), "=")
        override(i)%name = settings(i)(:at - 1)
        override(i)%value = trim(adjustl(settings(i)(at + 1:)))
      end do
    end if
    call reset(memory)
    call read_deck("tests/cases/static/"//name//".deck", override, model, report, error)
    if (allocated(error)) return
    if (report%errors() > 0) then
      call report%print(6)
      allocate (error)
      error%message = "errors in the deck "//name
      return
    end if
    call run_model(model, memory, error)
  end subroutine run_deck

  !> Run a deck and complain of any error.
  subroutine run_sound(name, memory, model, settings)
    character(len=*), intent(in) :: name
    type(memory_t), intent(inout) :: memory
    type(model_t), intent(out) :: model
    character(len=*), intent(in), optional :: settings(:)
    type(error_t), allocatable :: error

    call run_deck(name, memory, model, error, settings)
    if (.not. allocated(error)) return
    call expect(.false., "no error in "//name//", got: "//error%message)
  end subroutine run_sound

  !> Index of the node with an id (part 0).
  pure integer function node_index(model, id)
    type(model_t), intent(in) :: model
    integer, intent(in) :: id

    node_index = findloc(model%node%id == id .and. model%node%part == 0, .true., 1)
  end function node_index

  !> Run a model from the start.
  subroutine run_model(model, memory, error)
    type(model_t), intent(in) :: model
    type(memory_t), intent(inout) :: memory
    type(error_t), allocatable, intent(out) :: error

    call reset(memory)
    call run_analyses(model, memory, error)
  end subroutine run_model

  subroutine reset(memory)
    type(memory_t), intent(inout) :: memory

    memory%steps = 0
    if (allocated(memory%record)) deallocate (memory%record, memory%results)
    if (allocated(memory%remarks)) deallocate (memory%remarks, memory%completed, memory%critical)
    if (allocated(memory%spectrum)) deallocate (memory%spectrum)
    allocate (memory%record(400), memory%results(400), memory%remarks(0), memory%completed(0))
    allocate (memory%spectrum(0))
    allocate (memory%critical(0))
  end subroutine reset

  subroutine memory_begin(self, number, analysis, error)
    class(memory_t), intent(inout) :: self
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis
    type(error_t), allocatable, intent(out) :: error

    if (number /= size(self%completed) + 1 .or. analysis%steps < 1) allocate (error)
  end subroutine memory_begin

  subroutine memory_iteration(self, iteration)
    class(memory_t), intent(inout) :: self
    type(iteration_t), intent(in) :: iteration

    if (iteration%iteration > 0) self%iterations = self%iterations + 1
  end subroutine memory_iteration

  subroutine memory_remark(self, text)
    class(memory_t), intent(inout) :: self
    character(len=*), intent(in) :: text
    type(string_t), allocatable :: more(:)
    integer :: n

    n = size(self%remarks)
    allocate (more(n + 1))
    more(:n) = self%remarks
    more(n + 1)%s = text
    call move_alloc(more, self%remarks)
  end subroutine memory_remark

  subroutine memory_critical(self, point, error)
    class(memory_t), intent(inout) :: self
    type(critical_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error
    type(critical_t), allocatable :: more(:)
    integer :: n

    n = size(self%critical)
    allocate (more(n + 1))
    more(:n) = self%critical
    more(n + 1) = point
    call move_alloc(more, self%critical)
    if (point%step < 0) allocate (error)
  end subroutine memory_critical

  subroutine memory_compliance(self, node, matrix, error)
    class(memory_t), intent(inout) :: self
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: matrix(:, :, :)
    type(error_t), allocatable, intent(out) :: error

    self%compliances = matrix
    if (size(node) /= size(matrix, 3)) allocate (error)
  end subroutine memory_compliance

  subroutine memory_step(self, step, results, error)
    class(memory_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    type(error_t), allocatable, intent(out) :: error

    if (self%steps >= size(self%record)) then
      allocate (error)
      return
    end if
    self%steps = self%steps + 1
    self%record(self%steps) = step
    self%results(self%steps) = results
  end subroutine memory_step

  subroutine memory_modes(self, modes_found, error)
    class(memory_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes_found
    type(error_t), allocatable, intent(out) :: error
    type(modes_t), allocatable :: more(:)

    allocate (more(size(self%spectrum) + 1))
    more(:size(self%spectrum)) = self%spectrum
    more(size(more)) = modes_found
    call move_alloc(more, self%spectrum)
    if (modes_found%modes < 0) allocate (error)
  end subroutine memory_modes

  subroutine memory_finish(self, complete, error)
    class(memory_t), intent(inout) :: self
    logical, intent(in) :: complete
    type(error_t), allocatable, intent(out) :: error
    logical, allocatable :: all_of_them(:)

    allocate (all_of_them(size(self%completed) + 1))
    all_of_them(:) = [self%completed, complete]
    call move_alloc(all_of_them, self%completed)
    if (self%steps < 0) allocate (error)
  end subroutine memory_finish

  logical function memory_interrupted(self)
    class(memory_t), intent(inout) :: self

    memory_interrupted = self%iterations >= self%stop_after
  end function memory_interrupted

end module memory_recorder
