!> Small result files for tests of what reads them, written by the program's own modules.
module result_samples
  use kinds, only: wp
  use errors, only: error_t
  use check, only: expect
  use mode_results, only: modes_t, energy_kinds
  use output_hdf5, only: hdf5_file_t, about_t
  use output_modes, only: write_modes
  implicit none
  private

  public :: sample_t, new_sample, write_sample

  integer, parameter, public :: nodes = 4, members = 3, sample_modes = 3

  !> What a file is to hold.
  type :: sample_t
    integer, allocatable :: step(:)
    real(wp), allocatable :: displacement(:, :)   !< (3, steps*nodes)
    real(wp), allocatable :: reaction(:, :)       !< (7, steps*nodes)
    real(wp), allocatable :: pole(:, :)           !< (2, poles) complex numbers
    real(wp) :: residual = 1.0e-12_wp
    character(len=20) :: word = "steel"
    logical :: with_reaction = .true., with_more = .false.
    type(modes_t) :: modes
  end type sample_t

contains

  !> Two steps and three modes without symmetry.
  subroutine new_sample(sample)
    type(sample_t), intent(out) :: sample
    integer :: i, k

    sample%step = [1, 2]
    sample%displacement = reshape([(sin(0.7_wp*i), i=1, 6*nodes)], [3, 2*nodes])
    sample%reaction = reshape([(cos(1.3_wp*i), i=1, 14*nodes)], [7, 2*nodes])
    sample%reaction(7, :) = 1.0e-8_wp*sample%reaction(7, :)
    sample%pole = reshape([-1.0e-9_wp, 2.0_wp, -0.5_wp, 3.0_wp], [2, 2])
    associate (m => sample%modes)
      m%modes = sample_modes
      m%frequency = [1.0_wp, 2.0_wp, 3.0_wp]
      m%imaginary = [0.0_wp, 0.0_wp, 0.0_wp]
      m%damping = [0.0_wp, 0.0_wp, 0.0_wp]
      m%eigenvalue = 39.5_wp*m%frequency**2
      allocate (m%displacement(3, nodes, sample_modes), m%rotation(3, nodes, sample_modes), &
                m%warping(nodes, sample_modes), m%strain(8, members, sample_modes), &
                m%stress(8, members, sample_modes), m%energy(energy_kinds, sample_modes), &
                m%joint_strain(6, 0, sample_modes), m%joint_stress(6, 0, sample_modes))
      do k = 1, sample_modes
        m%displacement(:, :, k) = reshape([(sin(i*k + 0.3_wp), i=1, 3*nodes)], [3, nodes])
        m%rotation(:, :, k) = reshape([(0.1_wp*cos(i*k + 0.1_wp), i=1, 3*nodes)], [3, nodes])
        m%warping(:, k) = [(0.01_wp*sin(2.0_wp*i + k), i=1, nodes)]
        m%strain(:, :, k) = reshape([(0.2_wp*cos(0.4_wp*i*k), i=1, 8*members)], [8, members])
        m%stress(:, :, k) = 100*m%strain(:, :, k)
        m%energy(:, k) = [0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.0_wp, 0.0_wp]
      end do
      m%participation = reshape([(sin(1.0_wp*i), i=1, 6*sample_modes)], [6, sample_modes])
      m%effective_mass = m%participation**2
    end associate
  end subroutine new_sample

  subroutine write_sample(path, sample)
    character(len=*), intent(in) :: path
    type(sample_t), intent(in) :: sample
    character(len=*), parameter :: static = "analysis/01_static"
    type(hdf5_file_t) :: file
    type(error_t), allocatable :: error

    call file%create(path, error)
    call file%set_number("/", "layout_version", 1)
    call file%group("analysis")
    call file%group(static)
    call file%group(static//"/nodes")
    call file%group(static//"/convergence")
    call file%write(static//"/step", sample%step, about_t("1", "step", ""))
    call file%write(static//"/nodes/displacement", sample%displacement, &
                    about_t("L", "step*node; X Y Z", ""))
    if (sample%with_reaction) call file%write(static//"/nodes/reaction", sample%reaction, &
      about_t("F F F FL FL FL FL2", "step*node; X Y Z RX RY RZ W", ""))
    if (sample%with_more) call file%write(static//"/more", [1, 2], about_t("1", "", ""))
    call file%write(static//"/convergence/residual", [sample%residual], about_t("1", "step", ""))
    call file%write(static//"/pole", sample%pole, about_t("T-1", "pole; real imaginary", ""))
    call file%write(static//"/material", [sample%word], about_t("1", "element", ""))
    call file%group("analysis/02_eigen")
    call write_modes(file, "analysis/02_eigen", sample%modes)
    call file%close(error)
    call expect(.not. allocated(error), "the sample is written")
  end subroutine write_sample

end module result_samples
