!> Analyses that follow time: TRANSIENT, KINEMATIC, INVERSE; and SPACAR's TIMESTEP.
module deck_time_cards
  use kinds, only: wp
  use text, only: to_text
  use model_data, only: analysis_t, time_analyses, analysis_transient, analysis_kinematic, &
                        analysis_inverse
  use deck_card, only: card_t
  use deck_draft, only: draft_t, timestep_t
  use deck_load_cards, only: begin_analysis, read_name, check_count, check_tolerance, most_steps
  implicit none
  private

  public :: read_transient, read_kinematic, read_inverse, read_timestep

  !> Options in the order of the keyword table; KINEMATIC and INVERSE have the first four.
  integer, parameter :: end_option = 1, step_option = 2, every_option = 3, name_option = 4, &
    tolerance_option = 5, radius_option = 6, stabilised_option = 7, iterations_option = 8

  integer, parameter :: unknown_steps = 200           !< of steps that the analysis chooses
  real(wp), parameter :: most_time_steps = 1.0e9_wp

contains

  !> TRANSIENT TEND t (STEP h | TOL t) [EVERY dt] [RHOINF r] [STABILISED ON] ...
  subroutine read_transient(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(analysis_t) :: analysis
    integer :: k

    call begin_analysis(card, 0, draft, analysis, k)
    analysis%kind = analysis_transient
    call read_times(card, k, draft, analysis)
    call read_tolerance(card, draft, analysis)
    associate (option => card%option)
      if (option(radius_option) > 0) then
        analysis%spectral_radius = card%number(option(radius_option) + 1)
        if (analysis%spectral_radius < 0 .or. analysis%spectral_radius > 1) then
          call draft%report%add_error(card%place(option(radius_option) + 1), &
                                      "RHOINF lies between 0 and 1", "1: no numerical damping; "// &
                                      "0: fast vibrations vanish in one step")
        end if
      end if
      if (option(stabilised_option) > 0) then
        analysis%stabilised = card%whole(option(stabilised_option) + 1) == 2
      end if
      if (option(iterations_option) > 0) then
        analysis%iterations = card%whole(option(iterations_option) + 1)
        call check_count(card, option(iterations_option) + 1, most_steps, draft)
      end if
    end associate
    draft%model%analysis(k) = analysis
  end subroutine read_transient

  !> Either STEP or TOL.
  subroutine read_tolerance(card, draft, analysis)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(analysis_t), intent(inout) :: analysis
    character(len=*), parameter :: hint = "STEP h: equal time steps; TOL t: steps chosen to "// &
                                          "keep the error of each below t"

    associate (step => card%option(step_option), tolerance => card%option(tolerance_option))
      if (step > 0 .and. tolerance > 0) then
        call draft%report%add_error(card%place(max(step, tolerance)), &
                                    "STEP and TOL are both given", hint)
      else if (step == 0 .and. tolerance == 0) then
        call draft%report%add_error(card%place(1), "TRANSIENT needs STEP or TOL", hint)
      else if (tolerance > 0) then
        analysis%tolerance = card%number(tolerance + 1)
        call check_tolerance(card, tolerance + 1, draft)
      end if
    end associate
  end subroutine read_tolerance

  !> KINEMATIC TEND t STEP h [EVERY dt] [NAME name]
  subroutine read_kinematic(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_given_motion(card, draft, analysis_kinematic)
  end subroutine read_kinematic

  !> INVERSE TEND t STEP h [EVERY dt] [NAME name]
  subroutine read_inverse(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    call read_given_motion(card, draft, analysis_inverse)
  end subroutine read_inverse

  subroutine read_given_motion(card, draft, kind)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: kind
    type(analysis_t) :: analysis
    integer :: k

    call begin_analysis(card, 0, draft, analysis, k)
    analysis%kind = kind
    call read_times(card, k, draft, analysis)
    draft%model%analysis(k) = analysis
  end subroutine read_given_motion

  !> TEND, STEP, EVERY and NAME of analysis number `k`.
  subroutine read_times(card, k, draft, analysis)
    type(card_t), intent(in) :: card
    integer, intent(in) :: k
    type(draft_t), intent(inout) :: draft
    type(analysis_t), intent(inout) :: analysis
    real(wp) :: duration, interval

    associate (option => card%option)
      analysis%end_time = card%number(option(end_option) + 1)
      call find_duration(card, k, draft, analysis%end_time, duration)
      if (option(step_option) > 0) then
        analysis%time_step = card%number(option(step_option) + 1)
        call check_interval(card, option(step_option) + 1, "time step", duration, draft)
      end if
      if (option(every_option) > 0) then
        analysis%every = card%number(option(every_option) + 1)
        call check_interval(card, option(every_option) + 1, "interval", duration, draft)
        if (analysis%every > 0 .and. analysis%every < (1 - 1.0e-9_wp)*analysis%time_step) then
          call draft%report%add_error(card%place(option(every_option) + 1), &
                                      "EVERY is shorter than the time step")
        end if
      end if
    end associate
    call read_name(card, name_option, k, draft, analysis)
    interval = max(analysis%every, analysis%time_step)
    draft%analysis_steps(k) = unknown_steps
    if (interval > 0 .and. duration < most_time_steps*interval) then
      draft%analysis_steps(k) = max(1, ceiling(duration/interval - 1.0e-6_wp))
    end if
  end subroutine read_times

  !> Time from the end of the time analysis before, or from 0, up to TEND.
  subroutine find_duration(card, k, draft, end_time, duration)
    type(card_t), intent(in) :: card
    integer, intent(in) :: k
    type(draft_t), intent(inout) :: draft
    real(wp), intent(in) :: end_time
    real(wp), intent(out) :: duration
    integer :: i, last

    last = 0
    do i = 1, k - 1
      if (any(time_analyses == draft%model%analysis(i)%kind)) last = i
    end do
    duration = end_time
    if (last > 0) duration = end_time - draft%model%analysis(last)%end_time
    if (duration > 0) return
    associate (place => card%place(card%option(end_option) + 1))
      if (last == 0) then
        call draft%report%add_error(place, "TEND must be positive", "time starts at 0")
      else
        call draft%report%add_error(place, "TEND must be above "// &
          to_text(draft%model%analysis(last)%end_time)//", where the time analysis before ends", &
          "TEND is the time itself, not a duration; the analysis before is at "// &
          draft%report%location(draft%model%analysis(last)%place))
      end if
    end associate
    duration = 0
  end subroutine find_duration

  !> Word `w` must be a part of the duration; of 0, known to be wrong, nothing is asked.
  subroutine check_interval(card, w, what, duration, draft)
    type(card_t), intent(in) :: card
    integer, intent(in) :: w
    character(len=*), intent(in) :: what
    real(wp), intent(in) :: duration
    type(draft_t), intent(inout) :: draft

    associate (interval => card%number(w))
      if (.not. interval > 0) then
        call draft%report%add_error(card%place(w), "a positive "//what//" expected")
      else if (duration > 0 .and. interval > (1 + 1.0e-9_wp)*duration) then
        call draft%report%add_error(card%place(w), "the "//what// &
                                    " is longer than the analysis, which takes "//to_text(duration))
      else if (duration > most_time_steps*interval) then
        call draft%report%add_error(card%place(w), "more than 1e9 steps up to TEND")
      end if
    end associate
  end subroutine check_interval

  !> TIMESTEP tend n: what --mode 1 and 2 run.
  subroutine read_timestep(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(timestep_t) :: timestep

    if (draft%timestep%place%line > 0) call draft%report%add_error( &
      card%place(1), "TIMESTEP is given twice", &
      "first at "//draft%report%location(draft%timestep%place))
    timestep%place = card%place(1)
    timestep%end_time = card%number(2)
    timestep%steps = card%whole(3)
    if (.not. timestep%end_time > 0) call draft%report%add_error( &
      card%place(2), "the end time must be positive", "time starts at 0")
    call check_count(card, 3, most_steps, draft)
    draft%timestep = timestep
  end subroutine read_timestep

end module deck_time_cards
