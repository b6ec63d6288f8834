!> Dead loads: forces on the coordinates and their derivatives (theory 6).
module system_loads
  use kinds, only: wp
  use nodal_state, only: state_t, coordinate_number
  use rotation, only: rotation_matrix, cross, skew, identity3
  use model_functions, only: function_value
  use system_data, only: system_t, dead_load_t
  use system_pattern, only: add_block
  implicit none
  private

  public :: amplitudes, add_loads, load_direction

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
        if (load%function > 0) &
          factor(i) = function_value(system%function(load%function), level(load%pattern))
      end associate
    end do
  end function amplitudes

  !> Add the forces of all loads to `total` (by coordinate) and their tangent to `values`.
  pure subroutine add_loads(system, state, level, total, values)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    real(wp), intent(inout) :: total(:), values(:)
    real(wp) :: force(7), tangent(4, 4), factor(size(system%load))
    integer :: i, at(7)

    factor = amplitudes(system, level)
    do i = 1, size(system%load)
      associate (load => system%load(i))
        call dead_load(load, factor(i), state, force, tangent)
        at = coordinate_number(load%node([1, 1, 1, 2, 2, 2, 3]), [1, 2, 3, 4, 5, 6, 7])
        total(at) = total(at) + force
        call add_block(system%pattern, size(system%element) + i, tangent, values)
      end associate
    end do
  end subroutine add_loads

  !> Derivative of the forces (by coordinate) to the level of one pattern; that of a function by
  !> central differences, whose error, 1e-10, only costs iterations.
  pure subroutine load_direction(system, state, level, pattern, direction)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    integer, intent(in) :: pattern
    real(wp), intent(out) :: direction(:)
    real(wp), parameter :: h = 1.0e-5_wp
    real(wp) :: force(7), tangent(4, 4), rate
    integer :: i, at(7)

    direction = 0
    do i = 1, size(system%load)
      associate (load => system%load(i))
        if (load%pattern /= pattern) cycle
        rate = 1
        if (load%function > 0) then
          associate (f => system%function(load%function), s => level(pattern))
            rate = (function_value(f, s + h) - function_value(f, s - h))/(2*h)
          end associate
        end if
        call dead_load(load, rate, state, force, tangent)
        at = coordinate_number(load%node([1, 1, 1, 2, 2, 2, 3]), [1, 2, 3, 4, 5, 6, 7])
        direction(at) = direction(at) + force
      end associate
    end do
  end subroutine load_direction

  !> The kernel: forces on translation, rotation and alpha of the node, and the tangent on rotation
  !> and alpha: of -F.R(arm + alpha warp), with -skew(T)/2 for a dead moment.
  pure subroutine dead_load(load, factor, state, force, tangent)
    type(dead_load_t), intent(in) :: load
    real(wp), intent(in) :: factor
    type(state_t), intent(in) :: state
    real(wp), intent(out) :: force(7), tangent(4, 4)
    real(wp) :: r(3, 3), o(3), w(3), f(3)
    integer :: i

    f = factor*load%force
    r = rotation_matrix(state%euler(:, load%node(2)))
    w = matmul(r, load%warp)
    o = matmul(r, load%arm) + state%warping(load%node(3))*w
    force(1:3) = f
    force(4:6) = cross(o, f) + factor*load%moment
    force(7) = dot_product(f, w) + factor*load%bimoment
    tangent(1:3, 1:3) = dot_product(o, f)*identity3 - 0.5_wp*factor*skew(load%moment)
    do i = 1, 3
      tangent(1:3, i) = tangent(1:3, i) - 0.5_wp*(o*f(i) + f*o(i))
    end do
    tangent(1:3, 4) = -cross(w, f)
    tangent(4, 1:3) = tangent(1:3, 4)
    tangent(4, 4) = 0
  end subroutine dead_load

end module system_loads
