!> What the BEAMW element needs to know of its section and material: rigidities, not moduli.
module beamw_rigidity
  use kinds, only: wp
  use section_data, only: section_constants_t
  implicit none
  private

  public :: rigidity_t, section_rigidity, spacar_rigidity, shear_compliance

  !> Rigidities of a section about its principal axes. Indices of shear: 1 = y, 2 = z, 3 = omega.
  type :: rigidity_t
    real(wp) :: ea = 0.0_wp             !< [F]
    real(wp) :: eiy = 0.0_wp            !< bending in the xz plane [F L^2]
    real(wp) :: eiz = 0.0_wp            !< bending in the xy plane [F L^2]
    real(wp) :: git = 0.0_wp            !< St. Venant torsion [F L^2]
    real(wp) :: eiw = 0.0_wp            !< warping [F L^4]; zero: no bimoment, uniform twist
    real(wp) :: gd(3, 3) = 0.0_wp       !< shear [F, F L, F L^2]
    logical :: shear_rigid(3) = .true.  !< no shear strain of this kind
    real(wp) :: ys = 0.0_wp, zs = 0.0_wp             !< shear centre [L]
    real(wp) :: by = 0.0_wp, bz = 0.0_wp, bw = 0.0_wp  !< Wagner constants [L, L, 1]
    real(wp) :: eir = 0.0_wp            !< residual Wagner stiffness [F L^4]
    real(wp) :: polar = 0.0_wp          !< Ip/A [L^2]
  end type rigidity_t

contains

  !> From a section and a material; `shear` is the option SHEAR ON.
  pure function section_rigidity(section, e, g, shear) result(self)
    type(section_constants_t), intent(in) :: section
    real(wp), intent(in) :: e, g  !< moduli [F L^-2]
    logical, intent(in) :: shear
    type(rigidity_t) :: self

    self%ea = e*section%a
    self%eiy = e*section%iy
    self%eiz = e*section%iz
    self%git = g*section%it
    self%eiw = e*section%iw
    self%gd = g*section%d
    self%shear_rigid = section%shear_rigid .or. .not. (section%shear_given .and. shear)
    self%ys = section%ys
    self%zs = section%zs
    self%by = section%by
    self%bz = section%bz
    self%bw = section%bw
    self%eir = e*section%ir
    self%polar = section%ip()/section%a
  end function section_rigidity

  !> From SPACAR's ESTIFF: EA, GIt, EIy, EIz, cy, cz, EIw with cy = EIy/(G A k) of the xz plane,
  !> cz = EIz/(G A k) of the xy plane; zero lengths mean rigid in shear. Ip/A is taken as for
  !> a homogeneous section.
  pure function spacar_rigidity(stiffness, shear) result(self)
    real(wp), intent(in) :: stiffness(7)
    logical, intent(in) :: shear
    type(rigidity_t) :: self

    self%ea = stiffness(1)
    self%git = stiffness(2)
    self%eiy = stiffness(3)
    self%eiz = stiffness(4)
    self%eiw = stiffness(7)
    if (self%ea > 0) self%polar = (self%eiy + self%eiz)/self%ea
    if (shear .and. stiffness(5) > 0) then
      self%gd(2, 2) = self%eiy/stiffness(5)
      self%shear_rigid(2) = .false.
    end if
    if (shear .and. stiffness(6) > 0) then
      self%gd(1, 1) = self%eiz/stiffness(6)
      self%shear_rigid(1) = .false.
    end if
  end function spacar_rigidity

  !> Inverse of the shear rigidities with zero rows and columns where the beam is rigid in shear
  !> [F^-1, ...]: Gauss-Jordan elimination of the symmetric positive definite rest.
  pure function shear_compliance(self) result(f)
    type(rigidity_t), intent(in) :: self
    real(wp) :: f(3, 3), a(3, 6)
    integer :: i, j

    a = 0
    do i = 1, 3
      a(i, 3 + i) = 1
      if (.not. self%shear_rigid(i)) a(i, 1:3) = merge(0.0_wp, self%gd(i, :), self%shear_rigid)
    end do
    do i = 1, 3
      if (self%shear_rigid(i)) cycle
      a(i, :) = a(i, :)/a(i, i)
      do j = 1, 3
        if (j /= i .and. .not. self%shear_rigid(j)) a(j, :) = a(j, :) - a(j, i)*a(i, :)
      end do
    end do
    do i = 1, 3
      f(:, i) = merge(0.0_wp, a(:, 3 + i), self%shear_rigid .or. self%shear_rigid(i))
    end do
  end function shear_compliance

end module beamw_rigidity
