!> What `spar check` prints, as text or JSON.
module output_check
  use text, only: string_t, to_text, plural
  use analysis_check, only: check_t, finding_t, element_names, status_names
  use output_json, only: json_string, json_number, json_logical
  implicit none
  private

  public :: print_check, print_check_json

  character(len=13), parameter :: kind_names(3) = ["translational", "rotational   ", &
                                                   "warping      "]

contains

  subroutine print_check(unit, check)
    integer, intent(in) :: unit
    type(check_t), intent(in) :: check
    integer :: i

    call print_counts(unit, check)
    do i = 1, size(check%defaults)
      write (unit, "(a)") check%defaults(i)%s
    end do
    call print_findings(unit, check%overconstrained, check%everywhere, "redundant constraint")
    call print_releases(unit, check%overconstrained)
    call print_findings(unit, check%only_here, check%singular, "singular constraint")
    if (check%contradiction /= "") write (unit, "(a)") "contradiction: "//check%contradiction
    call print_findings(unit, check%motion, check%mobile, "free motion")
    if (check%mobile == 0) write (unit, "(a)") "nothing moves freely"
  end subroutine print_check

  subroutine print_counts(unit, check)
    integer, intent(in) :: unit
    type(check_t), intent(in) :: check
    integer :: i

    call line("nodes", check%nodes)
    do i = 1, 3
      if (check%kind(i) > 0) call line("  "//kind_names(i), check%kind(i))
    end do
    call line("elements", sum(check%element))
    do i = 1, size(element_names)
      if (check%element(i) > 0) call line("  "//element_names(i), check%element(i))
    end do
    call line("generalized strains", sum(check%strain))
    do i = 1, 4
      associate (status => modulo(i, 4))
        if (check%strain(status) > 0) call line("  "//status_names(status), check%strain(status))
      end associate
    end do
    call line("coordinates in use", check%used)
    call line("  held by FIX or by rigid torsion (W)", check%held)
    call line("  free", check%free)
    call line("constraint equations", check%constraints)
    call line("  redundant", check%redundant)
    if (check%singular > 0) call line("  singular", check%singular)
    call line("degrees of freedom", check%freedoms)
    call line("  flexible", check%freedoms - check%mobile)
    call line("  free motions", check%mobile)

  contains

    subroutine line(what, number)
      character(len=*), intent(in) :: what
      integer, intent(in) :: number

      write (unit, "(a, t42, i9)") what, number
    end subroutine line

  end subroutine print_counts

  subroutine print_findings(unit, finding, all, noun)
    integer, intent(in) :: unit, all
    type(finding_t), intent(in) :: finding(:)
    character(len=*), intent(in) :: noun
    integer :: i

    do i = 1, size(finding)
      write (unit, "(a)") finding(i)%text
    end do
    if (all > size(finding)) write (unit, "(a)") "and "//plural(all - size(finding), "more "//noun)
  end subroutine print_findings

  !> Releases that together end several redundancies.
  subroutine print_releases(unit, finding)
    integer, intent(in) :: unit
    type(finding_t), intent(in) :: finding(:)
    integer :: i

    if (size(finding) < 2 .or. all([(finding(i)%card == "", i=1, size(finding))])) return
    write (unit, "(a)") "together these would remove them:"
    do i = 1, size(finding)
      if (finding(i)%card /= "") write (unit, "(a)") "    "//finding(i)%card
    end do
  end subroutine print_releases

  subroutine print_check_json(unit, deck, check)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: deck
    type(check_t), intent(in) :: check
    integer :: i

    write (unit, "(a)") "{""deck"": "//json_string(deck)//", ""sound"": "// &
      json_logical(check%refusal == "")//", ""refusal"": "//json_string(check%refusal)//","
    write (unit, "(a)") " ""nodes"": {""all"": "//to_text(check%nodes)// &
      counts(kind_names, check%kind)//"},"
    write (unit, "(a)") " ""elements"": {""all"": "//to_text(sum(check%element))// &
      counts(element_names, check%element)//"},"
    write (unit, "(a)") " ""strains"": {""all"": "//to_text(sum(check%strain))// &
      counts(status_names, check%strain)//"},"
    write (unit, "(a)") " ""coordinates"": {""all"": "//to_text(check%used)//", ""held"": "// &
      to_text(check%held)//", ""free"": "//to_text(check%free)//"},"
    write (unit, "(a)") " ""constraints"": {""all"": "//to_text(check%constraints)// &
      ", ""redundant"": "//to_text(check%redundant)//", ""singular"": "// &
      to_text(check%singular)//"},"
    write (unit, "(a)") " ""degrees_of_freedom"": {""all"": "//to_text(check%freedoms)// &
      ", ""flexible"": "//to_text(check%freedoms - check%mobile)//", ""free_motions"": "// &
      to_text(check%mobile)//"},"
    write (unit, "(a)") " ""defaults"": "//texts(check%defaults)//","
    write (unit, "(a)") " ""contradiction"": "//json_string(check%contradiction)//","
    call print_constraints("overconstrained", check%overconstrained)
    call print_constraints("singular", check%only_here)
    write (unit, "(a)") " ""motions"": ["
    do i = 1, size(check%motion)
      associate (f => check%motion(i))
        write (unit, "(a)") "  {""text"": "//json_string(f%text)//", ""name"": "// &
          json_string(f%name)//", ""coordinates"": "//texts(f%part)//", ""values"": "// &
          values(f)//", ""released"": "//texts(f%other)//"}"// &
          trim(merge(",", " ", i < size(check%motion)))
      end associate
    end do
    write (unit, "(a)") " ]}"

  contains

    subroutine print_constraints(key, finding)
      character(len=*), intent(in) :: key
      type(finding_t), intent(in) :: finding(:)
      integer :: i

      write (unit, "(a)") " "//json_string(key)//": ["
      do i = 1, size(finding)
        associate (f => finding(i))
          write (unit, "(a)") "  {""text"": "//json_string(f%text)//", ""redundant"": "// &
            json_string(f%name)//", ""strains"": "//texts(f%part)//", ""weights"": "// &
            values(f)//", ""fixed_nodes"": "//texts(f%other)//", ""release"": "// &
            json_string(f%card)//"}"//trim(merge(",", " ", i < size(finding)))
        end associate
      end do
      write (unit, "(a)") " ],"
    end subroutine print_constraints

  end subroutine print_check_json

  !> Numbers behind names, each with a comma in front.
  pure function counts(names, number) result(phrase)
    character(len=*), intent(in) :: names(:)
    integer, intent(in) :: number(:)
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = ""
    do i = 1, size(names)
      phrase = phrase//", "//json_string(trim(names(i)))//": "//to_text(number(i))
    end do
  end function counts

  pure function texts(list) result(phrase)
    type(string_t), intent(in) :: list(:)
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = "["
    do i = 1, size(list)
      if (i > 1) phrase = phrase//", "
      phrase = phrase//json_string(list(i)%s)
    end do
    phrase = phrase//"]"
  end function texts

  pure function values(finding) result(phrase)
    type(finding_t), intent(in) :: finding
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = "["
    do i = 1, size(finding%value)
      if (i > 1) phrase = phrase//", "
      phrase = phrase//json_number(finding%value(i))
    end do
    phrase = phrase//"]"
  end function values

end module output_check
