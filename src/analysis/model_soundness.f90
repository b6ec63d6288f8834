!> What has to be known of a model before its analyses run: constraints that repeat others, motions
!> that cannot be, motions that nothing resists.
module model_soundness
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use text, only: to_text, plural
  use model_data, only: model_t, structure_analyses, analysis_kinematic, analysis_inverse, &
                        analysis_names
  use nodal_state, only: state_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_constraints, only: drop_redundant
  use system_dependence, only: dependence_t, find_dependences, find_contradiction
  use system_mobility, only: free_motion_t, find_free_motions
  use model_sentences, only: dependence_sentence, contradiction_sentence, motion_sentence
  use recorder, only: recorder_t
  implicit none
  private

  public :: warn_of_redundant, refuse_free_motion, refuse_contradiction, count_line, &
            needs_structure, refusal

  integer, parameter :: most_motions = 3   !< of a message

contains

  !> Redundant constraints that agree are left out, with a warning for each that says why.
  subroutine warn_of_redundant(model, system, state, recorder, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    class(recorder_t), intent(inout) :: recorder
    type(error_t), allocatable, intent(out) :: error
    type(dependence_t), allocatable :: found(:)
    integer, allocatable :: dropped(:)
    integer :: i

    call drop_redundant(system, state, dropped, error)
    if (.not. allocated(error)) call refuse_contradiction(model, system, state, dropped, error)
    if (.not. allocated(error)) call find_dependences(model, system, state, dropped, found, error)
    if (allocated(error)) return
    do i = 1, size(found)
      call recorder%remark("warning: overconstrained"//count_line(i, size(dropped))//": "// &
                           dependence_sentence(model, system, found(i)))
    end do
    if (size(dropped) > size(found)) call recorder%remark( &
      "warning: "//plural(size(dropped) - size(found), "more redundant constraint"))
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

    call find_contradiction(model, system, state, dropped, found, exists, error)
    if (exists .and. .not. allocated(error)) call fail( &
      error, exit_deck, contradiction_sentence(model, system, found))
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
    call fail(error, exit_deck, list//"; "//refusal(model))
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
