!> Groups /deck and /model of the result file: what was computed.
module output_model
  use kinds, only: wp
  use model_data, only: model_t, member_t, components, name_length, translational, rotational, &
                        warping
  use output_hdf5, only: hdf5_file_t, about_t
  use output_drawings, only: write_drawings, write_stress_places
  use output_joints, only: write_joints, write_masses
  implicit none
  private

  public :: write_deck, write_model

  integer, parameter :: dof_missing = 0, dof_free = 1, dof_fixed = 2
  character(len=*), parameter :: type_names(2) = ["BEAMW", "BEAM "]

contains

  !> The text of the deck and the values of its names.
  subroutine write_deck(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    integer :: i, n, width

    call file%group("deck")
    call file%write("deck/text", model%deck, about_t("1", "", "the deck, includes expanded"))
    n = 0
    if (allocated(model%setting)) n = size(model%setting)
    width = 1
    do i = 1, n
      width = max(width, len(model%setting(i)%value))
    end do
    call write_settings(file, model, n, width)
  end subroutine write_deck

  subroutine write_settings(file, model, n, width)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    integer, intent(in) :: n, width    !< number of settings, length of the longest value
    character(len=name_length) :: name(n)
    character(len=width) :: value(n)
    integer :: i

    do i = 1, n
      name(i) = model%setting(i)%name
      value(i) = model%setting(i)%value
    end do
    call file%group("deck/settings")
    call file%write("deck/settings/name", name, &
                    about_t("1", "setting", "names defined by SET or -D"))
    call file%write("deck/settings/value", value, about_t("1", "setting", "their values"))
  end subroutine write_settings

  !> Nodes, elements, joints, masses, sections, materials, constraints.
  subroutine write_model(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model

    call file%group("model")
    call write_nodes(file, model)
    call write_freedom(file, model)
    call write_elements(file, model)
    call write_element_names(file, model)
    call write_joints(file, model)
    call write_masses(file, model)
    call write_sections(file, model)
    call write_drawings(file, model)
    call write_stress_places(file, model)
    call write_materials(file, model)
  end subroutine write_model

  subroutine write_nodes(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    real(wp) :: position(3, size(model%node))
    integer :: kind(3, size(model%node)), i

    do i = 1, size(model%node)
      position(:, i) = model%node(i)%position
      kind(:, i) = merge(1, 0, model%node(i)%exists)
    end do
    call file%group("model/nodes")
    call file%write("model/nodes/id", model%node%id, about_t("1", "node", &
                    "number in the deck; of an inner node, of its divided element"))
    call file%write("model/nodes/part", model%node%part, about_t("1", "node", &
                    "0, or number of the inner node of a divided element"))
    call file%write("model/nodes/kind", kind, about_t("1", "node; translational rotational"// &
                    " warping", "1: the node has these coordinates, 0: it has not"))
    call file%write("model/nodes/position", position, &
                    about_t("L", "node; X Y Z", "initial position"))
  end subroutine write_nodes

  !> Which coordinates exist, and which of them are fixed.
  subroutine write_freedom(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    integer :: freedom(components, size(model%node)), i, k

    freedom = dof_missing
    do i = 1, size(model%node)
      associate (exists => model%node(i)%exists)
        if (exists(translational)) freedom(1:3, i) = dof_free
        if (exists(rotational)) freedom(4:6, i) = dof_free
        if (exists(warping)) freedom(7, i) = dof_free
      end associate
      where (freedom(:, i) == dof_free .and. model%node(i)%fixed) freedom(:, i) = dof_fixed
    end do
    call file%write("model/degrees_of_freedom", freedom, about_t("1", &
                    "node; X Y Z RX RY RZ W", "0: does not exist, 1: free, 2: fixed"))
    call file%group("model/constraints")
    associate (fixed => reshape(freedom == dof_fixed, [size(freedom)]), &
               node => reshape(spread([(i - 1, i=1, size(model%node))], 1, components), &
                               [size(freedom)]), &
               component => reshape(spread([(k, k=1, components)], 2, size(model%node)), &
                                    [size(freedom)]))
      call file%write("model/constraints/node", pack(node, fixed), about_t("1", "constraint", &
                      "row of /model/nodes, from 0"))
      call file%write("model/constraints/component", pack(component, fixed), about_t("1", &
                      "constraint", "fixed coordinate: 1 to 7 for X Y Z RX RY RZ W"))
    end associate
  end subroutine write_freedom

  subroutine write_elements(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    integer :: node(6, size(model%member)), status(8, size(model%member)), &
               option(5, size(model%member)), i
    real(wp) :: chord(3, size(model%member)), triad(9, size(model%member))

    do i = 1, size(model%member)
      associate (m => model%member(i))
        node(:, i) = reshape(m%node, [6]) - 1
        status(:, i) = m%status
        option(:, i) = [m%second, m%mass, merge(1, 0, [m%shear, m%rotary, m%rigid])]
        chord(:, i) = m%chord
        triad(:, i) = reshape(m%triad, [9])
      end associate
    end do
    call file%group("model/elements")
    call file%write("model/elements/id", model%member%id, &
                    about_t("1", "element", "number in the deck"))
    call file%write("model/elements/part", model%member%part, about_t("1", "element", &
                    "0, or number of the part of a divided element"))
    call file%write("model/elements/nodes", node, about_t("1", "element; Xp Rp Wp Xq Rq Wq", &
                    "rows of /model/nodes, from 0; -1: none"))
    call file%write("model/elements/mode_status", status, about_t("1", "element; mode 1 to 8", &
                    "0: fixed, 1: flexible, 2: released, 3: prescribed"))
    call file%write("model/elements/options", option, about_t("1", &
                    "element; SECOND MASS SHEAR ROTARY RIGID", "SECOND 0 NONE, 1 JONKER,"// &
                    " 2 CONSISTENT; MASS 0 NONE, 1 LUMPED, 2 CONSISTENT; others 0 off, 1 on"))
    call file%write("model/elements/chord", chord, about_t("L", "element; X Y Z", &
                    "initial vector from end p to end q"))
    call file%write("model/elements/triad", triad, about_t("1", &
                    "element; eX eY eZ, X Y Z of each", "initial axes, eY and eZ principal"))
    call write_cards(file, model)
  end subroutine write_elements

  !> What ESTIFF, EM, EDAMP and ESIG cards gave, if there are any.
  subroutine write_cards(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    real(wp) :: value(8, size(model%member))
    integer :: i

    if (any(model%member%has_stiffness)) then
      do i = 1, size(model%member)
        value(:7, i) = model%member(i)%stiffness
      end do
      call file%write("model/elements/stiffness", value(:7, :), about_t("F FL2 FL2 FL2 L2 L2 FL4", &
                      "element; EA GIt EIy EIz cy cz EIw", "given by ESTIFF, else 0"))
    end if
    if (any(model%member%has_inertia)) then
      do i = 1, size(model%member)
        value(:6, i) = model%member(i)%inertia
      end do
      call file%write("model/elements/inertia", value(:6, :), about_t( &
                      "ML-1 ML ML ML ML ML3", "element; rA rIp rIy rIz rIyz rIw (r: density)", &
                      "given by EM, else 0"))
    end if
    if (any(model%member%has_damping)) then
      do i = 1, size(model%member)
        value(:5, i) = model%member(i)%damping
      end do
      call file%write("model/elements/damping", value(:5, :), about_t( &
                      "FT FL2T FL2T FL2T FL4T", "element; EA GIt EIy EIz EIw", &
                      "per rate of strain, given by EDAMP, else 0"))
    end if
    do i = 1, size(model%member)
      value(:, i) = model%member(i)%initial_stress
    end do
    if (any(abs(value) > 0)) call file%write("model/elements/initial_stress", value, &
      about_t("F", "element; mode 1 to 8", "given by ESIG, else 0"))
  end subroutine write_cards

  subroutine write_element_names(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    character(len=name_length), dimension(size(model%member)) :: section, material
    integer :: i

    section = ""
    material = ""
    do i = 1, size(model%member)
      associate (m => model%member(i))
        if (m%section > 0) section(i) = model%section(m%section)%name
        if (m%material > 0) material(i) = model%material(m%material)%name
      end associate
    end do
    call file%write("model/elements/type", type_names(model%member%kind), &
                    about_t("1", "element", "keyword"))
    call file%write("model/elements/section", section, about_t("1", "element", &
                    "name, as in /model/sections; empty: none"))
    call file%write("model/elements/material", material, about_t("1", "element", &
                    "name, as in /model/materials; empty: none"))
  end subroutine write_element_names

  !> All constants of the sections, about their principal axes.
  subroutine write_sections(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    real(wp) :: constants(17, size(model%section)), place(3, size(model%section))
    integer :: i

    do i = 1, size(model%section)
      associate (c => model%section(i)%constants, g => model%section(i)%geometry)
        constants(:, i) = [c%a, c%iy, c%iz, c%it, c%iw, c%ys, c%zs, c%d(1, 1), c%d(2, 2), &
                           c%d(3, 3), c%d(1, 2), c%d(1, 3), c%d(2, 3), c%by, c%bz, c%bw, c%ir]
        place(:, i) = [g%theta, g%centroid]
      end associate
    end do
    call file%group("model/sections")
    call file%write("model/sections/name", model%section%name, &
                    about_t("1", "section", "name"))
    call file%write("model/sections/shape", model%section%shape, &
                    about_t("1", "section", "C, I, ..., PLATES or CONSTANTS, as in the deck"))
    call file%write("model/sections/constants", constants, about_t( &
                    "L2 L4 L4 L4 L6 L L L2 L2 L4 L2 L3 L3 L L 1 L6", "section;"// &
                    " A IY IZ IT IW YS ZS DY DZ DW DYZ DYW DZW BY BZ BW IR", &
                    "about the principal axes; names as in SECTION CONSTANTS"))
    call file%write("model/sections/axes", place, about_t("1 L L", &
                    "section; angle y z", "turn of the principal axes against the drawn"// &
                    " ones in radians, centroid in the drawing"))
  end subroutine write_sections

  subroutine write_materials(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    real(wp) :: constants(4, size(model%material))
    integer :: i

    do i = 1, size(model%material)
      associate (m => model%material(i))
        constants(:, i) = [m%e, m%g, m%rho, m%damping]
      end associate
    end do
    call file%group("model/materials")
    call file%write("model/materials/name", model%material%name, &
                    about_t("1", "material", "name"))
    call file%write("model/materials/constants", constants, about_t("FL-2 FL-2 ML-3 T", &
                    "material; E G RHO DAMPING", "names as in MATERIAL"))
  end subroutine write_materials

end module output_model
