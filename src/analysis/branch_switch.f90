!> From a bifurcation point onto the secondary branch, along the critical mode.
module branch_switch
  use kinds, only: wp
  use nodal_state, only: node_coordinates
  use system_data, only: system_t
  use system_assembly, only: iterate_t, assemble
  use system_newton, only: advance
  use system_unknowns, only: mixed_entries
  use path_control, only: control_t, arc_product
  use recorder, only: critical_t
  implicit none
  private

  public :: lean_into_mode

contains

  !> Displace the critical state, which `iterate` holds, by an arc along the mode, and make that the
  !> start of the increment: the corrections keep its length, so they end on the branch that the
  !> mode belongs to. The sign is that of the mode as reported, its largest entry positive.
  subroutine lean_into_mode(system, point, arc, level, iterate, control)
    type(system_t), intent(in) :: system
    type(critical_t), intent(in) :: point
    real(wp), intent(in) :: arc, level(:)
    type(iterate_t), intent(inout) :: iterate
    type(control_t), intent(inout) :: control
    real(wp) :: solution(system%equations()), motion(system%coordinates)

    motion = 0
    motion(:node_coordinates*system%nodes) = reshape(point%mode, [node_coordinates*system%nodes])
    motion = arc/sqrt(arc_product(system, motion, motion))*motion
    solution = mixed_entries(system, motion, iterate%stress)
    call assemble(system, level, iterate)
    call advance(system, solution, 1.0_wp, iterate, control%total)
    control%arc = arc
    control%heading = control%total
  end subroutine lean_into_mode

end module branch_switch
