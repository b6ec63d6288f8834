!> A deck being read: what its cards said, not yet brought together.
!>
!> Cards may refer to what stands further down: lists and loads are kept as written until the end.
module deck_draft
  use kinds, only: wp
  use text, only: newline
  use lookup_tables, only: id_table_t
  use diagnostics, only: place_t, report_t
  use model_data, only: model_t, setting_t, second_consistent, mass_consistent, type_beamw
  use deck_registry, only: registry_t
  use deck_settings, only: settings_t
  use deck_expression, only: scope_t
  use deck_drawing, only: drawing_t
  implicit none
  private

  public :: draft_t, selection_t, item_t, record_t, beam_t, group_t, iteration_t, &
            timestep_t, new_draft

  integer, parameter, public :: select_all = 1, select_name = 2, select_range = 3

  !> One word of a list: ALL, a name, or first:last:step of ids or of the parts of one id.
  type :: selection_t
    integer :: kind = select_range
    integer :: name = 0                     !< number of the group or marker
    integer :: id = 0                       !< of parts: their element
    integer :: first = 0, last = 0, step = 1
    logical :: is_range = .false.           !< given as a:b
    type(place_t) :: place
  end type selection_t

  !> A component or mode with its place.
  type :: item_t
    integer :: value = 0
    type(place_t) :: place
  end type item_t

  integer, parameter, public :: record_fix = 1, record_flexible = 2, record_release = 3, &
    record_stiffness = 4, record_inertia = 5, record_load = 6, record_marker = 7, &
    record_gravity = 8, record_control = 9, record_stop = 10, record_rotation = 11
  integer, parameter, public :: record_compliance = 31, record_kept_nodes = 32, &
    record_kept_elements = 33
  integer, parameter, public :: record_damping = 21, record_stress = 22, record_strain = 23, &
    record_coordinate = 24, record_mass = 25, record_gear = 26, record_start = 27, &
    record_start_strain = 28, record_slider = 29

  !> A card about nodes or elements of a list.
  type :: record_t
    integer :: kind = 0
    type(place_t) :: place
    integer :: from = 1, to = 0             !< its lists in `selection`
    integer :: item_from = 1, item_to = 0   !< its components or modes in `item`
    integer :: values = 0
    real(wp) :: value(8) = 0.0_wp
    integer :: function = 0                 !< number of its function
    logical :: at_offset = .false., at_point = .false.
    real(wp) :: offset(2) = 0.0_wp
    integer :: point = 0
    type(place_t) :: at_place
    logical :: of_given = .false.
    integer :: of_id = 0, of_part = 0
    type(place_t) :: of_place
    integer :: marker = 0                   !< number of the marker it makes
    integer :: block = 1                    !< which stretch between analyses it stands in
    logical :: additional = .false.         !< DELXF, DELINPX, DELINPE
    logical :: before_halt = .false.        !< INPUTX, INPUTE: no HALT stands before it
    logical :: follower = .false.           !< FOLLOWER
    logical :: rate = .false.               !< STARTDX, STARTDE
    integer :: joint = 0                    !< number of the GEAR, SLIDER or CARRIAGE
  end type record_t

  !> The card of an element: a beam, or a joint, which `model%joint` holds.
  type :: beam_t
    integer :: id = 0
    integer :: kind = type_beamw
    integer :: joint = 0                    !< index of the joint; 0: a beam
    integer :: node(3, 2) = 0               !< numbers of its nodes by kind and end; 0: broken card
    real(wp) :: orientation(3) = 0.0_wp
    integer :: section = 0, material = 0
    integer :: second = second_consistent, mass = mass_consistent
    logical :: shear = .true., shear_asked = .false., rotary = .true., rigid = .false.
    integer :: divide = 1
    integer :: first_member = 0
    type(place_t) :: place
  end type beam_t

  type :: group_t
    integer :: from = 1, to = 0             !< its lists in `selection`
    logical :: of_nodes = .true.
    logical :: open = .false.               !< being resolved, to find cycles
  end type group_t

  !> SPACAR's ITERSTEP.
  type :: iteration_t
    integer :: iterations = 0, additional_steps = 10, base_steps = 10
    real(wp) :: tolerance = 0.0_wp
    type(place_t) :: place
  end type iteration_t

  !> SPACAR's TIMESTEP.
  type :: timestep_t
    real(wp) :: end_time = 0.0_wp
    integer :: steps = 0
    type(place_t) :: place
  end type timestep_t

  type :: draft_t
    type(report_t) :: report
    type(model_t) :: model
    type(settings_t) :: settings
    type(setting_t), allocatable :: override(:)       !< of -D
    logical, allocatable :: override_used(:)
    type(scope_t) :: scope                            !< what `i` means on the present card
    type(registry_t) :: materials, sections, functions, labels
    type(group_t), allocatable :: group(:)            !< by label; of markers: empty
    integer, allocatable :: marker_of(:)              !< by label: index in model%marker, or 0
    type(id_table_t) :: node_ids, beam_ids
    logical, allocatable :: node_broken(:)            !< its NODE card had errors
    logical :: nodes_incomplete = .false.             !< some NODE card has no readable id
    logical :: elements_incomplete = .false.          !< some element card had errors
    type(beam_t), allocatable :: beam(:)
    integer :: beams = 0
    type(drawing_t), allocatable :: drawing(:)        !< of SECTION PLATES cards
    integer :: drawings = 0
    integer :: drawn = 0                              !< where POINT and PLATE go; 0: nowhere
    type(selection_t), allocatable :: selection(:)
    integer :: selections = 0
    type(item_t), allocatable :: item(:)
    integer :: items = 0
    type(record_t), allocatable :: record(:)
    integer :: records = 0
    integer :: nodes = 0, members = 0, markers = 0, points = 0, analyses = 0, joints = 0
    integer :: block = 1                              !< number of the stretch between analyses
    integer, allocatable :: analysis_steps(:)         !< STEPS of each analysis; 0: not given
    type(iteration_t) :: iteration
    type(timestep_t) :: timestep
    integer :: spacar_mode = 10                       !< of --mode, for a deck without analyses
    type(place_t) :: damp_place                       !< of the DAMP card
    character(len=:), allocatable :: include_path     !< set by an INCLUDE card
    type(place_t) :: include_place
    logical :: complete = .true.                      !< a model to be run, not parts of one
    logical :: finished = .false.                     !< VISUALIZATION was read
    logical :: halted = .false.                       !< HALT was read
    character(len=:), allocatable :: kept             !< the text read so far, and spare room
    integer :: kept_length = 0
  contains
    procedure :: keep_text
    procedure :: keep_file
  end type draft_t

contains

  subroutine new_draft(overrides, draft)
    type(setting_t), intent(in) :: overrides(:)
    type(draft_t), intent(out) :: draft

    draft%override = overrides
    allocate (draft%override_used(size(overrides)))
    draft%override_used = .false.
    draft%materials%noun = "MATERIAL"
    draft%sections%noun = "SECTION"
    draft%functions%noun = "FUNCTION"
    draft%labels%noun = "GROUP or MARKER"
    draft%model%title = ""
    allocate (draft%model%node(64), draft%node_broken(64), draft%beam(64))
    allocate (draft%model%material(8), draft%model%section(8), draft%model%function(8))
    allocate (draft%model%marker(8), draft%model%point(8), draft%model%analysis(4))
    allocate (draft%selection(64), draft%item(64), draft%record(64))
    allocate (draft%group(8), draft%marker_of(8), draft%analysis_steps(4))
    allocate (draft%model%imperfection(0), draft%model%joint(0), draft%model%mass(0))
    allocate (draft%model%start(0))
    draft%marker_of = 0
    draft%node_broken = .false.
  end subroutine new_draft

  !> Append to the text of the deck.
  subroutine keep_text(self, piece)
    class(draft_t), intent(inout) :: self
    character(len=*), intent(in) :: piece

    call make_room(self, len(piece))
    self%kept(self%kept_length + 1:self%kept_length + len(piece)) = piece
    self%kept_length = self%kept_length + len(piece)
  end subroutine keep_text

  !> Append a part of a file, with a line end behind it.
  subroutine keep_file(self, file, from, to)
    class(draft_t), intent(inout) :: self
    integer, intent(in) :: file, from, to
    integer :: length

    length = to - from + 1
    if (length <= 0) return
    call make_room(self, length)
    self%kept(self%kept_length + 1:self%kept_length + length) = &
      self%report%file(file)%text(from:to)
    self%kept_length = self%kept_length + length
    if (self%kept(self%kept_length:self%kept_length) /= newline) call self%keep_text(newline)
  end subroutine keep_file

  subroutine make_room(draft, length)
    type(draft_t), intent(inout) :: draft
    integer, intent(in) :: length

    if (.not. allocated(draft%kept)) draft%kept = ""
    if (draft%kept_length + length > len(draft%kept)) then
      draft%kept = draft%kept//repeat(" ", len(draft%kept) + length)
    end if
  end subroutine make_room

end module deck_draft
