!> The command line as data.
module app_options
  use kinds, only: wp
  use errors, only: error_t, fail, exit_usage
  use text, only: string_t, quoted, nearest_word, newline
  use deck_settings, only: is_identifier
  use model_data, only: setting_t
  use deck_number, only: parse_number
  use deck_modes, only: run_modes, missing_modes
  use output_log, only: log_quiet, log_normal, log_verbose
  use output_differences, only: tolerance_t
  implicit none
  private

  public :: command_t, get_words, parse_words

  character(len=*), parameter, public :: commands(7) = &
    ["run     ", "check   ", "section ", "keywords", "compare ", "digest  ", "info    "]

  !> What the user asks for.
  type :: command_t
    character(len=:), allocatable :: action    !< one of `commands`, "help" or "version"
    character(len=:), allocatable :: argument  !< deck, keyword, command to explain; or empty
    character(len=:), allocatable :: output    !< -o; empty: the default
    type(setting_t), allocatable :: setting(:) !< -D
    character(len=:), allocatable :: restart   !< --restart; empty: not given
    logical :: overwrite = .true.
    logical :: progress = .true.
    logical :: drawn = .true.                  !< with /VTKHDF
    character(len=:), allocatable :: name      !< of a section, empty: all; second file to compare
    type(string_t), allocatable :: only(:)     !< --only
    type(tolerance_t) :: tolerance             !< --rtol, --atol
    integer :: digits = 6                      !< --digits
    integer :: mode = -1                       !< --mode; -1: not given
    logical :: json = .false.
    logical :: markdown = .false.
    integer :: level = log_normal              !< one of `log_*`
  end type command_t

contains

  !> The words of the command line of this process.
  subroutine get_words(words)
    type(string_t), allocatable, intent(out) :: words(:)
    integer :: i, length

    allocate (words(command_argument_count()))
    do i = 1, size(words)
      call get_command_argument(i, length=length)
      allocate (character(len=length) :: words(i)%s)
      if (length > 0) call get_command_argument(i, words(i)%s)
    end do
  end subroutine get_words

  !> What the words ask for.
  subroutine parse_words(words, command, error)
    type(string_t), intent(in) :: words(:)
    type(command_t), intent(out) :: command
    type(error_t), allocatable, intent(out) :: error

    command%argument = ""
    command%output = ""
    command%name = ""
    command%restart = ""
    allocate (command%setting(0), command%only(0))
    if (size(words) == 0) then
      call refuse("no command given", "", error)
      return
    end if
    select case (words(1)%s)
    case ("-h", "--help", "help")
      command%action = "help"
      if (size(words) > 1) command%argument = words(2)%s
    case ("-V", "--version")
      command%action = "version"
    case default
      if (any(commands == words(1)%s)) then
        command%action = words(1)%s
        call parse_arguments(words(2:), command, error)
      else
        call refuse_command(words(1)%s, error)
      end if
    end select
  end subroutine parse_words

  !> A first word that is no command is perhaps a deck.
  subroutine refuse_command(word, error)
    character(len=*), intent(in) :: word
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: near
    logical :: exists

    inquire (file=word, exist=exists)
    near = nearest_word(word, commands)
    if (index(word, "-") == 1) then
      call refuse("unknown option "//quoted(word), "", error)
    else if (exists .or. (near == "" .and. scan(word, "./") > 0)) then
      call fail(error, exit_usage, quoted(word)//" is not a command"//newline// &
                "    hint: spar run "//word)
    else
      call refuse("unknown command "//quoted(word), near, error)
    end if
  end subroutine refuse_command

  !> Options and arguments behind the command.
  subroutine parse_arguments(words, command, error)
    type(string_t), intent(in) :: words(:)
    type(command_t), intent(inout) :: command
    type(error_t), allocatable, intent(out) :: error
    integer :: i
    logical :: options

    options = .true.
    i = 1
    do while (i <= size(words))
      associate (word => words(i)%s)
        if (options .and. word == "--") then
          options = .false.
        else if (options .and. index(word, "-") == 1 .and. len(word) > 1) then
          call parse_option(words, i, command, error)
          if (allocated(error) .or. command%action == "help") return
        else if (any(["section", "compare"] == command%action) .and. word /= "" .and. &
                 command%argument /= "" .and. command%name == "") then
          command%name = word
        else if (command%argument /= "" .or. word == "") then
          call refuse("unexpected argument "//quoted(word), "", error, command%action)
          return
        else
          command%argument = word
        end if
      end associate
      i = i + 1
    end do
    select case (command%action)
    case ("keywords")
    case ("compare", "digest", "info")
      if (command%argument == "") call refuse("no result file given", "", error, command%action)
      if (command%action == "compare" .and. command%argument /= "" .and. command%name == "") then
        call refuse("two result files are needed", "", error, command%action)
      end if
    case default
      if (command%argument == "") call refuse("no deck given", "", error, command%action)
    end select
  end subroutine parse_arguments

  !> One option; `i` moves on to its last word.
  subroutine parse_option(words, i, command, error)
    type(string_t), intent(in) :: words(:)
    integer, intent(inout) :: i
    type(command_t), intent(inout) :: command
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: option, value

    option = words(i)%s
    if (option(:2) == "-o" .or. option(:2) == "-D") option = option(:2)
    if (.not. any(options_of(command%action) == option)) then
      call refuse("unknown option "//quoted(words(i)%s), &
                  nearest_word(option, options_of(command%action)), error, command%action)
      return
    end if
    select case (option)
    case ("-o", "-D")
      call get_value(words, i, command, value, error)
      if (allocated(error)) return
      if (option == "-o") call set_output(value, command, error)
      if (option == "-D") call add_setting(value, command, error)
    case ("--no-overwrite")
      command%overwrite = .false.
    case ("--rtol", "--atol", "--digits", "--only", "--mode", "--restart")
      call take_value(words, i, command, error)
    case ("--no-progress")
      command%progress = .false.
    case ("--no-vtk")
      command%drawn = .false.
    case ("--quiet", "--verbose")
      if (command%level /= log_normal) call refuse("give --quiet or --verbose once", "", error)
      command%level = merge(log_quiet, log_verbose, option == "--quiet")
    case ("--json")
      command%json = .true.
    case ("--markdown")
      command%markdown = .true.
    case default
      command%argument = command%action
      command%action = "help"
    end select
  end subroutine parse_option

  !> Options that a command has.
  pure function options_of(action) result(options)
    character(len=*), intent(in) :: action
    character(len=14), allocatable :: options(:)

    select case (action)
    case ("run")
      options = [character(len=14) :: "-h", "--help", "-D", "-o", "--no-overwrite", "--quiet", &
                 "--verbose", "--no-progress", "--no-vtk", "--mode", "--restart"]
    case ("check")
      options = [character(len=14) :: "-h", "--help", "-D", "-o", "--no-overwrite", "--no-vtk", &
                 "--json"]
    case ("section")
      options = [character(len=14) :: "-h", "--help", "-D", "--json"]
    case ("compare")
      options = [character(len=14) :: "-h", "--help", "--rtol", "--atol", "--only", "--json"]
    case ("digest")
      options = [character(len=14) :: "-h", "--help", "--digits"]
    case ("info")
      options = [character(len=14) :: "-h", "--help", "--json"]
    case default
      options = [character(len=14) :: "-h", "--help", "--markdown"]
    end select
  end function options_of

  !> The value of `-o FILE` or `-oFILE`.
  subroutine get_value(words, i, command, value, error)
    type(string_t), intent(in) :: words(:)
    integer, intent(inout) :: i
    type(command_t), intent(in) :: command
    character(len=:), allocatable, intent(out) :: value
    type(error_t), allocatable, intent(out) :: error

    value = words(i)%s(3:)
    if (value /= "") return
    if (i < size(words)) then
      i = i + 1
      value = words(i)%s
    end if
    if (value == "") call refuse("option "//quoted(words(i)%s(:2))//" needs a value", "", error, &
                                 command%action)
  end subroutine get_value

  !> An option of comparisons and digests with the word behind it; `i` moves on to that.
  subroutine take_value(words, i, command, error)
    type(string_t), intent(in) :: words(:)
    integer, intent(inout) :: i
    type(command_t), intent(inout) :: command
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: number
    integer :: status

    i = i + 1
    if (i > size(words)) then
      call refuse("option "//quoted(words(i - 1)%s)//" needs a value", "", error, command%action)
      return
    end if
    associate (option => words(i - 1)%s, word => words(i)%s)
      if (option == "--only") then
        call add_path(word, command%only)
        if (word == "") call refuse("'--only' needs a path", "", error, command%action)
        return
      else if (option == "--mode") then
        call set_mode(word, command, error)
        return
      else if (option == "--restart") then
        if (command%restart /= "") call refuse("option '--restart' is given twice", "", error, &
                                               command%action)
        command%restart = word
        if (word == "") call refuse("'--restart' needs a result file", "", error, command%action)
        return
      end if
      call parse_number(word, number, status)
      if (status == 0 .and. option == "--digits") then
        if (number < 1 .or. number > 17 .or. abs(number - anint(number)) > 0) status = 1
        if (status == 0) command%digits = nint(number)
      else if (status == 0) then
        if (number < 0) status = 1
        if (option == "--rtol") command%tolerance%relative = number
        if (option == "--atol") command%tolerance%absolute = number
      end if
      if (status /= 0) call refuse(quoted(word)//" is no value of "//option, "", error, &
                                   command%action)
    end associate
  end subroutine take_value

  !> One of SPACAR's run modes.
  subroutine set_mode(word, command, error)
    character(len=*), intent(in) :: word
    type(command_t), intent(inout) :: command
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: number
    integer :: status

    call parse_number(word, number, status)
    if (command%mode >= 0) then
      call refuse("option '--mode' is given twice", "", error, command%action)
    else if (status /= 0 .or. scan(word, ".eEdD") > 0 .or. &
             .not. any(abs(number - [run_modes, missing_modes]) < 0.5_wp)) then
      call refuse(quoted(word)//" is no mode: 0, 1, 2, 7, 8 and 10 are", "", error, command%action)
    else if (any(missing_modes == nint(number))) then
      call refuse("--mode "//word//" is not available yet", "", error, command%action)
    else
      command%mode = nint(number)
    end if
  end subroutine set_mode

  pure subroutine add_path(path, paths)
    character(len=*), intent(in) :: path
    type(string_t), allocatable, intent(inout) :: paths(:)
    type(string_t), allocatable :: more(:)
    integer :: i

    allocate (more(size(paths) + 1))
    do i = 1, size(paths)
      more(i)%s = paths(i)%s
    end do
    more(size(more))%s = path
    call move_alloc(more, paths)
  end subroutine add_path

  subroutine set_output(value, command, error)
    character(len=*), intent(in) :: value
    type(command_t), intent(inout) :: command
    type(error_t), allocatable, intent(out) :: error

    if (command%output /= "") call refuse("option '-o' is given twice", "", error, command%action)
    command%output = value
  end subroutine set_output

  !> NAME=VALUE.
  subroutine add_setting(value, command, error)
    character(len=*), intent(in) :: value
    type(command_t), intent(inout) :: command
    type(error_t), allocatable, intent(out) :: error
    type(setting_t), allocatable :: more(:)
    integer :: at, i, n

    at = index(value, "=")
    if (at < 2 .or. at == len(value)) then
      call refuse("'-D' takes NAME=VALUE, not "//quoted(value), "", error, command%action)
    else if (.not. is_identifier(value(:at - 1))) then
      call refuse(quoted(value(:at - 1))//" is not a name", "", error, command%action)
    end if
    if (allocated(error)) return
    n = size(command%setting)
    allocate (more(n + 1))
    do i = 1, n
      more(i) = command%setting(i)
      if (more(i)%name == value(:at - 1)) then
        call refuse("'-D "//value(:at - 1)//"' is given twice", "", error, command%action)
      end if
    end do
    more(n + 1)%name = value(:at - 1)
    more(n + 1)%value = value(at + 1:)
    call move_alloc(more, command%setting)
  end subroutine add_setting

  !> An error of usage, with what may have been meant or where help is.
  subroutine refuse(message, near, error, action)
    character(len=*), intent(in) :: message, near
    type(error_t), allocatable, intent(out) :: error
    character(len=*), intent(in), optional :: action
    character(len=:), allocatable :: hint

    hint = "spar --help"
    if (present(action)) hint = "spar "//action//" --help"
    if (near /= "") hint = "did you mean "//near//"?"
    call fail(error, exit_usage, message//newline//"    hint: "//hint)
  end subroutine refuse

end module app_options
