!> The equations of a model as data: elements, unknowns, loads and the sparsity of their matrix.
!>
!> Coordinates are numbered as in `nodal_state`; each is held or has an unknown. Behind the unknowns
!> of the coordinates stand those of the multipliers, one for each fixed strain that counts.
module system_data
  use kinds, only: wp
  use nodal_state, only: state_t
  use element_base, only: element_slot_t
  use beamw_constants, only: beamw_t
  use beamw_inertia, only: inertia_t
  use node_inertia, only: node_inertia_t
  use model_data, only: function_t
  implicit none
  private

  public :: system_t, dead_load_t, constants_slot_t, pattern_t, unknown_name_t, drive_t, turn_t
  public :: masses_t, rotor_t

  integer, parameter, public :: body_size = 14  !< most coordinates of a body

  !> A pointer that can live in an array.
  type :: constants_slot_t
    type(beamw_t), pointer :: constants => null()
  end type constants_slot_t

  !> A dead force at the end of an arm that turns with a node, R (arm + alpha warp), a dead moment
  !> and a bimoment (theory 6).
  type :: dead_load_t
    integer :: pattern = 0
    integer :: function = 0             !< index in `system%function`; 0: the load factor
    integer :: node(3) = 0              !< translational, rotational, warping
    real(wp) :: force(3) = 0.0_wp       !< [F]
    real(wp) :: moment(3) = 0.0_wp      !< [F L]
    real(wp) :: bimoment = 0.0_wp       !< [F L^2]
    real(wp) :: arm(3) = 0.0_wp         !< initially, global axes [L]
    real(wp) :: warp(3) = 0.0_wp        !< -omega eX of the section [L^2]
    logical :: follower = .false.       !< force and moment turn with the rotational node
    !> Coordinates of released bending strains by which the arm turns towards `axes`; 0: none.
    integer :: lean(2) = 0
    real(wp) :: lean_rate(2) = 0.0_wp   !< angle per released strain [1/L]
    real(wp) :: axes(3, 2) = 0.0_wp     !< initially, as long as the arm and across it [L]
  end type dead_load_t

  !> A motion of a held strain: value times load factor or function, and what time adds.
  type :: drive_t
    integer :: strain = 0
    integer :: pattern = 0
    integer :: function = 0             !< index in `system%function`; 0: the load factor
    real(wp) :: value = 0.0_wp, velocity = 0.0_wp, acceleration = 0.0_wp
  end type drive_t

  !> Strains that are Euler parameters of a node, and driven by an angle or rotation vector unless
  !> `euler`.
  type :: turn_t
    integer :: first = 0, strains = 0
    logical :: euler = .false.
  end type turn_t

  !> A steady turn of the model's frame, in full.
  type :: rotor_t
    integer :: pattern = 0
    real(wp) :: spin(3) = 0.0_wp        !< angular velocity [T^-1]
  end type rotor_t

  !> What has mass: beams, then trusses, then nodes.
  type :: masses_t
    integer :: bodies = 0, beams = 0, trusses = 0
    integer, allocatable :: block(:)           !< by body: its block of the system's pattern
    integer, allocatable :: coordinates(:)     !< by body: 14 or 6
    integer, allocatable :: coordinate(:, :)   !< (14, bodies)
    integer, allocatable :: node(:, :, :)      !< (kind, end, bodies); of a node: at end 1
    type(inertia_t), allocatable :: beam(:)
    real(wp), allocatable :: truss(:, :, :)    !< (6, 6, trusses)
    type(node_inertia_t), allocatable :: point(:)
    real(wp), allocatable :: position(:, :)    !< (3, nodes) initial
    real(wp) :: total = 0.0_wp                 !< [M]
  end type masses_t

  !> Sparsity in coordinate form and, for each block (element or load), where its entries go.
  type :: pattern_t
    logical :: symmetric = .true.          !< lower triangle only
    integer, allocatable :: row(:), column(:)
    integer, allocatable :: width(:)       !< by block: number of its unknowns, held ones included
    integer, allocatable :: first(:)       !< by block: start in `place`; one more at the end
    !> Entry of each pair of a block's unknowns, column by column, only from the diagonal down if
    !> the matrix is symmetric; 0: none, an unknown is held.
    integer, allocatable :: place(:)
  end type pattern_t

  !> What an unknown is, for messages.
  type :: unknown_name_t
    integer :: node = 0        !< index; 0: a multiplier or a released strain
    integer :: component = 0   !< 1 to 7: X Y Z RX RY RZ W
    integer :: element = 0     !< of a multiplier or release
    integer :: strain = 0
  end type unknown_name_t

  type :: system_t
    integer :: nodes = 0
    integer :: coordinates = 0            !< 7 per node and the released strains
    integer :: unknowns = 0               !< free coordinates
    integer :: multipliers = 0            !< fixed strains that count
    integer :: members = 0                !< the first elements are the model's members, in order
    integer :: joints = 0                 !< then come its joints, then what holds or drives nodes
    integer :: angles = 0                 !< angles that are counted through full turns
    type(element_slot_t), allocatable :: element(:)
    integer, allocatable :: unknown(:)    !< by coordinate: number of its unknown; 0: held
    logical, allocatable :: used(:)       !< by coordinate: an element depends on it
    integer, allocatable :: first(:)      !< by element: strains before its own; one more at the end
    integer, allocatable :: parts(:)      !< by element with parts: their blocks start behind this
    integer, allocatable :: jacobian(:)   !< by element: entries of Jacobians before its own
    integer, allocatable :: multiplier(:) !< by strain: number of its unknown; 0: none
    logical, allocatable :: dropped(:)    !< by strain: fixed, but follows from other constraints
    !> By strain: fixed, and follows from other constraints only where the model starts.
    logical, allocatable :: singular(:)
    real(wp), allocatable :: initial_stress(:)  !< by strain: at zero strain, of a law
    type(dead_load_t), allocatable :: load(:)
    integer, allocatable :: mass_node(:)  !< nodes with mass or inertia of their own
    type(function_t), allocatable :: function(:)
    type(drive_t), allocatable :: drive(:)
    type(turn_t), allocatable :: turn(:)
    !> (7, nodes) element whose strain is that coordinate; 0: none
    integer, allocatable :: holder(:, :)
    !> By pattern: its level is the time; cards without a function act in full.
    logical, allocatable :: timed(:)
    type(rotor_t), allocatable :: rotor(:)
    real(wp) :: axis_point(3) = 0.0_wp    !< of the axis of all rotors [L]
    type(masses_t) :: masses              !< of a model with rotors
    type(constants_slot_t), allocatable :: constants(:)
    integer :: constants_used = 0
    type(pattern_t) :: pattern
    real(wp) :: length = 0.0_wp           !< size of the model, for criteria without units [L]
  contains
    procedure :: equations
    procedure :: free
  end type system_t

contains

  !> Number of unknowns with the multipliers.
  pure integer function equations(self)
    class(system_t), intent(in) :: self

    equations = self%unknowns + self%multipliers
  end function equations

  !> Give back what the pointers hold.
  subroutine free(self)
    class(system_t), intent(inout) :: self
    integer :: i

    do i = 1, self%constants_used
      deallocate (self%constants(i)%constants)
    end do
    self%constants_used = 0
  end subroutine free

end module system_data
