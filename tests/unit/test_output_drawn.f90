!> Motions in time: which states are drawn and how, and how far a run is.
module test_output_drawn
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t, analysis_t, analysis_static, analysis_transient
  use output_progress, only: time_line
  use output_schedule, only: drawing_rule_t, new_rule, drawn_intervals
  use program_runs, only: scratch
  use result_reader, only: get_reals, get_integers, get_numbers
  use history_samples, only: get_history_model, write_history, sample_value, of_displacement, &
    of_joint_stress
  implicit none
  private

  public :: run_output_drawn_tests

  integer, parameter :: steps = 600

contains

  subroutine run_output_drawn_tests()
    call run("history: how many states are drawn", test_rule)
    call run("history: the drawing", test_drawing)
    call run("history: how far a motion is", test_progress)
  end subroutine run_output_drawn_tests

  !> At most one state for each of 200 intervals, the start and the end; in equal steps evenly.
  subroutine test_rule()
    integer, allocatable :: drawn(:)

    call expect(count_drawn(0.0_wp, 1.0_wp, 0.01_wp, 0.0_wp, 0.01_wp) == 101, "few steps: all")
    call expect(count_drawn(0.0_wp, 1.0_wp, 1.0e-4_wp, 0.0_wp, 1.0e-4_wp) == 201, "every 50th")
    call expect(count_drawn(0.0_wp, 1.0_wp, 1.0e-4_wp, 0.005_wp, 0.005_wp) == 201, "EVERY")
    call expect(count_drawn(0.0_wp, 3.01_wp, 0.01_wp, 0.0_wp, 0.01_wp, drawn) == 152, "every 2nd")
    call expect(all(drawn(2:151) - drawn(:150) == 2), "evenly")
    call expect(drawn(1) == 0 .and. drawn(152) == 301, "start and end")
    call expect(count_drawn(0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 1.0e-4_wp) == 201, "adaptive steps")
    call expect(count_drawn(5.0_wp, 6.0_wp, 1.0e-3_wp, 0.0_wp, 1.0e-3_wp) == 201, "a later start")
    call expect(drawn_intervals == 200, "as the page says")
  end subroutine test_rule

  !> States drawn of a motion recorded at equal intervals; `drawn`: their numbers from 0.
  integer function count_drawn(start, end, step, every, interval, drawn) result(states)
    real(wp), intent(in) :: start, end, step, every, interval
    integer, allocatable, intent(out), optional :: drawn(:)
    type(drawing_rule_t) :: rule
    type(analysis_t) :: analysis
    integer :: i, last, list(1000)
    logical :: draws

    analysis%kind = analysis_transient
    analysis%end_time = end
    analysis%time_step = step
    analysis%every = every
    rule = new_rule(analysis, start)
    states = 0
    last = nint((end - start)/interval)
    do i = 0, last
      draws = rule%draws(merge(end, start + i*interval, i == last))
      if (draws) states = states + 1
      if (draws) list(states) = i
    end do
    if (present(drawn)) drawn = list(:states)
    analysis%kind = analysis_static
    rule = new_rule(analysis, 0.0_wp)
    do i = 1, 1000
      call expect(rule%draws(0.0_wp), "STATIC is drawn step by step")
    end do
  end function count_drawn

  !> 600 steps: every third; the truss between nodes 1 and 2, straight, with its force and stress,
  !> and behind it the nodes of the hinges, which are 1, 3 and 4.
  subroutine test_drawing()
    type(model_t) :: model
    character(len=:), allocatable :: path
    integer, allocatable :: origin(:), whole(:), extents(:)
    real(wp), allocatable :: points(:), motion(:), force(:), stress(:)
    real(wp) :: axial
    integer, parameter :: dots = 3, n = 3*4*8 + 2 + dots, bar = 3*(n - dots), drawn = 201
    integer :: i, cells, k, truss

    path = scratch("drawn.h5")
    call get_history_model(steps, model)
    call write_history(path, model, steps)
    call get_integers(path, "VTKHDF/Steps/Origin", origin, extents)
    call expect(size(origin) == 2*drawn, "every third and the start")
    if (size(origin) /= 2*drawn) return
    call expect(all(origin(2::2) == [(3*i, i=0, 200)]), "rows of the analysis")
    call get_numbers(path, "VTKHDF/Steps", "NSteps", whole)
    call expect(all(whole == [drawn]), "NSteps")
    call get_integers(path, "VTKHDF/Types", whole, extents)
    cells = size(whole)
    truss = cells - dots
    call expect(count(whole == 3) == 1 .and. whole(truss) == 3, "one line")
    call expect(count(whole == 1) == dots .and. all(whole(truss + 1:) == 1), "then dots")
    call get_reals(path, "VTKHDF/Points", points, extents)
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call get_reals(path, "VTKHDF/CellData/section_force", force, extents)
    call get_reals(path, "VTKHDF/PointData/axial_stress", stress, extents)
    call expect_close(points(bar - 5:bar), [0.0_wp, 0.0_wp, 0.0_wp, 5.0_wp, 0.0_wp, 0.0_wp], &
                      1.0e-14_wp, "ends of the truss")
    do k = 0, drawn - 1, 50
      call expect_close(motion(3*n*k + bar - 5:3*n*k + bar), &
        [(sample_value(of_displacement, 3*k, 1, i), i=1, 3), &
         (sample_value(of_displacement, 3*k, 2, i), i=1, 3)], &
        2.0_wp**(-24)*sample_value(of_displacement, 3*k, 2, 3), "they follow the nodes")
      call expect_close(motion(3*n*(k + 1) - 5:3*n*(k + 1)), &
        [(sample_value(of_displacement, 3*k, 3, i), i=1, 3), &
         (sample_value(of_displacement, 3*k, 4, i), i=1, 3)], &
        2.0_wp**(-24)*sample_value(of_displacement, 3*k, 4, 3), "so do the dots")
      axial = sample_value(of_joint_stress, 3*k, 1, 1)
      call expect_close(force(7*(cells*k + truss) - 6:7*(cells*k + truss)), &
                        [axial, (0.0_wp, i=1, 6)], 1.0e-6_wp*axial, "its force")
      call expect_close(stress(n*(k + 1) - dots - 1:n*(k + 1) - dots), spread(axial/0.7_wp, 1, 2), &
                        1.0e-6_wp*axial, "its stress")
    end do
  end subroutine test_drawing

  !> A quarter in 30 s: 90 s to go.
  subroutine test_progress()
    call expect(time_line(1.0_wp, 2.0_wp, 5.0_wp, 600, 30.0_wp) == &
                "time 2 of 5, 25 %, 20 steps per second, 90 s to go", "a quarter")
    call expect(index(time_line(0.0_wp, 0.1_wp, 1.0_wp, 123456, 10.0_wp), "12346 steps") > 0, &
                "many steps per second")
    call expect(index(time_line(0.0_wp, 0.1_wp, 1.0_wp, 1, 60.0_wp), "9:00 min to go") > 0, &
                "minutes")
    call expect(index(time_line(0.0_wp, 0.1_wp, 1.0_wp, 1, 1000.0_wp), "2:30 h to go") > 0, &
                "hours")
    call expect(time_line(0.0_wp, 0.0_wp, 1.0_wp, 0, 1.0_wp) == "time 0 of 1, 0 %", "not yet")
  end subroutine test_progress

end module test_output_drawn
