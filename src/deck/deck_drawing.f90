!> The drawing of a section as its POINT and PLATE cards give it, before they are brought together.
module deck_drawing
  use kinds, only: wp
  use diagnostics, only: place_t
  implicit none
  private

  public :: drawing_t, drawn_point_t, drawn_plate_t, grow_drawings

  !> A POINT card.
  type :: drawn_point_t
    integer :: number = 0
    real(wp) :: position(2) = 0.0_wp   !< y, z [L]
    type(place_t) :: place
  end type drawn_point_t

  !> A PLATE card.
  type :: drawn_plate_t
    integer :: number(2) = 0           !< numbers of its end points
    real(wp) :: thickness = 0.0_wp     !< [L]
    type(place_t) :: place(2)          !< of the numbers
  end type drawn_plate_t

  !> A SECTION PLATES card and what follows it.
  type :: drawing_t
    integer :: section = 0             !< number of its section; 0: that card has errors
    logical :: broken = .false.        !< one of its cards has errors, which were reported
    integer :: points = 0, plates = 0
    type(drawn_point_t), allocatable :: point(:)
    type(drawn_plate_t), allocatable :: plate(:)
  contains
    procedure :: add_point
    procedure :: add_plate
  end type drawing_t

contains

  subroutine add_point(self, point)
    class(drawing_t), intent(inout) :: self
    type(drawn_point_t), intent(in) :: point
    type(drawn_point_t), allocatable :: more(:)

    if (.not. allocated(self%point)) allocate (self%point(8))
    if (self%points == size(self%point)) then
      allocate (more(2*self%points))
      more(:self%points) = self%point
      call move_alloc(more, self%point)
    end if
    self%points = self%points + 1
    self%point(self%points) = point
  end subroutine add_point

  subroutine add_plate(self, plate)
    class(drawing_t), intent(inout) :: self
    type(drawn_plate_t), intent(in) :: plate
    type(drawn_plate_t), allocatable :: more(:)

    if (.not. allocated(self%plate)) allocate (self%plate(8))
    if (self%plates == size(self%plate)) then
      allocate (more(2*self%plates))
      more(:self%plates) = self%plate
      call move_alloc(more, self%plate)
    end if
    self%plates = self%plates + 1
    self%plate(self%plates) = plate
  end subroutine add_plate

  !> Room for n drawings.
  subroutine grow_drawings(array, n)
    type(drawing_t), allocatable, intent(inout) :: array(:)
    integer, intent(in) :: n
    type(drawing_t), allocatable :: more(:)
    integer :: old

    old = 0
    if (allocated(array)) old = size(array)
    if (n <= old) return
    allocate (more(max(n, 2*old)))
    if (old > 0) more(:old) = array
    call move_alloc(more, array)
  end subroutine grow_drawings

end module deck_drawing
