!> Cards that give sections: SECTION by constants, by a shape, by a drawing with POINT and PLATE.
module deck_section_cards
  use kinds, only: wp
  use errors, only: error_t
  use text, only: quoted, to_text, upper, lower, joined
  use section_data, only: section_constants_t, section_geometry_t
  use section_check, only: settle_shear
  use section_shapes, only: shape_dimensions_t, shape_rule_t, shape_rule, set_dimension, &
                            shape_section
  use model_data, only: standard_poisson
  use deck_card, only: card_t
  use deck_draft, only: draft_t
  use deck_drawing, only: drawn_point_t, drawn_plate_t, grow_drawings
  use deck_growth, only: grow
  use deck_model_cards, only: define_name
  implicit none
  private

  public :: read_constants, read_shape, read_plates, read_point, read_plate
  public :: shape_options, open_drawing

  integer, parameter :: most_sizes = 7   !< of a shape

contains

  !> SECTION name CONSTANTS ...; the options stand in the order of the table.
  subroutine read_constants(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(section_constants_t) :: c
    real(wp) :: value(17)
    integer :: k, i

    value = 0.0_wp
    do i = 1, size(value)
      if (card%option(i) > 0) value(i) = card%number(card%option(i) + 1)
    end do
    c%a = value(1)
    c%iy = value(2)
    c%iz = value(3)
    c%it = value(4)
    c%iw = value(5)
    c%ys = value(6)
    c%zs = value(7)
    do i = 1, 3
      c%d(i, i) = value(7 + i)
    end do
    c%d(1, 2:3) = value(11:12)
    c%d(2, 3) = value(13)
    c%d(2:3, 1) = c%d(1, 2:3)
    c%d(3, 2) = c%d(2, 3)
    c%by = value(14)
    c%bz = value(15)
    c%bw = value(16)
    c%ir = value(17)
    call settle_shear(c)
    draft%drawn = 0
    call define_name(card, 2, draft%report, draft%sections, .true., k)
    if (k == 0) return
    call grow(draft%model%section, k)
    associate (section => draft%model%section(k))
      section%name = card%word(2)
      section%shape = "CONSTANTS"
      section%constants = c
      section%defaults = constant_defaults(card, c)
      section%place = card%place(2)
    end associate
  end subroutine read_constants

  !> What a CONSTANTS card leaves to the program, for `spar check`.
  function constant_defaults(card, c) result(phrase)
    type(card_t), intent(in) :: card
    type(section_constants_t), intent(in) :: c
    character(len=:), allocatable :: phrase
    character(len=2), parameter :: names(7) = ["IW", "YS", "ZS", "BY", "BZ", "BW", "IR"]
    integer, parameter :: option(7) = [5, 6, 7, 14, 15, 16, 17]
    character(len=1), parameter :: axes(3) = ["Y", "Z", "W"]
    character(len=:), allocatable :: rigid
    integer :: i

    phrase = ""
    rigid = ""
    do i = 1, size(names)
      if (card%option(option(i)) == 0) phrase = joined(phrase, " = ", names(i))
    end do
    if (phrase /= "") phrase = phrase//" = 0"
    do i = 1, 3
      if (.not. c%shear_rigid(i) .or. (i == 3 .and. .not. c%iw > 0.0_wp)) cycle
      rigid = joined(rigid, ", ", "D"//axes(i))
    end do
    if (rigid /= "") phrase = joined(phrase, "; ", "rigid in shear: no "//rigid)
  end function constant_defaults

  !> SECTION name C|I|T|...; the options are the sizes of the shape's rule, then OUTER, MIDLINE.
  subroutine read_shape(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    type(shape_dimensions_t) :: sizes
    type(section_constants_t) :: constants
    type(section_geometry_t) :: geometry
    type(error_t), allocatable :: error
    character(len=3) :: name(most_sizes)
    character(len=:), allocatable :: shape
    logical :: known, sound
    integer :: i, k, n

    shape = upper(card%word(3))
    name = shape_sizes(shape_rule(shape))
    n = count(name /= "")
    do i = 1, n
      if (card%option(i) == 0) cycle
      call set_dimension(sizes, trim(name(i)), card%number(card%option(i) + 1), known)
    end do
    sizes%midline = card%option(n + 2) > 0
    sound = .not. (sizes%midline .and. card%option(n + 1) > 0)
    if (.not. sound) then
      call draft%report%add_error(card%place(card%option(n + 2)), &
                                  "OUTER and MIDLINE are both given")
    end if
    call shape_section(shape, sizes, standard_poisson, constants, geometry, error)
    if (allocated(error)) then
      call complain_about_size(card, draft, name(:n), error%message)
      sound = .false.
    end if
    draft%drawn = 0
    call define_name(card, 2, draft%report, draft%sections, sound, k)
    if (k == 0) return
    call grow(draft%model%section, k)
    associate (section => draft%model%section(k))
      section%name = card%word(2)
      if (.not. sound) return
      section%shape = shape
      section%sizes = sizes
      section%constants = constants
      section%geometry = geometry
      section%defaults = shape_defaults(card, name(:n))
      section%place = card%place(2)
    end associate
  end subroutine read_shape

  !> The error of a shape at the size that its message starts with.
  subroutine complain_about_size(card, draft, name, message)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    character(len=*), intent(in) :: name(:), message
    integer :: i, w

    w = 3
    do i = 1, size(name)
      if (index(message, trim(name(i))//" ") /= 1) cycle
      if (card%option(i) > 0) w = card%option(i) + 1
    end do
    call draft%report%add_error(card%place(w), message)
  end subroutine complain_about_size

  !> What a shape's card leaves to the program, for `spar check`.
  function shape_defaults(card, name) result(phrase)
    type(card_t), intent(in) :: card
    character(len=*), intent(in) :: name(:)
    character(len=:), allocatable :: phrase
    integer :: i, n

    phrase = ""
    n = size(name)
    do i = 1, n
      if (card%option(i) > 0) cycle
      if (name(i) == "B2") phrase = joined(phrase, ", ", "B2 = B")
      if (name(i) == "T2") phrase = joined(phrase, ", ", "T2 = T")
      if (name(i) == "LIP") phrase = joined(phrase, ", ", "no LIP")
    end do
    if (.not. any(name == "T") .or. any(card%option(n + 1:n + 2) > 0)) return
    phrase = joined(phrase, ", ", "OUTER sizes")
  end function shape_defaults

  !> The sizes of a shape, required ones first, then blanks: the options of its row in the keyword
  !> table.
  pure function shape_sizes(rule) result(name)
    type(shape_rule_t), intent(in) :: rule
    character(len=3) :: name(most_sizes), all(most_sizes)

    all = [rule%required, rule%optional]
    name = pack(all, all /= "", spread("   ", 1, most_sizes))
  end function shape_sizes

  !> The options of a shape in the words of the keyword table.
  pure function shape_options(rule) result(phrase)
    type(shape_rule_t), intent(in) :: rule
    character(len=:), allocatable :: phrase
    character(len=3) :: name(most_sizes)
    integer :: i

    phrase = ""
    name = shape_sizes(rule)
    do i = 1, count(name /= "")
      phrase = joined(phrase, " | ", trim(name(i))//" "//lower(trim(name(i)))//":L")
      if (any(rule%required == name(i))) phrase = phrase//"!"
    end do
    if (any(name == "T")) phrase = phrase//" | OUTER | MIDLINE"
  end function shape_options

  !> SECTION name PLATES: what is drawn by the POINT and PLATE cards behind it.
  subroutine read_plates(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer :: k

    call define_name(card, 2, draft%report, draft%sections, .true., k)
    call open_drawing(draft, k)
    if (k == 0) return
    call grow(draft%model%section, k)
    draft%model%section(k)%name = card%word(2)
    draft%model%section(k)%shape = "PLATES"
    draft%model%section(k)%defaults = ""
    draft%model%section(k)%place = card%place(2)
  end subroutine read_plates

  !> Let POINT and PLATE cards belong to a section from now on; 0: to none that matters.
  subroutine open_drawing(draft, section)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: section

    draft%drawings = draft%drawings + 1
    draft%drawn = draft%drawings
    call grow_drawings(draft%drawing, draft%drawings)
    draft%drawing(draft%drawings)%section = section
  end subroutine open_drawing

  !> POINT n y z
  subroutine read_point(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft
    integer :: i

    if (.not. has_drawing(card, draft)) return
    associate (drawing => draft%drawing(draft%drawn))
      do i = 1, drawing%points
        if (drawing%point(i)%number /= card%whole(2)) cycle
        call draft%report%add_error(card%place(2), "this section has a point "// &
          to_text(card%whole(2))//" already", "first given at "// &
          draft%report%location(drawing%point(i)%place))
        drawing%broken = .true.
        return
      end do
      call drawing%add_point(drawn_point_t(card%whole(2), card%number(3:4), card%place(2)))
    end associate
  end subroutine read_point

  !> PLATE i j t
  subroutine read_plate(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    if (.not. has_drawing(card, draft)) return
    associate (drawing => draft%drawing(draft%drawn))
      if (.not. card%number(4) > 0.0_wp) then
        call draft%report%add_error(card%place(4), "the thickness of a plate must be positive, "// &
                                    "not "//to_text(card%number(4)))
        drawing%broken = .true.
      else
        call drawing%add_plate(drawn_plate_t(card%whole(2:3), card%number(4), &
                                             [card%place(2), card%place(3)]))
      end if
    end associate
  end subroutine read_plate

  !> Whether a SECTION PLATES card stands before; else an error.
  logical function has_drawing(card, draft)
    type(card_t), intent(in) :: card
    type(draft_t), intent(inout) :: draft

    has_drawing = draft%drawn > 0
    if (has_drawing .or. draft%sections%incomplete) return
    call draft%report%add_error(card%place(1), upper(card%word(1))//" belongs behind a card "// &
                                "SECTION name PLATES")
  end function has_drawing

end module deck_section_cards
