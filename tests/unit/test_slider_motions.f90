!> Models with SLIDER and CARRIAGE, from decks of tests/cases/slider, against closed forms.
module test_slider_motions
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_solve
  use deck_samples, only: read_sound, frame
  use model_data, only: model_t, joint_slider, joint_carriage, rotational, mode_fixed, &
                        mode_flexible, mode_released
  use memory_recorder, only: memory_t, run_deck, run_sound, node_index
  use rotation, only: cross
  use text, only: to_text
  implicit none
  private

  public :: run_slider_motions_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  character(len=*), parameter :: folder = "../slider/"

contains

  subroutine run_slider_motions_tests()
    call run("slider: cards", cards)
    call run("slider: a load driven along a supported beam", supported)
    call run("slider: forces and moments balance on a beam bent far", bent)
    call run("slider: a bead on an incline, s = g sin(a) t^2/2", incline)
    call run("slider: a bead on a turning rod, s = s0 cosh(w t), of second order", turning_rod)
    call run("slider: a carriage driven along a turning rod, in polar coordinates", driven)
    call run("slider: a moving force on a beam, against the series of Fryba", moving_force)
    call run("slider: energy of a mass that slides along a flexing beam", energy)
    call run("slider: around half a circle of straight beams", arch)
    call run("slider: frequencies, buckling and damping", small_motions)
    call run("slider: the trolley of the examples", trolley)
    call run("slider: who left its beam, and when", over_the_end)
  end subroutine run_slider_motions_tests

  !> F a2 b2/(3 EI l) at the ends of the elements; between them what a cubic lacks, the deflection
  !> of a clamped element under the same force, F a3 b3/(3 EI l3).
  subroutine supported()
    real(wp), parameter :: ei = 100, length = 2, part = 0.5_wp, force = 1.0e-3_wp
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: a, b, w, inside(2)
    integer :: i, s

    call run_sound(folder//"supported", memory, model)
    s = node_index(model, 9)
    do i = 0, 20
      a = i*length/20
      b = length - a
      inside(1) = modulo(a, part)
      inside(2) = part - inside(1)
      w = force*(a**2*b**2/(3*ei*length) - product(inside**3)/(3*ei*part**3))
      associate (now => memory%results(memory%steps - 20 + i))
        call expect_close(now%displacement(:, s), [a, 0.0_wp, -w], 1.0e-6_wp*force/ei, "place")
        call expect_close(now%joint_strain(:3, 1), [a, 0.0_wp, 0.0_wp], 1.0e-14_wp, "strains")
        call expect_close(now%joint_stress(2:3, 1), [0.0_wp, -force], 1.0e-6_wp*force, &
                          "force on the slider")
        call expect_close(now%reaction(3, 1), force*b/length, 1.0e-6_wp*force, "reaction")
      end associate
    end do
  end subroutine supported

  !> The clamp's force and moment about the origin against those of the load where the node is;
  !> the slider's three forces have the load's size, but that along the line is per length of the
  !> undeformed beam, and the cubic with its slopes of length 1 is stretched a little.
  subroutine bent()
    real(wp), parameter :: force(3) = 6*[2.0_wp, 5.0_wp, -40.0_wp], length = 900
    real(wp), parameter :: tolerance = 1.0e-6_wp*norm2(force)
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: place(3)
    integer :: i, s

    call run_sound(folder//"bent", memory, model)
    call expect(memory%steps == 40, "all steps")
    s = node_index(model, 9)
    do i = 11, memory%steps
      associate (now => memory%results(i))
        place = model%node(s)%position + now%displacement(:, s)
        call expect_close(now%reaction(1:3, 1), -force, tolerance, "force of the clamp")
        call expect_close(now%reaction(4:6, 1), -cross(place, force), tolerance*length, &
                          "moment of the clamp")
        call expect_close(norm2(now%joint_stress(:3, 1))/norm2(force), 1.0_wp, 2.0e-3_wp, &
                          "force on the slider")
      end associate
    end do
    call expect(norm2(place - [800.0_wp, 0.0_wp, 0.0_wp]) > 600, "bent far")
  end subroutine bent

  !> The motion is a polynomial of second degree: the integration is exact.
  subroutine incline()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: t, way
    integer :: i, s

    call run_sound(folder//"incline", memory, model)
    s = node_index(model, 9)
    do i = 1, memory%steps
      t = (i - 1)*0.02_wp
      way = 2.5_wp*t**2
      associate (now => memory%results(i))
        call expect_close(now%displacement(:, s), way*[cos(pi/6), 0.0_wp, -sin(pi/6)], 1.0e-11_wp, &
                          "place")
        call expect_close(now%joint_strain(1, 1), way, 1.0e-11_wp, "way")
        call expect_close(now%joint_rate(1, 1), 5*t, 1.0e-11_wp, "speed")
        call expect_close(norm2(now%joint_stress(2:3, 1)), 20*cos(pi/6), 1.0e-8_wp, &
                          "normal force")
      end associate
    end do
  end subroutine incline

  !> With steps h and h/2, the error a quarter; what is extrapolated is exact to fourth order.
  subroutine turning_rod()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: error(2)
    integer :: k

    do k = 1, 2
      call run_sound(folder//"rod", memory, model, ["h="//to_text(0.02_wp/k)])
      associate (strain => memory%results(memory%steps)%joint_strain)
        error(k) = strain(1, findloc(model%joint%id, 5, 1)) + 1 - cosh(2.5_wp)
      end associate
    end do
    call expect(abs(error(1)) < 1.0e-3_wp*cosh(2.5_wp), "near")
    call expect_close(error(1)/error(2), 4.0_wp, 0.02_wp, "second order")
  end subroutine turning_rod

  !> s = 1 + 2t - t2/8, angle t + t2/4: velocity, acceleration and the forces m a of the joint;
  !> the carriage turns with the rod.
  subroutine driven()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: t, s(0:2), w(0:2), radial, across, e(3, 2)
    integer :: i, n, j

    call run_sound(folder//"driven", memory, model)
    n = node_index(model, 9)
    j = findloc(model%joint%id, 5, 1)
    do i = 1, memory%steps
      t = (i - 1)*0.1_wp
      s = [1 + 2*t - 0.125_wp*t**2, 2 - 0.25_wp*t, -0.25_wp]
      w = [t + 0.25_wp*t**2, 1 + 0.5_wp*t, 0.5_wp]
      e = reshape([cos(w(0)), sin(w(0)), 0.0_wp, -sin(w(0)), cos(w(0)), 0.0_wp], [3, 2])
      radial = s(2) - s(0)*w(1)**2
      across = s(0)*w(2) + 2*s(1)*w(1)
      associate (now => memory%results(i))
        call expect_close(model%node(n)%position + now%displacement(:, n), s(0)*e(:, 1), &
                          1.0e-12_wp, "place")
        call expect_close(now%velocity(1:3, n), s(1)*e(:, 1) + s(0)*w(1)*e(:, 2), 1.0e-11_wp, &
                          "velocity")
        call expect_close(now%velocity(4:6, n), [0.0_wp, 0.0_wp, w(1)], 1.0e-11_wp, "spin")
        call expect_close(now%acceleration(1:3, n), radial*e(:, 1) + across*e(:, 2), 1.0e-10_wp, &
                          "acceleration")
        call expect_close(norm2(now%joint_stress(2:3, j)), abs(2*across), 1.0e-9_wp, &
                          "across")
        call expect_close(now%joint_stress(1, j), -2*radial, 1.0e-9_wp, "driving force")
        call expect_close(norm2(now%joint_stress(4:6, j)), 0.3_wp*w(2), 1.0e-9_wp, "moment")
      end associate
    end do
  end subroutine driven

  !> Deflection of the middle. Beside the error of the steps, 1e-3 of the largest one with some 30
  !> in the period of the third mode, that of the cubics, as in `supported`.
  subroutine moving_force()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp), parameter :: largest = 1.0e-3_wp/48
    real(wp) :: w
    integer :: i, middle

    call run_sound(folder//"moving_load", memory, model)
    middle = findloc(model%node%id == 1 .and. model%node%part == 4, .true., 1)
    call expect(memory%steps == 21, "all steps")
    do i = 1, memory%steps
      w = -1.0e-3_wp*fryba(0.5_wp, (i - 1)*0.05_wp)
      call expect_close(memory%results(i)%displacement(3, middle), w, 2.0e-3_wp*largest, "middle")
    end do
  end subroutine moving_force

  !> A unit force that enters a beam of unit length, rigidity and mass at time 0 and crosses it in
  !> unit time: L. Fryba, Vibration of solids and structures under moving loads, 1999, (1.28).
  pure real(wp) function fryba(x, t)
    real(wp), intent(in) :: x, t
    real(wp) :: own, drive
    integer :: n

    fryba = 0
    do n = 1, 200
      own = (n*pi)**2
      drive = n*pi
      fryba = fryba + 2*sin(n*pi*x)*(sin(drive*t) - drive/own*sin(own*t))/(own**2 - drive**2)
    end do
  end function fryba

  !> What is missing in the balance shrinks with the square of the step, over four passages from
  !> element to element.
  subroutine energy()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: missing(2), fall
    integer :: k, s

    do k = 1, 2
      call run_sound(folder//"flexing", memory, model, ["h="//to_text(0.004_wp/2**(k - 1))])
      s = node_index(model, 9)
      associate (now => memory%results(memory%steps))
        fall = -10*now%displacement(3, s)
        missing(k) = now%energy(1) + now%energy(2) - now%energy(3)
        call expect(now%joint_strain(1, 1) > 1, "it has slid over several elements")
      end associate
    end do
    call expect(abs(missing(1)) < 1.0e-2_wp*fall, "near")
    call expect(abs(missing(2)) < 0.4_wp*abs(missing(1)), "second order")
  end subroutine energy

  !> A cubic with the tangents of an arc of half angle f, and its chord for both slopes, is off by
  !> r f^4/8 in the middle; the carriage keeps the tangent.
  subroutine arch()
    real(wp), parameter :: r = 2, half = pi/24
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: place(3), turn
    integer :: i, s

    call run_sound(folder//"arch", memory, model)
    call expect(memory%steps == 63, "all steps")
    s = node_index(model, 99)
    do i = 1, memory%steps
      associate (now => memory%results(i))
        place = model%node(s)%position + now%displacement(:, s) - [0.0_wp, 0.0_wp, r]
        turn = 2*atan2(-now%euler(3, s), now%euler(1, s))
        call expect_close(norm2(place)/r, 1.0_wp, 1.1_wp*half**4/8, "radius")
        call expect_close(place/norm2(place), [sin(turn), 0.0_wp, -cos(turn)], half**3, "tangent")
        call expect_close(now%velocity(1:3, s)/norm2(now%velocity(1:3, s)), &
                          [cos(turn), 0.0_wp, sin(turn)], 1.0e-12_wp, "along the line")
      end associate
    end do
  end subroutine arch

  !> Reactions under the weights of trolley and girder, which moves along little; the axles keep
  !> their distance, the front one goes where it is driven.
  subroutine trolley()
    real(wp), parameter :: g = 9.81_wp, weight = 1400*g, span = 12
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: girder
    integer :: i

    call run_sound("../../../decks/trolley", memory, model)
    call expect(memory%steps == 2 + 61, "all steps")
    associate (section => model%section(1)%constants)
      girder = 7850*section%a*g*span
    end associate
    associate (now => memory%results(2))
      call expect_close(now%reaction(3, 1), 0.75_wp*weight + girder/2, 1.0e-3_wp*weight, "reaction")
      call expect_close(sum(now%reaction(3, :)), weight + girder, 1.0e-6_wp*weight, "weights")
      call expect_close(-sum(now%joint_stress(3, :)), weight, 1.0e-5_wp*weight, "axles")
    end associate
    do i = 3, memory%steps
      associate (way => memory%results(i)%joint_strain(1, :), t => min(4.0_wp, (i - 3)*0.1_wp))
        call expect_close(way(2), 3*(1 - cos(pi*t/4)), 1.0e-10_wp, "driven")
        call expect_close(way(1), way(2), 1.0e-4_wp, "distance")
      end associate
    end do
  end subroutine trolley

  subroutine over_the_end()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck(folder//"incline", memory, model, error, ["a=1.5"])
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(error%status == exit_solve, "no solution")
    call expect(index(error%message, "beyond time 1.41") > 0, "when: "//error%message)
    call expect(index(error%message, "element 5 (slider) leaves its beam") > 0, "who")
  end subroutine over_the_end

  !> Small motions: the forces of a slider have a stiffness of their own, its mode a spring and a
  !> damper. Rod with a spring k at its foot and a mass or force at s: w^2 = (k + m g s)/(m s^2),
  !> P = k/s; a mass on a rail: w = 10, a tenth of the critical damping twice.
  subroutine small_motions()
    real(wp), parameter :: s = 2.5_wp, ratio = 0.2_wp, w = 10*sqrt(1 - ratio**2)
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: t
    integer :: i

    call run_sound(folder//"pendulum", memory, model)
    call expect_close(2*pi*memory%spectrum(1)%frequency(1), sqrt((5 + 20*s)/(2*s**2)), 1.0e-9_wp, &
                      "swing")
    call run_sound(folder//"inverted", memory, model)
    call expect_close(memory%spectrum(1)%multiplier(1), 30/s, 1.0e-9_wp, "buckling")
    call run_sound(folder//"damped", memory, model)
    call expect_close([memory%spectrum(1)%frequency(1), memory%spectrum(1)%damping(1)], &
                      [w/(2*pi), ratio], 1.0e-9_wp, "damped")
    do i = 2, memory%steps
      t = (i - 1)*0.1_wp
      call expect_close(memory%results(i)%joint_strain(1, 1), exp(-10*ratio*t)*sin(w*t)/w, &
                        1.0e-5_wp, "damped motion")
    end do
  end subroutine small_motions

  !> Along a part and a divided beam, in the order of a group; along ALL that are beams.
  subroutine cards()
    integer, parameter :: f = mode_fixed
    type(model_t) :: model

    call read_sound(frame//"FIX 1|NODE 3 8 0 0|BEAM 2 2 3 DIVIDE 3|NODE 9 5 0 0|"// &
                    "SLIDER 3 9 ALONG line|GROUP line ELEMENTS 1 2.1:2.2|"// &
                    "CARRIAGE 4 19 ALONG ALL|NODE 19 1 0.5 0|DYNE 3 1|EDAMP 3 2", model)
    call expect(size(model%joint) == 2, "the sizes")
    if (size(model%joint) /= 2) return
    associate (slider => model%joint(1), carriage => model%joint(2))
      call expect(slider%kind == joint_slider .and. carriage%kind == joint_carriage, "kinds")
      call expect(all(slider%track == [1, 2, 3]) .and. all(carriage%track == [1, 2, 3, 4]), "beams")
      call expect(all(slider%status(:3) == [mode_flexible, f, f]), "three modes")
      call expect(all(carriage%status == [mode_released, f, f, f, f, f]), "six modes")
      call expect(all(model%node(slider%node(:1, 2))%id == 9) .and. all(slider%node(:, 1) == 0) &
                  .and. slider%node(2, 2) == 0, "the node of the slider")
      call expect(all(model%node(carriage%node(:, 2))%id == 19), "the node of the carriage")
      call expect(.not. model%node(slider%node(1, 2))%exists(rotational) .and. &
                  model%node(carriage%node(1, 2))%exists(rotational), "what exists")
    end associate
  end subroutine cards

end module test_slider_motions
