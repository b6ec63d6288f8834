!> Motions that start in a singular position: the program cannot always know which way they go.
module singular_refusal
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use model_data, only: model_t, analysis_transient, analysis_kinematic, analysis_inverse, &
                        analysis_names
  use nodal_state, only: state_t
  use system_data, only: system_t
  use system_names, only: strain_name, coordinate_name
  use start_velocity, only: find_velocities
  use singular_start, only: departure_t, find_departure
  implicit none
  private

  public :: refuse_unclear, leave_singular, check_departure

contains

  !> Say what the program cannot know. `strict`: every motion must be prescribed or resisted.
  subroutine refuse_unclear(model, system, strict, name, departure, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    logical, intent(in) :: strict
    character(len=*), intent(in) :: name   !< of the analysis
    type(departure_t), intent(in) :: departure
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: words, cure

    cure = "draw the model a little off it"
    if (departure%coordinate > 0) then
      words = coordinate_name(model, departure%coordinate)
      cure = cure//", or say by STARTDX "//words(len("node ") + 1:)//" how it moves"
    end if
    if (strict .and. departure%freedoms > 0) then
      words = "the motion is not determined"
      cure = "INPUTE or INPUTX prescribes it"
    else if (departure%order == 0) then
      words = "nothing moves yet, and which way it will go is open"
    else if (departure%ways > 1) then
      words = "more than one motion goes on as prescribed"
    else if (departure%ways == 0) then
      words = "no motion was found that goes on as prescribed"
    else
      return
    end if
    call fail(error, exit_deck, name//" starts in a singular position, where "// &
              strain_name(model, system, departure%strain)//" depends on others: "//words// &
              "; "//cure)
  end subroutine refuse_unclear

  !> The velocities of a motion with masses that starts in a singular position: those found without
  !> regard to that are changed to the one way there is.
  subroutine leave_singular(model, system, state, level, velocity, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    real(wp), intent(inout) :: velocity(:)
    type(error_t), allocatable, intent(out) :: error
    type(departure_t) :: departure

    call find_departure(model, system, state, level, departure, error, velocity)
    if (allocated(error) .or. .not. departure%singular) return
    call refuse_unclear(model, system, .false., "TRANSIENT", departure, error)
    if (.not. allocated(error) .and. departure%order == 1) velocity = departure%rate
  end subroutine leave_singular

  !> Whether the first analysis, if it is a motion in time, knows which way to go.
  subroutine check_departure(model, system, state, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(error_t), allocatable, intent(out) :: error
    type(departure_t) :: departure
    real(wp) :: level(size(model%pattern)), velocity(system%coordinates)

    if (size(model%analysis) == 0) return
    level = 0
    select case (model%analysis(1)%kind)
    case (analysis_transient)
      call find_velocities(model, system, state, level, velocity, error)
      if (.not. allocated(error)) call leave_singular(model, system, state, level, velocity, error)
    case (analysis_kinematic, analysis_inverse)
      call find_departure(model, system, state, level, departure, error)
      if (departure%singular .and. .not. allocated(error)) call refuse_unclear( &
        model, system, .true., trim(analysis_names(model%analysis(1)%kind)), departure, error)
    case default
    end select
  end subroutine check_departure

end module singular_refusal
