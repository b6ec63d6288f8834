!> SPACAR's run modes: what `--mode N` runs on a deck without analysis cards.
module deck_modes
  use kinds, only: wp
  use text, only: to_text
  use diagnostics, only: place_t
  use model_data, only: analysis_t, analysis_names, analysis_static, analysis_buckling, &
                        analysis_eigen, analysis_transient, analysis_inverse, time_analyses
  use deck_draft, only: draft_t
  implicit none
  private

  public :: imply_analysis, implies_eigen, describe_analysis, check_timestep

  integer, parameter, public :: mode_check = 0, mode_transient = 1, mode_inverse = 2, &
                                mode_eigen = 7, mode_buckling = 8, mode_static = 10
  integer, parameter, public :: run_modes(6) = [mode_check, mode_transient, mode_inverse, &
                                                mode_eigen, mode_buckling, mode_static]
  !> SPACAR's modes that need linearization.
  integer, parameter, public :: missing_modes(3) = [3, 4, 9]

contains

  !> The analysis of the last loads: of the additional ones where there are both.
  subroutine imply_analysis(draft, loaded, analysis)
    type(draft_t), intent(in) :: draft
    logical, intent(in) :: loaded            !< the deck has loads
    type(analysis_t), intent(inout) :: analysis

    select case (draft%spacar_mode)
    case (mode_transient, mode_inverse)
      analysis%kind = merge(analysis_transient, analysis_inverse, &
                            draft%spacar_mode == mode_transient)
      analysis%end_time = draft%timestep%end_time
      analysis%steps = max(1, draft%timestep%steps)
      analysis%time_step = analysis%end_time/analysis%steps
    case (mode_buckling)
      analysis%kind = analysis_buckling
    case (mode_eigen)
      if (.not. (loaded .or. prestressed(draft))) analysis%kind = analysis_eigen
    case default
      analysis%kind = analysis_static
    end select
  end subroutine imply_analysis

  !> Whether the equilibrium found is to be followed by EIGEN.
  pure logical function implies_eigen(draft, analysis)
    type(draft_t), intent(in) :: draft
    type(analysis_t), intent(in) :: analysis  !< the last one

    implies_eigen = draft%analyses == 0 .and. draft%spacar_mode == mode_eigen .and. &
                    analysis%kind == analysis_static
  end function implies_eigen

  !> Does any element have stresses at the start?
  pure logical function prestressed(draft)
    type(draft_t), intent(in) :: draft
    integer :: i

    prestressed = .true.
    do i = 1, draft%members
      if (any(abs(draft%model%member(i)%initial_stress) > 0.0_wp)) return
    end do
    do i = 1, size(draft%model%joint)
      if (any(abs(draft%model%joint(i)%initial_stress) > 0.0_wp)) return
    end do
    prestressed = .false.
  end function prestressed

  !> The modes in time need TIMESTEP, the others do not use it.
  subroutine check_timestep(draft)
    type(draft_t), intent(inout) :: draft

    if (draft%analyses == 0 .and. any(draft%spacar_mode == [mode_transient, mode_inverse])) then
      if (draft%timestep%steps == 0) call draft%report%add_error( &
        place_t(file=1), "--mode "//to_text(draft%spacar_mode)//" needs a TIMESTEP card", &
        "TIMESTEP tend n: n equal steps to the time tend")
    else if (draft%timestep%place%line > 0) then
      call draft%report%add_note(draft%timestep%place, "TIMESTEP is ignored: it belongs to "// &
                                 "--mode 1 and 2 of a deck without analyses")
    end if
  end subroutine check_timestep

  !> An implied analysis in one phrase, as its card would be written.
  function describe_analysis(analysis) result(phrase)
    type(analysis_t), intent(in) :: analysis
    character(len=:), allocatable :: phrase

    phrase = trim(analysis_names(analysis%kind))
    if (analysis%kind == analysis_static) then
      phrase = phrase//" STEPS "//to_text(analysis%steps)
    else if (any(time_analyses == analysis%kind)) then
      phrase = phrase//" TEND "//to_text(analysis%end_time)//" STEP "//to_text(analysis%time_step)
    else
      phrase = phrase//" MODES "//to_text(analysis%modes)
    end if
  end function describe_analysis

end module deck_modes
