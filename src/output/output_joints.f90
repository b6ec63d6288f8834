!> Joints and masses in group /model of the result file; nothing where there are none.
module output_joints
  use kinds, only: wp
  use model_data, only: model_t, joint_t, name_length, joint_names, joint_modes, joint_gear, &
                        joint_universal, joint_slider, joint_carriage
  use output_hdf5, only: hdf5_file_t, about_t
  implicit none
  private

  public :: write_joints, write_masses

  integer, parameter :: no_mode = -1

contains

  !> What joints are and what they join.
  subroutine write_joints(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    integer :: node(4, size(model%joint)), status(6, size(model%joint)), i
    real(wp) :: chord(3, size(model%joint)), axes(6, size(model%joint))

    if (size(model%joint) == 0) return
    do i = 1, size(model%joint)
      associate (j => model%joint(i))
        node(:, i) = reshape(j%node, [4]) - 1
        status(:, i) = no_mode
        status(:joint_modes(j%kind), i) = j%status(:joint_modes(j%kind))
        chord(:, i) = j%chord
        axes(:, i) = 0
        axes(1:3, i) = j%axis(:, 1)
        if (j%kind == joint_universal) axes(4:6, i) = j%axis(:, 2)
      end associate
    end do
    call file%group("model/joints")
    call file%write("model/joints/id", model%joint%id, about_t("1", "joint", "number in the deck"))
    call file%write("model/joints/type", joint_names(model%joint%kind), &
                    about_t("1", "joint", "keyword"))
    call file%write("model/joints/nodes", node, about_t("1", "joint; Xp Rp Xq Rq", &
                    "rows of /model/nodes, from 0; -1: none"))
    call file%write("model/joints/mode_status", status, about_t("1", "joint; mode 1 to 6", &
                    "0: fixed, 1: flexible, 2: released, 3: prescribed, -1: no such mode"))
    call file%write("model/joints/chord", chord, about_t("L", "joint; X Y Z", &
                    "initial vector from end p to end q"))
    call file%write("model/joints/axes", axes, about_t("1", "joint; aX aY aZ bX bY bZ", &
                    "initial directions of a and, of UNIVERSAL, of b at end q"))
    call write_names(file, model)
    call write_cards(file, model%joint)
    call write_gears(file, model%joint)
    call write_tracks(file, model%joint)
  end subroutine write_joints

  !> Sections and materials of trusses.
  subroutine write_names(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    character(len=name_length), dimension(size(model%joint)) :: section, material
    integer :: i

    section = ""
    material = ""
    do i = 1, size(model%joint)
      associate (j => model%joint(i))
        if (j%section > 0) section(i) = model%section(j%section)%name
        if (j%material > 0) material(i) = model%material(j%material)%name
      end associate
    end do
    call file%write("model/joints/section", section, about_t("1", "joint", &
                    "name, as in /model/sections; empty: none"))
    call file%write("model/joints/material", material, about_t("1", "joint", &
                    "name, as in /model/materials; empty: none"))
  end subroutine write_names

  !> What ESTIFF, EDAMP, ESIG and EM cards gave, if there are any. The dimension of a mode depends
  !> on the joint's type: the attribute is that of an angle.
  subroutine write_cards(file, joint)
    type(hdf5_file_t), intent(inout) :: file
    type(joint_t), intent(in) :: joint(:)
    character(len=*), parameter :: modes = "joint; mode 1 to 6"
    real(wp) :: value(6, size(joint))
    integer :: i

    if (any(joint%has_stiffness)) then
      do i = 1, size(joint)
        value(:, i) = joint(i)%stiffness
      end do
      call file%write("model/joints/stiffness", value, about_t("FL", modes, &
                      "given by ESTIFF, else 0; of lengths FL-1, of TRUSS EA"))
    end if
    if (any(joint%has_damping)) then
      do i = 1, size(joint)
        value(:, i) = joint(i)%damping
      end do
      call file%write("model/joints/damping", value, about_t("FLT", modes, &
                      "given by EDAMP, else 0; of lengths FL-1T, of TRUSS FT"))
    end if
    do i = 1, size(joint)
      value(:, i) = joint(i)%initial_stress
    end do
    if (any(abs(value) > 0)) call file%write("model/joints/initial_stress", value, &
      about_t("FL", modes, "given by ESIG, else 0; of lengths F"))
    if (any(joint%has_inertia)) call file%write("model/joints/inertia", joint%inertia, &
      about_t("ML-1", "joint", "mass per length of a TRUSS given by EM, else 0"))
  end subroutine write_cards

  subroutine write_gears(file, joint)
    type(hdf5_file_t), intent(inout) :: file
    type(joint_t), intent(in) :: joint(:)
    integer :: hinge(2, size(joint)), i

    if (all(joint%kind /= joint_gear)) return
    do i = 1, size(joint)
      hinge(:, i) = joint(i)%gear - 1
    end do
    call file%write("model/joints/gear", hinge, about_t("1", "joint; first second", &
                    "hinges of a GEAR: rows of /model/joints, from 0; -1: none"))
    call file%write("model/joints/ratio", joint%ratio, about_t("1", "joint", &
                    "of a GEAR: its strain is second angle - ratio * first angle"))
  end subroutine write_gears

  !> The beams of sliders, those of one joint behind those of another.
  subroutine write_tracks(file, joint)
    type(hdf5_file_t), intent(inout) :: file
    type(joint_t), intent(in) :: joint(:)
    integer, allocatable :: track(:)
    integer :: beams(size(joint)), i

    beams = 0
    do i = 1, size(joint)
      if (any(joint(i)%kind == [joint_slider, joint_carriage])) beams(i) = size(joint(i)%track)
    end do
    if (sum(beams) == 0) return
    allocate (track(sum(beams)))
    do i = 1, size(joint)
      if (beams(i) > 0) track(sum(beams(:i - 1)) + 1:sum(beams(:i))) = joint(i)%track - 1
    end do
    call file%write("model/joints/beams", beams, about_t("1", "joint", &
                    "number of beams that a SLIDER or CARRIAGE runs along"))
    call file%write("model/joints/track", track, about_t("1", "beam", &
                    "rows of /model/elements, from 0, of all joints in their order"))
  end subroutine write_tracks

  !> Masses and rotary inertias of nodes.
  subroutine write_masses(file, model)
    type(hdf5_file_t), intent(inout) :: file
    type(model_t), intent(in) :: model
    real(wp) :: inertia(6, size(model%mass))
    integer :: i

    if (size(model%mass) == 0) return
    do i = 1, size(model%mass)
      associate (j => model%mass(i)%inertia)
        inertia(:, i) = [j(1, 1), j(1, 2), j(1, 3), j(2, 2), j(2, 3), j(3, 3)]
      end associate
    end do
    call file%group("model/masses")
    call file%write("model/masses/node", model%mass%node - 1, about_t("1", "mass", &
                    "row of /model/nodes, from 0"))
    call file%write("model/masses/mass", model%mass%mass, about_t("M", "mass", "given by XM"))
    call file%write("model/masses/inertia", inertia, about_t("ML2", &
                    "mass; Ixx Ixy Ixz Iyy Iyz Izz", "about the node, global axes at the start"))
  end subroutine write_masses

end module output_joints
