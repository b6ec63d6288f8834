!> Reads a deck into a model and reports everything that is wrong with it in one run.
module deck_reader
  use text, only: string_t, quoted, newline
  use errors, only: error_t
  use diagnostics, only: report_t, place_t
  use model_data, only: model_t, setting_t
  use deck_card, only: card_t, next_card
  use deck_usage, only: usage_t, parse_usage, kind_id
  use deck_draft, only: draft_t, selection_t, new_draft
  use deck_expression, only: scope_t
  use deck_handler, only: keyword_t
  use deck_keywords, only: keywords
  use deck_form, only: find_row, match_card
  use deck_values, only: evaluate_card, read_range, is_braced
  use deck_broken, only: mark_broken, mark_all_broken
  use deck_resolve, only: resolve_draft
  use deck_source, only: load_text, beside
  implicit none
  private

  public :: read_deck, read_deck_text

  integer, parameter :: deepest = 40         !< of nested includes
  integer, parameter :: most_repeats = 20000000

  !> What stays the same while a deck is read.
  type :: table_t
    type(keyword_t), allocatable :: keyword(:)
    type(usage_t), allocatable :: usage(:)
  end type table_t

contains

  !> Read a deck. `report` has all that is to be said of it; the model is sound if it has no
  !> errors. `error` is for a deck file that cannot be read at all.
  subroutine read_deck(path, overrides, model, report, error, parts, mode)
    character(len=*), intent(in) :: path
    type(setting_t), intent(in) :: overrides(:)  !< of -D
    type(model_t), intent(out) :: model
    type(report_t), intent(out) :: report
    type(error_t), allocatable, intent(out) :: error
    logical, intent(in), optional :: parts       !< of sections and materials: need not be complete
    integer, intent(in), optional :: mode        !< of SPACAR, for a deck without analysis cards
    character(len=:), allocatable :: text

    call load_text(path, text, error)
    if (.not. allocated(error)) call read_deck_text(path, text, overrides, model, report, &
                                                      parts, mode)
  end subroutine read_deck

  !> Read a deck from memory; `path` is its name in messages and where includes count from.
  subroutine read_deck_text(path, text, overrides, model, report, parts, mode)
    character(len=*), intent(in) :: path
    character(len=:), allocatable, intent(inout) :: text   !< moved into the report
    type(setting_t), intent(in) :: overrides(:)
    type(model_t), intent(out) :: model
    type(report_t), intent(out) :: report
    logical, intent(in), optional :: parts                 !< see `read_deck`
    integer, intent(in), optional :: mode                  !< see `read_deck`
    type(draft_t) :: draft
    type(table_t) :: table
    type(string_t) :: open_files(deepest)
    integer :: file

    call new_draft(overrides, draft)
    if (present(parts)) draft%complete = .not. parts
    if (present(mode)) draft%spacar_mode = mode
    call compile(table)
    call draft%report%add_file(path, text, file)
    open_files(1)%s = beside("", path)
    call read_file(file, draft, table, open_files, 1)
    call resolve_draft(draft)
    call move_model(draft, model)
    report = draft%report
    call report%sort()
  end subroutine read_deck_text

  subroutine move_model(draft, model)
    type(draft_t), intent(inout) :: draft
    type(model_t), intent(out) :: model

    call move_alloc(draft%model%title, model%title)
    call move_alloc(draft%model%deck, model%deck)
    call move_alloc(draft%model%node, model%node)
    call move_alloc(draft%model%material, model%material)
    call move_alloc(draft%model%section, model%section)
    call move_alloc(draft%model%member, model%member)
    call move_alloc(draft%model%joint, model%joint)
    call move_alloc(draft%model%mass, model%mass)
    call move_alloc(draft%model%start, model%start)
    call move_alloc(draft%model%marker, model%marker)
    call move_alloc(draft%model%point, model%point)
    call move_alloc(draft%model%function, model%function)
    call move_alloc(draft%model%pattern, model%pattern)
    call move_alloc(draft%model%analysis, model%analysis)
    call move_alloc(draft%model%setting, model%setting)
    call move_alloc(draft%model%imperfection, model%imperfection)
    call move_alloc(draft%model%kept_node, model%kept_node)
    call move_alloc(draft%model%kept_member, model%kept_member)
    model%rayleigh = draft%model%rayleigh
  end subroutine move_model

  subroutine compile(table)
    type(table_t), intent(out) :: table
    integer :: i

    table%keyword = keywords()
    allocate (table%usage(size(table%keyword)))
    do i = 1, size(table%keyword)
      associate (row => table%keyword(i))
        call parse_usage(row%name, row%forms, row%options, table%usage(i))
      end associate
    end do
  end subroutine compile

  !> All cards of a file and of those it includes.
  recursive subroutine read_file(file, draft, table, open_files, depth)
    integer, intent(in) :: file
    type(draft_t), intent(inout) :: draft
    type(table_t), intent(in) :: table
    type(string_t), intent(inout) :: open_files(:)
    integer, intent(in) :: depth
    type(card_t) :: card
    integer :: at, line, copied, first_line

    card%file = file
    at = 1
    line = 1
    copied = 0
    do while (.not. draft%finished)
      call next_card(draft%report%file(file)%text, at, line, card)
      if (card%words == 0 .and. .not. allocated(card%problem)) exit
      call read_card(card, draft, table)
      if (.not. allocated(draft%include_path)) cycle
      first_line = draft%report%file(file)%line_start(card%line(1))
      call draft%keep_file(file, copied + 1, first_line - 1)
      call draft%keep_text("# INCLUDE "//draft%include_path//newline)
      copied = at - 1
      call include_file(draft, table, open_files, depth)
    end do
    call draft%keep_file(file, copied + 1, len(draft%report%file(file)%text))
  end subroutine read_file

  !> Read the file that an INCLUDE card names.
  recursive subroutine include_file(draft, table, open_files, depth)
    type(draft_t), intent(inout) :: draft
    type(table_t), intent(in) :: table
    type(string_t), intent(inout) :: open_files(:)
    integer, intent(in) :: depth
    type(error_t), allocatable :: error
    character(len=:), allocatable :: path, text
    integer :: i, file

    path = beside(open_files(depth)%s, draft%include_path)
    deallocate (draft%include_path)
    do i = 1, depth
      if (open_files(i)%s /= path) cycle
      call draft%report%add_error(draft%include_place, "an include cycle: "//quoted(path)// &
                                  " is being read already")
      return
    end do
    if (depth == deepest) then
      call draft%report%add_error(draft%include_place, "includes nested too deeply")
      return
    end if
    call load_text(path, text, error)
    if (allocated(error)) then
      call draft%report%add_error(draft%include_place, error%message)
      call mark_all_broken(draft)
      return
    end if
    call draft%report%add_file(path, text, file)
    open_files(depth + 1)%s = path
    call read_file(file, draft, table, open_files, depth + 1)
  end subroutine include_file

  !> One card: find its row, evaluate its words, store it; once for each id of a range.
  subroutine read_card(card, draft, table)
    type(card_t), intent(inout) :: card
    type(draft_t), intent(inout) :: draft
    type(table_t), intent(in) :: table
    integer :: row, near
    logical :: ok

    row = 0
    near = 0
    if (allocated(card%problem)) then
      call draft%report%add_error(card%problem_place, card%problem)
      call mark_broken(card, draft, "")
      return
    end if
    call put_set_words(card, draft)
    call find_row(card, table%usage, draft%report, row, near)
    ok = row > 0
    if (ok) call match_card(card, table%usage(row), draft%report, ok)
    if (ok) call check_stage(card, draft, table%keyword(row), ok)
    if (ok) call store_card(card, draft, table%keyword(row), ok)
    if (.not. ok .and. near == 0) call mark_broken(card, draft, "")
    if (.not. ok .and. near > 0) call mark_broken(card, draft, trim(table%keyword(near)%name))
  end subroutine read_card

  !> `{name}` of a SET whose value is a word stands for that word, wherever a word may stand.
  subroutine put_set_words(card, draft)
    type(card_t), intent(inout) :: card
    type(draft_t), intent(in) :: draft
    integer :: w, i

    do w = 2, card%words
      if (.not. is_braced(card%text(card%first(w):card%last(w)))) cycle
      i = draft%settings%table%find(trim(adjustl(card%text(card%first(w) + 1:card%last(w) - 1))))
      if (i == 0) cycle
      if (.not. draft%settings%numeric(i)) call card%replace(w, draft%settings%word(i)%s)
    end do
  end subroutine put_set_words

  !> Model cards end with the first analysis.
  subroutine check_stage(card, draft, keyword, ok)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(keyword_t), intent(in) :: keyword
    logical, intent(inout) :: ok

    ok = keyword%stage /= "model" .or. draft%analyses == 0
    if (.not. ok) call draft%report%add_error(card%place(1), trim(keyword%name)// &
      " behind an analysis: the model is complete there", "the first analysis is at "// &
      draft%report%location(draft%model%analysis(1)%place))
  end subroutine check_stage

  subroutine store_card(card, draft, keyword, ok)
    type(card_t), intent(inout) :: card
    type(draft_t), intent(inout) :: draft
    type(keyword_t), intent(in) :: keyword
    logical, intent(inout) :: ok
    type(selection_t) :: range
    integer :: i

    range%first = 0
    range%last = 0
    if (card%words > 1) then
      if (card%kind(2) == kind_id) call own_ids(card, draft, range, ok)
    end if
    if (.not. ok) return
    do i = range%first, range%last, range%step
      draft%scope = scope_t(has_i=range%is_range, i=i)
      call evaluate_card(card, draft, ok)
      draft%scope = scope_t()
      if (.not. ok) return
      call keyword%apply(card, draft)
    end do
  end subroutine store_card

  !> The ids that a card is for.
  subroutine own_ids(card, draft, range, ok)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(selection_t), intent(inout) :: range
    logical, intent(inout) :: ok

    call read_range(card%text(card%first(2):card%last(2)), card%place(2), draft, range, ok)
    if (.not. ok) return
    if (range%id > 0) then
      call draft%report%add_error(card%place(2), "the id of a node or element has no part")
      ok = .false.
    else if (abs(range%last - range%first)/abs(range%step) > most_repeats) then
      call draft%report%add_error(card%place(2), "a range of more than 20000000 ids")
      ok = .false.
    end if
  end subroutine own_ids

end module deck_reader
