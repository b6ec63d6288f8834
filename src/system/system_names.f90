!> Names of coordinates and strains, for messages.
module system_names
  use text, only: to_text, lower
  use model_data, only: model_t, joint_truss, joint_names
  use nodal_state, only: node_coordinates, coordinate_number
  use system_data, only: system_t
  implicit none
  private

  public :: node_name, member_name, coordinate_name, strain_name, locate_strain
  public :: element_number

  character(len=2), parameter, public :: component_name(node_coordinates) = &
    ["X ", "Y ", "Z ", "RX", "RY", "RZ", "W "]

  character(len=10), parameter :: mode_name(8) = ["elongation", "torsion   ", "bending   ", &
    "bending   ", "bending   ", "bending   ", "warping   ", "warping   "]

contains

  !> "node 3", "node 5.2".
  pure function node_name(model, node) result(name)
    type(model_t), intent(in) :: model
    integer, intent(in) :: node
    character(len=:), allocatable :: name

    name = "node "//with_part(model%node(node)%id, model%node(node)%part)
  end function node_name

  !> "element 3", "element 5.2"; joints come behind the members.
  pure function member_name(model, member) result(name)
    type(model_t), intent(in) :: model
    integer, intent(in) :: member
    character(len=:), allocatable :: name

    if (member > size(model%member)) then
      name = "element "//to_text(model%joint(member - size(model%member))%id)
      return
    end if
    name = "element "//with_part(model%member(member)%id, model%member(member)%part)
  end function member_name

  pure function with_part(id, part) result(name)
    integer, intent(in) :: id, part
    character(len=:), allocatable :: name

    name = to_text(id)
    if (part > 0) name = name//"."//to_text(part)
  end function with_part

  !> "node 3 RX", or the released strain it belongs to.
  pure function coordinate_name(model, coordinate) result(name)
    type(model_t), intent(in) :: model
    integer, intent(in) :: coordinate
    character(len=:), allocatable :: name
    integer :: node

    node = (coordinate - 1)/node_coordinates + 1
    if (node <= size(model%node)) then
      name = node_name(model, node)//" "// &
             trim(component_name(coordinate - node_coordinates*(node - 1)))
    else
      name = "a released strain"
    end if
  end function coordinate_name

  !> "element 3 mode 2 (torsion)", "element 4 mode 1 (hinge)"; strains that are coordinates of a
  !> node are named as such.
  pure function strain_name(model, system, strain) result(name)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain
    character(len=:), allocatable :: name
    integer :: e, mode

    call locate_strain(system, strain, e, mode)
    if (e <= system%members) then
      name = member_name(model, e)//" mode "//to_text(mode)//" ("//trim(mode_name(mode))//")"
    else if (e <= system%members + system%joints) then
      associate (joint => model%joint(e - system%members))
        name = member_name(model, e)//" mode "//to_text(mode)//" ("
        if (joint%kind == joint_truss) then
          name = name//"elongation)"
        else
          name = name//lower(trim(joint_names(joint%kind)))//")"
        end if
      end associate
    else
      name = held_name(model, system, e, mode)
    end if
  end function strain_name

  !> "node 3 RX"; fixed rotations that need a constraint say so.
  pure function held_name(model, system, e, mode) result(name)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, mode
    character(len=:), allocatable :: name
    integer :: node, i, n

    node = (system%element(e)%e%coordinate(1) - 1)/node_coordinates + 1
    n = 0
    do i = 1, node_coordinates
      if (system%holder(i, node) /= e) cycle
      n = n + 1
      if (n == mode) exit
    end do
    name = coordinate_name(model, coordinate_number(node, i))
    if (model%node(node)%fixed(i)) name = "the fixed rotation of "//node_name(model, node)
  end function held_name

  !> The element of a strain, and its number there.
  pure subroutine locate_strain(system, strain, e, mode)
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain
    integer, intent(out) :: e, mode
    integer :: last, middle

    e = 1
    last = size(system%element)
    do while (e < last)
      middle = (e + last)/2
      if (system%first(middle + 1) < strain) then
        e = middle + 1
      else
        last = middle
      end if
    end do
    mode = strain - system%first(e)
  end subroutine locate_strain

  !> "3", "5.2": how cards call an element; empty if none made it.
  pure function element_number(model, system, e) result(name)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    character(len=:), allocatable :: name

    name = ""
    if (e <= system%members) then
      name = with_part(model%member(e)%id, model%member(e)%part)
    else if (e <= system%members + system%joints) then
      name = to_text(model%joint(e - system%members)%id)
    end if
  end function element_number

end module system_names
