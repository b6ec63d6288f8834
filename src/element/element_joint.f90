!> What all joints, springs and gears share: each strain has its own stiffness and damping.
module element_joint
  use kinds, only: wp
  use element_base, only: element_t
  implicit none
  private

  type, abstract, extends(element_t), public :: element_joint_t
    real(wp), allocatable :: stiffness(:)  !< by strain, [F L^-1] of a length, [F L] of an angle
    real(wp), allocatable :: viscosity(:)  !< by strain, that times T
  contains
    procedure :: set_law
    procedure :: law
    procedure :: damping
  end type element_joint_t

contains

  !> The three arrays are by strain. What is not fixed and has no stiffness is free.
  pure subroutine set_law(self, fixed, stiffness, viscosity)
    class(element_joint_t), intent(inout) :: self
    logical, intent(in) :: fixed(:)
    real(wp), intent(in) :: stiffness(:), viscosity(:)

    self%strains = size(fixed)
    allocate (self%fixed, source=fixed)
    allocate (self%stiffness, source=merge(0.0_wp, stiffness, fixed))
    allocate (self%viscosity, source=merge(0.0_wp, viscosity, fixed))
    self%damped = any(abs(self%viscosity) > 0)
  end subroutine set_law

  pure subroutine law(self, stiffness)
    class(element_joint_t), intent(in) :: self
    real(wp), intent(out) :: stiffness(self%strains, self%strains)
    integer :: i

    stiffness = 0
    do i = 1, self%strains
      stiffness(i, i) = self%stiffness(i)
    end do
  end subroutine law

  pure subroutine damping(self, viscosity)
    class(element_joint_t), intent(in) :: self
    real(wp), intent(out) :: viscosity(self%strains, self%strains)
    integer :: i

    viscosity = 0
    do i = 1, self%strains
      viscosity(i, i) = self%viscosity(i)
    end do
  end subroutine damping

end module element_joint
