!> Arrays that grow by doubling: `call grow(array, n)` makes room for n entries.
module deck_growth
  use model_data, only: node_t, material_t, section_t, function_t, marker_t, analysis_t, load_t, &
                        joint_t, mass_t, motion_t, start_t
  use deck_draft, only: beam_t, selection_t, item_t, record_t, group_t
  implicit none
  private

  public :: grow

  interface grow
    module procedure :: grow_nodes, grow_materials, grow_sections, grow_functions, &
      grow_markers, grow_analysiss, grow_loads, grow_beams, grow_selections, &
      grow_items, grow_records, grow_groups, grow_integers, grow_logicals, &
      grow_joints, grow_masses, grow_motions, grow_starts
  end interface grow

contains

  subroutine grow_nodes(array, n)
    type(node_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(node_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_nodes

  subroutine grow_materials(array, n)
    type(material_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(material_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_materials

  subroutine grow_sections(array, n)
    type(section_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(section_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_sections

  subroutine grow_functions(array, n)
    type(function_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(function_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_functions

  subroutine grow_markers(array, n)
    type(marker_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(marker_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_markers

  subroutine grow_analysiss(array, n)
    type(analysis_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(analysis_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_analysiss

  subroutine grow_loads(array, n)
    type(load_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(load_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_loads

  subroutine grow_beams(array, n)
    type(beam_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(beam_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_beams

  subroutine grow_selections(array, n)
    type(selection_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(selection_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_selections

  subroutine grow_items(array, n)
    type(item_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(item_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_items

  subroutine grow_records(array, n)
    type(record_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(record_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_records

  subroutine grow_groups(array, n)
    type(group_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(group_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_groups

  subroutine grow_integers(array, n)
    integer, allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    integer, allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more = 0
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_integers

  subroutine grow_logicals(array, n)
    logical, allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    logical, allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more = .false.
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_logicals

  subroutine grow_joints(array, n)
    type(joint_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(joint_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_joints

  subroutine grow_masses(array, n)
    type(mass_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(mass_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_masses

  subroutine grow_motions(array, n)
    type(motion_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(motion_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_motions

  subroutine grow_starts(array, n)
    type(start_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(start_t), allocatable :: more(:)

    if (n <= size(array)) return
    allocate (more(max(n, 2*size(array))))
    more(:size(array)) = array
    call move_alloc(more, array)
  end subroutine grow_starts

end module deck_growth
