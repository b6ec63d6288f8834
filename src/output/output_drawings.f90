!> The drawings of the sections in the result file, and where stresses are given.
module output_drawings
  use kinds, only: wp
  use text, only: to_text
  use section_data, only: section_geometry_t, to_drawn
  use model_data, only: model_t, name_length
  use system_stress, only: stress_place_t, stress_places
  use output_hdf5, only: hdf5_file_t, about_t
  use output_files, only: link_name
  implicit none
  private

  public :: write_drawings, write_stress_places

  character(len=*), parameter :: in_user_axes = "in the user's axes"

contains

  !> A group for each section with a drawing, named like it.
  subroutine write_drawings(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    character(len=name_length + 12) :: name(size(model%section))
    integer :: i

    if (size(model%section) == 0) return
    do i = 1, size(model%section)
      name(i) = link_name(trim(model%section(i)%name))
      if (any(name(:i - 1) == name(i))) name(i) = trim(name(i))//"_"//to_text(i)
    end do
    call file%group("model/sections/drawings")
    do i = 1, size(model%section)
      associate (geometry => model%section(i)%geometry)
        if (.not. allocated(geometry%number)) cycle
        call file%group("model/sections/drawings/"//trim(name(i)))
        call write_points(file, "model/sections/drawings/"//trim(name(i)), geometry)
        call write_plates(file, "model/sections/drawings/"//trim(name(i)), geometry)
        call write_outline(file, "model/sections/drawings/"//trim(name(i)), geometry)
      end associate
    end do
  end subroutine write_drawings

  subroutine write_points(file, group, geometry)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(section_geometry_t), intent(in) :: geometry

    call file%write(group//"/number", geometry%number, &
                    about_t("1", "point", "number of the point, as in AT POINT"))
    call file%write(group//"/points", geometry%points, &
                    about_t("L", "point; y z", "in the user's axes, from the drawing's origin"))
    call file%write(group//"/principal", geometry%principal, &
                    about_t("L", "point; y z", "in principal axes, from the centroid"))
    if (.not. geometry%warping_known) return
    call file%write(group//"/omega", geometry%omega, about_t("L2", "point", "warping coordinate"))
  end subroutine write_points

  !> The walls, unless the section is solid or round.
  subroutine write_plates(file, group, geometry)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(section_geometry_t), intent(in) :: geometry

    if (.not. allocated(geometry%plates)) return
    call file%write(group//"/plates", geometry%plates - 1, &
                    about_t("1", "wall; end end", "rows of points, from 0"))
    call file%write(group//"/thickness", geometry%thickness, &
                    about_t("L", "wall", "thickness of the wall"))
  end subroutine write_plates

  !> Closed polygons in both axes; of a section with a hole the second one is the hole.
  subroutine write_outline(file, group, geometry)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(section_geometry_t), intent(in) :: geometry
    integer :: polygon(size(geometry%outline, 2)), i, last
    real(wp) :: drawn(2, size(geometry%outline, 2))

    last = 0
    do i = 1, size(geometry%outline_last)
      polygon(last + 1:geometry%outline_last(i)) = i - 1
      last = geometry%outline_last(i)
    end do
    do i = 1, size(drawn, 2)
      drawn(:, i) = to_drawn(geometry, geometry%outline(:, i))
    end do
    call file%write(group//"/outline", drawn, &
                    about_t("L", "corner; y z", "corners of closed polygons, "//in_user_axes))
    call file%write(group//"/outline_principal", geometry%outline, &
                    about_t("L", "corner; y z", "the same corners in principal axes"))
    call file%write(group//"/polygon", polygon, about_t("1", "corner", &
                    "number of its polygon, from 0; of two in a closed section, 1 is the hole"))
  end subroutine write_outline

  !> What the rows of point_stress stand for; nothing if no section has points.
  subroutine write_stress_places(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    type(stress_place_t), allocatable :: places(:)
    integer, allocatable :: number(:)
    integer :: i

    allocate (places, source=stress_places(model))
    if (size(places) == 0) return
    allocate (number(size(places)))
    do i = 1, size(places)
      associate (section => model%member(places(i)%member)%section)
        number(i) = model%section(section)%geometry%number(places(i)%point)
      end associate
    end do
    call file%group("model/stress_points")
    call file%write("model/stress_points/element", places%member - 1, about_t("1", &
                    "place", "row of /model/elements, from 0"))
    call file%write("model/stress_points/end", places%end - 1, about_t("1", "place", &
                    "end of the element: 0 is p, 1 is q"))
    call file%write("model/stress_points/point", places%point - 1, about_t("1", "place", &
                    "row of the points of the element's section, from 0"))
    call file%write("model/stress_points/number", number, about_t("1", "place", &
                    "number of that point, as in AT POINT"))
  end subroutine write_stress_places

end module output_drawings
