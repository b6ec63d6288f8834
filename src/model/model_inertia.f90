!> The inertia of a body about a point.
module model_inertia
  use kinds, only: wp
  implicit none
  private

  public :: inertia_matrix, inertia_fault

  integer, parameter, public :: inertia_sound = 0, inertia_negative = 1, inertia_triangle = 2

  real(wp), parameter :: tolerance = 1.0e-12_wp  !< relative to the largest entry

contains

  !> The symmetric matrix of xx xy xz yy yz zz.
  pure function inertia_matrix(value) result(j)
    real(wp), intent(in) :: value(6)
    real(wp) :: j(3, 3)

    j = reshape([value(1), value(2), value(3), value(2), value(4), value(5), value(3), value(5), &
                 value(6)], [3, 3])
  end function inertia_matrix

  !> Whether an inertia can be that of a body: no principal moment negative (else
  !> `inertia_negative`), none larger than the sum of the others (else `inertia_triangle`), which
  !> is to say that J and the second moments of mass tr(J)/2 - J are positive semidefinite.
  pure integer function inertia_fault(j) result(fault)
    real(wp), intent(in) :: j(3, 3)
    real(wp) :: moments(3, 3)
    integer :: i

    fault = inertia_sound
    moments = -j
    do i = 1, 3
      moments(i, i) = moments(i, i) + 0.5_wp*(j(1, 1) + j(2, 2) + j(3, 3))
    end do
    if (.not. is_semidefinite(moments)) fault = inertia_triangle
    if (.not. is_semidefinite(j)) fault = inertia_negative
  end function inertia_fault

  !> All principal minors of a symmetric matrix are at least 0, but for rounding.
  pure logical function is_semidefinite(a)
    real(wp), intent(in) :: a(3, 3)
    real(wp) :: m(3, 3), determinant
    integer :: i, k

    is_semidefinite = .true.
    if (.not. any(abs(a) > 0)) return
    m = a/maxval(abs(a))
    do i = 1, 3
      k = modulo(i, 3) + 1
      if (m(i, i) < -tolerance) is_semidefinite = .false.
      if (m(i, i)*m(k, k) - m(i, k)**2 < -tolerance) is_semidefinite = .false.
    end do
    determinant = m(1, 1)*(m(2, 2)*m(3, 3) - m(2, 3)**2) &
                  - m(1, 2)*(m(1, 2)*m(3, 3) - m(2, 3)*m(1, 3)) &
                  + m(1, 3)*(m(1, 2)*m(2, 3) - m(2, 2)*m(1, 3))
    if (determinant < -tolerance) is_semidefinite = .false.
  end function is_semidefinite

end module model_inertia
