!> BEAMW: the shear-deformable thin-walled beam with warping, a generalized-strain element.
module element_beamw
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number, node_coordinates
  use element_base, only: element_t
  use rotation, only: rotated
  use beamw_constants, only: beamw_t
  use beam_strains, only: kinematics_t, beam_kinematics, beam_curvature, mid_twist_derivatives, &
                          reduced
  implicit none
  private

  public :: element_beamw_t, new_element_beamw, add_damping, beamw_strains, beamw_geometric

  integer, parameter, public :: modes = 8

  !> Nodes by kind (translational, rotational, warping) and end; a released strain adds a
  !> coordinate behind the fourteen of the nodes.
  type, extends(element_t) :: element_beamw_t
    integer :: node(3, 2) = 0
    real(wp) :: chord(3) = 0.0_wp             !< initial vector from p to q [L]
    real(wp) :: length = 0.0_wp               !< its length [L]
    integer :: release(modes) = 0             !< by mode: index in `state%release`; 0: not released
    integer, allocatable :: released(:)       !< the released modes
    type(beamw_t), pointer :: constants => null()  !< shared by all elements that are alike
    real(wp), allocatable :: viscosity(:, :)  !< (9, 9) stress per rate of strain [F/L T]; or none
  contains
    procedure :: evaluate
    procedure :: law
    procedure :: damping
  end type element_beamw_t

contains

  !> An element between nodes; `release`: see the type. `fixed` is by mode; a rigid beam has
  !> all eight fixed. Modes 7 and 8 that are fixed are not constraints of the element: who
  !> builds the system holds alpha itself.
  subroutine new_element_beamw(node, nodes, chord, triad, fixed, release, constants, element)
    integer, intent(in) :: node(3, 2), nodes
    real(wp), intent(in) :: chord(3), triad(3, 3)
    logical, intent(in) :: fixed(modes)
    integer, intent(in) :: release(modes)
    type(beamw_t), pointer, intent(in) :: constants
    class(element_t), allocatable, intent(out) :: element
    type(element_beamw_t), allocatable :: new
    integer :: i, e

    allocate (new)
    new%node = node
    new%chord = chord
    new%length = norm2(chord)
    new%size = new%length
    new%triad = triad
    new%section_node = node(2, :)
    new%release = release
    allocate (new%released(count(release > 0)), new%coordinate(14 + count(release > 0)))
    new%released(:) = pack([(i, i=1, modes)], release > 0)
    new%constants => constants
    new%strains = modes + 1
    new%coordinates = size(new%coordinate)
    do e = 1, 2
      do i = 1, 3
        new%coordinate(7*(e - 1) + i) = coordinate_number(node(1, e), i)
        new%coordinate(7*(e - 1) + 3 + i) = coordinate_number(node(2, e), 3 + i)
      end do
      new%coordinate(7*e) = coordinate_number(node(3, e), 7)
    end do
    new%coordinate(15:) = node_coordinates*nodes + release(new%released)
    new%fixed = [fixed(1:6), .false., .false., .false.]
    call move_alloc(new, element)
  end subroutine new_element_beamw

  !> Give a beam viscous stresses, (9, 9) per rate of its strains [F L^-1 T].
  subroutine add_damping(viscosity, element)
    real(wp), intent(in) :: viscosity(:, :)
    class(element_t), intent(inout) :: element

    select type (element)
    type is (element_beamw_t)
      element%viscosity = viscosity
      call free_rows(element, element%viscosity)
      element%damped = .true.
    end select
  end subroutine add_damping

  pure subroutine evaluate(self, state, stress, strain, jacobian, geometric, valid)
    class(element_beamw_t), intent(in) :: self
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: stress(self%strains)
    real(wp), intent(out) :: strain(self%strains)
    real(wp), intent(out) :: jacobian(self%strains, self%coordinates)
    real(wp), intent(out) :: geometric(self%coordinates, self%coordinates)
    logical, intent(out) :: valid
    type(kinematics_t) :: k
    real(wp) :: chord(3), triad(3, 3, 2), release(modes), weight(9, modes), b(9, reduced)
    real(wp) :: g(reduced, reduced)
    integer :: i

    chord = self%chord + (state%displacement(:, self%node(1, 2)) &
                          - state%displacement(:, self%node(1, 1)))
    do i = 1, 2
      triad(:, :, i) = rotated(state%euler(:, self%node(2, i)), self%triad)
    end do
    release = 0
    do i = 1, size(self%released)
      release(self%released(i)) = state%release(self%release(self%released(i)))
    end do
    call beam_kinematics(chord, triad, state%warping(self%node(3, :)), release, self%length, &
                         self%constants%angles, k)
    valid = k%valid
    if (.not. valid) return
    call beamw_strains(self%constants, k, strain, weight, b)
    call expand_columns(b, jacobian(:, 1:14))
    if (any(abs(stress) > 0)) then
      call beamw_geometric(self%constants, k, stress, weight, g)
      call expand_square(g, geometric(1:14, 1:14))
    else
      geometric(1:14, 1:14) = 0
    end if
    if (size(self%released) > 0) then
      call add_releases(self%constants, self%released, k, stress, weight, jacobian, geometric)
    end if
  end subroutine evaluate

  pure subroutine law(self, stiffness)
    class(element_beamw_t), intent(in) :: self
    real(wp), intent(out) :: stiffness(self%strains, self%strains)

    stiffness = self%constants%s
    call free_rows(self, stiffness)
  end subroutine law

  pure subroutine damping(self, viscosity)
    class(element_beamw_t), intent(in) :: self
    real(wp), intent(out) :: viscosity(self%strains, self%strains)

    viscosity = 0
    if (allocated(self%viscosity)) viscosity = self%viscosity
  end subroutine damping

  !> No law for strains that are fixed.
  pure subroutine free_rows(self, law)
    class(element_beamw_t), intent(in) :: self
    real(wp), intent(inout) :: law(self%strains, self%strains)
    integer :: i

    do i = 1, self%strains
      if (.not. self%fixed(i)) cycle
      law(i, :) = 0
      law(:, i) = 0
    end do
  end subroutine free_rows

  !> Second-order strains, their derivative to the strains of the nodes, w + Qe, and to the
  !> eleven coordinates of `beam_strains` (theory 5).
  pure subroutine beamw_strains(c, k, strain, weight, b)
    type(beamw_t), intent(in) :: c
    type(kinematics_t), intent(in) :: k
    real(wp), intent(out) :: strain(9), weight(9, 8), b(9, reduced)
    real(wp) :: qe(8), row(8)
    integer :: i, j

    do i = 1, 9
      row = c%w(:, i)
      strain(i) = dot_product(row, k%strain)
      if (c%curved(i)) then
        qe = product8(c%q(:, :, i), k%strain)
        row = row + qe
        strain(i) = strain(i) + 0.5_wp*dot_product(qe, k%strain)
      end if
      weight(i, :) = row
    end do
    associate (d => k%gradient)  ! the chord does not twist, spins do not stretch: `to_mid_twist`
      do j = 1, 3
        b(:, j) = weight(:, 1)*d(j, 1) + weight(:, 3)*d(j, 3) + weight(:, 4)*d(j, 4) &
                  + weight(:, 5)*d(j, 5) + weight(:, 6)*d(j, 6)
      end do
      do j = 4, 9
        b(:, j) = weight(:, 2)*d(j, 2) + weight(:, 3)*d(j, 3) + weight(:, 4)*d(j, 4) &
                  + weight(:, 5)*d(j, 5) + weight(:, 6)*d(j, 6)
      end do
      b(:, 10) = weight(:, 7)*d(10, 7)
      b(:, 11) = weight(:, 8)*d(11, 8)
    end associate
  end subroutine beamw_strains

  !> A matrix of fixed size times a vector.
  pure function product8(matrix, x) result(y)
    real(wp), intent(in) :: matrix(8, 8), x(8)
    real(wp) :: y(8)

    y = matrix(:, 1)*x(1) + matrix(:, 2)*x(2) + matrix(:, 3)*x(3) + matrix(:, 4)*x(4) &
        + matrix(:, 5)*x(5) + matrix(:, 6)*x(6) + matrix(:, 7)*x(7) + matrix(:, 8)*x(8)
  end function product8

  !> Sum of stress(i) times the Hessian of strain i in the eleven coordinates.
  pure subroutine beamw_geometric(c, k, stress, weight, g)
    type(beamw_t), intent(in) :: c
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: stress(9), weight(9, 8)
    real(wp), intent(out) :: g(reduced, reduced)
    real(wp) :: qs(8, 8), dq(reduced, 8), h(9, 9)
    integer :: i, j

    qs = 0
    do i = 1, 9
      if (c%curved(i)) qs = qs + stress(i)*c%q(:, :, i)
    end do
    associate (d => k%gradient)
      do j = 1, 8
        dq(1:9, j) = d(1:9, 1)*qs(1, j) + d(1:9, 2)*qs(2, j) + d(1:9, 3)*qs(3, j) &
                     + d(1:9, 4)*qs(4, j) + d(1:9, 5)*qs(5, j) + d(1:9, 6)*qs(6, j)
        dq(10, j) = d(10, 7)*qs(7, j)
        dq(11, j) = d(11, 8)*qs(8, j)
      end do
      do j = 1, 9
        g(:, j) = dq(:, 1)*d(j, 1) + dq(:, 2)*d(j, 2) + dq(:, 3)*d(j, 3) &
                  + dq(:, 4)*d(j, 4) + dq(:, 5)*d(j, 5) + dq(:, 6)*d(j, 6)
      end do
      g(:, 10) = dq(:, 7)*d(10, 7)
      g(:, 11) = dq(:, 8)*d(11, 8)
    end associate
    call beam_curvature(k, matmul(stress, weight), h)
    g(1:9, 1:9) = g(1:9, 1:9) + h
  end subroutine beamw_geometric

  !> From chord, spins, warpings to the fourteen coordinates of the nodes.
  pure subroutine expand_columns(b, full)
    real(wp), intent(in) :: b(9, reduced)
    real(wp), intent(out) :: full(9, 14)

    full(:, 1:3) = -b(:, 1:3)
    full(:, 4:6) = b(:, 4:6)
    full(:, 7) = b(:, 10)
    full(:, 8:10) = b(:, 1:3)
    full(:, 11:13) = b(:, 7:9)
    full(:, 14) = b(:, 11)
  end subroutine expand_columns

  pure subroutine expand_square(g, full)
    real(wp), intent(in) :: g(reduced, reduced)
    real(wp), intent(out) :: full(14, 14)
    integer, parameter :: from(14) = [1, 2, 3, 4, 5, 6, 10, 1, 2, 3, 7, 8, 9, 11]
    integer :: j

    do j = 1, 14
      full(:, j) = g(from, from(j))
    end do
    full(1:3, 4:) = -full(1:3, 4:)
    full(4:, 1:3) = -full(4:, 1:3)
  end subroutine expand_square

  !> Rows and columns of the released parts, which the raw strains lose: coordinates 15 and on.
  pure subroutine add_releases(c, released, k, stress, weight, jacobian, geometric)
    type(beamw_t), intent(in) :: c
    integer, intent(in) :: released(:)
    type(kinematics_t), intent(in) :: k
    real(wp), intent(in) :: stress(9), weight(9, 8)
    real(wp), intent(inout) :: jacobian(:, :), geometric(:, :)
    real(wp) :: first(8, 8), second(8, 8), qs(8, 8), mixed(9, reduced), full(9, 14)
    integer :: i, m, r

    qs = 0
    do i = 1, 9
      qs = qs + stress(i)*c%q(:, :, i)
    end do
    call mid_twist_derivatives(k, matmul(stress, weight), first, second)
    mixed = 0
    mixed(1:8, :) = matmul(transpose(matmul(qs, first)), transpose(k%gradient))
    mixed(1:8, 1:9) = mixed(1:8, 1:9) + matmul(second(:, 1:6), transpose(k%draw))
    call expand_columns(mixed, full)
    do r = 1, size(released)
      m = released(r)
      jacobian(:, 14 + r) = -matmul(weight, first(:, m))
      geometric(14 + r, 1:14) = -full(m, :)
      geometric(1:14, 14 + r) = -full(m, :)
      geometric(15:, 14 + r) = matmul(first(:, m), matmul(qs, first(:, released))) &
                               + second(released, m)
    end do
  end subroutine add_releases

end module element_beamw
