!> What the program knows of a beam's section: its constants and its drawing.
!>
!> Principal axes y, z through the centroid, y' = R(theta) (y - centroid), theta from y to z.
module section_data
  use kinds, only: wp
  implicit none
  private

  public :: section_constants_t, section_geometry_t
  public :: to_principal, to_drawn, principal_point, warping_at, axial_stress

  !> Kind of a drawing: none (constants only), open walls, solid, closed cell.
  integer, parameter, public :: section_unknown = 0, section_open = 1, section_solid = 2, &
                                section_closed = 3

  !> Constants of a section about its principal axes; rows of `d`: 1 = y, 2 = z, 3 = omega.
  type :: section_constants_t
    real(wp) :: a = 0.0_wp         !< area [L^2]
    real(wp) :: iy = 0.0_wp        !< integral of z**2 [L^4]
    real(wp) :: iz = 0.0_wp        !< integral of y**2 [L^4]
    real(wp) :: it = 0.0_wp        !< torsion constant [L^4]
    real(wp) :: iw = 0.0_wp        !< integral of omega**2 [L^6]
    real(wp) :: ys = 0.0_wp        !< shear centre [L]
    real(wp) :: zs = 0.0_wp        !< shear centre [L]
    real(wp) :: d(3, 3) = 0.0_wp   !< shear rigidities / G [L^2, L^3 with omega, L^4]
    real(wp) :: by = 0.0_wp        !< Wagner constant of Iy [L]
    real(wp) :: bz = 0.0_wp        !< Wagner constant of Iz [L]
    real(wp) :: bw = 0.0_wp        !< Wagner constant of Iw, dimensionless
    real(wp) :: ir = 0.0_wp        !< residual Wagner constant [L^6]
    logical :: shear_given = .false.     !< false: no shear rigidities, rigid in shear
    !> The midline carries no such shear: `d` is uncoupled there and holds the walls'
    !> transverse shear, or any positive number where the constant (iw) is zero.
    logical :: shear_rigid(3) = .false.
  contains
    procedure :: ip
  end type section_constants_t

  !> The drawing of a section.
  type :: section_geometry_t
    integer :: kind = section_unknown       !< one of `section_*`
    logical :: origin_at_centroid = .true.  !< where `AT oy oz` counts from; false: the drawing's
    logical :: warping_known = .false.      !< whether `omega` holds anything
    real(wp) :: theta = 0.0_wp              !< turn of the principal axes against the user's
    real(wp) :: centroid(2) = 0.0_wp        !< in the drawing's axes [L]
    integer, allocatable :: number(:)       !< the user's number of each point; 1, 2, ... at first
    real(wp), allocatable :: points(:, :)   !< (2, points) as drawn [L]
    real(wp), allocatable :: principal(:, :)  !< (2, points) in principal axes [L]
    real(wp), allocatable :: omega(:)       !< warping coordinate at the points [L^2]
    integer, allocatable :: plates(:, :)    !< (2, plates) indices of the end points
    real(wp), allocatable :: thickness(:)   !< of the plates [L]
    real(wp), allocatable :: outline(:, :)  !< (2, corners) closed polygons, principal axes [L]
    integer, allocatable :: outline_last(:) !< index of the last corner of each polygon
  end type section_geometry_t

contains

  !> Polar moment about the centroid, Iy + Iz [L^4].
  pure function ip(self)
    class(section_constants_t), intent(in) :: self
    real(wp) :: ip

    ip = self%iy + self%iz
  end function ip

  !> A point of the drawing in principal axes.
  pure function to_principal(geometry, drawn) result(point)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: drawn(2)  !< in the drawing's axes and from its origin [L]
    real(wp) :: point(2)

    point = turned(drawn - geometry%centroid, geometry%theta)
  end function to_principal

  !> A point in principal axes in those of the drawing, from its origin.
  pure function to_drawn(geometry, principal) result(point)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: principal(2)  !< [L]
    real(wp) :: point(2)

    point = geometry%centroid + turned(principal, -geometry%theta)
  end function to_drawn

  !> The place `AT oy oz` in principal axes through the centroid.
  pure function principal_point(geometry, at) result(point)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: at(2)  !< in the user's axes, from the centroid or the drawing's origin
    real(wp) :: point(2)

    if (geometry%origin_at_centroid) then
      point = turned(at, geometry%theta)
    else
      point = to_principal(geometry, at)
    end if
  end function principal_point

  !> Coordinates in axes turned by `theta`.
  pure function turned(point, theta)
    real(wp), intent(in) :: point(2), theta
    real(wp) :: turned(2)

    turned = [point(1)*cos(theta) + point(2)*sin(theta), &
              point(2)*cos(theta) - point(1)*sin(theta)]
  end function turned

  !> Warping coordinate at a point (principal axes), linear along the midline of the plate
  !> within half whose thickness the point lies, nearest first; unknown elsewhere.
  pure subroutine warping_at(geometry, point, omega, known)
    type(section_geometry_t), intent(in) :: geometry
    real(wp), intent(in) :: point(2)  !< [L]
    real(wp), intent(out) :: omega    !< [L^2], zero if unknown
    logical, intent(out) :: known
    real(wp) :: ends(2, 2), along(2), xi, distance, nearest
    integer :: i

    omega = 0.0_wp
    known = geometry%warping_known .and. .not. allocated(geometry%plates)
    if (.not. (geometry%warping_known .and. allocated(geometry%plates))) return
    nearest = huge(1.0_wp)
    do i = 1, size(geometry%thickness)
      ends = geometry%principal(:, geometry%plates(:, i))
      along = ends(:, 2) - ends(:, 1)
      xi = dot_product(point - ends(:, 1), along)/dot_product(along, along)
      xi = min(max(xi, 0.0_wp), 1.0_wp)
      distance = norm2(point - ends(:, 1) - xi*along)
      if (distance > 0.5_wp*geometry%thickness(i)*(1.0_wp + 1.0e-6_wp)) cycle
      if (distance >= nearest) cycle
      nearest = distance
      known = .true.
      associate (at_ends => geometry%omega(geometry%plates(:, i)))
        omega = at_ends(1) + xi*(at_ends(2) - at_ends(1))
      end associate
    end do
  end subroutine warping_at

  !> Axial stress at a point: N/A + My z/Iy - Mz y/Iz - B omega/Iw, with
  !> My = int sigma z, Mz = -int sigma y, B = -int sigma omega [F L^-2].
  pure function axial_stress(constants, point, omega, forces) result(stress)
    type(section_constants_t), intent(in) :: constants
    real(wp), intent(in) :: point(2)   !< principal axes [L]
    real(wp), intent(in) :: omega      !< [L^2], zero where unknown
    real(wp), intent(in) :: forces(4)  !< N [F], My, Mz [F L], B [F L^2]
    real(wp) :: stress

    stress = forces(1)/constants%a + forces(2)*point(2)/constants%iy &
             - forces(3)*point(1)/constants%iz
    if (constants%iw > 0.0_wp) stress = stress - forces(4)*omega/constants%iw
  end function axial_stress

end module section_data
