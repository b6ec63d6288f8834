!> Fields on the mesh of a model: how its points move, and what stresses it.
module beam_drawing
  use kinds, only: wp, sp
  use rotation, only: rotated, turned, rotation_vector
  use section_data, only: axial_stress
  use beam_curve, only: beam_ends_t, beam_curve_t, station_t, new_curve, beam_station, &
                        relative_rotation
  use beam_mesh, only: mesh_t, profile_t, beam_t
  implicit none
  private

  public :: posture_t, draw_motion, draw_mode, draw_forces, draw_stress, mode_forces

  !> Largest angle by which a model is moved along a mode to see how its points follow.
  real(wp), parameter :: small_angle = 1.0e-4_wp

  !> Where the nodes are.
  type :: posture_t
    real(wp), allocatable :: displacement(:, :)   !< (3, nodes) [L]
    real(wp), allocatable :: euler(:, :)          !< (4, nodes) Euler parameters, scalar first
    real(wp), allocatable :: warping(:)           !< (nodes) [L^-1]
  end type posture_t

contains

  !> Displacement [L] and rotation vector [rad] of all points of a mesh; bars have no rotation.
  pure subroutine draw_motion(mesh, posture, displacement, rotation)
    type(mesh_t), intent(in) :: mesh
    type(posture_t), intent(in) :: posture
    real(wp), intent(out), contiguous :: displacement(:, :), rotation(:, :)   !< (3, points)
    type(station_t) :: station
    type(beam_curve_t) :: curve
    integer :: e, i, n, corners

    do e = 1, size(mesh%beam)
      n = mesh%beam(e)%first
      curve = new_curve(ends_of(mesh%beam(e), posture))
      associate (profile => mesh%profile(mesh%beam(e)%profile))
        corners = size(profile%omega)
        do i = 0, mesh%segments
          station = beam_station(curve, i/real(mesh%segments, wp))
          call move_corners(profile, curve%triad, station, displacement(:, n + 1:n + corners))
          rotation(:, n + 1:n + corners) = spread(rotation_vector(station%euler), 2, corners)
          n = n + corners
        end do
      end associate
    end do
    do e = 1, size(mesh%bar)
      n = mesh%bar(e)%first
      displacement(:, n + 1:n + 2) = posture%displacement(:, mesh%bar(e)%node)
      rotation(:, n + 1:n + 2) = 0
    end do
    do e = 1, size(mesh%dot)
      associate (node => mesh%dot(e)%node, at => mesh%dot(e)%first + 1)
        displacement(:, at) = posture%displacement(:, node(1))
        rotation(:, at) = 0
        if (node(2) > 0) rotation(:, at) = rotation_vector(posture%euler(:, node(2)))
      end associate
    end do
  end subroutine draw_motion

  !> A beam as it is now.
  pure function ends_of(beam, posture) result(ends)
    type(beam_t), intent(in) :: beam
    type(posture_t), intent(in) :: posture
    type(beam_ends_t) :: ends

    ends%beam_shape_t = beam%ends
    ends%displacement = posture%displacement(:, beam%node(1, :))
    ends%euler = posture%euler(:, beam%node(2, :))
    if (ends%warps) ends%warping = posture%warping(beam%node(3, :))
  end function ends_of

  !> The corners of a section follow its centroid, its rotation and, by -omega alpha, its warping.
  pure subroutine move_corners(profile, triad, station, displacement)
    type(profile_t), intent(in) :: profile
    real(wp), intent(in) :: triad(3, 3)
    type(station_t), intent(in) :: station
    real(wp), intent(out), contiguous :: displacement(:, :)   !< (3, corners)
    real(wp) :: now(3, 3), y(3), z(3), out(3)
    integer :: k

    now = rotated(station%euler, triad)
    y = now(:, 2) - triad(:, 2)
    z = now(:, 3) - triad(:, 3)
    out = station%warping*now(:, 1)
    do k = 1, size(profile%omega)
      displacement(:, k) = station%displacement + profile%corner(1, k)*y &
                           + profile%corner(2, k)*z - profile%omega(k)*out
    end do
  end subroutine move_corners

  !> Displacement and spin of all points in a mode, linear about a posture: half the difference of
  !> what a little of the mode, forth and back, makes of them.
  pure subroutine draw_mode(mesh, posture, displacement, rotation, warping, moved, spin)
    type(mesh_t), intent(in) :: mesh
    type(posture_t), intent(in) :: posture
    real(wp), intent(in) :: displacement(:, :), rotation(:, :), warping(:)   !< by node
    real(wp), intent(out), contiguous :: moved(:, :), spin(:, :)             !< (3, points)
    real(wp), dimension(3, size(moved, 2)) :: back, back_spin
    type(posture_t) :: near
    real(wp) :: step, length
    integer :: e, i, n

    length = tiny(1.0_wp)
    do e = 1, size(mesh%beam)
      length = max(length, norm2(mesh%beam(e)%ends%chord))
    end do
    do e = 1, size(mesh%bar)
      n = mesh%bar(e)%first
      length = max(length, norm2(mesh%position(:, n + 2) - mesh%position(:, n + 1)))
    end do
    if (size(mesh%beam) + size(mesh%bar) == 0) length = 1
    step = max(maxval(abs(rotation)), maxval(abs(displacement))/length, &
               maxval(abs(warping))*length, tiny(1.0_wp)/small_angle)
    step = small_angle/step
    near = posture
    do i = -1, 1, 2
      near%displacement = posture%displacement + i*step*displacement
      near%warping = posture%warping + i*step*warping
      do n = 1, size(warping)
        near%euler(:, n) = turned(posture%euler(:, n), i*step*rotation(:, n))
      end do
      call draw_motion(mesh, near, moved, spin)
      if (i < 0) back = moved
      if (i < 0) back_spin = spin
    end do
    moved = (moved - back)/(2*step)
    do n = 1, size(spin, 2)
      spin(:, n) = relative_rotation(turned([1, 0, 0, 0]*1.0_wp, back_spin(:, n)), &
                                     turned([1, 0, 0, 0]*1.0_wp, spin(:, n)))/(2*step)
    end do
  end subroutine draw_mode

  !> Section forces at the ends of the beams from the stress resultants of a mode, to first order:
  !> theory 4, and the shear forces that balance the moments.
  pure subroutine mode_forces(mesh, stress, force_p, force_q)
    type(mesh_t), intent(in) :: mesh
    real(wp), intent(in) :: stress(:, :)                     !< (8, members) [F]
    real(wp), intent(out) :: force_p(:, :), force_q(:, :)    !< (7, members) N Vy Vz T My Mz B
    real(wp) :: length
    integer :: e

    do e = 1, size(mesh%beam)
      length = norm2(mesh%beam(e)%ends%chord)
      associate (s => stress(:, e))
        force_p(1:3, e) = [s(1), s(5) - s(6), s(4) - s(3)]
        force_p(4:7, e) = length*[s(2), s(3), s(5), -length*s(7)]
        force_q(1:3, e) = force_p(1:3, e)
        force_q(4:7, e) = length*[s(2), s(4), s(6), length*s(8)]
      end associate
    end do
  end subroutine mode_forces

  !> Section forces in the cells, linear along the beams; bars have a normal force, dots none.
  pure subroutine draw_forces(mesh, force_p, force_q, joint_stress, force)
    type(mesh_t), intent(in) :: mesh
    real(wp), intent(in), contiguous :: force_p(:, :), force_q(:, :) !< (7, members) N ... B
    real(wp), intent(in) :: joint_stress(:, :)         !< (modes, joints)
    real(sp), intent(out), contiguous :: force(:, :)   !< (7, cells)
    integer :: i, beams

    beams = size(mesh%owner) - size(mesh%bar) - size(mesh%dot)
    force(:, beams + 1:) = 0
    do i = 1, size(mesh%bar)
      force(1, beams + i) = real(joint_stress(1, mesh%bar(i)%joint), sp)
    end do
    do i = 1, beams
      associate (e => mesh%owner(i), xi => mesh%middle(i))
        force(:, i) = real((1 - xi)*force_p(:, e) + xi*force_q(:, e), sp)
      end associate
    end do
  end subroutine draw_forces

  !> Axial stress at the points, from section forces linear along the beams and from the forces of
  !> bars; 0 where the section is unknown.
  pure subroutine draw_stress(mesh, force_p, force_q, joint_stress, stress)
    type(mesh_t), intent(in) :: mesh
    real(wp), intent(in), contiguous :: force_p(:, :), force_q(:, :) !< (7, members) N ... B
    real(wp), intent(in) :: joint_stress(:, :)         !< (modes, joints)
    real(sp), intent(out), contiguous :: stress(:)     !< (points) [F L^-2]
    integer :: e, n

    stress = 0
    do e = 1, size(mesh%beam)
      associate (profile => mesh%profile(mesh%beam(e)%profile))
        n = mesh%beam(e)%first
        if (profile%constants%a > 0) call stress_beam(profile, force_p(:, e), force_q(:, e), &
          stress(n + 1:n + (mesh%segments + 1)*size(profile%omega)))
      end associate
    end do
    do e = 1, size(mesh%bar)
      n = mesh%bar(e)%first
      if (mesh%bar(e)%area > 0) stress(n + 1:n + 2) = &
        real(joint_stress(1, mesh%bar(e)%joint)/mesh%bar(e)%area, sp)
    end do
  end subroutine draw_stress

  !> Axial stress at the corners of all stations of a beam.
  pure subroutine stress_beam(profile, force_p, force_q, stress)
    type(profile_t), intent(in) :: profile
    real(wp), intent(in) :: force_p(7), force_q(7)
    real(sp), intent(out), contiguous :: stress(:)
    real(wp), dimension(size(profile%omega)) :: p, q
    real(wp) :: xi
    integer :: i, k, corners, pieces

    corners = size(profile%omega)
    pieces = size(stress)/corners - 1
    do k = 1, corners
      associate (at => profile%corner(:, k), omega => profile%omega(k))
        p(k) = axial_stress(profile%constants, at, omega, force_p([1, 5, 6, 7]))
        q(k) = axial_stress(profile%constants, at, omega, force_q([1, 5, 6, 7]))
      end associate
    end do
    do i = 0, pieces
      xi = i/real(pieces, wp)
      stress(i*corners + 1:(i + 1)*corners) = real((1 - xi)*p + xi*q, sp)
    end do
  end subroutine stress_beam

end module beam_drawing
