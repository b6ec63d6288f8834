!> Prescribed motions that jump in time, which no mass can follow, or are all kinks.
module drive_jumps
  use kinds, only: wp
  use text, only: to_text
  use model_data, only: model_t, analysis_t, function_t
  use model_functions, only: next_jump, next_kink
  use system_data, only: system_t
  use system_names, only: strain_name
  use recorder, only: recorder_t
  implicit none
  private

  public :: warn_of_jumps

  !> A table with more kinks than this is taken for a measured motion.
  integer, parameter :: few_kinks = 8

contains

  !> A warning for each motion whose function jumps between `time` and the end of an analysis [T],
  !> or else kinks there many times.
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
        if (jump <= analysis%end_time) then
          call recorder%remark("warning: the motion prescribed for "// &
            strain_name(model, system, drive%strain)//" jumps at time "//to_text(jump)// &
            ": the model is put there at once, without a velocity; RAMP takes its time")
        else if (kinks(system%function(drive%function), time, analysis%end_time) > few_kinks) then
          call recorder%remark("warning: the motion prescribed for "// &
            strain_name(model, system, drive%strain)//" kinks at each point of its TABLE: its "// &
            "accelerations are blows there, and nothing between; SPLINE is smooth")
        end if
      end associate
    end do
  end subroutine warn_of_jumps

  !> How many kinks a function has between two times, counted as far as they are many.
  pure integer function kinks(f, from, to)
    type(function_t), intent(in) :: f
    real(wp), intent(in) :: from, to
    real(wp) :: kink

    kinks = 0
    kink = next_kink(f, from)
    do while (kink <= to .and. kinks <= few_kinks)
      kinks = kinks + 1
      kink = next_kink(f, kink)
    end do
  end function kinks

end module drive_jumps
