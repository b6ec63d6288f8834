!> Between what is numbered by coordinate or by strain and the unknowns of the equations.
module system_unknowns
  use kinds, only: wp
  use system_data, only: system_t
  implicit none
  private

  public :: by_coordinate, by_unknown, held_entries, mixed_entries

contains

  !> The coordinates' part of a solution, zero where they are held.
  pure function by_coordinate(system, solution) result(x)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: solution(:)
    real(wp) :: x(system%coordinates)
    integer :: k

    do k = 1, size(x)
      x(k) = 0
      if (system%unknown(k) > 0) x(k) = solution(system%unknown(k))
    end do
  end function by_coordinate

  !> What belongs to coordinates, by unknown; zero for the multipliers.
  pure function by_unknown(system, x) result(b)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:)           !< by coordinate
    real(wp) :: b(system%equations())
    integer :: k

    b = 0
    do k = 1, size(x)
      if (system%unknown(k) > 0) b(system%unknown(k)) = x(k)
    end do
  end function by_unknown

  !> What belongs to held strains, by unknown; zero for the coordinates.
  pure function held_entries(system, y) result(b)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: y(:)           !< by strain
    real(wp) :: b(system%equations())
    integer :: k

    b = 0
    do k = 1, size(y)
      if (system%multiplier(k) > 0) b(system%multiplier(k)) = y(k)
    end do
  end function held_entries

  !> What belongs to coordinates and to held strains, by unknown.
  pure function mixed_entries(system, x, y) result(b)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: x(:), y(:)     !< by coordinate, by strain
    real(wp) :: b(system%equations())
    integer :: k

    b = by_unknown(system, x)
    do k = 1, size(y)
      if (system%multiplier(k) > 0) b(system%multiplier(k)) = y(k)
    end do
  end function mixed_entries

end module system_unknowns
