!> What all ways along an equilibrium path share: states to come back to, options, messages.
module equilibrium_path
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck, exit_solve
  use text, only: to_text, plural, lower
  use model_data, only: model_t, analysis_t, control_displacement, joint_slider, joint_carriage, &
                        joint_names
  use nodal_state, only: state_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_motion, only: overturned
  use system_names, only: coordinate_name, strain_name, member_name
  use newton_method, only: newton_t, newton_outcome_t, newton_slow, newton_distorted
  use recorder, only: step_t
  implicit none
  private

  public :: safe_t, keep_safe, go_back, newton_options, check_dropped, check_angles
  public :: failure, reason, parameter_name

  !> A state to come back to.
  type :: safe_t
    type(state_t) :: state
    real(wp), allocatable :: stress(:), level(:)
  end type safe_t

contains

  !> Remember the present state and the levels of the patterns.
  pure subroutine keep_safe(iterate, level, safe)
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: level(:)
    type(safe_t), intent(inout) :: safe

    if (.not. allocated(safe%stress)) then
      allocate (safe%stress(size(iterate%stress)), safe%level(size(level)))
    end if
    safe%state = iterate%state
    safe%stress = iterate%stress
    safe%level = level
  end subroutine keep_safe

  !> Back to what `keep_safe` remembered; the iterate is not assembled there.
  pure subroutine go_back(safe, iterate, level)
    type(safe_t), intent(in) :: safe
    type(iterate_t), intent(inout) :: iterate
    real(wp), intent(inout) :: level(:)

    iterate%state = safe%state
    iterate%stress = safe%stress
    level = safe%level
  end subroutine go_back

  !> What went wrong, in one sentence: step, iteration, residual and where it is worst.
  function failure(model, system, analysis, reached, record, outcome) result(message)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: reached
    type(step_t), intent(in) :: record
    type(newton_outcome_t), intent(in) :: outcome
    character(len=:), allocatable :: message

    message = "no equilibrium found in step "//to_text(record%step)//" of "// &
              to_text(analysis%steps)//" beyond "//parameter_name(analysis)//" "// &
              to_text(reached)//" ("// &
              plural(record%cutbacks, "cut-back")//"): "//reason(model, outcome)
    if (outcome%worst > 0) message = message//"; iteration "//to_text(outcome%last%iteration)// &
      ": largest unbalanced force "//to_text(outcome%last%residual, 3)//" of the loads at "// &
      coordinate_name(model, outcome%worst)
    if (outcome%last%constraint > 1.0e-9_wp) message = message//", a fixed strain is off by "// &
      to_text(outcome%last%constraint*system%length, 3)
  end function failure

  function reason(model, outcome) result(words)
    type(model_t), intent(in) :: model
    type(newton_outcome_t), intent(in) :: outcome
    character(len=:), allocatable :: words

    select case (outcome%status)
    case (newton_slow)
      words = "not converged after "//plural(outcome%last%iteration, "iteration")
    case (newton_distorted)
      words = distortion(model, outcome%element)
    case default
      words = "the iteration diverged"
    end select
  end function reason

  !> What ails an element that cannot be as it is.
  pure function distortion(model, element) result(words)
    type(model_t), intent(in) :: model
    integer, intent(in) :: element
    character(len=:), allocatable :: words
    integer :: joint

    words = member_name(model, element)//" turns too far within itself"
    joint = element - size(model%member)
    if (joint <= 0) then
      words = words//": divide it"
    else if (any(model%joint(joint)%kind == [joint_slider, joint_carriage])) then
      words = member_name(model, element)//" ("//lower(trim(joint_names(model%joint(joint)%kind))) &
              //") leaves its beam"
    end if
  end function distortion

  pure function newton_options(analysis) result(options)
    type(analysis_t), intent(in) :: analysis
    type(newton_t) :: options

    if (analysis%tolerance > 0) options%tolerance = analysis%tolerance
    if (analysis%iterations > 0) options%iterations = analysis%iterations
  end function newton_options

  !> A fixed strain that was left out because others imply it must have stayed zero.
  subroutine check_dropped(model, system, iterate, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(error_t), allocatable, intent(out) :: error
    integer :: k

    do k = 1, size(system%dropped)
      if (.not. system%dropped(k)) cycle
      if (abs(iterate%strain(k) - iterate%target(k)) <= 1.0e-8_wp*system%length) cycle
      call fail(error, exit_solve, "the constraints contradict each other: "// &
                strain_name(model, system, k)//", redundant at the start, is off by "// &
                to_text(iterate%strain(k) - iterate%target(k), 3)//"; if the model is drawn in "// &
                "a singular position, draw it a little off that")
      return
    end do
  end subroutine check_dropped

  !> Motions must not turn a node by a half turn or more: its Euler parameters cannot follow.
  subroutine check_angles(model, system, level, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: angle
    integer :: strain

    call overturned(system, level, strain, angle)
    if (strain == 0) return
    call fail(error, exit_deck, strain_name(model, system, strain)//" is prescribed an angle "// &
              "of "//to_text(angle, 4)//", and INPUTX turns a node by less than pi; a HINGE "// &
              "with INPUTE makes full turns")
  end subroutine check_angles

  pure function parameter_name(analysis) result(name)
    type(analysis_t), intent(in) :: analysis
    character(len=:), allocatable :: name

    name = "load factor"
    if (analysis%control == control_displacement) name = "displacement"
  end function parameter_name

end module equilibrium_path
