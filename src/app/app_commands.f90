!> The commands of the program.
module app_commands
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  use errors, only: error_t, fail, exit_different, exit_usage, exit_deck
  use text, only: string_t, upper, quoted, plural, newline, nearest_word
  use program_version, only: program_name, version
  use diagnostics, only: report_t
  use model_data, only: model_t, analysis_kind_check => analysis_check
  use deck_reader, only: read_deck
  use deck_keywords, only: keywords
  use deck_modes, only: mode_check, mode_static
  use deck_manual, only: list_keywords, describe_keyword, keywords_markdown
  use analysis_run, only: run_analyses
  use analysis_check, only: check_t, check_model
  use restart_point, only: point_t
  use output_log, only: log_quiet
  use output_check, only: print_check, print_check_json
  use output_constants, only: print_section, print_sections_json
  use output_recorder, only: run_recorder_t, run_options_t
  use output_compare, only: compare_files
  use output_differences, only: differences_t, print_differences, print_differences_json
  use output_digest, only: write_digest
  use output_info, only: file_info_t, read_info, print_info, print_info_json
  use app_options, only: command_t, get_words, parse_words
  use app_help, only: print_help
  implicit none
  private

  public :: run_program

contains

  !> Do what the command line asks for; `status` is the exit status.
  subroutine run_program(status)
    integer, intent(out) :: status
    type(command_t) :: command
    type(error_t), allocatable :: error

    call read_command(command, error)
    if (.not. allocated(error)) call do_command(command, error)
    status = 0
    if (.not. allocated(error)) return
    status = error%status
    if (error%message /= "") write (error_unit, "(a)") error%message
  end subroutine run_program

  subroutine read_command(command, error)
    type(command_t), intent(out) :: command
    type(error_t), allocatable, intent(out) :: error
    type(string_t), allocatable :: words(:)

    call get_words(words)
    call parse_words(words, command, error)
  end subroutine read_command

  subroutine do_command(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error

    select case (command%action)
    case ("run")
      call run_deck(command, error)
    case ("check")
      call check_deck(command, error)
    case ("section")
      call show_sections(command, error)
    case ("keywords")
      call show_keywords(command, error)
    case ("compare")
      call compare_results(command, error)
    case ("digest")
      call write_digest(output_unit, command%argument, command%digits, error)
    case ("info")
      call show_info(command, error)
    case ("version")
      write (output_unit, "(a)") program_name//" "//version
    case default
      call print_help(output_unit, command%argument)
    end select
  end subroutine do_command

  !> Read a deck; what is wrong with it is printed.
  subroutine load_deck(command, model, error)
    type(command_t), intent(in) :: command
    type(model_t), intent(out) :: model
    type(error_t), allocatable, intent(out) :: error
    type(report_t) :: report

    call read_deck(command%argument, command%setting, model, report, error, &
                   parts=command%action == "section", &
                   mode=merge(command%mode, mode_static, command%mode >= 0))
    if (allocated(error)) return
    if (report%errors() > 0 .or. command%level > log_quiet) call report%print(error_unit)
    if (report%errors() > 0) call fail(error, exit_deck, command%argument//": "// &
                                       plural(report%errors(), "error"))
    if (.not. allocated(error) .and. command%mode >= 0) call check_mode(command, model, error)
  end subroutine load_deck

  !> --mode is for decks without analysis cards: implied analyses have no place.
  subroutine check_mode(command, model, error)
    type(command_t), intent(in) :: command
    type(model_t), intent(in) :: model
    type(error_t), allocatable, intent(out) :: error

    if (all(model%analysis%place%line == 0)) return
    call fail(error, exit_usage, "--mode is for a deck without analysis cards, "//command%argument &
              //" has some"//newline//"    hint: spar run "//command%argument)
  end subroutine check_mode

  !> spar run; SPACAR's mode 0 is spar check
  subroutine run_deck(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error
    type(model_t) :: model
    type(run_recorder_t) :: recorder
    type(run_options_t) :: options
    type(point_t), allocatable :: point
    type(error_t), allocatable :: second

    if (command%mode == mode_check) then
      call check_deck(command, error)
      return
    end if
    call get_options(command, options, error)
    if (.not. allocated(error)) call load_deck(command, model, error)
    if (.not. allocated(error)) call recorder%open(options, model, error)
    if (allocated(error)) return
    call recorder%get_point(point)
    call run_analyses(model, recorder, error, point)
    call recorder%close(.not. allocated(error), second)
    if (.not. allocated(error)) call move_alloc(second, error)
  end subroutine run_deck

  subroutine get_options(command, options, error)
    type(command_t), intent(in) :: command
    type(run_options_t), intent(out) :: options
    type(error_t), allocatable, intent(out) :: error

    options%deck = command%argument
    options%output = command%output
    if (options%output == "") options%output = base_name(command%argument)//".h5"
    if (command%restart /= "") options%restart = command%restart
    options%overwrite = command%overwrite
    options%progress = command%progress
    options%drawn = command%drawn
    options%level = command%level
    if (options%output == options%deck .or. options%output//".part" == options%deck) then
      call fail(error, exit_usage, "the results would replace the deck "//quoted(options%deck)// &
                newline//"    hint: spar run "//options%deck//" -o OTHER.h5")
    end if
  end subroutine get_options

  !> A path without folders and extension.
  pure function base_name(path) result(name)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: name
    integer :: dot

    name = path(index(path, "/", back=.true.) + 1:)
    dot = index(name, ".", back=.true.)
    if (dot > 1) name = name(:dot - 1)
  end function base_name

  !> spar check
  subroutine check_deck(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error
    type(model_t) :: model
    type(check_t) :: check

    call load_deck(command, model, error)
    if (.not. allocated(error)) call check_model(model, check, error)
    if (allocated(error)) return
    if (command%json) then
      call print_check_json(output_unit, command%argument, check)
    else
      call print_check(output_unit, check)
    end if
    if (command%output /= "") call write_motions(command, model, check, error)
    if (check%refusal /= "" .and. .not. allocated(error)) call fail(error, exit_deck, check%refusal)
  end subroutine check_deck

  !> The free motions as modes in a result file.
  subroutine write_motions(command, model, check, error)
    type(command_t), intent(in) :: command
    type(model_t), intent(in) :: model
    type(check_t), intent(in) :: check
    type(error_t), allocatable, intent(out) :: error
    type(run_recorder_t) :: recorder
    type(run_options_t) :: options
    type(model_t) :: shown
    type(error_t), allocatable :: second

    call get_options(command, options, error)
    if (allocated(error)) return
    options%level = log_quiet
    shown = model
    deallocate (shown%analysis)
    allocate (shown%analysis(1))
    shown%analysis(1)%kind = analysis_kind_check
    shown%analysis(1)%modes = check%modes%modes
    call recorder%open(options, shown, error)
    if (allocated(error)) return
    call recorder%begin(1, shown%analysis(1), error)
    if (.not. allocated(error)) call recorder%modes(check%modes, error)
    if (.not. allocated(error)) call recorder%finish(.true., error)
    call recorder%close(.not. allocated(error), second)
    if (.not. allocated(error)) call move_alloc(second, error)
  end subroutine write_motions

  !> spar section
  subroutine show_sections(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error
    type(model_t) :: model
    logical, allocatable :: shown(:)
    integer :: i

    call load_deck(command, model, error)
    if (allocated(error)) return
    shown = model%section%name == command%name .or. command%name == ""
    if (.not. any(shown)) then
      call refuse_section(command, model, error)
    else if (command%json) then
      call print_sections_json(output_unit, model, shown)
    else
      do i = 1, size(shown)
        if (.not. shown(i)) cycle
        if (any(shown(:i - 1))) write (output_unit, "(a)")
        call print_section(output_unit, model, model%section(i))
      end do
    end if
  end subroutine show_sections

  subroutine refuse_section(command, model, error)
    type(command_t), intent(in) :: command
    type(model_t), intent(in) :: model
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: near

    if (command%name == "") then
      call fail(error, exit_deck, command%argument//": the deck has no sections")
    else
      near = nearest_word(command%name, model%section%name)
      if (near /= "") near = newline//"    hint: did you mean "//near//"?"
      call fail(error, exit_usage, command%argument//": no section "//quoted(command%name)//near)
    end if
  end subroutine refuse_section

  !> spar keywords
  subroutine show_keywords(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error
    logical :: found

    if (command%markdown) then
      call keywords_markdown(output_unit)
    else if (command%argument == "") then
      call list_keywords(output_unit)
    else
      call describe_keyword(output_unit, upper(command%argument), found)
      if (.not. found) call refuse_keyword(command%argument, error)
    end if
  end subroutine show_keywords

  !> spar compare
  subroutine compare_results(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error
    type(differences_t) :: found

    call compare_files(command%argument, command%name, command%tolerance, command%only, found, &
                       error)
    if (allocated(error)) return
    if (command%json) then
      call print_differences_json(output_unit, found, command%argument, command%name)
    else
      call print_differences(output_unit, found, command%argument, command%name)
    end if
    if (found%all > 0) call fail(error, exit_different, "")
  end subroutine compare_results

  !> spar info
  subroutine show_info(command, error)
    type(command_t), intent(in) :: command
    type(error_t), allocatable, intent(out) :: error
    type(file_info_t) :: info

    call read_info(command%argument, info, error)
    if (allocated(error)) return
    if (command%json) then
      call print_info_json(output_unit, info)
    else
      call print_info(output_unit, info)
    end if
  end subroutine show_info

  subroutine refuse_keyword(name, error)
    character(len=*), intent(in) :: name
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: hint

    associate (table => keywords())
      hint = nearest_word(name, table%name)
    end associate
    if (hint /= "") hint = "did you mean "//hint//"?"
    if (hint == "") hint = "spar keywords"
    call fail(error, exit_usage, "no keyword "//quoted(name)//newline//"    hint: "//hint)
  end subroutine refuse_keyword

end module app_commands
