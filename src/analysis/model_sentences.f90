!> What is wrong or strange with a model, in sentences that name the place.
module model_sentences
  use text, only: string_t, to_text
  use model_data, only: model_t
  use nodal_state, only: node_coordinates
  use system_data, only: system_t
  use system_names, only: node_name, coordinate_name, strain_name, element_number, &
                          locate_strain, component_name
  use system_dependence, only: dependence_t, is_driven
  use system_mobility, only: free_motion_t
  implicit none
  private

  public :: dependence_sentence, singular_sentence, contradiction_sentence, motion_sentence, &
            release_card, listed, motion_name, node_list

  integer, parameter :: most_strains = 8, most_nodes = 6, most_releases = 4

contains

  !> "element 3 mode 2 (torsion), element 5 mode 6 (bending) hold each other; RLSE 3 2 would
  !> remove it"
  function dependence_sentence(model, system, found) result(sentence)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(dependence_t), intent(in) :: found
    character(len=:), allocatable :: sentence

    sentence = partners_sentence(model, system, found)
    if (found%release == 0) then
      sentence = sentence//"; leave out one of them"
    else
      sentence = sentence//"; "//release_card(model, system, found%release)//" would remove it"
    end if
  end function dependence_sentence

  !> "drawn in a singular position: element 3 mode 1 (elongation), element 5 mode 1 (elongation)
  !> hold each other with FIX of node 1, but only there"
  function singular_sentence(model, system, found, leads) result(sentence)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(dependence_t), intent(in) :: found
    logical, intent(in) :: leads           !< a motion leads away from there
    character(len=:), allocatable :: sentence

    sentence = "drawn in a singular position: "//partners_sentence(model, system, found)// &
               ", but only there"
    if (.not. leads) sentence = sentence//"; it yields to first order, and no motion leads away"
  end function singular_sentence

  !> "element 3 mode 2 (torsion), element 5 mode 6 (bending) hold each other with FIX of node 1"
  function partners_sentence(model, system, found) result(sentence)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(dependence_t), intent(in) :: found
    character(len=:), allocatable :: sentence

    sentence = listed(strain_names(model, system, found%strain), most_strains, found%partners)
    if (found%partners == 1) then
      sentence = sentence//" is held already"
      if (size(found%held) > 0) sentence = sentence//" by FIX of "//node_list(model, found%held)
    else
      sentence = sentence//" hold each other"
      if (size(found%held) > 0) sentence = sentence//" with FIX of "//node_list(model, found%held)
    end if
  end function partners_sentence

  !> "RLSE 3 2": the card that ends a redundancy; empty if there is none.
  function release_card(model, system, strain) result(card)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain
    character(len=:), allocatable :: card

    card = ""
    if (strain > 0) card = "RLSE "//strain_words(model, system, strain)
  end function release_card

  !> "3 2": element and mode, as a card has them.
  function strain_words(model, system, strain) result(words)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain
    character(len=:), allocatable :: words
    integer :: e, mode

    call locate_strain(system, strain, e, mode)
    words = element_number(model, system, e)//" "//to_text(mode)
  end function strain_words

  !> "the motions prescribed for element 1 mode 1 and element 2 mode 1 contradict each other"
  function contradiction_sentence(model, system, found) result(sentence)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(dependence_t), intent(in) :: found
    character(len=:), allocatable :: sentence
    logical :: driven(size(found%strain))
    integer :: i

    do i = 1, size(driven)
      driven(i) = is_driven(system, found%strain(i))
    end do
    associate (others => pack(found%strain, .not. driven), n => count(driven))
      sentence = listed(strain_names(model, system, pack(found%strain, driven)), most_strains, n)
      if (n > 1) then
        sentence = "the motions prescribed for "//sentence//" contradict each other"
        if (size(others) > 0) sentence = sentence//": "//listed( &
          strain_names(model, system, others), most_strains, found%partners - n)// &
          trim(merge(" connects them", " connect them ", found%partners - n == 1))
      else
        sentence = "the motion prescribed for "//sentence//" is not possible"
        if (size(others) > 0) then
          sentence = sentence//": "//listed(strain_names(model, system, others), most_strains, &
                                            found%partners - n)//" hold against it"
        else if (size(found%held) > 0) then
          sentence = sentence//": FIX of "//node_list(model, found%held)//" holds against it"
        end if
      end if
    end associate
  end function contradiction_sentence

  !> "node 3 X moves, with node 2 Y RZ, by element 4 mode 1 of HINGE; FIX 3 X would hold it, ..."
  function motion_sentence(model, system, found) result(sentence)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(free_motion_t), intent(in) :: found
    character(len=:), allocatable :: sentence, card
    integer :: e, mode

    sentence = motion_name(model, system, found)
    if (size(found%moves) > 1) sentence = sentence//" with "// &
      nodes_that_move(model, pack(found%moves, found%moves /= found%coordinate))
    if (size(found%strain) > 0) sentence = sentence//", by "// &
      listed(strain_names(model, system, found%strain), most_releases, size(found%strain))
    card = ""
    if (found%coordinate <= node_coordinates*system%nodes) then
      card = coordinate_name(model, found%coordinate)
      card = card(len("node ") + 1:)
      sentence = sentence//"; FIX "//card//" would hold it"
    else
      sentence = sentence//"; without its RLSE it would be held"
    end if
    if (size(found%strain) > 0) then
      call locate_strain(system, found%strain(1), e, mode)
      card = strain_words(model, system, found%strain(1))
      if (e <= system%members + system%joints) sentence = sentence//", DYNE "//card// &
        " with a stiffness resist it, INPUTE "//card//" drive it"
    else if (card /= "") then
      sentence = sentence//", INPUTX "//card//" drive it"
    end if
  end function motion_sentence

  !> "node 3 X", or the released strain that moves alone.
  function motion_name(model, system, found) result(name)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(free_motion_t), intent(in) :: found
    character(len=:), allocatable :: name

    if (found%coordinate <= node_coordinates*system%nodes .or. size(found%strain) == 0) then
      name = coordinate_name(model, found%coordinate)
    else
      name = strain_name(model, system, found%strain(1))
    end if
  end function motion_name

  !> "node 2 X RZ, node 4 X and 3 more"
  function nodes_that_move(model, coordinates) result(list)
    type(model_t), intent(in) :: model
    integer, intent(in) :: coordinates(:)
    character(len=:), allocatable :: list
    integer :: node(size(coordinates)), i, k, shown, first

    node = (coordinates - 1)/node_coordinates + 1
    list = ""
    shown = 0
    do i = 1, size(node)
      if (any(node(:i - 1) == node(i))) cycle
      shown = shown + 1
      if (shown > most_nodes) then
        list = list//" ..."
        return
      end if
      if (shown > 1) list = list//", "
      list = list//node_name(model, node(i))
      first = node_coordinates*(node(i) - 1)
      do k = 1, node_coordinates
        if (any(coordinates == first + k)) list = list//" "//trim(component_name(k))
      end do
    end do
  end function nodes_that_move

  !> "node 1", "nodes 1, 5.2 and 3 more"
  function node_list(model, node) result(list)
    type(model_t), intent(in) :: model
    integer, intent(in) :: node(:)
    character(len=:), allocatable :: list
    type(string_t) :: names(size(node))
    integer :: i

    do i = 1, size(node)
      list = node_name(model, node(i))
      names(i)%s = list(len("node ") + 1:)
    end do
    list = "node"
    if (size(node) > 1) list = "nodes"
    list = list//" "//listed(names, most_nodes, size(node))
  end function node_list

  function strain_names(model, system, strain) result(names)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: strain(:)
    type(string_t) :: names(size(strain))
    integer :: i

    do i = 1, size(strain)
      names(i)%s = strain_name(model, system, strain(i))
    end do
  end function strain_names

  !> "a, b, c and 5 more"
  function listed(names, most, all) result(list)
    type(string_t), intent(in) :: names(:)
    integer, intent(in) :: most, all   !< so many are shown of so many
    character(len=:), allocatable :: list
    integer :: i, shown

    shown = min(most, size(names))
    list = ""
    do i = 1, shown
      if (i > 1) list = list//", "
      list = list//names(i)%s
    end do
    if (all > shown) list = list//" and "//to_text(all - shown)//" more"
  end function listed

end module model_sentences
