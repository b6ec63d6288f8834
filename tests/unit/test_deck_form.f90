!> The form of a deck: numbers, expressions, words, lines, SET and INCLUDE.
module test_deck_form
  use check, only: run, expect, expect_close
  use kinds, only: wp
  use errors, only: error_t, exit_io
  use diagnostics, only: report_t, place_t
  use formula, only: formula_t, formula_value
  use model_data, only: model_t, setting_t
  use text, only: edit_distance, nearest_word
  use lookup_tables, only: id_table_t, name_table_t
  use deck_number, only: parse_number, number_ok, number_malformed, number_too_large
  use deck_settings, only: settings_t
  use deck_expression, only: compile_expression, scope_t, problem_t
  use deck_card, only: card_t, next_card
  use deck_reader, only: read_deck
  use deck_samples, only: read_sample, read_sound, frame
  implicit none
  private

  public :: run_deck_form_tests

contains

  subroutine run_deck_form_tests()
    call run("deck: numbers that are", good_numbers)
    call run("deck: numbers that are not", bad_numbers)
    call run("deck: expressions", expressions)
    call run("deck: expressions without value", undefined_values)
    call run("deck: words, comments, continuation", words)
    call run("deck: line ends, tabs, UTF-8", odd_bytes)
    call run("deck: columns behind UTF-8 are characters", columns)
    call run("deck: SET and -D", settings)
    call run("deck: -D that fits nothing", unknown_setting)
    call run("deck: includes", includes)
    call run("deck: files that cannot be read", unreadable)
    call run("deck: a range as id", ranges)
    call run("deck: a line of a million words", long_line)
    call run("edit distance", distances)
    call run("lookup tables", tables)
  end subroutine run_deck_form_tests

  subroutine good_numbers()
    call is_number("12", 12.0_wp)
    call is_number("+.5", 0.5_wp)
    call is_number("-5.", -5.0_wp)
    call is_number("1e3", 1.0e3_wp)
    call is_number("1D-3", 1.0e-3_wp)
    call is_number("2.4557823129251700847", 2.4557823129251700847_wp)
    call is_number("0.1", 0.1_wp)
    call is_number("123456789012345678901234567890123456789012345", &
                   123456789012345678901234567890123456789012345.0_wp)
    call is_number("6.02214076e+23", 6.02214076e+23_wp)
    call is_number("9.1093837015e-31", 9.1093837015e-31_wp)
    call is_number("0e99999", 0.0_wp)
    call is_number("1e-999", 0.0_wp)
  end subroutine good_numbers

  subroutine is_number(word, wanted)
    character(len=*), intent(in) :: word
    real(wp), intent(in) :: wanted
    real(wp) :: value
    integer :: status

    call parse_number(word, value, status)
    call expect(status == number_ok, word//" is a number")
    call expect_close(value, wanted, 0.0_wp, word)
  end subroutine is_number

  subroutine bad_numbers()
    character(len=5), parameter :: word(15) = ["1,5  ", "2*7  ", "1/2  ", "1e   ", "1+5  ", &
      "+    ", ".    ", "nan  ", "     ", "1e+  ", "--1  ", "1.2.3", "0x1  ", "inf  ", "1 2  "]
    real(wp) :: value
    integer :: i, status

    do i = 1, size(word)
      call parse_number(trim(word(i)), value, status)
      call expect(status == number_malformed, "'"//trim(word(i))//"' is not a number")
    end do
    call parse_number("-1e309", value, status)
    call expect(status == number_too_large, "1e309 is too large")
  end subroutine bad_numbers

  subroutine expressions()
    call has_value("-2^2", -4.0_wp)
    call has_value("2^3^2", 512.0_wp)
    call has_value("2^-1 * 3", 1.5_wp)
    call has_value("7 - 2 - 1", 4.0_wp)
    call has_value("12/3/2", 2.0_wp)
    call has_value("2*(3+4)*-1", -14.0_wp)
    call has_value("(-2)^3", -8.0_wp)
    call has_value("sqrt(2)*sin(pi/3) - cos(0.5) + tan(0.25)", &
                   sqrt(2.0_wp)*sin(acos(-1.0_wp)/3) - cos(0.5_wp) + tan(0.25_wp))
    call has_value("asin(0.3) + acos(0.3) + atan(2) + atan2(-1, -2)", &
                   asin(0.3_wp) + acos(0.3_wp) + atan(2.0_wp) + atan2(-1.0_wp, -2.0_wp))
    call has_value("exp(1.5) + log(1.5) + abs(-3)", exp(1.5_wp) + log(1.5_wp) + 3)
    call has_value("min(3, 1, 2) + 10*max(3, 7)", 71.0_wp)
    call has_value("width*i + t", 2.5_wp*3 + 7)
    call has_value("1e1+2d0", 12.0_wp)
  end subroutine expressions

  subroutine has_value(text, wanted)
    character(len=*), intent(in) :: text
    real(wp), intent(in) :: wanted
    type(formula_t) :: program
    type(problem_t) :: problem

    call compile(text, program, problem)
    call expect(.not. allocated(problem%message), text//" is an expression")
    call expect_close(formula_value(program, 7.0_wp), wanted, 4*epsilon(1.0_wp)*abs(wanted), text)
  end subroutine has_value

  subroutine compile(text, program, problem)
    character(len=*), intent(in) :: text
    type(formula_t), intent(out) :: program
    type(problem_t), intent(out) :: problem
    type(settings_t) :: settings

    call settings%define("width", "2.5", .true., 2.5_wp, place_t())
    call compile_expression(text, settings, scope_t(.true., .true., 3), program, problem)
  end subroutine compile

  subroutine undefined_values()
    character(len=16), parameter :: text(8) = ["1/0             ", "sqrt(-1)        ", &
      "log(0)          ", "exp(1000)       ", "1e200*1e200     ", "(-8)^(1/3)      ", &
      "asin(2)         ", "0^-1            "]
    type(formula_t) :: program
    type(problem_t) :: problem
    integer :: i

    do i = 1, size(text)
      call compile(trim(text(i)), program, problem)
      call expect(.not. allocated(problem%message), trim(text(i))//" is an expression")
      call expect(is_nan(formula_value(program, 0.0_wp)), trim(text(i))//" has no value")
    end do
    call compile(repeat("(", 100000), program, problem)
    call expect(allocated(problem%message), "a deep expression is refused")
  end subroutine undefined_values

  !> By its bits, since comparing may trap.
  pure logical function is_nan(x)
    use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
    real(wp), intent(in) :: x

    is_nan = ieee_is_nan(x)
  end function is_nan

  subroutine words()
    character(len=*), parameter :: text = &
      "# nothing"//achar(10)//' WORD "a # b" {1 + ! 2}x a!b'//achar(10)// &
      "one & % more"//achar(10)//achar(10)//"  two&"//achar(10)//"three"
    type(card_t) :: card
    integer :: at, line

    at = 1
    line = 1
    card%file = 1
    call next_card(text, at, line, card)
    call expect(card%words == 4, "four words")
    call expect(card%word(2) == "a # b" .and. card%is_quoted(2), "a quoted word")
    call expect(card%word(3) == "{1 + ! 2}x", "a braced word")
    call expect(card%word(4) == "a", "a comment ends a word")
    call expect(card%line(4) == 2 .and. card%column(4) == 26, "its place")
    call next_card(text, at, line, card)
    call expect(card%words == 3, "a continued card")
    call expect(card%word(2) == "two" .and. card%line(2) == 5, "its second line")
    call expect(card%raw(1) == "one two three", "its words together")
    call next_card(text, at, line, card)
    call expect(card%words == 0, "the end")
  end subroutine words

  subroutine odd_bytes()
    type(model_t) :: model
    character(len=1), parameter :: cr = achar(13), tab = achar(9)

    call read_sound("TITLE"//tab//'"caf'//char(195)//char(169)//'"'//cr//"|"//frame//cr// &
                    "|fix"//tab//"1"//cr//"|XF 2 0 0 -1 # "//char(195)//cr, model)
    call expect(model%title == "caf"//char(195)//char(169), "the title")
    call expect(model%node(1)%fixed(1), "a card with tabs and CR")
    call expect(model%pattern(1)%loads == 1, "the last line without line end")
  end subroutine odd_bytes

  subroutine columns()
    type(model_t) :: model
    type(report_t) :: report

    call read_sample(frame//'FIX 1|TITLE "'//repeat(char(195)//char(169), 4)//'" & |  x|'// &
                     "XF 2 0 0 "//char(195)//char(169)//" FUNCTION none", model, report)
    call expect(report%errors() == 1, "one error")
    if (report%items < 1) return
    call expect(report%heading(report%item(1)) == "sample.deck:9:10: '"//char(195)//char(169)// &
                "' is not a number", report%heading(report%item(1)))
  end subroutine columns

  subroutine settings()
    type(model_t) :: model
    type(report_t) :: report
    type(setting_t) :: over(2)

    over(1)%name = "L"
    over(1)%value = "9"
    over(2)%name = "which"
    over(2)%value = "bar"
    call read_sample("SET L 4|SET half {L/2}|SET which ""none""|MATERIAL m E 1 G 1|"// &
                     "SECTION bar CONSTANTS A 1 IY 1 IZ 1 IT 1|NODE 1 0 0 0|"// &
                     "NODE 2 {L} {half} {L^2}|BEAMW {L - 8} 1 2 SECTION {which} MATERIAL m|"// &
                     "FIX 1|XF 2 1 0 0", model, report, over)
    call expect(report%errors() == 0, "no errors")
    if (report%errors() > 0) return
    call expect_close(model%node(2)%position, [9.0_wp, 4.5_wp, 81.0_wp], 0.0_wp, "with -D")
    call expect(model%member(1)%id == 1, "an expression as id")
    call expect(model%member(1)%section == 1, "a SET word as name")
    call expect(model%setting(1)%name == "L" .and. model%setting(1)%value == "9", "kept")
  end subroutine settings

  subroutine unknown_setting()
    type(model_t) :: model
    type(report_t) :: report
    type(setting_t) :: over(1)

    over(1)%name = "lenght"
    over(1)%value = "9"
    call read_sample("SET length 4|"//frame//"FIX 1|XF 2 1 0 0", model, report, over)
    call expect(report%errors() == 1, "an error")
    call expect(report%heading(report%item(1)) == "-D lenght: the deck has no such SET", "its text")
    call expect(report%item(1)%hint == "did you mean length?", "its hint")
    over(1)%name = "length"
    over(1)%value = "9,5"
    call read_sample("SET length 4|"//frame//"FIX 1|XF 2 1 0 0", model, report, over)
    call expect(report%errors() == 1, "an error")
    call expect(report%heading(report%item(1)) == "-D length=9,5: '9,5' is not a number", &
        "its text")
  end subroutine unknown_setting

  subroutine includes()
    type(model_t) :: model
    type(report_t) :: report
    type(error_t), allocatable :: error
    type(setting_t) :: none(0)

    call read_deck("tests/cases/deck/outer.deck", none, model, report, error)
    call expect(.not. allocated(error) .and. report%errors() == 0, "no errors")
    if (allocated(error) .or. report%errors() > 0) return
    call expect_close(model%node(2)%position(1), 4.0_wp, 0.0_wp, "a SET value in an include")
    call expect(model%member(1)%status(1) == 1, "a section two levels deep")
    call expect(index(model%deck, "# INCLUDE parts/inner.inc"//achar(10)//"NODE 1 0 0 0") > 0, &
                "the include is expanded in the deck's text")
    call expect(index(model%deck, "IT 1"//achar(10)//"BEAMW 1") > 0, "and goes on behind it")
  end subroutine includes

  subroutine unreadable()
    type(model_t) :: model
    type(report_t) :: report
    type(error_t), allocatable :: error
    type(setting_t) :: none(0)

    call read_deck("tests/cases/deck/missing.deck", none, model, report, error)
    call expect(allocated(error), "a missing deck")
    if (allocated(error)) call expect(error%status == exit_io, "its exit status")
    call read_deck("tests/cases", none, model, report, error)
    call expect(allocated(error), "a folder")
    if (allocated(error)) call expect(error%status == exit_io, "its exit status")
  end subroutine unreadable

  subroutine ranges()
    type(model_t) :: model

    call read_sound("NODE 1:9:2 {3*(i-1)} {i^2} 0|MATERIAL m E 1 G 1|"// &
                    "SECTION s CONSTANTS A 1 IY 1 IZ 1 IT 1|"// &
                    "BEAMW 1:7:2 {i} {i+2} SECTION s MATERIAL m|FIX 1|XF 9 1 0 0", model)
    call expect(size(model%node) == 5 .and. size(model%member) == 4, "five nodes, four elements")
    call expect(size(model%node) == 5, "the sizes")
    if (size(model%node) /= 5) return
    call expect_close(model%node(3)%position, [12.0_wp, 25.0_wp, 0.0_wp], 0.0_wp, "node 5")
    call expect(model%member(2)%id == 3 .and. all(model%member(2)%node(:, 2) == 3), "element 3")
  end subroutine ranges

  subroutine long_line()
    type(model_t) :: model
    type(report_t) :: report

    call read_sample("NODE 1 0 0 0"//repeat(" 1", 1000000)//"|BEAMW "//repeat("1", 1000000), &
                     model, report)
    call expect(report%errors() == 2, "two errors")
  end subroutine long_line

  subroutine distances()
    call expect(edit_distance("FIX", "fix") == 0, "case does not count")
    call expect(edit_distance("FXI", "FIX") == 1, "a swap")
    call expect(edit_distance("kitten", "sitting") == 3, "kitten, sitting")
    call expect(edit_distance("", "abc") == 3, "from nothing")
    call expect(nearest_word("NOED", ["FIX  ", "NODE ", "BEAMW"]) == "NODE", "nearest")
    call expect(nearest_word("WIBBLE", ["FIX  ", "NODE ", "BEAMW"]) == "", "none near")
  end subroutine distances

  subroutine tables()
    type(id_table_t) :: ids
    type(name_table_t) :: names
    character(len=12) :: name
    integer :: i, k

    do i = 1, 5000
      call ids%add(7*i, modulo(i, 3), k)
      write (name, "('n', i0)") i
      call names%add(trim(name), k)
    end do
    call ids%add(70, 1, k)
    call expect(k == 10 .and. ids%entries == 5000, "an id twice is one entry")
    call expect(ids%find(7*4321, modulo(4321, 3)) == 4321, "an id is found")
    call expect(ids%find(7, 0) == 0, "another part is not")
    call expect(names%find("n4999") == 4999 .and. names%find("n5001") == 0, "names")
  end subroutine tables

end module test_deck_form
