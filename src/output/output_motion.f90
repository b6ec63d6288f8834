!> The datasets that only analyses in time have: velocities, accelerations, energies and momentum.
module output_motion
  use kinds, only: wp, i8
  use system_results, only: results_t, energy_names
  use output_choice, only: choice_t
  use output_hdf5, only: hdf5_file_t, about_t
  use output_tables, only: table_t
  implicit none
  private

  public :: motion_tables_t

  integer, parameter :: velocity = 1, angular_velocity = 2, warping_rate = 3, acceleration = 4, &
    angular_acceleration = 5, warping_acceleration = 6, linear_momentum = 7, &
    angular_momentum = 8, first_energy = 9, tables = first_energy + size(energy_names) - 1

  character(len=*), parameter :: energy_texts(size(energy_names)) = [character(len=72) :: &
    "of all masses", "of all flexible modes, initial stresses included", &
    "work of the loads since the start", "work of prescribed coordinates and strains since the"// &
    " start", "work lost in dampers since the start", &
    "kinetic + strain + dissipated - loads - motion, from 0 at the start"]

  type :: motion_tables_t
    type(table_t) :: table(tables)
  contains
    procedure :: start
    procedure :: append
  end type motion_tables_t

contains

  !> Make the datasets of about `steps` steps; `balanced`: masses are known.
  subroutine start(self, file, group, node, steps, balanced)
    class(motion_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group         !< of the analysis
    type(choice_t), intent(in) :: node            !< nodes that are kept
    integer(i8), intent(in) :: steps
    logical, intent(in) :: balanced
    character(len=*), parameter :: xyz = "step*node; X Y Z", turn = "step*node; RX RY RZ"

    associate (t => self%table, rows => steps*node%rows, nodes => group//"/nodes/")
      call t(velocity)%start_reals(file, nodes//"velocity", rows, &
        about_t("LT-1", xyz, "velocity"), 3)
      call t(angular_velocity)%start_reals(file, nodes//"angular_velocity", rows, &
        about_t("T-1", turn, "angular velocity, global axes"), 3)
      call t(warping_rate)%start_reals(file, nodes//"warping_rate", rows, &
        about_t("L-1T-1", "step*node", "change of the warping coordinate with time"))
      call t(acceleration)%start_reals(file, nodes//"acceleration", rows, &
        about_t("LT-2", xyz, "acceleration"), 3)
      call t(angular_acceleration)%start_reals(file, nodes//"angular_acceleration", rows, &
        about_t("T-2", turn, "angular acceleration, global axes"), 3)
      call t(warping_acceleration)%start_reals(file, nodes//"warping_acceleration", rows, &
        about_t("L-1T-2", "step*node", "change of the warping rate with time"))
    end associate
    if (balanced) call start_balances(self, file, group, steps)
  end subroutine start

  !> Energy and momentum of the whole model.
  subroutine start_balances(self, file, group, steps)
    type(motion_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    integer(i8), intent(in) :: steps
    integer :: i

    call file%group(group//"/energy")
    do i = 1, size(energy_names)
      call self%table(first_energy + i - 1)%start_reals(file, &
        group//"/energy/"//trim(energy_names(i)), steps, &
        about_t("FL", "step", trim(energy_texts(i))))
    end do
    call file%group(group//"/momentum")
    call self%table(linear_momentum)%start_reals(file, group//"/momentum/linear", steps, &
      about_t("MLT-1", "step; X Y Z", "momentum of all masses"), 3)
    call self%table(angular_momentum)%start_reals(file, group//"/momentum/angular", steps, &
      about_t("ML2T-1", "step; X Y Z", "angular momentum of all masses about the origin"), 3)
  end subroutine start_balances

  !> Add a state.
  subroutine append(self, file, node, results)
    class(motion_tables_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(choice_t), intent(in) :: node
    type(results_t), intent(in) :: results
    integer :: i

    associate (t => self%table)
      call node%append(file, t(velocity), results%velocity(1:3, :))
      call node%append(file, t(angular_velocity), results%velocity(4:6, :))
      call node%append(file, t(warping_rate), results%velocity(7:7, :))
      call node%append(file, t(acceleration), results%acceleration(1:3, :))
      call node%append(file, t(angular_acceleration), results%acceleration(4:6, :))
      call node%append(file, t(warping_acceleration), results%acceleration(7:7, :))
      if (.not. allocated(results%energy)) return  ! KINEMATIC knows no masses
      do i = 1, size(energy_names)
        call t(first_energy + i - 1)%append(file, results%energy(i))
      end do
      call t(linear_momentum)%append(file, reshape(results%momentum(1:3), [3, 1]))
      call t(angular_momentum)%append(file, reshape(results%momentum(4:6), [3, 1]))
    end associate
  end subroutine append

end module output_motion
