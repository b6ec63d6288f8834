!> Axial stresses at the points of the sections, at both ends of every element.
module system_stress
  use kinds, only: wp
  use section_data, only: axial_stress
  use model_data, only: model_t, section_t
  implicit none
  private

  public :: stress_place_t, stress_places, point_stress

  integer, parameter, public :: stress_parts = 4  !< total, axial, bending, warping

  !> Where a stress is given.
  type :: stress_place_t
    integer :: member = 0
    integer :: end = 1    !< 1 = p, 2 = q
    integer :: point = 0  !< index in the section's geometry
  end type stress_place_t

contains

  !> The places in their order: by element, end and point.
  pure function stress_places(model) result(places)
    type(model_t), intent(in) :: model
    type(stress_place_t), allocatable :: places(:)
    integer :: m, e, i, n

    n = 0
    do m = 1, size(model%member)
      n = n + 2*points_of(model, m)
    end do
    allocate (places(n))
    n = 0
    do m = 1, size(model%member)
      do e = 1, 2
        do i = 1, points_of(model, m)
          n = n + 1
          places(n) = stress_place_t(m, e, i)
        end do
      end do
    end do
  end function stress_places

  !> Number of points of a member's section.
  pure integer function points_of(model, m)
    type(model_t), intent(in) :: model
    integer, intent(in) :: m

    points_of = 0
    associate (section => model%member(m)%section)
      if (section == 0) return
      if (.not. allocated(model%section(section)%geometry%number)) return
      points_of = size(model%section(section)%geometry%number)
    end associate
  end function points_of

  !> Stresses at all places [F L^-2]: total and its axial, bending and warping parts.
  pure function point_stress(model, force_p, force_q) result(stress)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: force_p(:, :), force_q(:, :)  !< (7, members) N Vy Vz T My Mz B
    real(wp), allocatable :: stress(:, :)                 !< (4, places)
    integer :: m, i, n, points

    n = 0
    do m = 1, size(model%member)
      n = n + 2*points_of(model, m)
    end do
    allocate (stress(stress_parts, n))
    n = 0
    do m = 1, size(model%member)
      points = points_of(model, m)
      if (points == 0) cycle
      associate (section => model%section(model%member(m)%section))
        do i = 1, points
          stress(:, n + i) = stress_at(section, i, force_p(:, m))
          stress(:, n + points + i) = stress_at(section, i, force_q(:, m))
        end do
      end associate
      n = n + 2*points
    end do
  end function point_stress

  pure function stress_at(section, i, force) result(stress)
    type(section_t), intent(in) :: section
    integer, intent(in) :: i         !< index of the point
    real(wp), intent(in) :: force(7)
    real(wp) :: stress(stress_parts), omega, place(2)

    place = section%geometry%principal(:, i)
    omega = 0.0_wp
    if (section%geometry%warping_known) omega = section%geometry%omega(i)
    associate (c => section%constants)
      stress(2) = axial_stress(c, place, omega, [force(1), 0.0_wp, 0.0_wp, 0.0_wp])
      stress(3) = axial_stress(c, place, omega, [0.0_wp, force(5), force(6), 0.0_wp])
      stress(4) = axial_stress(c, place, omega, [0.0_wp, 0.0_wp, 0.0_wp, force(7)])
    end associate
    stress(1) = sum(stress(2:4))
  end function stress_at

end module system_stress
