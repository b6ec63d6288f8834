!> Equilibrium paths beyond limit points: published curves and independent values.
module test_path
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_solve
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck, run_sound, node => node_index
  use recorder, only: critical_limit
  implicit none
  private

  public :: run_path_tests

contains

  subroutine run_path_tests()
    call run("path: Lee's frame with snap-back (STA-11)", lee)
    call run("path: Williams' toggle (STA-09)", williams)
    call run("path: channel post-buckling, independent values", channel)
    call run("path: channel, all second-order options, meshes and corners", channel_robust)
    call run("path: channel by arc length, ends at STOP", channel_arc)
    call run("path: stability REQUIRED ends before the limit point", required)
  end subroutine run_path_tests

  subroutine solve(name, memory, model, settings)
    character(len=*), intent(in) :: name
    type(memory_t), intent(inout) :: memory
    type(model_t), intent(out) :: model
    character(len=*), intent(in), optional :: settings(:)

    call run_sound("../path/"//name, memory, model, settings)
  end subroutine solve

  !> Mean number of iterations per recorded step: the issue's bound.
  subroutine expect_few_iterations(memory, what)
    type(memory_t), intent(in) :: memory
    character(len=*), intent(in) :: what

    call expect(sum(memory%record(:memory%steps)%iterations) <= 4.5_wp*memory%steps, &
                what//": at most 4.5 iterations a step")
  end subroutine expect_few_iterations

  !> First limit 1.8556728 at v = 48.735 (exact boundary-value problem, shear-rigid), lowest load
  !> -0.9414 and turning points of v (61.0 and 50.75) on the way back.
  subroutine lee()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp), allocatable :: v(:)
    integer :: i, n

    call solve("lee", memory, model)
    n = memory%steps
    if (n < 20) return
    call expect(size(memory%critical) == 2, "two limit points")
    if (size(memory%critical) /= 2) return
    call expect_close(memory%critical(1)%factor/1.8556727825252703_wp, 1.0_wp, 3.0e-3_wp, &
                      "first limit")
    call expect_close(memory%critical(2)%factor/(-0.9414452350338697_wp), 1.0_wp, 1.0e-2_wp, &
                      "second limit")
    call expect(all(memory%critical%kind == critical_limit), "of the kind limit point")
    allocate (v(n))
    v(:) = [(-memory%results(i)%displacement(3, node(model, 3)), i=1, n)]
    associate (back => [(v(i) > v(i - 1) .and. v(i) > v(i + 1), i=2, n - 1)], &
               forth => [(v(i) < v(i - 1) .and. v(i) < v(i + 1), i=2, n - 1)])
      call expect(count(back) == 1 .and. count(forth) == 1, "v turns back once and forth once")
      call expect_close(v(1 + findloc(back, .true., 1)), 61.003_wp, 0.3_wp, "v where it turns back")
      call expect_close(v(1 + findloc(forth, .true., 1)), 50.749_wp, 0.3_wp, &
                        "v where it turns forth")
    end associate
    call expect_close(memory%record(n)%factor, 3.0_wp, 1.0e-12_wp, "ends at TO exactly")
    call expect_few_iterations(memory, "Lee's frame")
  end subroutine lee

  !> P at w = 0.1, 0.2, ... 0.7 and the two limit loads, exact boundary-value problem.
  subroutine williams()
    real(wp), parameter :: p(7) = [25.201324868243898_wp, 33.49186223583465_wp, &
      32.83364624529159_wp, 31.283552473897846_wp, 36.0725563650806_wp, 53.285291179804105_wp, &
      88.1642856891828_wp]
    type(memory_t) :: memory
    type(model_t) :: model

    call solve("williams", memory, model)
    if (memory%steps /= 7) return
    call expect_close(memory%record(:7)%factor/p, spread(1.0_wp, 1, 7), 3.0e-3_wp, "P(w)")
    call expect(size(memory%critical) == 2, "two limit points")
    if (size(memory%critical) /= 2) return
    call expect_close(memory%critical%factor/[33.86123304140249_wp, 31.26258314659061_wp], &
                      [1, 1]*1.0_wp, 3.0e-3_wp, "limit loads")
    call expect(all(memory%record(:7)%unstable == [0, 0, 1, 0, 0, 0, 0]), "unstable between them")
    call expect_few_iterations(memory, "Williams' toggle")
  end subroutine williams

  !> Theory 10: F at D for -w(D) = 30, 60, 90, 150, 210, 300 cm, ten elements; the shell within
  !> 1 % up to 150 cm and 3.5 % at 300; F at E for 30, 90, 210 cm.
  subroutine channel()
    real(wp), parameter :: d(6) = &
      [8.7934_wp, 9.5363_wp, 10.3907_wp, 12.6174_wp, 15.6318_wp, 21.7805_wp]
    real(wp), parameter :: shell(6) = &
      [8.753_wp, 9.532_wp, 10.379_wp, 12.544_wp, 15.413_wp, 21.062_wp]
    real(wp), parameter :: e(3) = [11.3646_wp, 12.6819_wp, 17.2141_wp]
    type(memory_t) :: memory
    type(model_t) :: model

    call solve("channel", memory, model)
    if (memory%steps /= 30) return
    associate (f => memory%record([3, 6, 9, 15, 21, 30])%factor)
      call expect_close(f/d, spread(1.0_wp, 1, 6), 1.0e-3_wp, "F at D")
      call expect_close(f(:4)/shell(:4), spread(1.0_wp, 1, 4), 1.0e-2_wp, "the shell's F")
      call expect_close(f(6)/shell(6), 1.0_wp, 3.5e-2_wp, "the shell's F at 300 cm")
    end associate
    call expect_few_iterations(memory, "load at D")
    call solve("channel", memory, model, ["z=-14.2"])
    if (memory%steps /= 30) return
    associate (f => memory%record([3, 9, 21])%factor)
      call expect_close(f/e, [1, 1, 1]*1.0_wp, 1.0e-3_wp, "F at E")
    end associate
  end subroutine channel

  !> Every mesh, option and corner reaches 300 cm from the default settings.
  subroutine channel_robust()
    character(len=*), parameter :: second(3) = ["second=CONSISTENT", "second=JONKER    ", &
                                                "second=NONE      "]
    character(len=*), parameter :: mesh(3) = ["n=10", "n=20", "n=40"]
    character(len=*), parameter :: corner(2) = ["z=14.2 ", "z=-14.2"]
    real(wp), parameter :: at_300(3) = [21.7805_wp, 0.0_wp, 21.5192_wp]
    character(len=20) :: setting(3)
    type(memory_t) :: memory
    type(model_t) :: model
    integer :: i, j, k

    do i = 1, 3
      do j = 1, 3
        do k = 1, 2
          setting(1) = second(i)
          setting(2) = mesh(j)
          setting(3) = corner(k)
          call solve("channel", memory, model, setting)
          call expect(memory%steps == 30, second(i)//" "//mesh(j)//" "//corner(k)//": 300 cm")
          if (memory%steps /= 30 .or. i > 1 .or. j == 2 .or. k == 2) cycle
          call expect_close(memory%record(30)%factor/at_300(j), 1.0_wp, 1.0e-3_wp, "F at 300 cm")
        end do
      end do
    end do
  end subroutine channel_robust

  !> The same equilibrium as by displacement control, wherever the points in between lie.
  subroutine channel_arc()
    type(memory_t) :: memory
    type(model_t) :: model
    integer :: n

    call solve("channel_arc", memory, model)
    n = memory%steps
    if (n == 0) return
    call expect_close(memory%results(n)%marker(3, 1), -150.0_wp, 1.0e-8_wp, "ends at STOP exactly")
    call expect_close(memory%record(n)%factor/12.6174_wp, 1.0_wp, 1.0e-3_wp, "F at 150 cm")
    call expect_few_iterations(memory, "arc length")
  end subroutine channel_arc

  !> Williams' toggle is lost at 33.86: the steps before are kept, the run ends with status 4.
  subroutine required()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("../path/lee", memory, model, error, ["stability=REQUIRED"])
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(error%status == exit_solve, "status 4")
    call expect(index(error%message, "stability is REQUIRED and lost at load factor 1.855") > 0, &
                "where, got '"//error%message//"'")
    call expect(all(memory%record(:memory%steps)%unstable == 0), "only stable steps are kept")
  end subroutine required

end module test_path
