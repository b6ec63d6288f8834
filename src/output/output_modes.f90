!> Modes of BUCKLING and EIGEN, and free motions found by CHECK, in the result file.
module output_modes
  use mode_results, only: modes_t
  use system_results, only: result_modes
  use output_hdf5, only: hdf5_file_t, about_t
  implicit none
  private

  public :: write_modes

contains

  !> All of an analysis' modes, below its group.
  subroutine write_modes(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes

    if (allocated(modes%multiplier)) then
      call file%set_number(group, "spectrum_complete", merge(1, 0, modes%complete))
      call write_multipliers(file, group, modes)
    else if (allocated(modes%frequency)) then
      call file%set_number(group, "spectrum_complete", merge(1, 0, modes%complete))
      call write_frequencies(file, group, modes)
    end if
    call write_nodes(file, group//"/modes", modes)
    call write_elements(file, group//"/modes", modes)
  end subroutine write_modes

  subroutine write_multipliers(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes

    call file%write(group//"/multiplier", modes%multiplier, &
      about_t("1", "mode", "of the load pattern, from the present state to buckling"))
    call file%write(group//"/load_factor", modes%load_factor, &
      about_t("1", "mode", "of the load pattern at buckling: present factor and multiplier"))
  end subroutine write_multipliers

  subroutine write_frequencies(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes
    character(len=*), parameter :: six = "mode; X Y Z RX RY RZ"

    call file%write(group//"/frequency", modes%frequency(:modes%modes), &
      about_t("T-1", "mode", "natural frequency; 0 of a free or an unstable motion"))
    call file%write(group//"/frequency_imaginary", modes%imaginary(:modes%modes), &
      about_t("T-1", "mode", "imaginary part of the frequency of an unstable motion, else 0"))
    call file%write(group//"/eigenvalue", modes%eigenvalue(:modes%modes), &
      about_t("T-2", "mode", "square of the circular frequency, negative if unstable"))
    call file%write(group//"/participation", modes%participation, &
      about_t("1", six, "mass times mode and rigid motion, rotations about the centre of mass"))
    call file%write(group//"/effective_mass", modes%effective_mass, &
      about_t("M M M ML2 ML2 ML2", six, "square of the participation: mass that moves with a mode"))
    call file%write(group//"/rigid_mass", modes%rigid_mass, &
      about_t("M M M ML2 ML2 ML2", "X Y Z RX RY RZ", "mass of the model, inertia about its centre"))
    call file%write(group//"/mass_centre", modes%centre, &
      about_t("L", "X Y Z", "centre of mass of the members"))
  end subroutine write_frequencies

  subroutine write_nodes(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes
    integer :: rows

    rows = size(modes%displacement, 2)*modes%modes
    call file%group(group)
    call file%group(group//"/nodes")
    call file%write(group//"/nodes/displacement", &
      reshape(modes%displacement(:, :, :modes%modes), [3, rows]), &
      about_t("L", "mode*node; X Y Z", "displacement of the mode"))
    call file%write(group//"/nodes/rotation", &
      reshape(modes%rotation(:, :, :modes%modes), [3, rows]), &
      about_t("1", "mode*node; RX RY RZ", "small rotation of the mode, global axes"))
    call file%write(group//"/nodes/warping", reshape(modes%warping(:, :modes%modes), [rows]), &
      about_t("L-1", "mode*node", "warping coordinate of the mode, a rate of twist"))
  end subroutine write_nodes

  subroutine write_elements(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes
    integer :: rows

    rows = size(modes%strain, 2)*modes%modes
    call file%group(group//"/elements")
    call file%write(group//"/elements/strain", &
      reshape(modes%strain(:, :, :modes%modes), [result_modes, rows]), &
      about_t("L", "mode*element; strain 1 to 8", "generalized strains of the mode"))
    call file%write(group//"/elements/stress", &
      reshape(modes%stress(:, :, :modes%modes), [result_modes, rows]), &
      about_t("F", "mode*element; strain 1 to 8", "their stress resultants"))
    call file%write(group//"/energy", modes%energy(:, :modes%modes), &
      about_t("1", "mode; axial, torsion, bending y, bending z, warping", &
              "shares of the strain energy; 0 of a free motion"))
  end subroutine write_elements

end module output_modes
