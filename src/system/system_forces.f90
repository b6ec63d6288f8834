!> The loads of a system: those of cards, and the weight of what has mass (theory 6).
module system_forces
  use kinds, only: wp
  use model_data, only: model_t, member_t, load_t, mode_released, mass_none, mass_consistent
  use system_data, only: system_t, dead_load_t
  use system_inertia, only: truss_density, line_densities, mass_shear_centre
  implicit none
  private

  public :: make_loads

contains

  !> Loads of all patterns; gravity becomes one load at each end of each member with mass.
  subroutine make_loads(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: p, i, n, weights

    weights = 2*count(line_mass_given(model, [(i, i=1, system%members)])) &
              + 2*count(truss_density(model, model%joint) > 0) + count(model%mass%mass > 0)
    n = 0
    do p = 1, size(model%pattern)
      n = n + model%pattern(p)%loads
      if (has_gravity(model, p)) n = n + weights
    end do
    allocate (system%load(n))
    n = 0
    do p = 1, size(model%pattern)
      do i = 1, model%pattern(p)%loads
        n = n + 1
        system%load(n) = point_load(model, model%pattern(p)%load(i), p)
      end do
      if (.not. has_gravity(model, p)) cycle
      do i = 1, system%members
        if (.not. line_mass_given(model, i)) cycle
        system%load(n + 1:n + 2) = weight_loads(model, model%member(i), p)
        call lean_with_releases(model%member(i), system%element(i)%e%coordinate, &
                                system%load(n + 1:n + 2))
        n = n + 2
      end do
      call add_other_weights(model, p, system, n)
    end do
  end subroutine make_loads

  !> Dead weight of trusses, half at each end, and of nodes.
  pure subroutine add_other_weights(model, p, system, n)
    type(model_t), intent(in) :: model
    integer, intent(in) :: p
    type(system_t), intent(inout) :: system
    integer, intent(inout) :: n
    real(wp) :: half
    integer :: i, e

    associate (field => model%pattern(p)%gravity)
      do i = 1, size(model%joint)
        half = 0.5_wp*truss_density(model, model%joint(i))*norm2(model%joint(i)%chord)
        if (.not. half > 0) cycle
        do e = 1, 2
          n = n + 1
          system%load(n) = dead_load_t(pattern=p, node=model%joint(i)%node(1, e), force=half*field)
        end do
      end do
      do i = 1, size(model%mass)
        if (.not. model%mass(i)%mass > 0) cycle
        n = n + 1
        system%load(n) = dead_load_t(pattern=p, node=model%mass(i)%node, &
                                     force=model%mass(i)%mass*field)
      end do
    end associate
  end subroutine add_other_weights

  pure logical function has_gravity(model, p)
    type(model_t), intent(in) :: model
    integer, intent(in) :: p

    has_gravity = any(abs(model%pattern(p)%gravity) > 0)
  end function has_gravity

  !> Whether a member has mass.
  elemental logical function line_mass_given(model, i)
    type(model_t), intent(in) :: model
    integer, intent(in) :: i

    line_mass_given = model%member(i)%mass /= mass_none .and. line_mass(model, model%member(i)) > 0
  end function line_mass_given

  !> Mass per length [M L^-1].
  pure function line_mass(model, member)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    real(wp) :: line_mass, density(6)

    density = line_densities(model, member)
    line_mass = density(1)
  end function line_mass

  !> Dead weight: half at each end; with the consistent mass at the arms l0/6 d that stand for
  !> the end moments of the Hermite interpolation, d = eX + alpha s (theory 6, 7).
  pure function weight_loads(model, member, pattern) result(load)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    integer, intent(in) :: pattern
    type(dead_load_t) :: load(2)
    real(wp) :: length, s(3), centre(2)
    integer :: e

    length = norm2(member%chord)
    centre = mass_shear_centre(model, member)
    s = centre(2)*member%triad(:, 2) - centre(1)*member%triad(:, 3)
    do e = 1, 2
      load(e)%pattern = pattern
      load(e)%node = member%node(:, e)
      load(e)%force = 0.5_wp*length*line_mass(model, member)*model%pattern(pattern)%gravity
      if (member%mass /= mass_consistent) cycle
      load(e)%arm = (3 - 2*e)*length/6*member%triad(:, 1)
      load(e)%warp = (3 - 2*e)*length/6*s
    end do
  end function weight_loads

  !> At an end with released bending the beam's own direction is not that of the node: the arm leans
  !> by the released angles, ay = rel5/l0, az = -rel3/l0 at p and opposite at q.
  pure subroutine lean_with_releases(member, coordinate, load)
    type(member_t), intent(in) :: member
    integer, intent(in) :: coordinate(:)  !< its element: 14 of the nodes, then the releases
    type(dead_load_t), intent(inout) :: load(2)
    integer :: e, i, mode

    if (member%mass /= mass_consistent .or. size(coordinate) == 14) return
    do e = 1, 2
      do i = 1, 2
        mode = 6 + e - 2*i  ! towards y: 5, 6; towards z: 3, 4
        if (member%status(mode) /= mode_released) cycle
        load(e)%lean(i) = coordinate(14 + count(member%status(:mode) == mode_released))
        load(e)%lean_rate(i) = (3 - 2*e)*(3 - 2*i)/norm2(member%chord)
      end do
      load(e)%axes = (3 - 2*e)*norm2(member%chord)/6*member%triad(:, 2:3)
    end do
  end subroutine lean_with_releases

  !> A load of a card.
  pure function point_load(model, card, pattern) result(load)
    type(model_t), intent(in) :: model
    type(load_t), intent(in) :: card
    integer, intent(in) :: pattern
    type(dead_load_t) :: load

    load%pattern = pattern
    load%function = card%function
    load%node = card%node
    load%force = card%force
    load%moment = card%moment
    load%bimoment = card%bimoment
    load%follower = card%follower
    if (card%marker == 0) return
    associate (point => model%point(card%marker))
      if (point%member == 0) return
      associate (m => model%member(point%member))
        load%node = m%node(:, merge(1, 2, m%node(1, 1) == card%node))
        load%arm = point%offset(1)*m%triad(:, 2) + point%offset(2)*m%triad(:, 3)
        if (point%omega_known) load%warp = -point%omega*m%triad(:, 1)
      end associate
    end associate
  end function point_load

end module system_forces
