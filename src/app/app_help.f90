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
    case ("compare")
      call print_compare(unit)
    case ("digest")
      call print_digest(unit)
    case ("info")
      call print_info(unit)
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
      "  spar compare A.h5 B.h5     the differences between two result files", &
      "  spar digest OUT.h5         the results as text that `diff` can compare", &
      "  spar info OUT.h5           what a result file holds", &
      "  spar COMMAND --help        the options of a command", &
      "  spar --version", &
      "", &
      "Exit status: 0 done, 1 compare found differences, 2 usage, 3 deck or model error,", &
      "             4 no solution, 5 file or memory, 130 interrupted"
  end subroutine print_all

  subroutine print_run(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar run DECK [options]      solve a deck", &
      "", &
      "  -o OUT.h5          result file; default: the deck's name with .h5, in this folder", &
      "  -D NAME=VALUE      value of a name, in place of the deck's SET; may be repeated", &
      "  --mode N           of a deck without analysis cards, what SPACAR runs in this mode:", &
      "                     0 check, 1 transient and 2 inverse dynamics (TIMESTEP gives the", &
      "                     times), 7 equilibrium, then frequencies, 8 buckling multipliers of", &
      "                     the DELXF loads upon the XF loads (of the XF loads without DELXF),", &
      "                     10 load steps (default)", &
      "  --restart OUT.h5   go on where the TRANSIENT of a result file stopped: interrupted, or", &
      "                     with a later TEND; the rest of the deck is to be the same", &
      "  --no-vtk           leave out the drawing for ParaView (/VTKHDF)", &
      "  --no-overwrite     refuse to replace an existing result file", &
      "  --quiet            print nothing but errors", &
      "  --verbose          print every iteration", &
      "  --no-progress      no progress line on long runs", &
      "", &
      "The results stand in OUT.h5.part until the run ends. Ctrl-C keeps the steps that have", &
      "converged, with the attribute complete = 0. A run with --restart writes all results, old", &
      "and new, as if it had never stopped."
  end subroutine print_run

  subroutine print_check(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar check DECK [options]    read, check and explain a deck; exit status 3 if unsound", &
      "", &
      "  -D NAME=VALUE      value of a name, in place of the deck's SET; may be repeated", &
      "  -o OUT.h5          result file for the shapes of the free motions; else none is written", &
      "  --no-vtk           leave out their drawing for ParaView (/VTKHDF)", &
      "  --no-overwrite     refuse to replace an existing result file", &
      "  --json             as JSON, in full precision", &
      "", &
      "Unsound is a model whose analyses cannot run: with free motions where there is STATIC,", &
      "BUCKLING, COMPLIANCE, KINEMATIC or INVERSE, or with prescribed motions that contradict", &
      "each other. Constraints that repeat others are named, with a release that would help."
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

  subroutine print_compare(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar compare A.h5 B.h5 [options]   the differences between two result files, a line each:", &
      "                                   path, index, both values, relative error", &
      "", &
      "  --rtol R           numbers may differ by R times the larger one; default 1e-6", &
      "  --atol A           and by A; default 0", &
      "  --only PATH        compare this dataset or group; may be repeated", &
      "  --json             as JSON", &
      "", &
      "NaN differs from everything. What is below R/1000 of the largest entry of a dataset or of", &
      "what it follows from, counts as round-off (docs/results.md). Whole numbers and texts have", &
      "to be equal.", &
      "Modes are compared up to their sign, complex ones up to their phase, those of equal", &
      "eigenvalues as the space they span, not those whose eigenvalue the end of the list cuts.", &
      "/VTKHDF, /restart and convergence are left out unless --only names them.", &
      "Exit status: 0 no differences, 1 some, 2 usage, 5 a file cannot be read"
  end subroutine print_compare

  subroutine print_digest(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar digest OUT.h5 [options]       the results as text that `diff` can compare", &
      "", &
      "  --digits N         digits of a number; default 6", &
      "", &
      "No digit is printed below 1e-(N+3) of the largest entry of a dataset or of what it", &
      "follows from, so that round-off does not show (docs/results.md). Of modes of equal", &
      "eigenvalues nothing else is printed."
  end subroutine print_digest

  subroutine print_info(unit)
    integer, intent(in) :: unit

    write (unit, "(a)") &
      "spar info OUT.h5 [options]         what was run, what is inside, whether it is complete", &
      "", &
      "  --json             as JSON"
  end subroutine print_info

end module app_help
