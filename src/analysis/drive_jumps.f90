!> Prescribed motions that jump in time, which no mass can follow.
module drive_jumps
  use kinds, only: wp
  use text, only: to_text
  use model_data, only: model_t, analysis_t
  use model_functions, only: next_jump
  use system_data, only: system_t
  use system_names, only: strain_name
  use recorder, only: recorder_t
  implicit none
  private

  public :: warn_of_jumps

contains

  !> A warning for each motion whose function jumps between `time` and the end of an analysis [T].
  subroutine warn_of_jumps(model, system, analysis, time, recorder)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(analysis_t), intent(in) :: analysis
    real(wp), intent(in) :: time
    class(recorder_t), intent(inout) :: recorder
    real(wp) :: jump
    integer :: i

    do i = 1, size(system%drive)
      associate (drive => system%drive(i))
        if (drive%function == 0 .or. .not. system%timed(drive%pattern)) cycle
        jump = next_jump(system%function(drive%function), time)
        if (jump > analysis%end_time) cycle
        call recorder%remark("warning: the motion prescribed for "// &
          strain_name(model, system, drive%strain)//" jumps at time "//to_text(jump)// &
          ": the model is put there at once, without a velocity; RAMP takes its time")
      end associate
    end do
  end subroutine warn_of_jumps

end module drive_jumps
