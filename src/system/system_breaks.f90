!> Where functions of time break off: loads jump, prescribed motions change their rate at once.
module system_breaks
  use kinds, only: wp
  use model_functions, only: next_jump, next_kink
  use system_data, only: system_t
  implicit none
  private

  public :: next_break

contains

  !> The first time behind `time` at which a load of a timed pattern jumps or a motion of one jumps
  !> or kinks; huge if there is none.
  pure real(wp) function next_break(system, time)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: time   !< [T]
    integer :: i

    next_break = huge(next_break)
    do i = 1, size(system%load)
      associate (load => system%load(i))
        if (load%function == 0 .or. .not. system%timed(load%pattern)) cycle
        next_break = min(next_break, next_jump(system%function(load%function), time))
      end associate
    end do
    do i = 1, size(system%drive)
      associate (drive => system%drive(i))
        if (drive%function == 0 .or. .not. system%timed(drive%pattern)) cycle
        next_break = min(next_break, next_kink(system%function(drive%function), time))
      end associate
    end do
  end function next_break

end module system_breaks
