!> What closes the system when the load factor is an unknown too: a displacement or an arc length.
!>
!> The arc is cylindrical: the norm of the incremental displacements and rotations alone, theirs
!> squared, mean over the nodes, lengths in units of the model. The condition is linearized in
!> every iteration, which needs no choice between two roots and, since the increment is always
!> corrected towards the cylinder, passes limit points and snap-back alike.
module path_control
  use kinds, only: wp
  use model_data, only: control_load, control_displacement, control_arc
  use nodal_state, only: node_coordinates
  use system_data, only: system_t
  use system_assembly, only: iterate_t
  use system_measure, only: measure_t
  implicit none
  private

  public :: control_t, load_increment, arc_product

  !> The condition of one increment.
  type :: control_t
    integer :: kind = control_load         !< one of `control_*`
    integer :: pattern = 0                 !< whose load factor is the unknown
    type(measure_t) :: measure             !< of `control_displacement`
    real(wp) :: target = 0.0_wp            !< its value at the end of the increment
    real(wp) :: arc = 0.0_wp               !< length of the increment, relative to the model
    real(wp), allocatable :: heading(:)    !< by coordinate: where the path came to; sets the sign
    real(wp), allocatable :: total(:)      !< by coordinate: sum of this increment so far
  end type control_t

contains

  !> Increment of the load factor from the two solutions of an iteration, by coordinate: `residual`
  !> balances the forces, `direction` answers a unit of load.
  pure function load_increment(system, control, iterate, residual, direction) result(increment)
    type(system_t), intent(in) :: system
    type(control_t), intent(in) :: control
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: residual(:), direction(:)
    real(wp) :: increment

    select case (control%kind)
    case (control_displacement)
      increment = measure_increment(control, iterate, residual, direction)
    case (control_arc)
      if (.not. any(abs(control%total) > 0)) then
        increment = control%arc/sqrt(arc_product(system, direction, direction))
        if (arc_product(system, direction, control%heading) < 0) increment = -increment
      else
        increment = (0.5_wp*(control%arc**2 - arc_product(system, control%total, control%total)) &
                     - arc_product(system, control%total, residual)) &
                    /arc_product(system, control%total, direction)
      end if
    case default
      increment = 0
    end select
  end function load_increment

  pure function measure_increment(control, iterate, residual, direction) result(increment)
    type(control_t), intent(in) :: control
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(in) :: residual(:), direction(:)
    real(wp) :: increment, slope(7)
    integer :: at(7)

    call control%measure%gradient(iterate%state, at, slope)
    increment = (control%target - control%measure%value(iterate%state) &
                 - dot_product(slope, residual(at)))/dot_product(slope, direction(at))
  end function measure_increment

  !> Mean over the nodes of the products of displacements, in model lengths, and rotations.
  pure function arc_product(system, a, b) result(product)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: a(:), b(:)
    real(wp) :: product
    integer :: i, k

    product = 0
    do i = 1, system%nodes
      k = node_coordinates*(i - 1)
      product = product + dot_product(a(k + 1:k + 3), b(k + 1:k + 3))/system%length**2 &
                + dot_product(a(k + 4:k + 6), b(k + 4:k + 6))
    end do
    product = product/system%nodes
  end function arc_product

end module path_control
