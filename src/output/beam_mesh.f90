!> The undeformed model as a mesh of VTK: beams as lines or as their sections' outlines swept
!> along them, trusses as straight lines, the nodes of other joints as dots.
module beam_mesh
  use kinds, only: wp
  use section_data, only: section_constants_t, section_geometry_t, section_open, section_closed
  use beamw_rigidity, only: rigidity_t, shear_compliance
  use beam_curve, only: beam_shape_t
  use model_data, only: model_t, member_t, mode_flexible, joint_truss, joint_gear
  use system_constants, only: member_rigidity
  implicit none
  private

  public :: mesh_t, profile_t, beam_t, bar_t, dot_t, new_mesh

  !> Cell types of VTK.
  integer, parameter, public :: vertex_cell = 1, line_cell = 3, polygon_cell = 7, quad_cell = 9

  !> Pieces of a beam at most, without and with outlines; points in all, where that allows more than
  !> one piece each. Every point costs 50 bytes a step, and writing them a tenth of a run.
  integer, parameter :: line_segments = 4, outline_segments = 3, all_points = 3000

  !> What is swept along a beam: closed polygons, or the centroid alone.
  type :: profile_t
    integer :: kind = 0                     !< one of `section_*`
    real(wp), allocatable :: corner(:, :)   !< (2, corners) principal axes [L]
    real(wp), allocatable :: omega(:)       !< (corners) [L^2], 0 where unknown
    integer, allocatable :: last(:)         !< last corner of each polygon; none: a line
    type(section_constants_t) :: constants  !< no area: unknown
  end type profile_t

  !> A beam of the model.
  type :: beam_t
    integer :: node(3, 2) = 0     !< by kind and end, as in the model
    integer :: profile = 0        !< index
    integer :: first = 0          !< points of the mesh before its own
    type(beam_shape_t) :: ends    !< undeformed
  end type beam_t

  !> A truss of the model.
  type :: bar_t
    integer :: joint = 0          !< index
    integer :: node(2) = 0        !< translational nodes p and q
    integer :: first = 0          !< points of the mesh before its own two
    real(wp) :: area = 0.0_wp     !< [L^2], 0 if unknown
  end type bar_t

  !> A node of other joints, if it has a place.
  type :: dot_t
    integer :: node(2) = 0        !< translational and rotational, 0: does not turn
    integer :: first = 0          !< points of the mesh before its own
  end type dot_t

  type :: mesh_t
    integer :: segments = 1                     !< pieces of a beam
    type(profile_t), allocatable :: profile(:)  !< of the sections; the last is a line
    type(beam_t), allocatable :: beam(:)
    type(bar_t), allocatable :: bar(:)
    type(dot_t), allocatable :: dot(:)
    real(wp), allocatable :: position(:, :)     !< (3, points), by beam, station, corner; bars; dots
    integer, allocatable :: corners(:)          !< points of the cells from 0, cell by cell
    integer, allocatable :: offset(:)           !< by cell: entries of `corners` before; one more
    integer, allocatable :: kind(:)             !< by cell: type of VTK
    integer, allocatable :: owner(:)            !< by cell: its beam; then bars, dots
    real(wp), allocatable :: middle(:)          !< by cell: its place along the beam, 0 to 1
  end type mesh_t

contains

  !> Points and cells of a model.
  pure subroutine new_mesh(model, mesh)
    type(model_t), intent(in) :: model
    type(mesh_t), intent(out) :: mesh
    integer :: e, points

    allocate (mesh%profile(size(model%section) + 1))
    do e = 1, size(model%section)
      call new_profile(model%section(e)%constants, model%section(e)%geometry, mesh%profile(e))
    end do
    call new_line(mesh%profile(size(mesh%profile)))
    mesh%segments = pieces(model, mesh%profile)
    allocate (mesh%beam(size(model%member)))
    points = 0
    do e = 1, size(model%member)
      call new_beam(model, model%member(e), mesh%beam(e))
      if (mesh%beam(e)%profile == 0) mesh%beam(e)%profile = size(mesh%profile)
      mesh%beam(e)%first = points
      points = points + (mesh%segments + 1)*size(mesh%profile(mesh%beam(e)%profile)%omega)
    end do
    call new_bars(model, points, mesh%bar)
    points = points + 2*size(mesh%bar)
    call new_dots(model, points, mesh%dot)
    allocate (mesh%position(3, points + size(mesh%dot)))
    call place_points(model, mesh)
    call make_cells(model, mesh)
  end subroutine new_mesh

  !> In how many pieces a beam is drawn.
  pure integer function pieces(model, profile)
    type(model_t), intent(in) :: model
    type(profile_t), intent(in) :: profile(:)   !< of the sections, and a line
    integer :: e, corners

    pieces = line_segments
    corners = 0
    do e = 1, size(model%member)
      associate (section => model%member(e)%section)
        if (section == 0) then
          corners = corners + 1
        else
          corners = corners + size(profile(section)%omega)
          if (size(profile(section)%last) > 0) pieces = outline_segments
        end if
      end associate
    end do
    pieces = max(1, min(pieces, all_points/max(1, corners) - 1))
  end function pieces

  pure subroutine new_beam(model, member, beam)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(beam_t), intent(out) :: beam
    type(rigidity_t) :: rigidity

    beam%node = member%node
    beam%profile = member%section
    beam%ends%chord = member%chord
    beam%ends%triad = member%triad
    if (member%rigid .or. all(member%status /= mode_flexible)) return
    if (.not. member%has_stiffness .and. min(member%section, member%material) == 0) return
    rigidity = member_rigidity(model, member)
    beam%ends%shear_centre = [rigidity%ys, rigidity%zs]
    beam%ends%warps = rigidity%eiw > 0 .and. all(member%node(3, :) > 0)
    associate (phi => matmul(shear_compliance(rigidity), [0.0_wp, 0.0_wp, 12*rigidity%eiw]) &
               /dot_product(member%chord, member%chord))
      beam%ends%shear = phi(3)/(1 + phi(3))
    end associate
  end subroutine new_beam

  pure subroutine new_bars(model, points, bar)
    type(model_t), intent(in) :: model
    integer, intent(in) :: points          !< of the beams
    type(bar_t), allocatable, intent(out) :: bar(:)
    integer :: i, n

    allocate (bar(count(model%joint%kind == joint_truss)))
    n = 0
    do i = 1, size(model%joint)
      associate (joint => model%joint(i))
        if (joint%kind /= joint_truss) cycle
        n = n + 1
        bar(n) = bar_t(i, joint%node(1, :), points + 2*(n - 1))
        if (joint%section > 0) bar(n)%area = model%section(joint%section)%constants%a
      end associate
    end do
  end subroutine new_bars

  !> The nodes of the joints that are no trusses, each once.
  pure subroutine new_dots(model, points, dot)
    type(model_t), intent(in) :: model
    integer, intent(in) :: points          !< of beams and bars
    type(dot_t), allocatable, intent(out) :: dot(:)
    integer :: turning(size(model%node)), i, end, at, n

    turning = -1
    do i = 1, size(model%joint)
      associate (joint => model%joint(i))
        if (any(joint%kind == [joint_truss, joint_gear])) cycle
        do end = 1, 2
          at = maxval(joint%node(:, end))
          if (joint%node(1, end) > 0) at = joint%node(1, end)
          if (at == 0) cycle
          if (model%node(at)%exists(1)) turning(at) = joint%node(2, end)
        end do
      end associate
    end do
    allocate (dot(count(turning >= 0)))
    n = 0
    do at = 1, size(turning)
      if (turning(at) < 0) cycle
      n = n + 1
      dot(n) = dot_t([at, turning(at)], points + n - 1)
    end do
  end subroutine new_dots

  pure subroutine new_line(profile)
    type(profile_t), intent(out) :: profile

    allocate (profile%corner(2, 1), profile%omega(1), profile%last(0))
    profile%corner = 0
    profile%omega = 0
  end subroutine new_line

  !> The outline of a section, a line where it has none. The walls of an open one are a rectangle
  !> each, from end to end and back: the warping coordinate is that of their ends.
  pure subroutine new_profile(constants, geometry, profile)
    type(section_constants_t), intent(in) :: constants
    type(section_geometry_t), intent(in) :: geometry
    type(profile_t), intent(out) :: profile
    integer :: i

    if (allocated(geometry%outline)) then
      profile%kind = geometry%kind
      profile%corner = geometry%outline
      profile%last = geometry%outline_last
      allocate (profile%omega(size(profile%corner, 2)))
      profile%omega = 0
      if (geometry%warping_known .and. geometry%kind == section_open) then
        do i = 1, size(geometry%plates, 2)
          profile%omega(4*i - 3:4*i) = geometry%omega(geometry%plates([1, 2, 2, 1], i))
        end do
      else if (geometry%warping_known .and. allocated(geometry%plates)) then
        profile%omega = reshape(geometry%omega, shape(profile%omega), pad=geometry%omega)
      end if
    else
      call new_line(profile)
    end if
    profile%constants = constants
  end subroutine new_profile

  !> Where the points are before deformation.
  pure subroutine place_points(model, mesh)
    type(model_t), intent(in) :: model
    type(mesh_t), intent(inout) :: mesh
    real(wp) :: centre(3)
    integer :: e, i, k, n

    do e = 1, size(model%member)
      n = mesh%beam(e)%first
      associate (m => model%member(e), profile => mesh%profile(mesh%beam(e)%profile))
        do i = 0, mesh%segments
          centre = model%node(m%node(1, 1))%position + m%chord*i/mesh%segments
          do k = 1, size(profile%omega)
            n = n + 1
            mesh%position(:, n) = centre + matmul(m%triad(:, 2:3), profile%corner(:, k))
          end do
        end do
      end associate
    end do
    do e = 1, size(mesh%bar)
      n = mesh%bar(e)%first
      do i = 1, 2
        mesh%position(:, n + i) = model%node(mesh%bar(e)%node(i))%position
      end do
    end do
    do e = 1, size(mesh%dot)
      mesh%position(:, mesh%dot(e)%first + 1) = model%node(mesh%dot(e)%node(1))%position
    end do
  end subroutine place_points

  !> There are no more cells than points and, on average, no more than four corners to a cell.
  pure subroutine make_cells(model, mesh)
    type(model_t), intent(in) :: model
    type(mesh_t), intent(inout) :: mesh
    integer :: e, i, cells, ends(size(model%node))

    ends = 0
    do e = 1, size(model%member)
      do i = 1, 2
        associate (node => model%member(e)%node(1, i))
          ends(node) = ends(node) + 1
        end associate
      end do
    end do
    associate (most => size(mesh%position, 2))
      allocate (mesh%corners(4*most), mesh%offset(most + 1), mesh%kind(most), mesh%owner(most), &
                mesh%middle(most))
    end associate
    mesh%offset(1) = 0
    cells = 0
    do e = 1, size(model%member)
      if (size(mesh%profile(mesh%beam(e)%profile)%last) == 0) then
        call add_lines(mesh, e, cells)
      else
        call add_surface(mesh, e, cells)
        do i = 1, 2
          if (ends(model%member(e)%node(1, i)) == 1) call add_cap(mesh, e, i, cells)
        end do
      end if
    end do
    do e = 1, size(mesh%bar)
      call add_cell(mesh, mesh%bar(e)%first + [0, 1], line_cell, 0, 0.5_wp, cells)
    end do
    do e = 1, size(mesh%dot)
      call add_cell(mesh, [mesh%dot(e)%first], vertex_cell, 0, 0.5_wp, cells)
    end do
    mesh%corners = mesh%corners(:mesh%offset(cells + 1))
    mesh%offset = mesh%offset(:cells + 1)
    mesh%kind = mesh%kind(:cells)
    mesh%owner = mesh%owner(:cells)
    mesh%middle = mesh%middle(:cells)
  end subroutine make_cells

  pure subroutine add_lines(mesh, e, cells)
    type(mesh_t), intent(inout) :: mesh
    integer, intent(in) :: e
    integer, intent(inout) :: cells
    integer :: i

    do i = 1, mesh%segments
      call add_cell(mesh, mesh%beam(e)%first + [i - 1, i], line_cell, e, &
                    (i - 0.5_wp)/mesh%segments, cells)
    end do
  end subroutine add_lines

  !> A quadrangle for each side of the polygons and each piece of the beam.
  pure subroutine add_surface(mesh, e, cells)
    type(mesh_t), intent(inout) :: mesh
    integer, intent(in) :: e
    integer, intent(inout) :: cells
    integer :: i, j, k, from, next, at, more

    associate (last => mesh%profile(mesh%beam(e)%profile)%last)
      more = last(size(last))
      do i = 1, mesh%segments
        at = mesh%beam(e)%first + (i - 1)*more - 1
        from = 1
        do j = 1, size(last)
          do k = from, last(j)
            next = merge(from, k + 1, k == last(j))
            call add_cell(mesh, at + [k, next, next + more, k + more], quad_cell, e, &
                          (i - 0.5_wp)/mesh%segments, cells)
          end do
          from = last(j) + 1
        end do
      end do
    end associate
  end subroutine add_surface

  !> The section itself at end p (1) or q (2); of two polygons with a hole, the ring between.
  pure subroutine add_cap(mesh, e, end, cells)
    type(mesh_t), intent(inout) :: mesh
    integer, intent(in) :: e, end
    integer, intent(inout) :: cells
    integer :: j, k, n, from, at
    real(wp) :: xi

    xi = end - 1
    associate (profile => mesh%profile(mesh%beam(e)%profile), &
               last => mesh%profile(mesh%beam(e)%profile)%last)
      at = mesh%beam(e)%first - 1
      if (end == 2) at = at + mesh%segments*last(size(last))
      if (profile%kind == section_closed) then
        n = last(1)
        do k = 1, n
          j = modulo(k, n) + 1
          call add_cell(mesh, at + [k, j, n + j, n + k], quad_cell, e, xi, cells)
        end do
        return
      end if
      from = 1
      do j = 1, size(last)
        call add_cell(mesh, at + [(k, k=from, last(j))], &
                      merge(quad_cell, polygon_cell, last(j) - from == 3), e, xi, cells)
        from = last(j) + 1
      end do
    end associate
  end subroutine add_cap

  pure subroutine add_cell(mesh, points, kind, beam, middle, cells)
    type(mesh_t), intent(inout) :: mesh
    integer, intent(in) :: points(:), kind, beam
    real(wp), intent(in) :: middle
    integer, intent(inout) :: cells
    integer :: n

    n = mesh%offset(cells + 1)
    mesh%corners(n + 1:n + size(points)) = points
    cells = cells + 1
    mesh%offset(cells + 1) = n + size(points)
    mesh%kind(cells) = kind
    mesh%owner(cells) = beam
    mesh%middle(cells) = middle
  end subroutine add_cell

end module beam_mesh
