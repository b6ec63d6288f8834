!> Whether constants of a section, however they came about, can be those of a body.
module section_check
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use section_data, only: section_constants_t
  implicit none
  private

  public :: check_constants, check_product, settle_shear

contains

  !> Flags that follow from the numbers of `d` where a user gave them one by one: shear is given if
  !> any is; a strain with a zero on the diagonal, or warping shear without Iw, is rigid.
  pure subroutine settle_shear(self)
    type(section_constants_t), intent(inout) :: self
    integer :: i

    self%shear_given = any(abs(self%d) > 0.0_wp)
    self%shear_rigid = [(.not. abs(self%d(i, i)) > 0.0_wp, i=1, 3)]
    if (.not. self%iw > 0.0_wp) self%shear_rigid(3) = .true.
  end subroutine settle_shear

  !> Errors: A, Iy, Iz, It not positive; Iw, IR negative; shear rigidities, where given and not
  !> rigid, not a symmetric positive definite matrix, or a rigid one coupled with others.
  subroutine check_constants(self, error)
    type(section_constants_t), intent(in) :: self
    type(error_t), allocatable, intent(out) :: error
    character(len=2), parameter :: names(6) = ["A ", "IY", "IZ", "IT", "IW", "IR"]
    real(wp) :: values(6)
    integer :: i

    values = [self%a, self%iy, self%iz, self%it, self%iw, self%ir]
    do i = 1, size(values)
      if (values(i) > 0.0_wp .and. values(i) <= huge(1.0_wp)) cycle
      if (i > 4 .and. abs(values(i)) <= 0.0_wp) cycle
      call fail(error, exit_deck, trim(names(i))//" has to be "//trim(merge("positive    ", &
                                                            "not negative", i <= 4)))
      return
    end do
    if (self%shear_given) call check_shear(self, error)
  end subroutine check_constants

  !> Moments about axes that need not be principal: Iy Iz has to be at least Iyz**2.
  subroutine check_product(iy, iz, iyz, error)
    real(wp), intent(in) :: iy, iz, iyz  !< [L^4], or times a density
    type(error_t), allocatable, intent(out) :: error

    if (iyz**2 <= iy*iz) return
    call fail(error, exit_deck, "IYZ is too large: IY IZ has to be at least IYZ squared")
  end subroutine check_product

  !> Symmetric positive definite rows that are not rigid, uncoupled rows that are.
  subroutine check_shear(self, error)
    type(section_constants_t), intent(in) :: self
    type(error_t), allocatable, intent(out) :: error
    character(len=1), parameter :: names(3) = ["Y", "Z", "W"]
    real(wp) :: c(3, 3), root(3), minor, determinant
    integer :: i, j

    do i = 1, 3
      root(i) = 1.0_wp
      if (self%shear_rigid(i)) cycle
      if (.not. (self%d(i, i) > 0.0_wp .and. self%d(i, i) <= huge(1.0_wp))) then
        call fail(error, exit_deck, "D"//names(i)//" has to be positive")
        return
      end if
      root(i) = sqrt(self%d(i, i))
    end do
    do j = 1, 3
      c(:, j) = self%d(:, j)/(root*root(j))
      c(j, j) = 1.0_wp
    end do
    do i = 1, 3
      if (.not. self%shear_rigid(i)) cycle
      if (all(abs(c(:, i)) + abs(c(i, :)) <= merge(2.0_wp, 0.0_wp, [1, 2, 3] == i))) cycle
      call fail(error, exit_deck, "the beam is rigid in shear "//names(i)//", which nothing can be &
                                  &coupled with")
      return
    end do
    if (.not. all(abs(c - transpose(c)) <= 1.0e-9_wp)) then
      call fail(error, exit_deck, "the shear rigidities are not symmetric")
      return
    end if
    minor = minval([1.0_wp - c(1, 2)**2, 1.0_wp - c(1, 3)**2, 1.0_wp - c(2, 3)**2])
    determinant = 1.0_wp + 2.0_wp*c(1, 2)*c(2, 3)*c(1, 3) - c(1, 2)**2 - c(1, 3)**2 - c(2, 3)**2
    if (minor > 0.0_wp .and. determinant > 1.0e-12_wp) return
    call fail(error, exit_deck, "the shear rigidities are not positive definite")
  end subroutine check_shear

end module section_check
