!> What of nodes, elements and places of stresses time histories keep: OUTPUT NODES and ELEMENTS.
module output_choice
  use kinds, only: wp
  use model_data, only: model_t, node_t
  use system_stress, only: stress_place_t, stress_places
  use output_hdf5, only: hdf5_file_t, about_t
  use output_tables, only: table_t
  implicit none
  private

  public :: choice_t, choices_t, all_of, kept_of, labels_of

  !> Rows of a table of the model.
  type :: choice_t
    logical :: all = .true.
    integer :: rows = 0                    !< how many are kept
    integer, allocatable :: row(:)         !< which, if not all
    integer, allocatable :: label(:, :)    !< (3, kept) row from 0, id, part
  contains
    procedure :: append => append_chosen
  end type choice_t

  type :: choices_t
    type(choice_t) :: node, member, place
  contains
    procedure :: write => write_choices
  end type choices_t

contains

  !> All there is.
  pure function all_of(model) result(choices)
    type(model_t), intent(in) :: model
    type(choices_t) :: choices

    choices%node%rows = size(model%node)
    choices%member%rows = size(model%member)
    choices%place%rows = size(stress_places(model))
  end function all_of

  !> What OUTPUT keeps, all where it says nothing.
  pure function kept_of(model) result(choices)
    type(model_t), intent(in) :: model
    type(choices_t) :: choices
    type(stress_place_t), allocatable :: place(:)
    integer :: i

    choices = all_of(model)
    if (allocated(model%kept_node)) then
      if (size(model%kept_node) > 0) choices%node = choice(labels_of(model%node), model%kept_node)
    end if
    if (.not. allocated(model%kept_member)) return
    if (size(model%kept_member) == 0) return
    choices%member = choice(labels(model%member%id, model%member%part), model%kept_member)
    allocate (place, source=stress_places(model))
    choices%place = choice(labels(place%member, place%point), pack([(i, i=1, size(place))], &
      [(any(model%kept_member == place(i)%member), i=1, size(place))]))
  end function kept_of

  pure function choice(label, row)
    integer, intent(in) :: label(:, :), row(:)
    type(choice_t) :: choice

    choice%all = .false.
    choice%rows = size(row)
    allocate (choice%row, source=row)
    allocate (choice%label(3, size(row)))
    choice%label(:, :) = label(:, row)
  end function choice

  !> What nodes are called in tables: (3, nodes) row from 0, id, part.
  pure function labels_of(node) result(label)
    type(node_t), intent(in) :: node(:)
    integer :: label(3, size(node))

    label = labels(node%id, node%part)
  end function labels_of

  pure function labels(id, part) result(label)
    integer, intent(in) :: id(:), part(:)
    integer :: label(3, size(id)), i

    label(1, :) = [(i - 1, i=1, size(id))]
    label(2, :) = id
    label(3, :) = part
  end function labels

  !> Say in the groups `nodes` and `elements` of an analysis what is kept, unless it is all.
  subroutine write_choices(self, file, group)
    class(choices_t), intent(in) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group

    if (.not. self%node%all) call file%write(group//"/nodes/index", self%node%label, &
      about_t("1", "node; row id part", "kept nodes: row of /model/nodes, from 0, and its name"))
    if (self%member%all) return
    call file%write(group//"/elements/index", self%member%label, about_t("1", &
      "element; row id part", "kept elements: row of /model/elements, from 0, and its name"))
    if (self%place%rows == 0) return
    call file%write(group//"/elements/place", self%place%label(1, :), about_t("1", "place", &
      "kept places of stresses: row of /model/stress_points, from 0"))
  end subroutine write_choices

  !> Append the chosen columns of an array, which are rows of the file.
  subroutine append_chosen(self, file, table, values)
    class(choice_t), intent(in) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(table_t), intent(inout) :: table
    real(wp), intent(in), contiguous :: values(:, :)

    if (self%all) then
      call table%append(file, values)
    else
      call table%append(file, values(:, self%row))
    end if
  end subroutine append_chosen

end module output_choice
