!> Dead loads: forces on the coordinates and their derivatives (theory 6).
module system_loads
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number, node_coordinates
  use rotation, only: rotation_matrix, cross, skew, identity3
  use model_functions, only: function_value, function_jet
  use system_data, only: system_t, dead_load_t
  use system_pattern, only: add_block
  implicit none
  private

  public :: amplitudes, add_loads, load_direction, dead_load

contains

  !> Factor of every load when its pattern stands at `level`.
  pure function amplitudes(system, level) result(factor)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)  !< load factor of each pattern
    real(wp) :: factor(size(system%load))
    integer :: i

    do i = 1, size(system%load)
      associate (load => system%load(i))
        factor(i) = level(load%pattern)
        if (system%timed(load%pattern)) factor(i) = 1
        if (load%function > 0) then
          factor(i) = function_value(system%function(load%function), level(load%pattern))
        end if
      end associate
    end do
  end function amplitudes

  !> Add the forces of all loads to `total` (by coordinate) and their tangent to `values`.
  pure subroutine add_loads(system, state, level, total, values)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    real(wp), intent(inout) :: total(:), values(:)
    real(wp) :: force(9), tangent(7, 7), factor(size(system%load))
    integer :: i

    factor = amplitudes(system, level)
    do i = 1, size(system%load)
      associate (load => system%load(i))
        if (load%follower) then
          call follower_load(load, factor(i), state, force, tangent)
        else
          call dead_load(load, factor(i), state, force, tangent(:6, :6))
        end if
        call add_force(load, force, total)
        associate (n => system%pattern%width(size(system%element) + i))
          call add_block(system%pattern, size(system%element) + i, tangent(:n, :n), values)
        end associate
      end associate
    end do
  end subroutine add_loads

  !> Derivative of the forces (by coordinate) to the level of one pattern.
  pure subroutine load_direction(system, state, level, pattern, direction)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    integer, intent(in) :: pattern
    real(wp), intent(out) :: direction(:)
    real(wp) :: force(9), tangent(7, 7), rate, jet(0:2)
    integer :: i

    direction = 0
    do i = 1, size(system%load)
      associate (load => system%load(i))
        if (load%pattern /= pattern) cycle
        rate = 1
        if (load%function > 0) then
          call function_jet(system%function(load%function), level(pattern), jet)
          rate = jet(1)
        end if
        if (load%follower) then
          call follower_load(load, rate, state, force, tangent)
        else
          call dead_load(load, rate, state, force, tangent(:6, :6))
        end if
        call add_force(load, force, direction)
      end associate
    end do
  end subroutine load_direction

  !> Add the forces of a load to those of the coordinates.
  pure subroutine add_force(load, force, total)
    type(dead_load_t), intent(in) :: load
    real(wp), intent(in) :: force(9)
    real(wp), intent(inout) :: total(:)
    integer :: at(7), j

    at = coordinate_number(load%node([1, 1, 1, 2, 2, 2, 3]), [1, 2, 3, 4, 5, 6, 7])
    total(at) = total(at) + force(:7)
    do j = 1, 2
      if (load%lean(j) > 0) total(load%lean(j)) = total(load%lean(j)) + force(7 + j)
    end do
  end subroutine add_force

  !> The kernel: forces on translation, rotation, alpha and the released strains by which the arm
  !> leans, and the tangent on all but the translation: that of -F.R(arm + alpha warp), with
  !> -skew(T)/2 for a dead moment.
  pure subroutine dead_load(load, factor, state, force, tangent)
    type(dead_load_t), intent(in) :: load
    real(wp), intent(in) :: factor
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: force(9), tangent(6, 6)
    real(wp) :: r(3, 3), o(3), across(3, 3), f(3), arm(3), slope(3, 2), bend(3, 2, 2)
    integer :: i, j

    f = factor*load%force
    r = rotation_matrix(state%euler(:, load%node(2)))
    call leaning_arm(load, state, arm, slope, bend)
    across(:, 1) = matmul(r, load%warp)
    across(:, 2:3) = matmul(r, slope)
    o = matmul(r, arm) + state%warping(load%node(3))*across(:, 1)
    force(1:3) = f
    force(4:6) = cross(o, f) + factor*load%moment
    force(7:9) = matmul(f, across)
    force(7) = force(7) + factor*load%bimoment
    tangent = 0
    tangent(1:3, 1:3) = dot_product(o, f)*identity3 - 0.5_wp*factor*skew(load%moment)
    do i = 1, 3
      tangent(1:3, i) = tangent(1:3, i) - 0.5_wp*(o*f(i) + f*o(i))
      tangent(1:3, 3 + i) = -cross(across(:, i), f)
    end do
    tangent(4:6, 1:3) = transpose(tangent(1:3, 4:6))
    do i = 1, 2
      do j = 1, 2
        tangent(4 + i, 4 + j) = -dot_product(f, matmul(r, bend(:, i, j)))
      end do
    end do
  end subroutine dead_load

  !> A force and moment that turn with the node, M = R (m + (arm + alpha warp) x f) about it; the
  !> tangent on rotation, alpha and translation (theory 6).
  pure subroutine follower_load(load, factor, state, force, tangent)
    type(dead_load_t), intent(in) :: load
    real(wp), intent(in) :: factor
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: force(9), tangent(7, 7)
    real(wp) :: r(3, 3), f(3), warp(3)

    r = rotation_matrix(state%euler(:, load%node(2)))
    f = factor*matmul(r, load%force)
    warp = matmul(r, load%warp)
    force = 0
    force(1:3) = f
    force(4:6) = factor*matmul(r, load%moment) &
                 + cross(matmul(r, load%arm) + state%warping(load%node(3))*warp, f)
    force(7) = dot_product(warp, f) + factor*load%bimoment
    tangent = 0
    tangent(1:3, 1:3) = 0.5_wp*skew(force(4:6))
    tangent(1:3, 4) = -cross(warp, f)
    tangent(5:7, 1:3) = skew(f)
  end subroutine follower_load

  !> The arm, turned by the released bending strains at its end, and its first and second
  !> derivatives to them: cos(t) arm + sin(t)/t (a1 axes1 + a2 axes2), t**2 = a1**2 + a2**2.
  pure subroutine leaning_arm(load, state, arm, slope, bend)
    type(dead_load_t), intent(in) :: load
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: arm(3), slope(3, 2), bend(3, 2, 2)
    real(wp) :: a(2), t, ratio, first, second, lean(3), d(2, 2)
    integer :: i, j

    arm = load%arm
    slope = 0
    bend = 0
    if (all(load%lean == 0)) return
    do i = 1, 2
      a(i) = 0
      if (load%lean(i) == 0) cycle
      a(i) = load%lean_rate(i)*state%release(load%lean(i) - node_coordinates*size(state%warping))
    end do
    t = norm2(a)
    if (t < 1.0e-2_wp) then  ! the next terms are below round-off
      ratio = 1 - t**2/6 + t**4/120
      first = -1.0_wp/3 + t**2/30 - t**4/840
      second = 1.0_wp/15 - t**2/210 + t**4/7560
    else
      ratio = sin(t)/t
      first = (cos(t) - ratio)/t**2
      second = -(ratio + 3*first)/t**2
    end if
    lean = matmul(load%axes, a)
    arm = cos(t)*load%arm + ratio*lean
    d = reshape([1, 0, 0, 1], [2, 2])
    do i = 1, 2
      slope(:, i) = load%lean_rate(i)*(ratio*(load%axes(:, i) - a(i)*load%arm) + first*a(i)*lean)
      do j = 1, 2
        bend(:, i, j) = load%lean_rate(i)*load%lean_rate(j)* &
                        (-(d(i, j)*ratio + first*a(i)*a(j))*load%arm &
                         + first*(a(i)*load%axes(:, j) + a(j)*load%axes(:, i) + d(i, j)*lean) &
                         + second*a(i)*a(j)*lean)
      end do
    end do
  end subroutine leaning_arm

end module system_loads
