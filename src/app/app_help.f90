!> The help texts of the command line.
module app_help
  implicit none
  private

  public :: print_help

contains

  !> Help for a command, or for all.
  subroutine print_help(unit, command)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: command

    select case (command)
    case ("run")
      call print_run(unit)
    case ("check")
      call print_check(unit)
    case ("section")
      call print_section(unit)
    case ("keywords")
      call print_keywords(unit)
    case default
      call print_all(unit)
    end select
  end subroutine print_help

  subroutine print_all(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar: flexible multibody systems of thin-walled beams", &
      "", &
      "  spar run DECK              solve a deck, write the results to an HDF5 file", &
      "  spar check DECK            read, check and explain a deck, run nothing", &
      "  spar section DECK [NAME]   the constants of the sections, or of one", &
      "  spar keywords [KEYWORD]    the keywords of a deck, or one in full", &
      "  spar COMMAND --help        the options of a command", &
      "  spar --version", &
      "", &
      "Exit status: 0 done, 2 usage, 3 deck or model error, 4 no solution,", &
      "             5 file or memory, 130 interrupted"
  end subroutine print_all

  subroutine print_run(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar run DECK [options]      solve a deck", &
      "", &
      "  -o OUT.h5          result file; default: the deck's name with .h5, in this folder", &
      "  -D NAME=VALUE      value of a name, in place of the deck's SET; may be repeated", &
      "  --no-overwrite     refuse to replace an existing result file", &
      "  --quiet            print nothing but errors", &
      "  --verbose          print every iteration", &
      "  --no-progress      no progress line on long runs", &
      "", &
      "The results stand in OUT.h5.part until the run ends. Ctrl-C keeps the steps that have", &
      "converged, with the attribute complete = 0."
  end subroutine print_run

  subroutine print_check(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar check DECK [options]    read, check and explain a deck; exit status 3 if unsound", &
      "", &
      "  -D NAME=VALUE      value of a name, in place of the deck's SET; may be repeated"
  end subroutine print_check

  subroutine print_section(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar section DECK [NAME] [options]    the constants of the sections of a deck, or of one,", &
      "                                      with a drawing; the deck may have nothing else", &
      "", &
      "  -D NAME=VALUE      value of a name, in place of the deck's SET; may be repeated", &
      "  --json             as JSON, in full precision"
  end subroutine print_section

  subroutine print_keywords(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar keywords [KEYWORD]      the keywords of a deck, or one in full with an example", &
      "", &
      "  --markdown         all of them, as in the manual"
  end subroutine print_keywords

end module app_help
