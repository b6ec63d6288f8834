!> Mechanisms drawn in a singular position: which constraints count, and where the motion goes.
module test_singular_start
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use json_numbers, only: member, elements, numbers, word
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_deck
  use program_runs, only: outcome_t, run_spar
  implicit none
  private

  public :: run_singular_start_tests

  character(len=*), parameter :: cases = "../singular/"
  character(len=4), parameter :: no_settings(0) = [character(len=4) :: ]
  real(wp), parameter :: pi = acos(-1.0_wp), w = 2*pi

contains

  subroutine run_singular_start_tests()
    call run("singular start: flat parallelogram, the coupler stays parallel", parallelogram)
    call run("singular start: flat parallelogram, crossed", crossed)
    call run("singular start: forces that are not finite", weighed)
    call run("singular start: the drive alone decides for a rhombus", rhombus)
    call run("singular start: from rest", from_rest)
    call run("singular start: two parallelograms with six constraints too many", double)
    call run("singular start: a row of parallelograms, a sparse matrix", row)
    call run("singular start: slider-crank with equal crank and rod", slider_crank)
    call run("singular start: a slider leaves dead centre", dead_centre)
    call run("singular start: TRANSIENT, driven and free", in_time)
    call run("singular start: what cannot be decided is said", undecided)
    call run("singular start: spar check", explained)
  end subroutine run_singular_start_tests

  subroutine follow(name, memory, settings, steps)
    character(len=*), intent(in) :: name, settings(:)
    type(memory_t), intent(out) :: memory
    integer, intent(in) :: steps           !< with the start
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: i

    call run_deck(cases//name, memory, model, error, settings)
    call expect(.not. allocated(error), name//": no error")
    if (allocated(error)) call expect(.false., error%message)
    call expect(memory%steps == steps, name//": steps")
    do i = 1, memory%steps
      call expect(memory%record(i)%last%constraint <= 1.0e-11_wp, name//": constraints hold")
    end do
  end subroutine follow

  !> Both masses circle at a steady speed: only the cranks carry a force, m w^2 a.
  subroutine parallelogram()
    type(memory_t) :: memory
    integer :: i

    call follow("given", memory, no_settings, 101)
    call expect(size(memory%remarks) == 1, "forces are finite")
    do i = 1, memory%steps
      associate (now => memory%results(i), angle => w*0.01_wp*(i - 1))
        call expect_close(now%joint_strain(1, [1, 2, 4]), [angle, -angle, angle], 1.0e-11_wp, &
                          "angles")
        call expect_close(now%velocity(:2, 4), w*[-sin(angle), cos(angle)], 1.0e-9_wp*w, "velocity")
        call expect_close(now%acceleration(:2, 4), -w**2*[cos(angle), sin(angle)], 1.0e-8_wp*w**2, &
                          "acceleration")
        call expect_close(now%stress(1, :), w**2*[3, 0, 2], 1.0e-8_wp*3*w**2, "forces")
      end associate
    end do
  end subroutine parallelogram

  !> Its weight across the bars would need an infinite force in line; the angles do not mind.
  subroutine weighed()
    type(memory_t) :: memory
    integer :: i

    call follow("weighed", memory, no_settings, 101)
    call expect(size(memory%remarks) == 2, "a warning besides that of the position")
    if (size(memory%remarks) == 2) call expect(index(memory%remarks(2)%s, "infinite") > 0, &
                                               memory%remarks(2)%s)
    do i = 1, memory%steps
      call expect_close(memory%results(i)%joint_strain(1, 4), w*0.01_wp*(i - 1), 1.0e-11_wp, &
                        "rocker")
    end do
  end subroutine weighed

  !> Closed form of the crossed linkage: tan(rocker/2) = -(b + a)/(b - a) tan(crank/2). It passes
  !> another singular position, near which what inertia forces settle to is round-off, other for
  !> each length.
  subroutine crossed()
    real(wp), parameter :: length(5) = [2.0_wp, 2.01_wp, 2.1_wp, 2.5_wp, 3.0_wp], a = 1
    type(memory_t) :: memory
    character(len=40) :: setting(2)
    real(wp) :: crank
    integer :: i, k

    do k = 1, size(length)
      associate (b => length(k))
        write (setting, "(a, f0.16)") "b=", b, "turn=", -2*w*a/(b - a)
        call follow("given", memory, setting, 101)
        do i = 1, memory%steps
          crank = w*0.01_wp*(i - 1)
          associate (rocker => memory%results(i)%joint_strain(1, 4))
            call expect_close(sin(rocker/2)*cos(crank/2)*(b - a) &
                              + cos(rocker/2)*sin(crank/2)*(b + a), 0.0_wp, 1.0e-10_wp, "rocker")
          end associate
        end do
      end associate
    end do
  end subroutine crossed

  !> With a = b the other way on has a crank at rest.
  subroutine rhombus()
    type(memory_t) :: memory
    integer :: i

    call follow("open", memory, ["b=1"], 101)
    do i = 1, memory%steps
      call expect_close(memory%results(i)%joint_strain(1, 4), w*0.01_wp*(i - 1), 1.0e-11_wp, &
                        "rocker")
    end do
  end subroutine rhombus

  subroutine from_rest()
    type(memory_t) :: memory
    real(wp) :: t
    integer :: i

    call follow("rest", memory, no_settings, 101)
    do i = 1, memory%steps
      t = 0.01_wp*(i - 1)
      associate (now => memory%results(i))
        call expect_close(now%joint_strain(1, 4), t**2, 1.0e-11_wp, "rocker")
        call expect_close(now%joint_rate(1, 4), 2*t, 1.0e-9_wp, "its speed")
        call expect_close(now%acceleration(6, 2), 2.0_wp, 1.0e-8_wp, "its acceleration")
      end associate
    end do
  end subroutine from_rest

  subroutine double()
    type(memory_t) :: memory
    integer :: i

    call follow("double", memory, no_settings, 101)
    call expect(size(memory%remarks) == 6 + 2, "redundant everywhere, and only here")
    do i = 1, memory%steps
      associate (now => memory%results(i), angle => w*0.01_wp*(i - 1))
        call expect_close(now%joint_strain(1, :6), angle*[1, 1, 1, -1, -1, -1], 1.0e-10_wp, &
                          "angles")
        call expect(maxval(abs(now%joint_strain(2:, :))) <= 1.0e-11_wp, "tilts")
      end associate
    end do
  end subroutine double

  subroutine row()
    type(memory_t) :: memory
    integer :: i, k

    call follow("row", memory, no_settings, 21)
    do i = 1, memory%steps
      associate (turned => memory%results(i)%joint_strain(1, 21:))
        call expect_close(turned, [(w*0.05_wp*(i - 1), k=1, 21)], 1.0e-10_wp, "cranks")
      end associate
    end do
  end subroutine row

  !> x = 2 r cos(angle), or the rod turns with the crank.
  subroutine slider_crank()
    type(memory_t) :: memory
    real(wp) :: t
    integer :: i

    call follow("slider_crank", memory, no_settings, 101)
    do i = 1, memory%steps
      t = 0.01_wp*(i - 1)
      associate (now => memory%results(i))
        call expect_close(now%displacement(1, 3), -sin(w*t), 1.0e-11_wp, "slider")
        call expect_close(now%velocity(1, 3), -w*cos(w*t), 1.0e-9_wp*w, "its velocity")
        call expect_close(now%acceleration(1, 3), w**2*sin(w*t), 1.0e-8_wp*w**2, "its acceleration")
      end associate
    end do
    call follow("slider_crank", memory, ["slide=0"], 101)
    do i = 1, memory%steps
      call expect_close(memory%results(i)%displacement(1, 3), 0.0_wp, 1.0e-11_wp, "slider at rest")
    end do
  end subroutine slider_crank

  !> x = 3 - t^2 = cos(crank) + sqrt(4 - sin^2(crank)): cosines.
  subroutine dead_centre()
    type(memory_t) :: memory
    real(wp) :: x
    integer :: i

    call follow("dead_started", memory, no_settings, 71)
    do i = 1, memory%steps
      x = 3 - (0.01_wp*(i - 1))**2
      associate (now => memory%results(i))
        call expect_close(cos(now%joint_strain(1, 1)), (x**2 - 3)/(2*x), 1.0e-11_wp, "crank")
        call expect(now%joint_strain(1, 1) > -1.0e-12_wp, "its way")
      end associate
    end do
    call expect_close(memory%results(1)%joint_rate(1, 1), 2/sqrt(3.0_wp), 1.0e-11_wp, &
                      "at dead centre")
  end subroutine dead_centre

  !> Without drive the masses keep their energy on circles: a steady speed of 3 rad a second;
  !> the integration errs by about (w h)^2/12 of the angle.
  subroutine in_time()
    type(memory_t) :: memory
    integer :: i

    call follow("transient", memory, no_settings, 201)
    do i = 1, memory%steps
      associate (angle => w*0.005_wp*(i - 1))
        call expect_close(memory%results(i)%joint_strain(1, [1, 2, 4]), [angle, -angle, angle], &
                          1.0e-9_wp, "driven")
      end associate
    end do
    call follow("free", memory, no_settings, 201)
    do i = 1, memory%steps
      associate (now => memory%results(i)%joint_strain(1, :), angle => 3*0.005_wp*(i - 1))
        call expect_close(now([2, 4]), now(1)*[-1, 1], 1.0e-9_wp, "free")
        call expect_close(now(1), angle, angle*(3*0.005_wp)**2 + 1.0e-12_wp, "its speed")
      end associate
    end do
  end subroutine in_time

  subroutine undecided()
    call expect_refused("open", "", "KINEMATIC starts in a singular position, where element 3 "// &
                        "mode 1 (elongation) depends on others: more than one motion goes on")
    call expect_refused("double_open", "", "more than one motion goes on as prescribed; draw "// &
                        "the model a little off it, or say by STARTDX")
    call expect_refused("given", "turn=1", "no motion was found that goes on as prescribed")
    call expect_refused("dead_centre", "", "hold against it in the singular position")
    call expect_refused("dead_centre", "speed=0", "no motion was found")
    call expect_refused("taut", "", "nothing moves yet, and which way it will go is open")
    call expect_refused("driven_static", "", "STATIC needs a structure, and not a singular "// &
                        "position")
    call expect_refused("sprung_static", "", "if the model is drawn in a singular position, "// &
                        "draw it a little off")
  end subroutine undecided

  subroutine expect_refused(name, setting, part)
    character(len=*), intent(in) :: name, setting, part
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    character(len=40) :: settings(merge(1, 0, setting /= ""))

    settings = setting
    call run_deck(cases//name, memory, model, error, settings)
    call expect(allocated(error), name//": refused")
    if (allocated(error)) call expect(index(error%message, part) > 0, "'"//part//"' in: "// &
                                      error%message)
  end subroutine expect_refused

  subroutine explained()
    call expect_report("given", 0, 0, 1, 0)
    call expect_report("double", 0, 6, 2, 0)
    call expect_report("open", 3, 0, 1, 0)
    call expect_report("free", 0, 0, 1, 1)
    call expect_report("taut", 3, 0, 1, 0)
  end subroutine explained

  subroutine expect_report(name, status, redundant, singular, motions)
    character(len=*), intent(in) :: name
    integer, intent(in) :: status, redundant, singular, motions
    type(outcome_t) :: outcome
    character(len=:), allocatable :: entry
    real(wp), allocatable :: weights(:)

    call run_spar("check --json tests/cases/singular/"//name//".deck", outcome)
    call expect(outcome%status == status, name//": status")
    call expect_number(outcome%output, "constraints", "redundant", redundant, name)
    call expect_number(outcome%output, "constraints", "singular", singular, name)
    call expect_number(outcome%output, "degrees_of_freedom", "free_motions", motions, name)
    entry = elements(member(outcome%output, "singular"), 1)
    call expect(index(word(member(entry, "text")), &
                      "drawn in a singular position: element 1 mode 1") == 1, name//": text")
    allocate (weights, source=numbers(member(entry, "weights")))
    call expect(maxval(abs(abs(weights) - 1)) <= 1.0e-12_wp, name//": equal forces in line")
  end subroutine expect_report

  subroutine expect_number(report, object, key, number, what)
    character(len=*), intent(in) :: report, object, key, what
    integer, intent(in) :: number
    real(wp) :: found(1)

    found = numbers(member(member(report, object), key)//" ")
    call expect_close(found(1), real(number, wp), 0.1_wp, what//": "//object//" "//key)
  end subroutine expect_number

end module test_singular_start
