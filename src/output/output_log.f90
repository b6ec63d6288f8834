!> What a user sees of a run: tables on standard output, warnings and a progress line on standard
!> error.
module output_log
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  use kinds, only: wp, i8
  use text, only: to_text, plural, string_t
  use model_data, only: model_t, analysis_t, analysis_buckling, analysis_compliance, &
                        analysis_transient, analysis_names, time_analyses, mode_analyses, &
                        control_load, control_arc
  use program_version, only: program_name, version
  use recorder, only: step_t, iteration_t, compliance_line
  use mode_results, only: modes_t, mode_lines
  use restart_point, only: point_t
  use system_results, only: results_t
  use output_progress, only: progress_t, seconds_since, time_line
  use output_summary, only: summary_t, summary_lines, right, longest_name
  implicit none
  private

  public :: run_log_t

  integer, parameter, public :: log_quiet = 0, log_normal = 1, log_verbose = 2

  integer, parameter :: most_rows = 40                   !< of the table of an analysis
  real(wp), parameter :: pause = 0.1_wp, long_pause = 2.0_wp  !< between lines of progress [s]

  type :: run_log_t
    private
    integer :: level = log_normal
    type(progress_t) :: progress
    integer(i8) :: start = 0, begun = 0      !< clock, of the run and of the present analysis
    integer :: steps = 0                !< of the present analysis, at most
    integer :: every = 1                !< steps from one row of its table to the next
    logical :: counted = .true.         !< it makes exactly so many steps
    logical :: in_time = .false.        !< its steps have a time, else a load factor
    real(wp) :: start_time = 0.0_wp, end_time = 0.0_wp   !< of a motion in time [T]
    type(step_t) :: last                !< step
    logical :: printed = .true.         !< it has its row
    integer :: warnings = 0
    character(len=longest_name), allocatable :: node(:)
    type(summary_t), allocatable :: summary(:)
    integer :: analyses = 0
    integer :: first = 1                !< analysis of this run
    integer :: resumed = 0              !< steps of it that an earlier run has made
  contains
    procedure :: resume
    procedure :: open => open_log
    procedure :: begin => begin_analysis
    procedure :: iteration => log_iteration
    procedure :: remark => log_remark
    procedure :: step => log_step
    procedure :: modes => log_modes
    procedure :: compliance => log_compliance
    procedure :: finish => finish_analysis
    procedure :: close => close_log
  end type run_log_t

contains

  !> Say what is going to be computed.
  subroutine open_log(self, level, progress, deck, model)
    class(run_log_t), intent(inout) :: self
    integer, intent(in) :: level
    logical, intent(in) :: progress            !< show how far a long run is
    character(len=*), intent(in) :: deck
    type(model_t), intent(in) :: model
    integer :: i

    self%level = level
    call self%progress%open(progress .and. level > log_quiet)
    call system_clock(self%start)
    allocate (self%node(size(model%node)), self%summary(size(model%analysis)))
    do i = 1, size(model%node)
      self%node(i) = to_text(model%node(i)%id)
      if (model%node(i)%part > 0) then
        self%node(i) = trim(self%node(i))//"."//to_text(model%node(i)%part)
      end if
    end do
    call say(self, program_name//" "//version//", "//deck)
    if (model%title /= "") call say(self, model%title)
    call say(self, plural(size(model%node), "node")//", "//plural( &
             size(model%member) + size(model%joint), "element")//", "// &
             plural(size(model%section), "section")//", "//plural(size(model%material), "material"))
  end subroutine open_log

  !> The run goes on from a point of another one.
  subroutine resume(self, path, point)
    class(run_log_t), intent(inout) :: self
    character(len=*), intent(in) :: path       !< of the file
    type(point_t), intent(in) :: point
    real(wp) :: square(size(point%state%warping))
    integer :: at

    square = sum(point%state%displacement**2, 1)
    self%first = point%analysis
    self%resumed = point%states - 1
    self%last%time = point%time
    associate (summary => self%summary(point%analysis))
      summary%steps = self%resumed
      summary%factor = point%time
      at = maxloc(square, 1)
      summary%largest = sqrt(square(at))
      summary%node = self%node(at)
    end associate
    call say(self, "Goes on from "//path//" at time "//to_text(point%time)//" of analysis "// &
             to_text(point%analysis)//", behind "//plural(point%states, "state"))
  end subroutine resume

  !> A line on standard output; who no longer listens is no error.
  subroutine say(self, line)
    type(run_log_t), intent(inout) :: self
    character(len=*), intent(in) :: line
    integer :: status

    if (self%level == log_quiet) return
    call self%progress%hide()
    write (output_unit, "(a)", iostat=status) line
    if (status /= 0) self%level = log_quiet
  end subroutine say

  subroutine begin_analysis(self, number, analysis)
    class(run_log_t), intent(inout) :: self
    integer, intent(in) :: number
    type(analysis_t), intent(in) :: analysis

    self%analyses = number
    self%in_time = any(time_analyses == analysis%kind)
    self%counted = analysis%control /= control_arc
    self%steps = merge(analysis%steps, analysis%most_steps, self%counted)
    if (self%in_time) self%counted = max(analysis%time_step, analysis%every) > 0
    self%every = row_distance(self%steps)
    self%printed = .true.
    self%start_time = max(self%start_time, self%last%time)
    self%end_time = analysis%end_time
    call system_clock(self%begun)
    if (self%level == log_verbose) self%every = 1
    associate (summary => self%summary(number))
      summary%name = to_text(number)//" "//trim(analysis_names(analysis%kind))
      if (analysis%name /= "") summary%name = summary%name//" "//trim(analysis%name)
      call say(self, "")
      call say(self, "Analysis "//summary%name//": "//purpose(analysis))
      if (any(mode_analyses == analysis%kind)) summary%found = 0
      if (analysis%kind == analysis_compliance) then
        summary%found = size(analysis%node)
        summary%noun = "node"
      end if
      summary%in_time = self%in_time
      summary%restarts = analysis%kind == analysis_transient
    end associate
    if (self%in_time .and. .not. self%last%time < self%end_time) then
      call say(self, "          is already at its end")
      return
    end if
    if (any([mode_analyses, analysis_compliance] == analysis%kind)) return
    if (self%level == log_verbose) then
      call say(self, "    step   "//progress_name(self)//"   iteration"//measures(self))
    else
      call say(self, "    step   "//progress_name(self)//repeat("   step size", &
               merge(1, 0, self%in_time))//"   iterations"//measures(self)// &
               "   largest displacement")
    end if
  end subroutine begin_analysis

  !> What tells the steps of the present analysis apart.
  pure character(len=11) function progress_name(self)
    type(run_log_t), intent(in) :: self

    progress_name = merge("       time", "load factor", self%in_time)
  end function progress_name

  !> What is measured of a step's equilibrium: motions in time are held to their constraints.
  pure character(len=23) function measures(self)
    type(run_log_t), intent(in) :: self

    measures = merge(" constraint   increment", "   residual   increment", self%in_time)
  end function measures

  pure function purpose(analysis)
    type(analysis_t), intent(in) :: analysis
    character(len=:), allocatable :: purpose

    if (any(mode_analyses == analysis%kind)) then
      purpose = plural(analysis%modes, "mode")
      if (analysis%kind == analysis_buckling) purpose = purpose//" of each sign"
      return
    else if (any(time_analyses == analysis%kind)) then
      purpose = "to time "//to_text(analysis%end_time)//", steps of "//to_text(analysis%time_step)
      if (.not. analysis%time_step > 0) then
        purpose = "to time "//to_text(analysis%end_time)//", tolerance "// &
                  to_text(analysis%tolerance)
      end if
      return
    else if (analysis%kind == analysis_compliance) then
      purpose = plural(size(analysis%node), "node")
      return
    end if
    purpose = plural(analysis%steps, "step")
    if (analysis%control == control_arc) purpose = "at most "//plural(analysis%most_steps, &
                                                   "step")//" along the path,"
    if (analysis%control == control_load .or. analysis%control == control_arc) then
      purpose = purpose//" to load factor "//to_text(analysis%factor)
      if (analysis%stops) purpose = purpose//" or displacement "//to_text(analysis%stop%value)
    else
      purpose = purpose//" to displacement "//to_text(analysis%controlled%value)
    end if
  end function purpose

  !> 1, 2, 5, 10, ...: so many steps from row to row that the table stays short.
  pure integer function row_distance(steps) result(every)
    integer, intent(in) :: steps

    every = 1
    do while (steps/every > most_rows)
      every = every*2
      if (index(to_text(every), "4") == 1) every = every/4*5
    end do
  end function row_distance

  subroutine log_iteration(self, iteration)
    class(run_log_t), intent(inout) :: self
    type(iteration_t), intent(in) :: iteration

    if (self%level == log_verbose) call say(self, row(self, iteration%step, &
      iteration%factor, iteration%iteration, 12, iteration))
    call show_progress(self, iteration)
  end subroutine log_iteration

  !> The columns that steps and iterations have in common.
  function row(self, step, factor, count, width, iteration, step_size) result(line)
    type(run_log_t), intent(in) :: self
    integer, intent(in) :: step, count
    real(wp), intent(in) :: factor
    integer, intent(in) :: width                !< of the column of `count`
    type(iteration_t), intent(in) :: iteration
    real(wp), intent(in), optional :: step_size
    character(len=:), allocatable :: line

    line = right(to_text(step), 8)//right(to_text(factor), 14)
    if (present(step_size)) line = line//right(to_text(step_size, 4), 12)
    line = line//right(to_text(count), width)// &
           right(small(merge(iteration%constraint, iteration%residual, self%in_time)), 11)// &
           right(small(iteration%increment), 12)
  end function row

  !> A measure of error in two digits.
  pure function small(x) result(word)
    real(wp), intent(in) :: x
    character(len=:), allocatable :: word
    character(len=12) :: buffer

    write (buffer, "(es8.1)") x
    word = trim(adjustl(buffer))
  end function small

  !> Warnings go to standard error.
  subroutine log_remark(self, text)
    class(run_log_t), intent(inout) :: self
    character(len=*), intent(in) :: text
    integer :: status

    if (index(text, "warning:") /= 1) then
      call say(self, "          "//text)
      return
    end if
    self%warnings = self%warnings + 1
    if (self%level == log_quiet) return
    call self%progress%hide()
    write (error_unit, "(a)", iostat=status) text
    if (status /= 0) self%level = log_quiet
  end subroutine log_remark

  subroutine log_step(self, step, results)
    class(run_log_t), intent(inout) :: self
    type(step_t), intent(in) :: step
    type(results_t), intent(in) :: results
    real(wp) :: square(size(results%displacement, 2))
    integer :: at

    if (self%level == log_quiet) return
    square = sum(results%displacement**2, 1)
    associate (summary => self%summary(self%analyses))
      summary%steps = step%step
      summary%iterations = summary%iterations + step%iterations
      summary%cutbacks = summary%cutbacks + step%cutbacks
      summary%factor = merge(step%time, step%factor, self%in_time)
      at = maxloc(square, 1)
      summary%largest = sqrt(square(at))
      summary%node = self%node(at)
    end associate
    self%last = step
    self%printed = self%level == log_verbose
    if (step%step <= 1 .or. modulo(step%step, self%every) == 0) call print_row(self)
    if (self%in_time) call show_time(self)
  end subroutine log_step

  !> Print the row of the last step, unless it was.
  subroutine print_row(self)
    type(run_log_t), intent(inout) :: self
    character(len=:), allocatable :: line

    if (self%printed) return
    self%printed = .true.
    associate (step => self%last, summary => self%summary(self%analyses))
      if (self%in_time) then
        line = row(self, step%step, step%time, step%iterations, 13, step%last, step%size)
      else
        line = row(self, step%step, step%factor, step%iterations, 13, step%last)
      end if
      call say(self, line//right(to_text(summary%largest, 5), 14)//" at node "// &
               trim(summary%node))
    end associate
  end subroutine print_row

  !> The table of the modes.
  subroutine log_modes(self, modes_found)
    class(run_log_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes_found
    type(string_t), allocatable :: line(:)
    integer :: i

    call mode_lines(modes_found, line)
    do i = 1, size(line)
      if (i > most_rows .and. self%level /= log_verbose) exit
      call say(self, line(i)%s)
    end do
    if (i <= size(line)) call say(self, "   ... and "//plural(size(line) - i + 1, "mode")//" more")
    self%summary(self%analyses)%found = modes_found%modes
  end subroutine log_modes

  !> The nodes' compliances in their own directions.
  subroutine log_compliance(self, node, matrix)
    class(run_log_t), intent(inout) :: self
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: matrix(:, :, :)
    integer :: i

    do i = 1, size(node)
      call say(self, "    "//compliance_line("node "//trim(self%node(node(i))), matrix(:, :, i)))
    end do
  end subroutine log_compliance

  subroutine finish_analysis(self, complete)
    class(run_log_t), intent(inout) :: self
    logical, intent(in) :: complete

    self%summary(self%analyses)%complete = complete
    self%resumed = 0
    call self%progress%hide()
    call print_row(self)
  end subroutine finish_analysis

  !> The summary: a row for each analysis, then where the results are.
  subroutine close_log(self, path)
    class(run_log_t), intent(inout) :: self
    character(len=*), intent(in) :: path   !< result file; empty: there is none
    type(string_t), allocatable :: line(:)
    integer :: i

    call self%progress%hide()
    if (self%analyses > 0) then
      call summary_lines(self%summary(self%first:self%analyses), line)
      call say(self, "")
      do i = 1, size(line)
        call say(self, line(i)%s)
      end do
    end if
    if (self%warnings > 0) call say(self, plural(self%warnings, "warning"))
    if (path /= "") call say(self, "Results in "//path//", "//elapsed(self)//" s")
    if (path == "" .or. self%analyses == 0) return
    associate (last => self%summary(self%analyses))
      if (last%complete .or. .not. last%restarts) return
      call say(self, "To go on: the same command with --restart "//path)
    end associate
  end subroutine close_log

  !> Seconds since the start, in two digits.
  function elapsed(self) result(word)
    type(run_log_t), intent(in) :: self
    character(len=:), allocatable :: word

    word = to_text(max(0.001_wp, seconds_since(self%start)), 2)
  end function elapsed

  !> How far the iterations are; a motion in time shows its steps.
  subroutine show_progress(self, iteration)
    type(run_log_t), intent(inout) :: self
    type(iteration_t), intent(in) :: iteration
    character(len=:), allocatable :: line

    if (self%in_time) return
    if (.not. self%progress%due(pause)) return
    line = self%summary(self%analyses)%name//": step "//to_text(iteration%step)//" of "// &
           to_text(self%steps)//", "//trim(adjustl(progress_name(self)))//" "// &
           to_text(iteration%factor)//", iteration "// &
           to_text(iteration%iteration)
    if (self%counted) line = line//", "//to_text((100*(iteration%step - 1))/self%steps)//" %"
    call self%progress%show(line)
  end subroutine show_progress

  subroutine show_time(self)
    type(run_log_t), intent(inout) :: self

    if (.not. self%progress%due(long_pause)) return
    associate (summary => self%summary(self%analyses))
      call self%progress%show(summary%name//": "//time_line(self%start_time, self%last%time, &
        self%end_time, summary%steps - self%resumed, seconds_since(self%begun)))
    end associate
  end subroutine show_time

end module output_log
