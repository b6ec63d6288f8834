!> A recorder of motions in time that keeps everything in memory, and a deck run with it.
module motion_recorder
  use kinds, only: wp
  use check, only: expect
  use errors, only: error_t
  use model_data, only: model_t, analysis_t, setting_t
  use diagnostics, only: report_t
  use deck_reader, only: read_deck
  use recorder, only: recorder_t, iteration_t, step_t
  use system_results, only: results_t
  use mode_results, only: modes_t
  use analysis_run, only: run_analyses
  use text, only: string_t
  implicit none
  private

  public :: motion_t, follow, setting, observed_order

  type, extends(recorder_t) :: motion_t
    logical :: kept = .true.                !< false: only the last step is, as number 1
    integer :: steps = 0                    !< kept, with the start
    real(wp), allocatable :: time(:), size(:)
    type(results_t), allocatable :: results(:)
    real(wp) :: constraint = 0.0_wp         !< largest gap of all steps
    integer :: refused = 0                  !< steps
    real(wp), allocatable :: frequency(:)   !< of EIGEN
    type(string_t), allocatable :: remarks(:)
    logical :: complete = .true.
  contains
    procedure :: begin => motion_begin
    procedure :: iteration => motion_iteration
    procedure :: remark => motion_remark
    procedure :: step => motion_step
    procedure :: modes => motion_modes
    procedure :: finish => motion_finish
    procedure :: interrupted => motion_interrupted
    procedure :: at => step_at
  end type motion_t

  interface setting
    module procedure :: real_setting, text_setting
  end interface setting

contains

  !> Run a deck of tests/cases/transient, which has to succeed; `settings`: as -D "name=value".
  subroutine follow(name, motion, model, settings)
    character(len=*), intent(in) :: name
    type(motion_t), intent(inout) :: motion
    type(model_t), intent(out) :: model
    character(len=*), intent(in) :: settings(:)
    type(setting_t), allocatable :: override(:)
    type(report_t) :: report
    type(error_t), allocatable :: error
    integer :: i, at

    allocate (override(size(settings)))
    do i = 1, size(settings)
      at = index(settings(i), "=")
      override(i)%name = settings(i)(:at - 1)
      override(i)%value = trim(adjustl(settings(i)(at + 1:)))
    end do
    call clear(motion)
    call read_deck("tests/cases/transient/"//trim(name)//".deck", override, model, report, error)
    if (report%errors() > 0) call report%print(6)
    call expect(.not. allocated(error) .and. report%errors() == 0, name//": read")
    if (allocated(error) .or. report%errors() > 0) return
    call run_analyses(model, motion, error)
    call expect(.not. allocated(error), name//": run without error")
    if (allocated(error)) call expect(.false., "no error like this: "//error%message)
  end subroutine follow

  !> As before the first run, with one empty result, so that what a test asks for is there.
  subroutine clear(motion)
    type(motion_t), intent(inout) :: motion

    motion%steps = 0
    motion%constraint = 0
    motion%refused = 0
    motion%complete = .true.
    if (allocated(motion%time)) deallocate (motion%time, motion%size, motion%results)
    if (allocated(motion%remarks)) deallocate (motion%remarks)
    allocate (motion%time(1), motion%size(1), motion%results(1), motion%remarks(0))
    motion%time = 0
    motion%size = 0
  end subroutine clear

  !> "name=value" with all digits.
  pure function real_setting(name, value) result(text)
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: value
    character(len=40) :: text

    write (text, "(a, '=', es23.16)") name, value
  end function real_setting

  pure function text_setting(name, value) result(text)
    character(len=*), intent(in) :: name, value
    character(len=40) :: text

    text = name//"="//value
  end function text_setting

  !> Order of convergence from errors whose step lengths are halved one after the other.
  pure real(wp) function observed_order(coarse, fine)
    real(wp), intent(in) :: coarse(:), fine(:)

    observed_order = log(norm2(coarse)/norm2(fine))/log(2.0_wp)
  end function observed_order

  !> The kept step nearest to a time.
  pure integer function step_at(self, time)
    class(motion_t), intent(in) :: self
    real(wp), intent(in) :: time

    step_at = max(1, minloc(abs(self%time(:self%steps) - time), 1))
  end function step_at

  subroutine motion_begin(self, number, analysis, error)
    class(motion_t), intent(inout) :: self
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis
    type(error_t), allocatable, intent(out) :: error

    if (number < 1 .or. analysis%steps < 1) allocate (error)
    self%complete = .false.
  end subroutine motion_begin

  subroutine motion_iteration(self, iteration)
    class(motion_t), intent(inout) :: self
    type(iteration_t), intent(in) :: iteration

    if (iteration%iteration < 0) self%complete = .false.
  end subroutine motion_iteration

  subroutine motion_remark(self, text)
    class(motion_t), intent(inout) :: self
    character(len=*), intent(in) :: text
    type(string_t), allocatable :: more(:)
    integer :: n

    n = size(self%remarks)
    allocate (more(n + 1))
    more(:n) = self%remarks
    more(n + 1)%s = text
    call move_alloc(more, self%remarks)
  end subroutine motion_remark

  subroutine motion_step(self, step, results, error)
    class(motion_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    type(error_t), allocatable, intent(out) :: error

    self%constraint = max(self%constraint, step%last%constraint)
    self%refused = self%refused + step%cutbacks
    self%steps = merge(self%steps + 1, 1, self%kept)
    if (self%steps > size(self%time)) call grow(self)
    self%time(self%steps) = step%time
    self%size(self%steps) = step%size
    self%results(self%steps) = results
    if (step%step < 0) allocate (error)
  end subroutine motion_step

  !> Room for twice as many steps.
  subroutine grow(self)
    class(motion_t), intent(inout) :: self
    type(results_t), allocatable :: more(:)
    integer :: n

    n = size(self%time)
    self%time = [self%time, self%time]
    self%size = [self%size, self%size]
    allocate (more(2*n))
    more(:n) = self%results
    call move_alloc(more, self%results)
  end subroutine grow

  subroutine motion_modes(self, modes_found, error)
    class(motion_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes_found
    type(error_t), allocatable, intent(out) :: error

    if (allocated(modes_found%frequency)) self%frequency = modes_found%frequency
    if (modes_found%modes < 0) allocate (error)
  end subroutine motion_modes

  subroutine motion_finish(self, complete, error)
    class(motion_t), intent(inout) :: self
    logical, intent(in) :: complete
    type(error_t), allocatable, intent(out) :: error

    self%complete = complete
    if (self%steps < 0) allocate (error)
  end subroutine motion_finish

  logical function motion_interrupted(self)
    class(motion_t), intent(inout) :: self

    motion_interrupted = self%steps < 0
  end function motion_interrupted

end module motion_recorder
