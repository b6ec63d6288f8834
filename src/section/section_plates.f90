!> Constants of a thin-walled open section from its midline of straight plates.
!>
!> Everything is integrated along the midline, without terms in t**3 except in the torsion
!> constant. The sections whose midline leaves a constant at zero are settled like this:
!>
!> * All plates meet in one point (angle, tee, cross, strip): the sectorial coordinate about that
!>   point is zero, Iw = 0 (below 1e-12 of Ip**2/A). No bimoment, hence no warping shear force
!>   and no strain gamma_w: the row of `d` decouples and only y, z are taken from the 2x2
!>   compliance. The wall's own warping across its thickness, of order t**3 b**3, is left out.
!> * All plates lie on a line (strip): the smaller second moment is zero (below 1e-12 of the
!>   other) and would make the beam a mechanism, so the leading term, sum of b t**3/12, is kept.
!>   Shear across the strip has no flow along the midline; its flexibility changes the beam by
!>   (t/l)**2 only, which thin-wall theory neglects.
!>
!> In both cases `shear_rigid` is set. What `d` then has on the diagonal is the walls' transverse
!> shear, 5/6 of the area (Reissner) or of its polar moment about the shear centre, so that `d` is
!> positive definite always and whoever inverts all of it still gets a sound result.
module section_plates
  use kinds, only: wp
  use errors, only: error_t
  use section_data, only: section_constants_t, section_geometry_t, section_open, to_principal
  use section_topology, only: plate_fault_t, tree_t, check_drawing, walk_tree
  implicit none
  private

  public :: plates_section, principal_turn

  !> What is smaller than this part of its natural size is zero: round-off leaves 1e-15, and no
  !> wall is so thin that its thickness would not count for more.
  real(wp), parameter :: negligible = 1.0e-12_wp

  !> Gauss rule on 0..1, exact up to degree 5.
  real(wp), parameter :: gauss_x(3) = [0.5_wp - 0.5_wp*sqrt(0.6_wp), 0.5_wp, &
                                       0.5_wp + 0.5_wp*sqrt(0.6_wp)]
  real(wp), parameter :: gauss_w(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

contains

  !> Constants and geometry of any tree of plates, in its principal axes.
  !> Errors: whatever `section_topology` refuses; `fault` says which point or plate it is about.
  subroutine plates_section(points, plates, thickness, constants, geometry, fault, error)
    real(wp), intent(in) :: points(:, :)  !< (2, points) y, z as drawn [L]
    integer, intent(in) :: plates(:, :)   !< (2, plates) indices of points
    real(wp), intent(in) :: thickness(:)  !< (plates) [L]
    type(section_constants_t), intent(out) :: constants
    type(section_geometry_t), intent(out) :: geometry
    type(plate_fault_t), intent(out) :: fault
    type(error_t), allocatable, intent(out) :: error
    type(tree_t) :: tree
    integer :: i

    call check_drawing(points, plates, thickness, fault, error)
    if (allocated(error)) return
    call walk_tree(size(points, 2), plates, tree, fault, error)
    if (allocated(error)) return

    geometry%kind = section_open
    geometry%origin_at_centroid = .false.
    geometry%points = points
    geometry%number = [(i, i=1, size(points, 2))]
    geometry%plates = plates
    geometry%thickness = thickness
    call turn_to_principal(geometry)
    call midline_constants(geometry, tree, constants)
    call draw_outline(geometry)
  end subroutine plates_section

  !> Centroid, turn and principal coordinates of the points.
  pure subroutine turn_to_principal(geometry)
    type(section_geometry_t), intent(inout) :: geometry
    real(wp) :: w(3*size(geometry%thickness)), y(size(w)), z(size(w))
    integer :: i

    w = weights(geometry)
    y = samples(geometry, geometry%points(1, :))
    z = samples(geometry, geometry%points(2, :))
    geometry%centroid = [sum(w*y), sum(w*z)]/sum(w)
    y = y - geometry%centroid(1)
    z = z - geometry%centroid(2)
    geometry%theta = principal_turn(sum(w*z**2), sum(w*y**2), sum(w*y*z))
    geometry%principal = geometry%points
    do i = 1, size(geometry%points, 2)
      geometry%principal(:, i) = to_principal(geometry, geometry%points(:, i))
    end do
  end subroutine turn_to_principal

  !> Angle from the given to the principal axes, in (-45, 45] degrees: tan(2 theta) =
  !> 2 Iyz/(Iz - Iy), zero without Iyz. Within 1e-6 of -45 it is the same axes' +45 (exchanged
  !> y and z), so that round-off does not choose between them.
  pure function principal_turn(iy, iz, iyz) result(theta)
    real(wp), intent(in) :: iy, iz, iyz  !< integrals of z**2, y**2, y z [L^4]
    real(wp) :: theta
    real(wp), parameter :: quarter = atan(1.0_wp), tie = 1.0e-6_wp

    theta = 0.0_wp
    if (abs(iyz) <= negligible*(iy + iz)) return
    theta = 0.5_wp*atan2(sign(2.0_wp, iz - iy)*iyz, abs(iz - iy))
    if (theta < tie - quarter) theta = theta + 2.0_wp*quarter
  end function principal_turn

  !> All constants, and the warping coordinate at the points, theory section 3.
  pure subroutine midline_constants(geometry, tree, self)
    type(section_geometry_t), intent(inout) :: geometry
    type(tree_t), intent(in) :: tree
    type(section_constants_t), intent(out) :: self
    real(wp) :: w(3*size(geometry%thickness)), y(size(w)), z(size(w)), o(size(w))
    real(wp) :: fields(3, size(geometry%principal, 2)), inertia(3)

    w = weights(geometry)
    y = samples(geometry, geometry%principal(1, :))
    z = samples(geometry, geometry%principal(2, :))
    self%a = sum(w)
    self%iy = sum(w*z**2)
    self%iz = sum(w*y**2)
    self%it = sum(lengths(geometry)*geometry%thickness**3)/3.0_wp
    self%shear_rigid(1) = self%iz <= negligible*self%iy
    self%shear_rigid(2) = self%iy <= negligible*self%iz

    geometry%omega = sectorial(geometry, tree)
    o = samples(geometry, geometry%omega)
    if (.not. self%shear_rigid(2)) self%ys = sum(w*o*z)/self%iy
    if (.not. self%shear_rigid(1)) self%zs = -sum(w*o*y)/self%iz
    geometry%omega = geometry%omega - self%ys*geometry%principal(2, :) &
                     + self%zs*geometry%principal(1, :) &
                     - sum(w*(o - self%ys*z + self%zs*y))/self%a
    o = samples(geometry, geometry%omega)
    self%iw = sum(w*o**2)
    self%shear_rigid(3) = self%iw <= negligible*self%ip()**2/self%a
    if (self%shear_rigid(3)) then
      self%iw = 0.0_wp
      geometry%omega = 0.0_wp
      o = 0.0_wp
    end if
    geometry%warping_known = .true.

    call wagner_constants(self, w, y, z, o)
    fields(1:2, :) = geometry%principal
    fields(3, :) = geometry%omega
    inertia = [self%iz, self%iy, self%iw]
    if (self%shear_rigid(1)) self%iz = sum(lengths(geometry)*geometry%thickness**3)/12.0_wp
    if (self%shear_rigid(2)) self%iy = sum(lengths(geometry)*geometry%thickness**3)/12.0_wp
    self%d = inverse(flow_compliance(geometry, tree, fields, inertia, self%shear_rigid) &
                     + wall_compliance(self))
    self%shear_given = .true.
  end subroutine midline_constants

  !> Sectorial coordinate about the centroid, d omega = y dz - z dy, zero at the root.
  pure function sectorial(geometry, tree) result(omega)
    type(section_geometry_t), intent(in) :: geometry
    type(tree_t), intent(in) :: tree
    real(wp) :: omega(size(geometry%principal, 2))
    integer :: i

    omega = 0.0_wp
    do i = 1, size(tree%plate)
      associate (p => geometry%principal(:, tree%near(i)), q => geometry%principal(:, tree%far(i)))
        omega(tree%far(i)) = omega(tree%near(i)) + p(1)*q(2) - p(2)*q(1)
      end associate
    end do
  end function sectorial

  !> Wagner's constants of asymmetry and the residual, with r from the centroid, rs from the shear
  !> centre; zero for a constant that divides by nothing.
  pure subroutine wagner_constants(self, w, y, z, o)
    type(section_constants_t), intent(inout) :: self
    real(wp), intent(in) :: w(:)              !< weights of the samples [L^2]
    real(wp), intent(in) :: y(:), z(:), o(:)  !< samples [L], [L], [L^2]
    real(wp) :: r2(size(w)), rs2(size(w))

    r2 = y**2 + z**2
    rs2 = (y - self%ys)**2 + (z - self%zs)**2
    if (.not. self%shear_rigid(2)) self%by = sum(w*z*r2)/self%iy - 2.0_wp*self%zs
    if (.not. self%shear_rigid(1)) self%bz = sum(w*y*r2)/self%iz - 2.0_wp*self%ys
    if (.not. self%shear_rigid(3)) self%bw = sum(w*o*rs2)/self%iw
    self%ir = sum(w*rs2**2) - self%a*(self%ip()/self%a + self%ys**2 + self%zs**2)**2 &
              - self%iy*self%by**2 - self%iz*self%bz**2 - self%iw*self%bw**2
    self%ir = max(0.0_wp, self%ir)
  end subroutine wagner_constants

  !> Compliance of the shear flows, s_ij = int q_i q_j/t ds, with q the first moment beyond a place
  !> over the moment of inertia; zero rows where there is no flow. [L^-2], [L^-3], [L^-4]
  pure function flow_compliance(geometry, tree, fields, inertia, without) result(s)
    type(section_geometry_t), intent(in) :: geometry
    type(tree_t), intent(in) :: tree
    real(wp), intent(in) :: fields(:, :)  !< (3, points) y, z, omega
    real(wp), intent(in) :: inertia(3)    !< Iz, Iy, Iw of the midline
    logical, intent(in) :: without(3)
    real(wp) :: s(3, 3), beyond(3, size(fields, 2)), length(size(geometry%thickness)), t
    real(wp) :: far(3), near(3), flow(3)
    integer :: i, g, j

    length = lengths(geometry)
    beyond = 0.0_wp
    s = 0.0_wp
    do i = size(tree%plate), 1, -1
      t = geometry%thickness(tree%plate(i))
      far = scaled(fields(:, tree%far(i)))
      near = scaled(fields(:, tree%near(i)))
      associate (l => length(tree%plate(i)), x => gauss_x)
        do g = 1, 3
          flow = beyond(:, tree%far(i)) + t*l*(far*x(g) + 0.5_wp*(near - far)*x(g)**2)
          do j = 1, 3
            s(:, j) = s(:, j) + gauss_w(g)*l/t*flow*flow(j)
          end do
        end do
        beyond(:, tree%near(i)) = beyond(:, tree%near(i)) + beyond(:, tree%far(i)) &
                                  + 0.5_wp*t*l*(far + near)
      end associate
    end do

  contains

    pure function scaled(field)
      real(wp), intent(in) :: field(3)
      real(wp) :: scaled(3)

      scaled = 0.0_wp
      where (.not. without) scaled = field/inertia
    end function scaled

  end function flow_compliance

  !> Compliance of the walls' transverse shear, where the midline has none.
  pure function wall_compliance(self) result(s)
    type(section_constants_t), intent(in) :: self
    real(wp) :: s(3, 3)

    s = 0.0_wp
    if (self%shear_rigid(1)) s(1, 1) = 1.2_wp/self%a
    if (self%shear_rigid(2)) s(2, 2) = 1.2_wp/self%a
    if (self%shear_rigid(3)) s(3, 3) = 1.2_wp/(self%ip() + self%a*(self%ys**2 + self%zs**2))
  end function wall_compliance

  !> Inverse of a symmetric positive definite matrix, scaled to a unit diagonal first.
  pure function inverse(s)
    real(wp), intent(in) :: s(3, 3)
    real(wp) :: inverse(3, 3), c(3, 3), root(3)
    integer :: i, j, k, l, m

    root = [(sqrt(s(i, i)), i=1, 3)]
    do j = 1, 3
      c(:, j) = s(:, j)/(root*root(j))
    end do
    do j = 1, 3
      k = mod(j, 3) + 1
      l = mod(k, 3) + 1
      do i = 1, 3
        m = mod(i, 3) + 1
        inverse(i, j) = c(m, k)*c(mod(m, 3) + 1, l) - c(m, l)*c(mod(m, 3) + 1, k)
      end do
    end do
    inverse = inverse/dot_product(c(:, 1), inverse(:, 1))
    do j = 1, 3
      inverse(:, j) = inverse(:, j)/(root*root(j))
    end do
  end function inverse

  !> Length of each plate [L].
  pure function lengths(geometry)
    type(section_geometry_t), intent(in) :: geometry
    real(wp) :: lengths(size(geometry%thickness))
    integer :: i

    do i = 1, size(lengths)
      lengths(i) = norm2(geometry%points(:, geometry%plates(2, i)) &
                         - geometry%points(:, geometry%plates(1, i)))
    end do
  end function lengths

  !> Areas that go with the Gauss points of all plates, three after three [L^2].
  pure function weights(geometry)
    type(section_geometry_t), intent(in) :: geometry
    real(wp) :: weights(3*size(geometry%thickness)), length(size(geometry%thickness))
    integer :: i

    length = lengths(geometry)
    do i = 1, size(length)
      weights(3*i - 2:3*i) = gauss_w*length(i)*geometry%thickness(i)
    end do
  end function weights

  !> A field given at the points and linear between, at the Gauss points of all plates.
  pure function samples(geometry, field)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: field(:)  !< (points)
    real(wp) :: samples(3*size(geometry%thickness))
    integer :: i

    do i = 1, size(geometry%thickness)
      associate (p => field(geometry%plates(1, i)), q => field(geometry%plates(2, i)))
        samples(3*i - 2:3*i) = p + (q - p)*gauss_x
      end associate
    end do
  end function samples

  !> One rectangle for each plate.
  pure subroutine draw_outline(geometry)
    type(section_geometry_t), intent(inout) :: geometry
    real(wp) :: ends(2, 2), aside(2)
    integer :: i

    allocate (geometry%outline(2, 4*size(geometry%thickness)))
    allocate (geometry%outline_last(size(geometry%thickness)))
    do i = 1, size(geometry%thickness)
      ends = geometry%principal(:, geometry%plates(:, i))
      aside = ends(:, 2) - ends(:, 1)
      aside = 0.5_wp*geometry%thickness(i)/norm2(aside)*[-aside(2), aside(1)]
      geometry%outline(:, 4*i - 3:4*i) = reshape([ends(:, 1) - aside, ends(:, 2) - aside, &
                                                  ends(:, 2) + aside, ends(:, 1) + aside], [2, 4])
      geometry%outline_last(i) = 4*i
    end do
  end subroutine draw_outline

end module section_plates
