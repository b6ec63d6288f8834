!> What has to be known of a model before its analyses run: constraints that repeat others, motions
!> that cannot be, motions that nothing resists.
module model_soundness
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use text, only: to_text, plural
  use model_data, only: model_t, structure_analyses, time_analyses, analysis_kinematic, &
                        analysis_inverse, analysis_names
  use nodal_state, only: state_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_build, only: number_multipliers
  use system_constraints, only: drop_redundant
  use system_singular, only: find_singular
  use system_dependence, only: dependence_t, find_dependences, find_contradiction
  use system_mobility, only: free_motion_t, find_free_motions
  use model_sentences, only: dependence_sentence, singular_sentence, contradiction_sentence, &
                             motion_sentence
  use recorder, only: recorder_t
  implicit none
  private

  public :: redundant_t, sort_redundant, warn_of_redundant, refuse_free_motion, count_line, &
            needs_structure, begins_with_motion, refusal, singular_cure

  !> Constraints that follow from others, as many explained as can be.
  type :: redundant_t
    integer :: all = 0, singular = 0               !< the latter only where the model is drawn
    type(dependence_t), allocatable :: everywhere(:), here(:)
    character(len=:), allocatable :: contradiction !< of prescribed motions; empty: none
    type(state_t), allocatable :: beside           !< next to a singular position; else none
    logical :: leads = .false.                     !< a motion leads there
  end type redundant_t

  integer, parameter :: most_motions = 3   !< of a message

contains

  !> Leave out the constraints that follow from others, where the model starts. Those that do so
  !> only there are marked, and count again if the deck begins with a motion in time.
  subroutine sort_redundant(model, system, state, found, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    type(redundant_t), intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    type(error_t), allocatable :: contradiction
    integer, allocatable :: dropped(:), singular(:)
    integer :: k

    found%contradiction = ""
    call drop_redundant(system, state, dropped, error)
    if (.not. allocated(error)) call find_singular(system, state, dropped, singular, &
                                                   found%beside, found%leads, error)
    if (allocated(error)) return
    system%singular(singular) = .true.
    found%all = size(dropped)
    found%singular = size(singular)
    call refuse_contradiction(model, system, state, dropped, contradiction)
    if (allocated(contradiction)) found%contradiction = contradiction%message
    dropped = pack(dropped, [(all(singular /= dropped(k)), k=1, size(dropped))])
    call find_dependences(model, system, state, dropped, found%everywhere, error)
    if (.not. allocated(error)) call find_dependences(model, system, state, singular, found%here, &
                                                      error)
    if (allocated(error) .or. size(singular) == 0 .or. .not. begins_with_motion(model)) return
    system%dropped(singular) = .false.
    call number_multipliers(system)
  end subroutine sort_redundant

  !> Whether a motion in time comes first, or nothing at all.
  pure logical function begins_with_motion(model)
    type(model_t), intent(in) :: model

    begins_with_motion = size(model%analysis) == 0
    if (.not. begins_with_motion) begins_with_motion = any(time_analyses == model%analysis(1)%kind)
  end function begins_with_motion

  !> Redundant constraints that agree are left out, with a warning for each that says why; those
  !> that are so only where the model is drawn are named. `beside` is a place next to that.
  subroutine warn_of_redundant(model, system, state, recorder, beside, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    class(recorder_t), intent(inout) :: recorder
    type(state_t), allocatable, intent(out) :: beside
    type(error_t), allocatable, intent(out) :: error
    type(redundant_t) :: found
    integer :: i

    call sort_redundant(model, system, state, found, error)
    if (allocated(error)) return
    if (found%contradiction /= "") then
      call fail(error, exit_deck, found%contradiction)
      return
    end if
    call move_alloc(found%beside, beside)
    associate (redundant => found%all - found%singular)
      do i = 1, size(found%everywhere)
        call recorder%remark("warning: overconstrained"//count_line(i, redundant)//": "// &
                             dependence_sentence(model, system, found%everywhere(i)))
      end do
      if (redundant > size(found%everywhere)) call recorder%remark( &
        "warning: "//plural(redundant - size(found%everywhere), "more redundant constraint"))
    end associate
    do i = 1, size(found%here)
      call recorder%remark("warning: "//singular_sentence(model, system, found%here(i), &
                                                           found%leads))
    end do
    if (found%singular > size(found%here)) call recorder%remark( &
      "warning: "//plural(found%singular - size(found%here), "more singular constraint"))
  end subroutine warn_of_redundant

  !> " once", or ", 2 of 6".
  pure function count_line(i, all) result(words)
    integer, intent(in) :: i, all
    character(len=:), allocatable :: words

    words = " once"
    if (all > 1) words = ", "//to_text(i)//" of "//to_text(all)
  end function count_line

  !> Motions prescribed for strains that depend on each other have to agree.
  subroutine refuse_contradiction(model, system, state, dropped, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    integer, intent(in) :: dropped(:)
    type(error_t), allocatable, intent(out) :: error
    type(dependence_t) :: found
    logical :: exists

    character(len=:), allocatable :: words

    call find_contradiction(model, system, state, dropped, found, exists, error)
    if (.not. exists .or. allocated(error)) return
    words = contradiction_sentence(model, system, found)
    if (system%singular(found%dropped)) words = words//" in the singular position it is drawn in"
    call fail(error, exit_deck, words)
  end subroutine refuse_contradiction

  !> A structure must resist every motion: free ones are named by node and coordinate.
  subroutine refuse_free_motion(model, system, solver, iterate, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(solver_t), intent(inout) :: solver
    type(iterate_t), intent(inout) :: iterate
    type(error_t), allocatable, intent(out) :: error
    type(free_motion_t), allocatable :: found(:)
    character(len=:), allocatable :: list
    real(wp) :: level(size(model%pattern))
    integer :: i

    if (system%unknowns == 0) then
      call fail(error, exit_deck, "nothing can move: every coordinate is fixed")
      return
    end if
    level = 0
    call assemble(system, level, iterate)
    call solver%factorize(iterate%values, error)
    if (allocated(error)) return
    if (size(solver%null_pivots()) == 0) return
    call find_free_motions(model, system, iterate, solver, found, error)
    if (allocated(error) .or. size(found) == 0) return
    list = "the model can move freely: "
    do i = 1, min(most_motions, size(found))
      if (i > 1) list = list//"; and "
      list = list//motion_sentence(model, system, found(i))
    end do
    if (size(found) > most_motions) list = list//"; and "// &
      plural(size(found) - most_motions, "more motion")//", see spar check"
    call fail(error, exit_deck, list//"; "//refusal(model)//singular_cure(system))
  end subroutine refuse_free_motion

  !> Whether an analysis needs a structure: EIGEN and motions in time do not.
  pure logical function needs_structure(model)
    type(model_t), intent(in) :: model
    integer :: i

    needs_structure = .false.
    do i = 1, size(model%analysis)
      needs_structure = needs_structure .or. any(structure_analyses == model%analysis(i)%kind)
    end do
  end function needs_structure

  !> What more to say where a model can move in a singular position only to first order.
  pure function singular_cure(system) result(words)
    type(system_t), intent(in) :: system
    character(len=:), allocatable :: words

    words = ""
    if (any(system%singular .and. system%dropped)) words = &
      ", and not a singular position: draw the model a little off it"
  end function singular_cure

  !> Which analysis cannot have free motions, and what it needs; empty if none minds.
  pure function refusal(model) result(words)
    type(model_t), intent(in) :: model
    character(len=:), allocatable :: words
    integer :: i

    words = ""
    do i = 1, size(model%analysis)
      associate (kind => model%analysis(i)%kind)
        if (any(structure_analyses == kind)) then
          words = trim(analysis_names(kind))//" needs a structure"
        else if (any([analysis_kinematic, analysis_inverse] == kind)) then
          words = trim(analysis_names(kind))//" needs every motion prescribed or resisted"
        end if
      end associate
      if (words /= "") return
    end do
  end function refusal

end module model_soundness
