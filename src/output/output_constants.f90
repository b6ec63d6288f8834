!> The constants of sections for people and, as JSON, for programs: `spar section`.
module output_constants
  use kinds, only: wp
  use text, only: to_text, joined
  use section_data, only: section_constants_t, to_drawn
  use section_shapes, only: shape_dimensions_t, not_given
  use model_data, only: model_t, section_t
  use output_sketch, only: sketch_t, draw_section
  use output_json, only: json_string
  implicit none
  private

  public :: print_section, print_sections_json

  integer, parameter :: constants = 18
  character(len=3), parameter :: names(constants) = [character(len=3) :: "A", "IY", "IZ", "IT", &
    "IW", "IP", "YS", "ZS", "DY", "DZ", "DW", "DYZ", "DYW", "DZW", "BY", "BZ", "BW", "IR"]
  character(len=2), parameter :: units(constants) = [character(len=2) :: "L2", "L4", "L4", "L4", &
    "L6", "L4", "L", "L", "L2", "L2", "L4", "L2", "L3", "L3", "L", "L", "1", "L6"]
  character(len=50), parameter :: meanings(constants) = [character(len=50) :: &
    "area", "second moment, integral of z^2", "second moment, integral of y^2", &
    "torsion constant", "warping constant", "polar moment about the centroid, IY + IZ", &
    "shear centre from the centroid, y", "shear centre from the centroid, z", &
    "shear rigidity over G, y", "shear rigidity over G, z", "shear rigidity over G, warping", &
    "coupling of shear in y and z", "coupling of shear in y and warping", &
    "coupling of shear in z and warping", "Wagner constant of IY", "Wagner constant of IZ", &
    "Wagner constant of IW", "residual Wagner constant"]

contains

  !> Constants in the order of `names`.
  pure function values(c)
    type(section_constants_t), intent(in) :: c
    real(wp) :: values(constants)

    values = [c%a, c%iy, c%iz, c%it, c%iw, c%ip(), c%ys, c%zs, c%d(1, 1), c%d(2, 2), c%d(3, 3), &
              c%d(1, 2), c%d(1, 3), c%d(2, 3), c%by, c%bz, c%bw, c%ir]
  end function values

  !> Name, axes, constants, drawing of a section.
  subroutine print_section(unit, model, section)
    integer, intent(in) :: unit
    type(model_t), intent(in) :: model
    type(section_t), intent(in) :: section
    real(wp) :: value(constants)
    character(len=16) :: number
    integer :: i

    call say(unit, "SECTION "//trim(section%name)//" "//trim(section%shape)//sizes_text(section))
    if (section%defaults /= "") call say(unit, "  defaults taken: "//section%defaults)
    call say(unit, "  about the principal axes through the centroid:")
    value = values(section%constants)
    do i = 1, constants
      number = to_text(without_noise(value(i), units(i), section%constants%a), 8)
      if (is_rigid(section%constants, names(i))) number = "rigid"
      call say(unit, "    "//names(i)//"  "//number//power(units(i))//"  "//trim(meanings(i)))
    end do
    call print_masses(unit, model, section)
    call print_axes(unit, section)
    if (allocated(section%geometry%outline)) call print_drawing(unit, section)
  end subroutine print_section

  !> Zero for what round-off has left of it, measured by the square root of the area.
  pure real(wp) function without_noise(value, unit_word, area)
    real(wp), intent(in) :: value, area
    character(len=*), intent(in) :: unit_word
    integer :: exponent

    exponent = 0
    if (unit_word /= "1") exponent = max(1, index("23456", unit_word(2:2)) + 1)
    without_noise = value
    if (abs(value) <= 1.0e-11_wp*sqrt(area)**exponent) without_noise = 0.0_wp
  end function without_noise

  !> A line; who no longer reads it is no error.
  subroutine say(unit, line)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: line
    integer :: status

    write (unit, "(a)", iostat=status) trim(line)
    if (status /= 0) return
  end subroutine say

  !> The sizes as on the card.
  function sizes_text(section) result(phrase)
    type(section_t), intent(in) :: section
    character(len=:), allocatable :: phrase
    character(len=3), parameter :: size_names(9) = ["H  ", "B  ", "T  ", "TW ", "B2 ", "T2 ", &
                                                    "LIP", "C  ", "D  "]
    real(wp) :: size_value(9)
    integer :: i

    phrase = ""
    associate (s => section%sizes)
      size_value = [s%h, s%b, s%t, s%tw, s%b2, s%t2, s%lip, s%c, s%d]
      do i = 1, size(size_value)
        if (.not. size_value(i) > not_given) cycle
        phrase = phrase//" "//trim(size_names(i))//" "//to_text(size_value(i))
      end do
      if (s%midline) phrase = phrase//" MIDLINE"
    end associate
    if (section%shape /= "PLATES") return
    phrase = " of "//to_text(size(section%geometry%number))//" points and "// &
             to_text(size(section%geometry%thickness))//" plates"
  end function sizes_text

  pure logical function is_rigid(c, name)
    type(section_constants_t), intent(in) :: c
    character(len=*), intent(in) :: name
    character(len=2), parameter :: shears(3) = ["DY", "DZ", "DW"]

    is_rigid = any(shears == name .and. (c%shear_rigid .or. .not. c%shear_given))
  end function is_rigid

  !> `L^4` in a column.
  pure function power(unit_word) result(word)
    character(len=*), intent(in) :: unit_word
    character(len=4) :: word

    word = unit_word
    if (len_trim(unit_word) == 2) word = "L^"//unit_word(2:2)
    if (unit_word == "1") word = "-"
  end function power

  !> Mass per length with each material that the section is used with.
  subroutine print_masses(unit, model, section)
    integer, intent(in) :: unit
    type(model_t), intent(in) :: model
    type(section_t), intent(in) :: section
    logical :: used(size(model%material))
    character(len=16) :: number
    integer :: i

    used = materials_of(model, section)
    do i = 1, size(used)
      if (.not. used(i)) cycle
      number = to_text(model%material(i)%rho*section%constants%a, 8)
      call say(unit, "    rhoA "//number//"M/L   mass per length, "//trim(model%material(i)%name))
    end do
  end subroutine print_masses

  !> Materials with a density that elements have besides this section.
  pure function materials_of(model, section) result(used)
    type(model_t), intent(in) :: model
    type(section_t), intent(in) :: section
    logical :: used(size(model%material))
    integer :: m

    used = .false.
    do m = 1, size(model%member)
      associate (member => model%member(m))
        if (member%section <= 0 .or. member%material <= 0) cycle
        if (model%section(member%section)%name /= section%name) cycle
        used(member%material) = model%material(member%material)%rho > 0.0_wp
      end associate
    end do
  end function materials_of

  !> Turn of the axes, centroid and shear centre as the user sees them.
  subroutine print_axes(unit, section)
    integer, intent(in) :: unit
    type(section_t), intent(in) :: section
    real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp
    character(len=:), allocatable :: from

    associate (g => section%geometry, c => section%constants)
      if (section%shape == "CONSTANTS") return
      call say(unit, "  principal axes turned by "//to_text(g%theta/degree)// &
               " degrees, from y to z")
      from = " from the centroid"
      if (.not. g%origin_at_centroid) then
        from = " from the drawing's origin"
        call say(unit, "  centroid C at y "//to_text(g%centroid(1))//", z "// &
                 to_text(g%centroid(2))//from)
      end if
      call say(unit, "  shear centre S at y "//to_text(user_place(section, 1))//", z "// &
               to_text(user_place(section, 2))//from//", in the axes given")
    end associate
  end subroutine print_axes

  !> Shear centre where `AT` would count it [L].
  pure function user_place(section, axis) result(x)
    type(section_t), intent(in) :: section
    integer, intent(in) :: axis
    real(wp) :: x, place(2)

    associate (g => section%geometry)
      place = to_drawn(g, [section%constants%ys, section%constants%zs])
      if (g%origin_at_centroid) place = place - g%centroid
    end associate
    x = place(axis)
    if (abs(x) <= 1.0e-12_wp*sqrt(section%constants%a)) x = 0.0_wp
  end function user_place

  subroutine print_drawing(unit, section)
    integer, intent(in) :: unit
    type(section_t), intent(in) :: section
    type(sketch_t) :: sketch
    integer :: i

    call draw_section(section%geometry, [section%constants%ys, section%constants%zs], sketch)
    call say(unit, "")
    do i = 1, sketch%rows
      call say(unit, "    "//sketch%line(i))
    end do
    call say(unit, "")
    call say(unit, "    y to the right, z up; a column is "//to_text(sketch%width, 3)// &
             " wide; "//trim(merge("X is C and S              ", "C centroid, S shear centre", &
                                   sketch%together)))
  end subroutine print_drawing

  !> All sections as one JSON object.
  subroutine print_sections_json(unit, model, shown)
    integer, intent(in) :: unit
    type(model_t), intent(in) :: model
    logical, intent(in) :: shown(:)     !< which sections
    integer :: i, last

    last = findloc(shown, .true., 1, back=.true.)
    call say(unit, "{""sections"": [")
    do i = 1, last
      if (shown(i)) call print_json(unit, model%section(i), merge(",", " ", i < last))
    end do
    call say(unit, "]}")
  end subroutine print_sections_json

  subroutine print_json(unit, section, separator)
    integer, intent(in) :: unit
    type(section_t), intent(in) :: section
    character(len=*), intent(in) :: separator
    character(len=:), allocatable :: line
    real(wp) :: value(constants)
    integer :: i

    associate (g => section%geometry, c => section%constants)
      call say(unit, " {""name"": "//json_string(trim(section%name))//", ""shape"": "// &
               json_string(trim(section%shape))//",")
      call say(unit, "  ""defaults"": "//json_string(section%defaults)//", ""angle"": "// &
               to_text(g%theta, 17)//", ""centroid"": "//json_list(g%centroid)//",")
      value = values(c)
      line = ""
      do i = 1, constants
        line = joined(line, ", ", """"//trim(names(i))//""": "//to_text(value(i), 17))
      end do
      call say(unit, "  ""constants"": {"//line//"},")
      line = ""
      do i = 1, constants
        line = joined(line, ", ", """"//trim(names(i))//""": """//trim(units(i))//"""")
      end do
      call say(unit, "  ""units"": {"//line//"},")
      line = ""
      do i = 1, 3
        line = joined(line, ", ", trim(merge("true ", "false", c%shear_rigid(i) .or. &
                                              .not. c%shear_given)))
      end do
      call say(unit, "  ""shear_rigid"": ["//line//"],")
      call print_points(unit, section, separator)
    end associate
  end subroutine print_json

  subroutine print_points(unit, section, separator)
    integer, intent(in) :: unit
    type(section_t), intent(in) :: section
    character(len=*), intent(in) :: separator
    character(len=:), allocatable :: points, plates
    integer :: i

    points = ""
    plates = ""
    associate (g => section%geometry)
      if (allocated(g%number)) then
        do i = 1, size(g%number)
          points = joined(points, ", ", "{""number"": "//to_text(g%number(i))//", ""place"": "// &
                          json_list(g%points(:, i))//", ""principal"": "// &
                          json_list(g%principal(:, i)))
          if (g%warping_known) points = points//", ""omega"": "//to_text(g%omega(i), 17)
          points = points//"}"
        end do
      end if
      if (allocated(g%plates)) then
        do i = 1, size(g%thickness)
          plates = joined(plates, ", ", "{""points"": ["//to_text(g%number(g%plates(1, i)))// &
                          ", "//to_text(g%number(g%plates(2, i)))//"], ""thickness"": "// &
                          to_text(g%thickness(i), 17)//"}")
        end do
      end if
    end associate
    call say(unit, "  ""points"": ["//points//"],")
    call say(unit, "  ""plates"": ["//plates//"]}"//separator)
  end subroutine print_points

  pure function json_list(pair) result(phrase)
    real(wp), intent(in) :: pair(2)
    character(len=:), allocatable :: phrase

    phrase = "["//to_text(pair(1), 17)//", "//to_text(pair(2), 17)//"]"
  end function json_list

end module output_constants
