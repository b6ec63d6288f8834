!> Who listens to an analysis: writes results, prints progress, knows of interruptions.
!> Analyses know only this; files and terminals are behind it.
module recorder
  use kinds, only: wp
  use errors, only: error_t, fail, exit_solve
  use text, only: to_text, string_t
  use model_data, only: analysis_t
  use system_results, only: results_t
  use mode_results, only: modes_t, mode_lines
  use restart_point, only: point_t
  implicit none
  private

  !> One Newton iteration.
  type, public :: iteration_t
    integer :: step = 0               !< recorded step it works for, from 1
    integer :: iteration = 0          !< within its increment of the load
    real(wp) :: factor = 0.0_wp       !< load factor or time aimed at
    real(wp) :: increment = 0.0_wp    !< largest change, relative to the motion so far
    real(wp) :: residual = 0.0_wp     !< largest unbalanced force, relative to the forces
    real(wp) :: constraint = 0.0_wp   !< largest fixed strain, relative to the model's length
  end type iteration_t

  !> One recorded step.
  type, public :: step_t
    integer :: step = 0               !< 0: the state the analysis starts from
    real(wp) :: factor = 0.0_wp       !< load factor
    real(wp) :: time = 0.0_wp         !< of a motion in time [T]
    real(wp) :: size = 0.0_wp         !< of a motion in time: its last time step [T]
    integer :: iterations = 0         !< spent on it, cut-backs included
    integer :: cutbacks = 0
    integer :: unstable = -1          !< unstable modes; -1: not asked for
    real(wp) :: arc = 0.0_wp          !< arc length of the step, 0 if not controlled by it
    type(iteration_t) :: last         !< the converged iteration
    !> (6, 6, nodes) of the nodes that the analysis asks for, as in `compliance` of `recorder_t`
    real(wp), allocatable :: compliance(:, :, :)
  end type step_t

  integer, parameter, public :: critical_limit = 1, critical_bifurcation = 2
  character(len=11), parameter, public :: critical_name(2) = ["limit point", "bifurcation"]

  public :: critical_line, compliance_line

  !> A critical point of the path.
  type, public :: critical_t
    integer :: step = 0                    !< recorded step behind it
    integer :: kind = critical_limit       !< limit point or bifurcation
    real(wp) :: factor = 0.0_wp            !< load factor
    integer :: before = 0, behind = 0      !< unstable modes on either side
    real(wp), allocatable :: mode(:, :)    !< (7, nodes) the critical mode: X Y Z RX RY RZ W
  end type critical_t

  type, abstract, public :: recorder_t
  contains
    procedure :: critical_point
    procedure :: modes
    procedure :: compliance
    procedure :: wants_point
    procedure :: keep_point
    procedure(begin_interface), deferred :: begin
    procedure(iteration_interface), deferred :: iteration
    procedure(remark_interface), deferred :: remark
    procedure(step_interface), deferred :: step
    procedure(finish_interface), deferred :: finish
    procedure(interrupted_interface), deferred :: interrupted
  end type recorder_t

  abstract interface
    !> Analysis number `number` of the run starts.
    subroutine begin_interface(self, number, analysis, error)
      import :: recorder_t, analysis_t, error_t
      implicit none
      class(recorder_t), intent(inout) :: self
      integer, intent(in) :: number
      type(analysis_t), intent(in) :: analysis
      type(error_t), allocatable, intent(out) :: error
    end subroutine begin_interface

    !> A Newton iteration was made.
    subroutine iteration_interface(self, iteration)
      import :: recorder_t, iteration_t
      implicit none
      class(recorder_t), intent(inout) :: self
      type(iteration_t), intent(in) :: iteration
    end subroutine iteration_interface

    !> Something worth a line: a cut-back, for instance.
    subroutine remark_interface(self, text)
      import :: recorder_t
      implicit none
      class(recorder_t), intent(inout) :: self
      character(len=*), intent(in) :: text
    end subroutine remark_interface

    !> A step has converged: keep it.
    subroutine step_interface(self, step, results, error)
      import :: recorder_t, step_t, results_t, error_t
      implicit none
      class(recorder_t), intent(inout) :: self
      type(step_t), intent(in) :: step
      type(results_t), intent(in) :: results
      type(error_t), allocatable, intent(out) :: error
    end subroutine step_interface

    !> The analysis that began last has ended, `complete` or not.
    subroutine finish_interface(self, complete, error)
      import :: recorder_t, error_t
      implicit none
      class(recorder_t), intent(inout) :: self
      logical, intent(in) :: complete
      type(error_t), allocatable, intent(out) :: error
    end subroutine finish_interface

    !> Whether the user wants the run to stop.
    logical function interrupted_interface(self)
      import :: recorder_t
      implicit none
      class(recorder_t), intent(inout) :: self
    end function interrupted_interface
  end interface

contains

  !> Modes of BUCKLING or EIGEN: a line for each.
  subroutine modes(self, modes_found, error)
    class(recorder_t), intent(inout) :: self
    type(modes_t), intent(in) :: modes_found
    type(error_t), allocatable, intent(out) :: error
    type(string_t), allocatable :: line(:)
    integer :: i

    call mode_lines(modes_found, line)
    do i = 1, size(line)
      call self%remark(line(i)%s)
    end do
    if (size(line) < 0) call fail(error, exit_solve, "")
  end subroutine modes

  !> How nodes yield to loads: displacement and rotation of each by a unit force and moment on it,
  !> in global axes. A line for each, unless a recorder keeps more.
  subroutine compliance(self, node, matrix, error)
    class(recorder_t), intent(inout) :: self
    integer, intent(in) :: node(:)            !< indices in the model
    !> (6, 6, nodes) X Y Z [L], RX RY RZ [1] by FX FY FZ [F], MX MY MZ [F L]
    real(wp), intent(in) :: matrix(:, :, :)
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    do i = 1, size(node)
      call self%remark(compliance_line("node number "//to_text(node(i)), matrix(:, :, i)))
    end do
    if (size(matrix, 3) /= size(node)) call fail(error, exit_solve, "a compliance without a node")
  end subroutine compliance

  !> The compliance of a node in its own directions, in one line.
  function compliance_line(name, matrix) result(line)
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: matrix(6, 6)
    character(len=:), allocatable :: line
    character(len=2), parameter :: direction(6) = ["X ", "Y ", "Z ", "RX", "RY", "RZ"]
    integer :: i

    line = name//":"
    do i = 1, 6
      line = line//" "//trim(direction(i))//" "//to_text(matrix(i, i), 5)
    end do
  end function compliance_line

  !> A critical point was passed: a line of it, unless a recorder keeps more.
  subroutine critical_point(self, point, error)
    class(recorder_t), intent(inout) :: self
    type(critical_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error

    call self%remark(critical_line(point))
    if (point%step < 0) call fail(error, exit_solve, "a critical point without a step")
  end subroutine critical_point

  !> Whether it is time for a restart point; never, unless a recorder keeps them.
  logical function wants_point(self)
    class(recorder_t), intent(inout) :: self

    wants_point = .not. same_type_as(self, self)
  end function wants_point

  !> Where the analysis stands behind the last recorded step: keep it in place of the last one.
  subroutine keep_point(self, point, error)
    class(recorder_t), intent(inout) :: self
    type(point_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error

    if (self%wants_point() .and. point%states < 1) then
      call fail(error, exit_solve, "a restart point without a state")
    end if
  end subroutine keep_point

  !> A critical point in one line.
  function critical_line(point) result(line)
    type(critical_t), intent(in) :: point
    character(len=:), allocatable :: line

    line = "step "//to_text(point%step)//": "//trim(critical_name(point%kind))// &
           " at load factor "//to_text(point%factor, 8)//", unstable modes "// &
           to_text(point%before)//" -> "//to_text(point%behind)
  end function critical_line

end module recorder
