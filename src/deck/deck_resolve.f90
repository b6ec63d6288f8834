!> The end of reading: brings together what the cards said, and checks the model.
module deck_resolve
  use text, only: to_text, nearest_word
  use diagnostics, only: place_t
  use model_axes, only: orient_members
  use model_check, only: check_parts, check_members, check_joints, check_use
  use deck_draft, only: draft_t
  use deck_growth, only: grow
  use deck_sections, only: settle_sections
  use deck_members, only: expand_beams
  use deck_joints, only: expand_joints
  use deck_statuses, only: set_modes
  use deck_properties, only: set_properties
  use deck_motion_cards, only: settle_inputs
  use deck_motions, only: set_motions
  use deck_starts, only: set_starts, set_masses
  use deck_supports, only: set_supports
  use deck_points, only: neighbours_t, find_neighbours, set_markers
  use deck_loads, only: set_analyses, set_loads
  use deck_targets, only: set_targets
  use deck_output_cards, only: set_output
  implicit none
  private

  public :: resolve_draft

contains

  !> Complete `draft%model`.
  subroutine resolve_draft(draft)
    type(draft_t), intent(inout) :: draft
    type(neighbours_t) :: neighbours
    integer, allocatable :: pattern(:, :)

    call check_overrides(draft)
    call check_names(draft)
    call fit_registries(draft)
    call settle_sections(draft)
    call expand_beams(draft)
    call expand_joints(draft)
    call check_positions(draft)
    call fit_arrays(draft)
    call settle_inputs(draft)
    call set_modes(draft)
    call set_properties(draft)
    call check_parts(draft%model, draft%report)
    call orient_members(draft%model, draft%report)
    call check_members(draft%model, draft%report)
    call check_joints(draft%model, draft%report)
    call set_supports(draft)
    call set_masses(draft)
    call find_neighbours(draft, neighbours)
    call set_analyses(draft, pattern)
    call set_markers(draft, neighbours)
    call set_targets(draft)
    call set_output(draft)
    call set_loads(draft, neighbours, pattern)
    call set_motions(draft, pattern)
    call set_starts(draft)
    draft%model%point = draft%model%point(:draft%points)
    if (draft%report%errors() == 0 .and. draft%complete) call check_use(draft%model, draft%report)
    call keep_settings(draft)
  end subroutine resolve_draft

  !> A -D that no SET takes up.
  subroutine check_overrides(draft)
    type(draft_t), intent(inout) :: draft
    character(len=:), allocatable :: best
    integer :: i

    do i = 1, size(draft%override)
      if (draft%override_used(i)) cycle
      best = nearest_word(trim(draft%override(i)%name), draft%settings%names())
      if (best /= "") best = "did you mean "//best//"?"
      call draft%report%add_error(place_t(), "-D "//trim(draft%override(i)%name)// &
                                  ": the deck has no such SET", best)
    end do
  end subroutine check_overrides

  subroutine check_names(draft)
    type(draft_t), intent(inout) :: draft

    call draft%materials%report_undefined(draft%report)
    call draft%sections%report_undefined(draft%report)
    call draft%functions%report_undefined(draft%report)
    call draft%labels%report_undefined(draft%report)
  end subroutine check_names

  !> Room for names that were used but never defined; no entries behind the last.
  subroutine fit_registries(draft)
    type(draft_t), intent(inout) :: draft

    associate (model => draft%model)
      call grow(model%material, draft%materials%table%entries)
      call grow(model%section, draft%sections%table%entries)
      call grow(model%function, draft%functions%table%entries)
      call grow(draft%group, draft%labels%table%entries)
      call grow(draft%marker_of, draft%labels%table%entries)
      model%material = model%material(:draft%materials%table%entries)
      model%section = model%section(:draft%sections%table%entries)
      model%function = model%function(:draft%functions%table%entries)
      model%marker = model%marker(:draft%markers)
    end associate
  end subroutine fit_registries

  subroutine fit_arrays(draft)
    type(draft_t), intent(inout) :: draft

    draft%model%node = draft%model%node(:draft%nodes)
  end subroutine fit_arrays

  !> Every node whose translation an element uses needs a position.
  subroutine check_positions(draft)
    type(draft_t), intent(inout) :: draft
    integer :: k

    if (draft%nodes_incomplete) return
    do k = 1, draft%nodes
      associate (node => draft%model%node(k))
        if (node%placed .or. draft%node_broken(k) .or. .not. node%exists(1)) cycle
        if (node%part > 0) then
          call draft%report%add_error(node%place, "there is no node "//to_text(node%id)//"."// &
                                      to_text(node%part))
        else
          call draft%report%add_error(node%place, "node "//to_text(node%id)// &
                                      " has no position", "NODE "//to_text(node%id)//" x y z")
        end if
      end associate
    end do
  end subroutine check_positions

  !> The SET values as used.
  subroutine keep_settings(draft)
    type(draft_t), intent(inout) :: draft
    integer :: i, n

    n = draft%settings%table%entries
    allocate (draft%model%setting(n))
    do i = 1, n
      draft%model%setting(i)%name = draft%settings%table%name(i)
      draft%model%setting(i)%value = draft%settings%word(i)%s
    end do
    if (.not. allocated(draft%kept)) draft%kept = ""
    draft%model%deck = draft%kept(:draft%kept_length)
  end subroutine keep_settings

end module deck_resolve
