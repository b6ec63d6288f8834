!> Is the model sound? Errors and warnings with the place of the card to blame.
module model_check
  use kinds, only: wp
  use text, only: to_text, quoted
  use errors, only: error_t
  use diagnostics, only: place_t, report_t
  use section_check, only: check_constants
  use model_data, only: model_t, member_t, joint_t, section_t, mode_flexible, mode_fixed, &
                        mass_none, static_analyses, analysis_buckling, joint_truss, joint_hinge, &
                        joint_spherical, joint_modes, joint_names, translational
  implicit none
  private

  public :: check_parts, check_members, check_joints, check_use

  real(wp), parameter :: no_length = 1.0e-12_wp !< relative to the positions

  character(len=*), parameter :: stiffness_names(6) = &
    ["EA ", "GIt", "EIy", "EIy", "EIz", "EIz"]

contains

  !> Materials and sections by themselves.
  subroutine check_parts(model, report)
    type(model_t), intent(in) :: model
    type(report_t), intent(inout) :: report
    integer :: i

    do i = 1, size(model%material)
      associate (material => model%material(i))
        if (material%place%line == 0) cycle
        call need_positive(report, material%place, "E of MATERIAL", material%name, material%e)
        if (material%e > 0.0_wp) then
          call need_positive(report, material%place, "G of MATERIAL", material%name, material%g)
        end if
        if (material%rho < 0.0_wp) call report%add_error(material%place, &
          "RHO of MATERIAL "//quoted(trim(material%name))//" cannot be negative")
        if (material%damping < 0.0_wp) call report%add_error(material%place, &
          "DAMPING of MATERIAL "//quoted(trim(material%name))//" cannot be negative")
      end associate
    end do
    do i = 1, size(model%section)
      if (model%section(i)%place%line > 0) call check_section(model%section(i), report)
    end do
  end subroutine check_parts

  subroutine need_positive(report, place, what, name, value)
    type(report_t), intent(inout) :: report
    type(place_t), intent(in) :: place
    character(len=*), intent(in) :: what, name
    real(wp), intent(in) :: value

    if (value > 0.0_wp) return
    call report%add_error(place, what//" "//quoted(trim(name))//" must be positive, not "// &
                          to_text(value))
  end subroutine need_positive

  subroutine check_section(section, report)
    type(section_t), intent(in) :: section
    type(report_t), intent(inout) :: report
    type(error_t), allocatable :: error
    integer :: before

    before = report%errors()
    associate (c => section%constants, place => section%place, name => section%name)
      call need_positive(report, place, "A of SECTION", name, c%a)
      call need_positive(report, place, "IY of SECTION", name, c%iy)
      call need_positive(report, place, "IZ of SECTION", name, c%iz)
      call need_positive(report, place, "IT of SECTION", name, c%it)
      if (report%errors() > before) return
      call check_constants(c, error)
      if (.not. allocated(error)) return
      call report%add_error(place, "SECTION "//quoted(trim(name))//": "//error%message)
    end associate
  end subroutine check_section

  !> What elements need to be complete.
  subroutine check_members(model, report)
    type(model_t), intent(in) :: model
    type(report_t), intent(inout) :: report
    character(len=:), allocatable :: name
    integer :: m

    do m = 1, size(model%member)
      associate (member => model%member(m))
        if (member%part > 1) cycle
        name = "element "//to_text(member%id)
        if (member%section /= 0 .and. member%material == 0 .and. .not. member%rigid) then
          call report%add_error(member%place, name//" has a SECTION but no MATERIAL")
        else if (member%section == 0 .and. member%material /= 0) then
          call report%add_error(member%place, name//" has a MATERIAL but no SECTION")
        else if (any(member%status == mode_flexible) .and. member%section == 0) then
          call check_stiffness(member, name, report)
        end if
      end associate
    end do
  end subroutine check_members

  !> Flexible modes without SECTION need ESTIFF, and a value there.
  subroutine check_stiffness(member, name, report)
    type(member_t), intent(in) :: member
    character(len=*), intent(in) :: name
    type(report_t), intent(inout) :: report
    integer, parameter :: value(6) = [1, 2, 3, 3, 4, 4]  !< of ESTIFF and EDAMP
    integer :: mode

    if (.not. member%has_stiffness) then
      call report%add_error(member%place, name//" has flexible modes but no stiffness", &
                            "give SECTION and MATERIAL, or ESTIFF")
      return
    end if
    do mode = 1, 6
      if (member%status(mode) /= mode_flexible .or. member%stiffness(value(mode)) > 0.0_wp) cycle
      if (member%damping(value(mode)) > 0.0_wp) cycle
      call report%add_warning(member%place, "mode "//to_text(mode)//" of "//name// &
                              " is flexible, but its stiffness "//trim(stiffness_names(mode))// &
                              " is 0")
    end do
  end subroutine check_stiffness

  !> What joints need to be complete.
  subroutine check_joints(model, report)
    type(model_t), intent(in) :: model
    type(report_t), intent(inout) :: report
    character(len=:), allocatable :: name
    integer :: j, mode

    do j = 1, size(model%joint)
      associate (joint => model%joint(j))
        name = "element "//to_text(joint%id)
        if (joint%section /= 0 .and. joint%material == 0) then
          call report%add_error(joint%place, name//" has a SECTION but no MATERIAL")
        else if (joint%section == 0 .and. joint%material /= 0) then
          call report%add_error(joint%place, name//" has a MATERIAL but no SECTION")
        else if (joint%section == 0) then
          do mode = 1, joint_modes(joint%kind)
            if (joint%status(mode) /= mode_flexible) cycle
            if (joint%stiffness(mode) > 0.0_wp .or. joint%damping(mode) > 0.0_wp) cycle
            call report%add_error(joint%place, "mode "//to_text(mode)//" of "//name// &
                                  " is flexible but has no stiffness", &
                                  "give it by ESTIFF, or damping by EDAMP, or write RLSE")
          end do
        end if
        call check_length(model, joint, name, report)
        if (all(joint%kind /= [joint_truss, joint_hinge])) cycle
        if (joint%status(1) == mode_fixed .and. joint%section == 0) call report%add_warning( &
          joint%place, name//" is a "//trim(joint_names(joint%kind))//" whose mode 1 has no "// &
          "DYNE, RLSE or INPUTE: it is rigid")
      end associate
    end do
  end subroutine check_joints

  !> A TRUSS has a length, a SPHERICAL joint has none.
  subroutine check_length(model, joint, name, report)
    type(model_t), intent(in) :: model
    type(joint_t), intent(in) :: joint
    character(len=*), intent(in) :: name
    type(report_t), intent(inout) :: report
    real(wp) :: scale
    logical :: long

    if (joint%node(translational, 1) == 0) return
    associate (node => model%node(joint%node(translational, :)))
      if (.not. all(node%placed)) return
      scale = maxval(abs(node(1)%position)) + maxval(abs(joint%chord))
    end associate
    long = norm2(joint%chord) > no_length*scale
    if (joint%kind == joint_truss .and. .not. long) call report%add_error(joint%place, name// &
      " has no length: its nodes are at the same place")
    if (joint%kind == joint_spherical .and. norm2(joint%chord) > 1.0e-6_wp*scale) then
      call report%add_warning(joint%place, name//" is a SPHERICAL joint between nodes at "// &
                              "different places: it keeps the vector between them")
    end if
  end subroutine check_length

  !> What a model needs to be of use; only worth asking if it has no errors.
  subroutine check_use(model, report)
    type(model_t), intent(in) :: model
    type(report_t), intent(inout) :: report
    type(place_t) :: deck_place
    integer :: i

    deck_place = place_t(file=1)
    if (size(model%member) + size(model%joint) == 0) then
      call report%add_error(deck_place, "the deck has no elements")
      return
    end if
    do i = 1, size(model%node)
      associate (node => model%node(i))
        if (.not. any(node%exists)) call report%add_warning(node%place, "no element uses node "// &
                                                            to_text(node%id))
      end associate
    end do
    if (size(model%pattern) == 0 .and. any([(any([static_analyses, analysis_buckling] == &
                                             model%analysis(i)%kind), &
                                             i=1, size(model%analysis))])) then
      call report%add_warning(deck_place, "the deck has no loads")
    end if
    do i = 1, size(model%pattern)
      associate (pattern => model%pattern(i))
        if (.not. any(abs([pattern%gravity, pattern%rotation%axis]) > 0)) cycle
        if (has_mass(model)) exit
        call report%add_warning(deck_place, trim(merge("GRAVITY ", "ROTATION", &
          any(abs(pattern%gravity) > 0)))//" acts on nothing: no element has mass", &
                                "MATERIAL ... RHO, EM, or XM")
      end associate
      exit
    end do
  end subroutine check_use

  !> Does any element or node have mass?
  pure logical function has_mass(model)
    type(model_t), intent(in) :: model
    integer :: m

    has_mass = .true.
    do m = 1, size(model%member)
      associate (member => model%member(m))
        if (member%mass == mass_none) cycle
        if (member%has_inertia .and. member%inertia(1) > 0.0_wp) return
        if (member%section == 0 .or. member%material == 0) cycle
        if (model%material(member%material)%rho > 0.0_wp) return
      end associate
    end do
    do m = 1, size(model%joint)
      associate (joint => model%joint(m))
        if (joint%mass == mass_none) cycle
        if (joint%has_inertia .and. joint%inertia > 0.0_wp) return
        if (joint%section == 0 .or. joint%material == 0) cycle
        if (model%material(joint%material)%rho > 0.0_wp) return
      end associate
    end do
    has_mass = any(model%mass%mass > 0.0_wp)
  end function has_mass

end module model_check
