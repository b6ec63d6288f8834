!> SLIDER and CARRIAGE: a node that runs along the centroid line of a chain of beams.
!> Strains: the way, the distances from the line along the section's y and z; of a CARRIAGE also
!> its turn about the line and the tilts of its y and z axis towards it.
!>
!> Of the chain's elements one is active, where the foot of the perpendicular is; the derivatives
!> to the coordinates of all others are zero.
module element_slider
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number, node_coordinates
  use element_base, only: element_t
  use element_joint, only: element_joint_t
  use pair_strains, only: unwrapped
  use rotation, only: rotated
  use slider_strains, only: rail_t, rail_coordinates, find_foot, distance, slider_jets, &
                            slider_derivatives, rail_frame, is_sound
  use vector_jets, only: jet_t
  implicit none
  private

  public :: track_t, new_element_slider

  !> An element of the chain.
  type :: track_t
    integer :: node(3, 2) = 0           !< by kind (translational, rotational, warping) and end
    real(wp) :: start(3) = 0.0_wp       !< initial position of p [L]
    real(wp) :: chord(3) = 0.0_wp       !< initial vector from p to q [L]
    real(wp) :: triad(3, 3) = 0.0_wp    !< initial axes of the sections
    real(wp) :: shear_centre(2) = 0.0_wp  !< y, z: where alpha moves the line [L]
    real(wp) :: slope(3, 2) = 0.0_wp    !< of the line at p and q, initially: unit vectors
    real(wp) :: arc = 0.0_wp            !< length of the chain before it [L]
  end type track_t

  !> How far the line is followed beyond its ends, in lengths of the element there.
  real(wp), parameter :: overrun = 0.01_wp

  type, extends(element_joint_t) :: element_slider_t
    integer :: node(2) = 0              !< translational and rotational; the latter 0: none
    real(wp) :: position(3) = 0.0_wp    !< of the node, initially [L]
    real(wp) :: axes(3, 3) = 0.0_wp     !< of the body: those of the section where it starts
    type(track_t), allocatable :: track(:)
    integer :: slot = 0                 !< of the way in `state%angle`; the turn's is the next
    real(wp) :: start = 0.0_wp          !< arc coordinate at the start [L]
    integer, allocatable :: from(:)     !< by coordinate of a part: which of `slider_strains` it is
  contains
    procedure :: evaluate
    procedure :: evaluate_part
    procedure :: count_turns
    procedure, private :: locate
    procedure, private :: rail_of
    procedure, private :: counted
  end type element_slider_t

contains

  !> An element of a node and a chain; it has six strains if the node has a rotation.
  subroutine new_element_slider(node, position, track, fixed, stiffness, damping, slot, element)
    integer, intent(in) :: node(2), slot
    real(wp), intent(in) :: position(3)     !< of the node, initially [L]
    type(track_t), intent(in) :: track(:)   !< each starts where the one before ends
    logical, intent(in) :: fixed(:)
    real(wp), intent(in) :: stiffness(:)    !< [F L^-1], of angles [F L]
    real(wp), intent(in) :: damping(:)      !< that times T
    class(element_t), allocatable, intent(out) :: element
    type(element_slider_t), allocatable :: new

    allocate (new)
    new%node = node
    new%position = position
    allocate (new%track, source=track)
    new%slot = slot
    new%counts_turns = .true.
    call new%set_law(fixed, stiffness, damping)
    call lay_track(new%track)
    new%size = new%track(size(track))%arc + norm2(track(size(track))%chord)
    call set_parts(new)
    call set_start(new)
    call move_alloc(new, element)
  end subroutine new_element_slider

  !> Arc coordinates and slopes: where elements meet at an angle the line takes the mean of their
  !> directions, so that it has no kink, and the first and the last are bent evenly: that of chords
  !> of a circle has its tangents.
  pure subroutine lay_track(track)
    type(track_t), intent(inout) :: track(:)
    integer :: k

    do k = 1, size(track)
      track(k)%slope = spread(track(k)%chord/norm2(track(k)%chord), 2, 2)
      if (k == 1) cycle
      associate (before => track(k - 1), here => track(k))
        here%arc = before%arc + norm2(before%chord)
        here%slope(:, 1) = before%slope(:, 2) + here%slope(:, 2)
        here%slope(:, 1) = here%slope(:, 1)/norm2(here%slope(:, 1))
        before%slope(:, 2) = here%slope(:, 1)
      end associate
    end do
    k = size(track)
    if (k == 1) return
    track(1)%slope(:, 1) = reflected(track(1)%slope(:, 2), track(1)%chord)
    track(k)%slope(:, 2) = reflected(track(k)%slope(:, 1), track(k)%chord)
  end subroutine lay_track

  !> The direction that a chord makes the same angle with on the other side.
  pure function reflected(slope, chord) result(image)
    real(wp), intent(in) :: slope(3), chord(3)
    real(wp) :: image(3)

    image = 2*dot_product(slope, chord)/dot_product(chord, chord)*chord - slope
  end function reflected

  !> The coordinates: those of the node, then of the chain's nodes, each once. A part is the node
  !> and one element.
  pure subroutine set_parts(new)
    type(element_slider_t), intent(inout) :: new
    integer :: list(6 + 2*node_coordinates*size(new%track)), own, n, k, e, i, c, at

    own = merge(6, 3, new%node(2) > 0)
    list(:own) = [(coordinate_number(new%node((i + 2)/3), i), i=1, own)]
    new%from = [(i, i=1, own), (6 + i, i=1, 2*node_coordinates)]
    allocate (new%part(size(new%from), size(new%track)))
    n = own
    do k = 1, size(new%track)
      new%part(:own, k) = [(i, i=1, own)]
      do e = 1, 2
        do i = 1, node_coordinates
          c = coordinate_number(new%track(k)%node((i + 2)/3, e), i)
          at = findloc(list(:n), c, 1, back=.true.)
          if (at == 0) then
            n = n + 1
            list(n) = c
            at = n
          end if
          new%part(own + node_coordinates*(e - 1) + i, k) = at
        end do
      end do
    end do
    new%coordinates = n
    allocate (new%coordinate, source=list(:n))
  end subroutine set_parts

  !> Where the body starts: at the place of the undeformed line that it is nearest to.
  pure subroutine set_start(new)
    type(element_slider_t), intent(inout) :: new
    type(rail_t) :: rail
    real(wp) :: xi, nearest, away
    integer :: k
    logical :: found

    nearest = huge(nearest)
    do k = 1, size(new%track)
      rail = rail_as_drawn(new, k)
      xi = min(1.0_wp, max(0.0_wp, dot_product(rail%away, rail%chord)/rail%length**2))
      call find_foot(rail, xi, found)
      away = distance(rail, min(1.0_wp, max(0.0_wp, xi)))
      if (.not. (found .and. away < nearest)) cycle
      nearest = away
      new%start = new%track(k)%arc + xi*rail%length
      new%axes = rail_frame(rail, xi)
    end do
  end subroutine set_start

  !> An element of the chain and the body, undeformed.
  pure function rail_as_drawn(self, k) result(rail)
    type(element_slider_t), intent(in) :: self
    integer, intent(in) :: k
    type(rail_t) :: rail

    associate (track => self%track(k))
      rail%length = norm2(track%chord)
      rail%away = self%position - track%start
      rail%chord = track%chord
      rail%d = track%slope
      rail%y = spread(track%triad(:, 2), 2, 2)
      rail%axes = self%axes(:, 2:3)
    end associate
  end function rail_as_drawn

  !> An element of the chain and the body as they stand.
  pure function rail_of(self, state, k) result(rail)
    class(element_slider_t), intent(in) :: self
    type(state_t), intent(in) :: state
    integer, intent(in) :: k
    type(rail_t) :: rail
    real(wp) :: now(3, 3)
    integer :: e

    rail = rail_as_drawn(self, k)
    associate (track => self%track(k), u => state%displacement)
      rail%away = rail%away + (u(:, self%node(1)) - u(:, track%node(1, 1)))
      rail%chord = rail%chord + (u(:, track%node(1, 2)) - u(:, track%node(1, 1)))
      do e = 1, 2
        now(:, 1) = track%slope(:, e)
        now(:, 2) = track%triad(:, 2)
        now(:, 3) = track%shear_centre(2)*track%triad(:, 2) &
                    - track%shear_centre(1)*track%triad(:, 3)
        now = rotated(state%euler(:, track%node(2, e)), now)
        rail%s(:, e) = now(:, 3)
        rail%d(:, e) = now(:, 1) + state%warping(track%node(3, e))*now(:, 3)
        rail%y(:, e) = now(:, 2)
      end do
    end associate
    if (self%node(2) == 0) return
    now = rotated(state%euler(:, self%node(2)), self%axes)
    rail%axes = now(:, 2:3)
  end function rail_of

  !> The active element and the foot on it: on from where it was counted last, over the elements'
  !> ends where it lies beyond them.
  pure subroutine locate(self, state, k, xi, rail, valid)
    class(element_slider_t), intent(in) :: self
    type(state_t), intent(in) :: state
    integer, intent(out) :: k
    real(wp), intent(out) :: xi
    type(rail_t), intent(out) :: rail
    logical, intent(out) :: valid
    integer :: i, heading, next
    real(wp) :: way

    way = self%start + state%angle(self%slot)
    k = max(1, count(self%track%arc <= way))
    xi = (way - self%track(k)%arc)/norm2(self%track(k)%chord)
    heading = 0
    do i = 1, size(self%track)
      rail = self%rail_of(state, k)
      call find_foot(rail, xi, valid)
      next = 0
      if (xi > 1 .and. k < size(self%track)) next = 1
      if (xi < 0 .and. k > 1) next = -1
      if (next == 0 .or. next == -heading) exit
      heading = next
      k = k + next
      xi = merge(0.0_wp, 1.0_wp, next > 0)
    end do
    if (k == size(self%track)) valid = valid .and. xi <= 1 + overrun
    if (k == 1) valid = valid .and. xi >= -overrun
    if (valid) valid = is_sound(rail, xi, self%node(2) > 0)
  end subroutine locate

  pure subroutine evaluate(self, state, stress, strain, jacobian, geometric, valid)
    class(element_slider_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
    real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
    logical, intent(out) :: valid
    real(wp) :: b(self%strains, size(self%part, 1)), g(size(self%part, 1), size(self%part, 1))
    integer :: k

    call self%evaluate_part(state, stress, k, strain, b, g, valid)
    jacobian = 0
    geometric = 0
    if (.not. valid) return
    jacobian(:, self%part(:, k)) = b
    geometric(self%part(:, k), self%part(:, k)) = g
  end subroutine evaluate

  !> Of the active element: the part.
  pure subroutine evaluate_part(self, state, stress, part, strain, jacobian, geometric, valid)
    class(element_slider_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    integer, intent(out) :: part
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(:, :), geometric(:, :)
    logical, intent(out) :: valid
    type(jet_t) :: jet(2:self%strains)
    type(rail_t) :: rail
    real(wp) :: xi, b(self%strains, rail_coordinates), g(rail_coordinates, rail_coordinates)

    call self%locate(state, part, xi, rail, valid)
    if (.not. valid) return
    call slider_jets(rail, xi, jet)
    call slider_derivatives(rail, xi, jet, stress, b, g)
    strain = self%counted(state, part, xi, jet)
    jacobian = b(:, self%from)
    geometric = g(self%from, self%from)
  end subroutine evaluate_part

  !> The strains, the turn of a CARRIAGE through full turns.
  pure function counted(self, state, k, xi, jet) result(strain)
    class(element_slider_t), intent(in) :: self
    type(state_t), intent(in) :: state
    integer, intent(in) :: k
    real(wp), intent(in) :: xi
    type(jet_t), intent(in) :: jet(2:)
    real(wp) :: strain(self%strains)

    strain(1) = (self%track(k)%arc - self%start) + xi*norm2(self%track(k)%chord)
    strain(2:) = jet%value
    if (self%strains > 3) strain(4) = unwrapped(strain(4), state%angle(self%slot + 1))
  end function counted

  !> Where there is no foot the way stays as it was counted.
  pure subroutine count_turns(self, state)
    class(element_slider_t), intent(in) :: self
    type(state_t), intent(inout) :: state
    type(jet_t) :: jet(2:self%strains)
    type(rail_t) :: rail
    real(wp) :: xi, strain(self%strains)
    integer :: k
    logical :: valid

    call self%locate(state, k, xi, rail, valid)
    if (.not. valid) return
    call slider_jets(rail, xi, jet)
    strain = self%counted(state, k, xi, jet)
    state%angle(self%slot) = strain(1)
    if (self%strains > 3) state%angle(self%slot + 1) = strain(4)
  end subroutine count_turns

end module element_slider
