!> CPU microseconds per recorded step of a motion in time, with the result file and the log of a
!> run: a chain of ten beams, 2000 steps of smooth results, with and without /VTKHDF.
program bench_recorder
  use, intrinsic :: iso_fortran_env, only: output_unit
  use kinds, only: wp
  use errors, only: error_t
  use diagnostics, only: report_t
  use model_data, only: model_t, setting_t, analysis_transient, components
  use deck_reader, only: read_deck
  use system_results, only: results_t, result_modes, energy_names
  use system_stress, only: stress_places
  use recorder, only: step_t
  use output_recorder, only: run_recorder_t, run_options_t
  use output_log, only: log_quiet
  implicit none
  integer, parameter :: steps = 2000, rounds = 9
  type(model_t) :: model
  type(report_t) :: report
  type(error_t), allocatable :: error
  type(results_t) :: results
  real(wp) :: time(rounds)
  integer :: drawn, round

  call read_deck("tests/bench/chain.deck", [setting_t ::], model, report, error)
  if (allocated(error)) error stop "cannot read the deck"
  model%analysis(1)%kind = analysis_transient
  model%analysis(1)%end_time = 1
  model%analysis(1)%time_step = 1.0_wp/steps
  call make_results()
  do drawn = 0, 1
    do round = 1, rounds
      time(round) = microseconds(drawn == 1)
    end do
    write (output_unit, "(f0.1)") minval(time)
  end do

contains

  subroutine make_results()
    integer :: nodes, members

    nodes = size(model%node)
    members = size(model%member)
    allocate (results%displacement(3, nodes), results%euler(4, nodes), results%warping(nodes))
    allocate (results%reaction(components, nodes), results%load(components, nodes))
    allocate (results%velocity(components, nodes), results%acceleration(components, nodes))
    allocate (results%strain(result_modes, members), results%stress(result_modes, members))
    allocate (results%force_p(7, members), results%force_q(7, members))
    allocate (results%point_stress(4, size(stress_places(model))))
    allocate (results%marker(3, 0), results%joint_strain(6, 0), results%joint_stress(6, 0))
    allocate (results%joint_rate(6, 0), results%energy(size(energy_names)), results%momentum(6))
    results%euler = 0
    results%euler(1, :) = 1
  end subroutine make_results

  !> Neither constant nor all alike: constants would be cheaper to write.
  subroutine set_results(time)
    real(wp), intent(in) :: time

    call wave(results%displacement, time)
    call wave(results%reaction, time)
    call wave(results%load, time)
    call wave(results%velocity, time)
    call wave(results%acceleration, time)
    call wave(results%strain, time)
    call wave(results%stress, time)
    call wave(results%force_p, time)
    call wave(results%force_q, time)
    call wave(results%point_stress, time)
    results%warping = 0.01_wp*time
    results%energy = time
    results%momentum = time
  end subroutine set_results

  subroutine wave(field, time)
    real(wp), intent(out) :: field(:, :)
    real(wp), intent(in) :: time
    integer :: i

    do i = 1, size(field, 2)
      field(:, i) = sin(3*time + i)
    end do
  end subroutine wave

  real(wp) function microseconds(drawn)
    logical, intent(in) :: drawn
    type(run_recorder_t) :: recorder
    type(run_options_t) :: options
    type(error_t), allocatable :: error
    type(step_t) :: step
    real(wp) :: start, finish, spent
    integer :: i

    options%deck = "chain.deck"
    options%output = "build/bench_recorder.h5"
    options%level = log_quiet
    options%drawn = drawn
    call recorder%open(options, model, error)
    spent = 0
    if (.not. allocated(error)) call recorder%begin(1, model%analysis(1), error)
    do i = 0, steps
      if (allocated(error)) exit
      step%step = i
      step%time = real(i, wp)/steps
      call set_results(step%time)
      call cpu_time(start)
      call recorder%step(step, results, error)
      call cpu_time(finish)
      spent = spent + finish - start
    end do
    call cpu_time(start)
    if (.not. allocated(error)) call recorder%finish(.true., error)
    if (.not. allocated(error)) call recorder%close(.true., error)
    call cpu_time(finish)
    if (allocated(error)) error stop "cannot record"
    microseconds = 1.0e6_wp*(spent + finish - start)/steps
  end function microseconds

end program bench_recorder
