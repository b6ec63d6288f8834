!> Modes of BUCKLING and EIGEN, and free motions found by CHECK, in the result file.
module output_modes
  use kinds, only: wp
  use mode_results, only: modes_t
  use system_results, only: result_modes, joint_strains
  use output_hdf5, only: hdf5_file_t, about_t
  use output_matrices, only: write_matrices
  implicit none
  private

  public :: write_modes

contains

  !> All of an analysis' modes, below its group.
  subroutine write_modes(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes

    if (allocated(modes%multiplier) .or. allocated(modes%frequency)) then
      call file%set_number(group, "spectrum_complete", merge(1, 0, modes%complete))
      call file%set_number(group, "cut_first", merge(1, 0, modes%cut(1)))
      call file%set_number(group, "cut_last", merge(1, 0, modes%cut(2)))
    end if
    if (allocated(modes%multiplier)) then
      call write_multipliers(file, group, modes)
    else if (allocated(modes%frequency)) then
      call write_frequencies(file, group, modes)
    end if
    call write_nodes(file, group//"/modes", modes)
    call write_elements(file, group//"/modes", modes)
    if (size(modes%joint_strain, 2) > 0) call write_joints(file, group//"/modes/joints", modes)
    if (allocated(modes%quadrature)) call write_quadrature(file, group//"/modes", modes)
    if (allocated(modes%matrices)) call write_matrices(file, group//"/matrices", modes)
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
    integer :: i

    call file%write(group//"/frequency", modes%frequency(:modes%modes), &
      about_t("T-1", "mode", "natural frequency; 0 of a motion that does not oscillate"))
    call file%write(group//"/frequency_imaginary", modes%imaginary(:modes%modes), &
      about_t("T-1", "mode", "imaginary part of the frequency of an unstable motion, else 0"))
    call file%write(group//"/damping", modes%damping(:modes%modes), &
      about_t("1", "mode", "ratio to critical damping; negative: the motion grows"))
    if (allocated(modes%lambda)) then
      call file%write(group//"/complex_eigenvalue", &
        reshape([(real(modes%lambda(i)), aimag(modes%lambda(i)), i=1, modes%modes)], &
                [2, modes%modes]), &
        about_t("T-1", "mode; real imaginary", "lambda of a motion as exp(lambda t)"))
    else
      call file%write(group//"/eigenvalue", modes%eigenvalue(:modes%modes), &
        about_t("T-2", "mode", "square of the circular frequency, negative if unstable"))
      call file%write(group//"/participation", modes%participation, &
        about_t("1", six, "mass times mode and rigid motion, rotations about the centre of mass"))
      call file%write(group//"/effective_mass", modes%effective_mass, &
        about_t("M M M ML2 ML2 ML2", six, &
                "square of the participation: mass that moves with a mode"))
    end if
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
      about_t("1", "mode; axial, torsion, bending y, bending z, warping, joints", &
              "shares of the strain energy; 0 of a free motion"))
  end subroutine write_elements

  subroutine write_joints(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes
    integer :: rows

    rows = size(modes%joint_strain, 2)*modes%modes
    call file%group(group)
    call file%write(group//"/strain", &
      reshape(modes%joint_strain(:, :, :modes%modes), [joint_strains, rows]), &
      about_t("1", "mode*joint; strain 1 to 6", "angles or lengths L, by the joint's type"))
    call file%write(group//"/stress", &
      reshape(modes%joint_stress(:, :, :modes%modes), [joint_strains, rows]), &
      about_t("FL", "mode*joint; strain 1 to 6", "moments or, of lengths, forces F"))
  end subroutine write_joints

  !> The imaginary parts of complex modes.
  subroutine write_quadrature(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes
    integer :: n

    n = modes%modes
    associate (part => modes%quadrature)
      call file%write(group//"/nodes/displacement_imaginary", flat(part%displacement), &
        about_t("L", "mode*node; X Y Z", "imaginary part of the displacement"))
      call file%write(group//"/nodes/rotation_imaginary", flat(part%rotation), &
        about_t("1", "mode*node; RX RY RZ", "imaginary part of the rotation"))
      call file%write(group//"/nodes/warping_imaginary", &
        reshape(part%warping(:, :n), [size(part%warping, 1)*n]), &
        about_t("L-1", "mode*node", "imaginary part of the warping coordinate"))
      call file%write(group//"/elements/strain_imaginary", flat(part%strain), &
        about_t("L", "mode*element; strain 1 to 8", "imaginary part of the strains"))
      call file%write(group//"/elements/stress_imaginary", flat(part%stress), &
        about_t("F", "mode*element; strain 1 to 8", "imaginary part of their stress resultants"))
      if (size(part%joint_strain, 2) == 0) return
      call file%write(group//"/joints/strain_imaginary", flat(part%joint_strain), &
        about_t("1", "mode*joint; strain 1 to 6", "imaginary part of the joints' strains"))
      call file%write(group//"/joints/stress_imaginary", flat(part%joint_stress), &
        about_t("FL", "mode*joint; strain 1 to 6", "imaginary part of their stress resultants"))
    end associate

  contains

    function flat(table)
      real(wp), intent(in) :: table(:, :, :)
      real(wp), allocatable :: flat(:, :)

      flat = reshape(table(:, :, :n), [size(table, 1), size(table, 2)*n])
    end function flat
  end subroutine write_quadrature

end module output_modes
