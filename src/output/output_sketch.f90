!> A section drawn with characters: y to the right, z up, as the user gave it.
module output_sketch
  use kinds, only: wp
  use section_data, only: section_geometry_t, section_open, to_drawn
  implicit none
  private

  public :: sketch_t, draw_section

  integer, parameter :: most_columns = 60, most_rows = 24
  real(wp), parameter :: aspect = 2.0_wp   !< height over width of a character

  !> Lines of characters and how large they are.
  type :: sketch_t
    integer :: rows = 0, columns = 0
    character(len=most_columns), allocatable :: line(:)  !< from above
    real(wp) :: width = 0.0_wp                           !< of a character [L]
    real(wp) :: left = 0.0_wp, bottom = 0.0_wp           !< centre of the lower left character [L]
    logical :: together = .false.                        !< C and S fall on one place, marked X
  end type sketch_t

contains

  !> Solid parts and thick walls as `#`, of thin walls the midline; centroid C, shear centre S. At
  !> most 60 by 24 characters.
  subroutine draw_section(geometry, shear_centre, sketch)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: shear_centre(2)   !< in principal axes [L]
    type(sketch_t), intent(out) :: sketch
    real(wp) :: corners(2, size(geometry%outline, 2)), low(2), high(2), size_of(2)
    integer :: i

    do i = 1, size(corners, 2)
      corners(:, i) = to_drawn(geometry, geometry%outline(:, i))
    end do
    associate (s => to_drawn(geometry, shear_centre))
      if (allocated(geometry%plates)) then
        low = min(minval(geometry%points, dim=2), s)
        high = max(maxval(geometry%points, dim=2), s)
      else
        low = min(minval(corners, dim=2), s)
        high = max(maxval(corners, dim=2), s)
      end if
    end associate
    size_of = high - low
    sketch%width = max(size_of(1)/(most_columns - 1), size_of(2)/(aspect*(most_rows - 1)))
    sketch%columns = min(most_columns, 1 + ceiling(size_of(1)/sketch%width - 1.0e-9_wp))
    sketch%rows = min(most_rows, 1 + ceiling(size_of(2)/(aspect*sketch%width) - 1.0e-9_wp))
    sketch%left = 0.5_wp*(low(1) + high(1)) - 0.5_wp*sketch%width*(sketch%columns - 1)
    sketch%bottom = 0.5_wp*(low(2) + high(2)) - 0.5_wp*aspect*sketch%width*(sketch%rows - 1)
    allocate (sketch%line(sketch%rows))
    sketch%line = ""
    if (is_thick(geometry, 2.0_wp*sketch%width)) call fill(sketch, geometry, corners)
    call draw_lines(sketch, geometry, corners)
    call mark_centres(sketch, geometry%centroid, to_drawn(geometry, shear_centre))
  end subroutine draw_section

  !> Whether there is more to see than midlines.
  pure logical function is_thick(geometry, least)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: least

    is_thick = .not. allocated(geometry%thickness)
    if (.not. is_thick) is_thick = maxval(geometry%thickness) > least
  end function is_thick

  !> Characters whose centre lies in the material.
  subroutine fill(sketch, geometry, corners)
    type(sketch_t), intent(inout) :: sketch
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: corners(:, :)
    integer :: row, column, i, first, inside
    real(wp) :: place(2)

    do row = 1, sketch%rows
      do column = 1, sketch%columns
        place = [sketch%left + (column - 1)*sketch%width, &
                 sketch%bottom + (sketch%rows - row)*aspect*sketch%width]
        inside = 0
        first = 1
        do i = 1, size(geometry%outline_last)
          if (is_inside(place, corners(:, first:geometry%outline_last(i)))) inside = inside + 1
          first = geometry%outline_last(i) + 1
        end do
        if (inside == 0 .or. (inside == 2 .and. geometry%kind /= section_open)) cycle
        sketch%line(row)(column:column) = "#"
      end do
    end do
  end subroutine fill

  !> Whether a ray from a place crosses a closed polygon an odd number of times.
  pure logical function is_inside(place, polygon)
    real(wp), intent(in) :: place(2), polygon(:, :)
    integer :: i, k

    is_inside = .false.
    k = size(polygon, 2)
    do i = 1, size(polygon, 2)
      associate (a => polygon(:, k), b => polygon(:, i))
        if ((a(2) > place(2)) .neqv. (b(2) > place(2))) then
          is_inside = is_inside .neqv. &
                      place(1) < a(1) + (b(1) - a(1))*(place(2) - a(2))/(b(2) - a(2))
        end if
      end associate
      k = i
    end do
  end function is_inside

  !> The midline of walls, however thin; of what has none, the outline.
  subroutine draw_lines(sketch, geometry, corners)
    type(sketch_t), intent(inout) :: sketch
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: corners(:, :)
    integer :: i, k, first, last

    if (allocated(geometry%plates)) then
      do i = 1, size(geometry%plates, 2)
        call draw_line(sketch, geometry%points(:, geometry%plates(1, i)), &
                       geometry%points(:, geometry%plates(2, i)))
      end do
    else
      first = 1
      do i = 1, size(geometry%outline_last)
        last = geometry%outline_last(i)
        do k = first, last
          call draw_line(sketch, corners(:, k), corners(:, merge(first, k + 1, k == last)))
        end do
        first = last + 1
      end do
    end if
  end subroutine draw_lines

  subroutine draw_line(sketch, from, to)
    type(sketch_t), intent(inout) :: sketch
    real(wp), intent(in) :: from(2), to(2)
    integer :: i, pieces, row, column

    pieces = 1 + ceiling(2.0_wp*maxval(abs(to - from))/sketch%width)
    do i = 0, pieces
      call locate(sketch, from + (to - from)*i/pieces, row, column)
      sketch%line(row)(column:column) = "#"
    end do
  end subroutine draw_line

  !> The character of a place; one half-way between two belongs to the upper, right one.
  pure subroutine locate(sketch, place, row, column)
    type(sketch_t), intent(in) :: sketch
    real(wp), intent(in) :: place(2)
    integer, intent(out) :: row, column
    real(wp), parameter :: little = 1.0e-6_wp

    column = 1 + floor((place(1) - sketch%left)/sketch%width + 0.5_wp + little)
    row = sketch%rows - floor((place(2) - sketch%bottom)/(aspect*sketch%width) + 0.5_wp + little)
    column = min(max(column, 1), sketch%columns)
    row = min(max(row, 1), sketch%rows)
  end subroutine locate

  subroutine mark_centres(sketch, centroid, shear_centre)
    type(sketch_t), intent(inout) :: sketch
    real(wp), intent(in) :: centroid(2), shear_centre(2)
    integer :: row(2), column(2)

    call locate(sketch, centroid, row(1), column(1))
    call locate(sketch, shear_centre, row(2), column(2))
    sketch%together = row(1) == row(2) .and. column(1) == column(2)
    sketch%line(row(1))(column(1):column(1)) = "C"
    sketch%line(row(2))(column(2):column(2)) = merge("X", "S", sketch%together)
  end subroutine mark_centres

end module output_sketch
