!> The end of reading, for sections: drawings become constants, Poisson's ratio comes from the
!> materials, thick walls are warned of.
module deck_sections
  use kinds, only: wp
  use errors, only: error_t
  use text, only: to_text, plural, quoted, joined
  use diagnostics, only: place_t
  use section_data, only: section_unknown
  use section_topology, only: plate_fault_t, thick_plates
  use section_plates, only: plates_section
  use section_shapes, only: shape_section
  use model_data, only: section_t
  use deck_draft, only: draft_t
  use deck_drawing, only: drawing_t
  implicit none
  private

  public :: settle_sections

  !> Shapes whose shear coefficients depend on Poisson's ratio.
  character(len=4), parameter :: poisson_shapes(4) = ["RECT", "BOX ", "CIRC", "TUBE"]

contains

  !> Complete the sections; those that cannot be are no longer usable.
  subroutine settle_sections(draft)
    type(draft_t), intent(inout) :: draft
    integer :: i

    do i = 1, draft%drawings
      if (draft%drawing(i)%section > 0) call settle_drawing(draft, draft%drawing(i))
    end do
    call settle_poisson(draft)
    do i = 1, size(draft%model%section)
      if (draft%model%section(i)%geometry%kind == section_unknown) cycle
      call warn_of_thick_walls(draft, draft%model%section(i))
    end do
  end subroutine settle_sections

  !> Constants of a SECTION PLATES card.
  subroutine settle_drawing(draft, drawing)
    type(draft_t), intent(inout) :: draft
    type(drawing_t), intent(in) :: drawing
    integer :: plates(2, drawing%plates), i
    real(wp) :: points(2, drawing%points)
    type(plate_fault_t) :: fault
    type(error_t), allocatable :: error
    logical :: sound

    sound = .not. drawing%broken
    if (sound) call find_ends(draft, drawing, plates, sound)
    associate (section => draft%model%section(drawing%section))
      if (sound) then
        do i = 1, drawing%points
          points(:, i) = drawing%point(i)%position
        end do
        call plates_section(points, plates, [(drawing%plate(i)%thickness, i=1, drawing%plates)], &
                            section%constants, section%geometry, fault, error)
        if (allocated(error)) call report_fault(draft, drawing, fault, error%message)
        sound = .not. allocated(error)
      end if
      if (sound) then
        section%geometry%number = [(drawing%point(i)%number, i=1, drawing%points)]
      else
        draft%sections%usable(drawing%section) = .false.
        section%geometry%kind = section_unknown
        section%place = place_t()
      end if
    end associate
  end subroutine settle_drawing

  !> The plates' ends as indices of points.
  subroutine find_ends(draft, drawing, plates, sound)
    type(draft_t), intent(inout) :: draft
    type(drawing_t), intent(in) :: drawing
    integer, intent(out) :: plates(:, :)
    logical, intent(inout) :: sound
    integer :: number(drawing%points), i, k

    number = [(drawing%point(i)%number, i=1, drawing%points)]
    do i = 1, drawing%plates
      do k = 1, 2
        plates(k, i) = findloc(number, drawing%plate(i)%number(k), 1)
        if (plates(k, i) > 0) cycle
        sound = .false.
        call draft%report%add_error(drawing%plate(i)%place(k), "section "// &
          name_of(draft, drawing)//" has no point "//to_text(drawing%plate(i)%number(k)))
      end do
    end do
  end subroutine find_ends

  !> An error of the drawing at the card it is about.
  subroutine report_fault(draft, drawing, fault, message)
    type(draft_t), intent(inout) :: draft
    type(drawing_t), intent(in) :: drawing
    type(plate_fault_t), intent(in) :: fault
    character(len=*), intent(in) :: message
    type(place_t) :: place, other
    character(len=:), allocatable :: hint

    place = draft%model%section(drawing%section)%place
    if (fault%point > 0) then
      place = drawing%point(fault%point)%place
      if (fault%other > 0) other = drawing%point(fault%other)%place
    else if (fault%plate > 0) then
      place = drawing%plate(fault%plate)%place(1)
      if (fault%other > 0) other = drawing%plate(fault%other)%place(1)
    end if
    hint = ""
    if (other%line > 0) hint = "the other one is at "//draft%report%location(other)
    call draft%report%add_error(place, "section "//name_of(draft, drawing)//": "//message, hint)
  end subroutine report_fault

  function name_of(draft, drawing) result(name)
    type(draft_t), intent(in) :: draft
    type(drawing_t), intent(in) :: drawing
    character(len=:), allocatable :: name

    name = quoted(trim(draft%model%section(drawing%section)%name))
  end function name_of

  !> Solid and closed shapes take Poisson's ratio from the first material they are used with.
  subroutine settle_poisson(draft)
    type(draft_t), intent(inout) :: draft
    logical :: wanted(size(draft%model%section)), warned(size(wanted))
    real(wp) :: poisson(size(wanted))
    integer :: b, i

    do i = 1, size(wanted)
      wanted(i) = any(poisson_shapes == draft%model%section(i)%shape)
    end do
    if (.not. any(wanted)) return
    warned = .false.
    poisson = huge(1.0_wp)
    do b = 1, draft%beams
      associate (beam => draft%beam(b))
        if (beam%section == 0 .or. draft%materials%reference(beam%material) <= 0) cycle
        if (.not. wanted(beam%section)) cycle
        call use_material(draft, b, poisson(beam%section), warned(beam%section))
      end associate
    end do
    do i = 1, size(wanted)
      if (wanted(i)) call give_poisson(draft%model%section(i), poisson(i))
    end do
  end subroutine settle_poisson

  !> Poisson's ratio of an isotropic material, or the largest one; a second one is warned of.
  subroutine use_material(draft, b, poisson, warned)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: b               !< index of the beam
    real(wp), intent(inout) :: poisson     !< huge: none yet
    logical, intent(inout) :: warned
    real(wp) :: nu

    associate (beam => draft%beam(b))
      associate (material => draft%model%material(beam%material))
        if (.not. (material%e > 0.0_wp .and. material%g > 0.0_wp)) return
        nu = min(0.5_wp, 0.5_wp*material%e/material%g - 1.0_wp)
      end associate
      if (poisson > 1.0_wp) then
        poisson = nu
      else if (abs(poisson - nu) > 1.0e-6_wp .and. .not. warned) then
        warned = .true.
        call draft%report%add_warning(beam%place, "section "// &
          quoted(trim(draft%model%section(beam%section)%name))//" is used with Poisson's "// &
          "ratios "//to_text(poisson)//" and "//to_text(nu)// &
          ": its shear coefficients are those of the first", &
          "give each material a section of its own")
      end if
    end associate
  end subroutine use_material

  subroutine give_poisson(section, poisson)
    type(section_t), intent(inout) :: section
    real(wp), intent(in) :: poisson        !< huge: none
    type(error_t), allocatable :: error

    if (poisson > 1.0_wp) then
      section%defaults = joined(section%defaults, ", ", "Poisson's ratio "// &
                                to_text(section%poisson))
    else
      section%poisson = poisson
      call shape_section(trim(section%shape), section%sizes, poisson, section%constants, &
                         section%geometry, error)
    end if
  end subroutine give_poisson

  !> Once for a section: walls too thick for the theory of thin ones.
  subroutine warn_of_thick_walls(draft, section)
    type(draft_t), intent(inout) :: draft
    type(section_t), intent(in) :: section
    logical, allocatable :: thick(:)
    integer :: i

    associate (g => section%geometry)
      if (.not. allocated(g%plates)) return
      thick = thick_plates(g%points, g%plates, g%thickness)
      i = findloc(thick, .true., 1)
      if (i == 0) return
      call draft%report%add_warning(section%place, "section "//quoted(trim(section%name))// &
        ": "//plural(count(thick), "wall")//" thicker than a fifth of the width, where the "// &
        "theory of thin walls loses accuracy", "the one between points "// &
        to_text(g%number(g%plates(1, i)))//" and "//to_text(g%number(g%plates(2, i)))// &
        " is "//to_text(g%thickness(i))//" thick and "// &
        to_text(norm2(g%points(:, g%plates(1, i)) - g%points(:, g%plates(2, i))))//" wide")
    end associate
  end subroutine warn_of_thick_walls

end module deck_sections
