!> Result files of motions in time, written by the program's recorder from made-up results: each
!> number says what it is, at which step, of which node or element.
module history_samples
  use kinds, only: wp
  use errors, only: error_t
  use check, only: expect
  use diagnostics, only: report_t
  use deck_reader, only: read_deck
  use model_data, only: model_t, setting_t, analysis_transient, analysis_compliance, components, &
                        joint_truss, joint_hinge, joint_gear, mode_released, mode_flexible
  use system_results, only: results_t, result_modes, joint_strains, energy_names
  use system_stress, only: stress_parts, stress_places
  use recorder, only: step_t
  use output_recorder, only: run_recorder_t, run_options_t
  use output_log, only: log_quiet
  implicit none
  private

  public :: get_history_model, write_history, record_steps, open_history, sample_value, yields

  !> What a number is of.
  integer, parameter, public :: of_displacement = 1, of_euler = 2, of_warping = 3, &
    of_reaction = 4, of_load = 5, of_strain = 6, of_stress = 7, of_force_p = 8, of_force_q = 9, &
    of_places = 10, of_marker = 11, of_joint_strain = 12, of_joint_stress = 13, &
    of_joint_rate = 14, of_velocity = 15, of_acceleration = 16, of_energy = 17, of_momentum = 18

contains

  !> A column `i` of row `j` at a step, from 0: exact in the file.
  elemental real(wp) function sample_value(what, step, j, i) result(number)
    integer, intent(in) :: what, step, j, i

    number = 1.0e6_wp*what + 1.0e3_wp*(step + 1) + 20*j + i
    if (what == of_displacement) number = 1.0e-9_wp*number
  end function sample_value

  !> A cantilever of three drawn beams, with a truss, two hinges, a gear and a mass, a motion of so
  !> many steps and COMPLIANCE of two nodes.
  subroutine get_history_model(steps, model)
    integer, intent(in) :: steps
    type(model_t), intent(out) :: model
    type(setting_t) :: none(0)
    type(report_t) :: report
    type(error_t), allocatable :: error

    call read_deck("tests/cases/program/drawing.deck", none, model, report, error)
    call expect(.not. allocated(error) .and. report%errors() == 0, "the deck is sound")
    deallocate (model%joint, model%mass, model%analysis)
    allocate (model%joint(4), model%mass(1), model%analysis(2))
    model%joint%id = [11, 12, 13, 14]
    model%joint%kind = [joint_truss, joint_hinge, joint_hinge, joint_gear]
    model%joint(1)%node(1, :) = [1, 2]
    model%joint(1)%chord = model%node(2)%position - model%node(1)%position
    model%joint(1)%section = 1
    model%joint(1)%status(1) = mode_flexible
    model%joint(1)%has_inertia = .true.
    model%joint(2)%node(2, :) = [1, 3]
    model%joint(2)%axis(:, 1) = [0, 0, 1]
    model%joint(2)%status(1) = mode_released
    model%joint(2)%has_stiffness = .true.
    model%joint(2)%stiffness(1) = 7
    model%joint(2)%has_damping = .true.
    model%joint(3)%node(2, :) = [3, 4]
    model%joint(3)%axis(:, 1) = [0, 1, 0]
    model%joint(3)%initial_stress(1) = 2
    model%joint(4)%gear = [2, 3]
    model%joint(4)%ratio = -2.5_wp
    model%mass(1)%node = 2
    model%mass(1)%mass = 3
    model%mass(1)%inertia = reshape([1, 2, 3, 2, 4, 5, 3, 5, 6]*1.0_wp, [3, 3])
    model%member(1)%has_damping = .true.
    model%member(1)%initial_stress(1) = 1
    model%analysis(1)%kind = analysis_transient
    model%analysis(1)%end_time = 0.001_wp*steps
    model%analysis(1)%time_step = 0.001_wp
    model%analysis(2)%kind = analysis_compliance
    allocate (model%analysis(2)%node(2))
    model%analysis(2)%node = [2, 4]
  end subroutine get_history_model

  !> All results at a step.
  subroutine get_results(model, step, results)
    type(model_t), intent(in) :: model
    integer, intent(in) :: step
    type(results_t), intent(out) :: results
    integer :: nodes, members, joints, places, markers

    nodes = size(model%node)
    members = size(model%member)
    joints = size(model%joint)
    places = size(stress_places(model))
    markers = size(model%marker)
    results%displacement = table(of_displacement, 3, nodes)
    results%euler = table(of_euler, 4, nodes)
    results%warping = reshape(table(of_warping, 1, nodes), [nodes])
    results%reaction = table(of_reaction, components, nodes)
    results%load = table(of_load, components, nodes)
    results%strain = table(of_strain, result_modes, members)
    results%stress = table(of_stress, result_modes, members)
    results%force_p = table(of_force_p, 7, members)
    results%force_q = table(of_force_q, 7, members)
    results%point_stress = table(of_places, stress_parts, places)
    results%marker = table(of_marker, 3, markers)
    results%joint_strain = table(of_joint_strain, joint_strains, joints)
    results%joint_stress = table(of_joint_stress, joint_strains, joints)
    results%joint_rate = table(of_joint_rate, joint_strains, joints)
    results%velocity = table(of_velocity, components, nodes)
    results%acceleration = table(of_acceleration, components, nodes)
    results%energy = reshape(table(of_energy, size(energy_names), 1), [size(energy_names)])
    results%momentum = reshape(table(of_momentum, 6, 1), [6])
  contains
    function table(what, columns, rows)
      integer, intent(in) :: what, columns, rows
      real(wp) :: table(columns, rows)
      integer :: i, j

      do j = 1, rows
        table(:, j) = [(sample_value(what, step, j, i), i=1, columns)]
      end do
    end function table
  end subroutine get_results

  subroutine open_history(path, model, recorder)
    character(len=*), intent(in) :: path
    type(model_t), intent(in) :: model
    type(run_recorder_t), intent(inout) :: recorder
    type(run_options_t) :: options
    type(error_t), allocatable :: error

    options%deck = "drawing.deck"
    options%output = path
    options%level = log_quiet
    call recorder%open(options, model, error)
    if (.not. allocated(error)) call recorder%begin(1, model%analysis(1), error)
    call expect(.not. allocated(error), path//" is open")
  end subroutine open_history

  !> Record steps `first` to `last`, the start being step 0.
  subroutine record_steps(model, first, last, recorder)
    type(model_t), intent(in) :: model
    integer, intent(in) :: first, last
    type(run_recorder_t), intent(inout) :: recorder
    type(step_t) :: step
    type(results_t) :: results
    type(error_t), allocatable :: error
    integer :: i

    do i = first, last
      step%step = i
      step%time = 0.001_wp*i
      step%size = 0.0005_wp
      step%iterations = modulo(i, 7)
      call get_results(model, i, results)
      call recorder%step(step, results, error)
      call expect(.not. allocated(error), "a step is recorded")
    end do
  end subroutine record_steps

  !> A file of a whole run, COMPLIANCE included.
  subroutine write_history(path, model, steps)
    character(len=*), intent(in) :: path
    type(model_t), intent(in) :: model
    integer, intent(in) :: steps
    type(run_recorder_t) :: recorder
    type(error_t), allocatable :: error
    real(wp) :: matrix(6, 6, 2)

    call open_history(path, model, recorder)
    call record_steps(model, 0, steps, recorder)
    call recorder%finish(.true., error)
    matrix(:, :, 1) = yields(1)
    matrix(:, :, 2) = yields(2)
    if (.not. allocated(error)) call recorder%begin(2, model%analysis(2), error)
    if (.not. allocated(error)) call recorder%compliance([2, 4], matrix, error)
    if (.not. allocated(error)) call recorder%finish(.true., error)
    if (.not. allocated(error)) call recorder%close(.true., error)
    call expect(.not. allocated(error), path//" is written")
  end subroutine write_history

  !> Compliance of a node, without symmetry: row 10, column 1.
  pure function yields(node) result(matrix)
    integer, intent(in) :: node
    real(wp) :: matrix(6, 6)
    integer :: i, j

    do j = 1, 6
      matrix(:, j) = [(100*node + 10*i + j, i=1, 6)]
    end do
  end function yields

end module history_samples
