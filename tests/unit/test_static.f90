!> Whole decks against closed forms, published numbers and statics.
module test_static
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use model_data, only: model_t
  use rotation, only: cross
  use system_results, only: results_t
  use memory_recorder, only: memory_t, run_sound, node => node_index
  implicit none
  private

  public :: run_static_tests

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_static_tests()
    call run("static: elastica table (STA-01)", elastica)
    call run("static: roll-up to a full circle, any plane", roll_up)
    call run("static: thick Reissner cantilever (STA-05)", reissner)
    call run("static: non-uniform torsion with bimoment (STA-13)", torsion)
    call run("static: 45-degree bend (STA-07)", bend)
    call run("static: small load on the paper's channel (STA-16)", small_channel)
    call run("static: channel at the web corner, independent values", large_channel)
    call run("static: rigid frame carries its load exactly", rigid_frame)
    call run("static: released bending modes make a hinge", release)
    call run("static: dead weight, consistent mass exact", weight)
    call run("static: dead weight of a beam with a hinge at its end", propped_weight)
    call run("static: weight of a rigid BEAM beside a BEAMW", neighbour_weight)
    call run("static: cantilever, P L**2/EI = 5, fine and coarse", cantilever)
    call run("static: global equilibrium of a space frame at large displacements", equilibrium)
    call run("static: single rotations held, forks", forks)
    call run("static: patch test of an unsymmetric section", patch)
  end subroutine run_static_tests

  !> Index of an element or its part.
  pure integer function member(model, id, part)
    type(model_t), intent(in) :: model
    integer, intent(in) :: id, part

    member = findloc(model%member%id == id .and. model%member%part == part, .true., 1)
  end function member

  !> w/L, u/L, theta of Mattiasson, IJNME 17 (1981) 145, from elliptic integrals.
  subroutine elastica()
    real(wp), parameter :: table(3, 15) = reshape([ &
      0.06636448214482982_wp, 0.00264654834052358_wp, 0.0996361630374017_wp, &
      0.13097524208521372_wp, 0.01035392154903847_wp, 0.19715462370320727_wp, &
      0.19235027968744933_wp, 0.02248766797902879_wp, 0.29073776684116504_wp, &
      0.24945154202800157_wp, 0.038165613240481844_wp, 0.37906300761322104_wp, &
      0.3017207737998131_wp, 0.05643323628337693_wp, 0.4613519497118789_wp, &
      0.4109782112482583_wp, 0.10794150068355901_wp, 0.6395398261507788_wp, &
      0.4934574803967118_wp, 0.16064172082516703_wp, 0.7817498315565433_wp, &
      0.6032534411299775_wp, 0.25442018456418725_wp, 0.9860169467113539_wp, &
      0.6699641812776665_wp, 0.32894124224684607_wp, 1.1212393474875757_wp, &
      0.7137915236119128_wp, 0.38762836072442997_wp, 1.2153681176116804_wp, &
      0.7445711488895153_wp, 0.4345888286819053_wp, 1.2836972858012436_wp, &
      0.7673690997404633_wp, 0.47292742838633695_wp, 1.334959857471854_wp, &
      0.7849823749533147_wp, 0.5048277321335317_wp, 1.3744315067013924_wp, &
      0.7990555274708401_wp, 0.5318205626725272_wp, 1.4054653336239527_wp, &
      0.8106090248802965_wp, 0.5549955977537513_wp, 1.4302855388038576_wp], [3, 15])
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: factor
    integer :: i, tip

    call run_sound("elastica", memory, model)
    call expect(memory%steps == 15, "15 steps")
    if (memory%steps /= 15) return
    tip = node(model, 2)
    do i = 1, 15
      associate (r => memory%results(i))
        factor = merge(0.2_wp*i, merge(0.5_wp*(i - 3), real(i - 5, wp), i <= 7), i <= 5)
        call expect_close(memory%record(i)%factor, factor, 1.0e-12_wp, "load factor")
        call expect_close([r%displacement(3, tip), -r%displacement(1, tip), &
                           2*asin(norm2(r%euler(2:4, tip)))]/table(:, i), [1, 1, 1]*1.0_wp, &
                          1.0e-3_wp, "w, u, theta over the table's")
      end associate
    end do
    call expect(all(memory%completed), "three complete analyses")
  end subroutine elastica

  !> The circle closes by symmetry. An element bent by an angle a has the chord 1 - a**2/24, where
  !> the arc has sin(a/2)/(a/2): a**4/1920 too short, here 5.07e-6 of the tip's 2/pi, 3.23e-6.
  subroutine roll_up()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: across(3), angle
    character(len=40) :: setting
    integer :: i, tip

    do i = 0, 3
      angle = i*pi/6 + merge(pi/12, 0.0_wp, i == 2) ! 0, 30, 75, 90 degrees
      if (i == 1) angle = pi/4
      write (setting, "('angle=', f20.17)") angle
      call run_sound("rollup", memory, model, [setting])
      if (memory%steps /= 10) cycle
      tip = node(model, 2)
      across = [0.0_wp, sin(angle), cos(angle)]
      call expect_close(memory%results(5)%displacement(:, tip), 2/pi*across - [1, 0, 0], &
                        3.3e-6_wp, "tip of the half circle")
      call expect_close(memory%results(10)%displacement(:, tip), [-1, 0, 0]*1.0_wp, 1.0e-9_wp, &
                        "tip of the full circle")
      call expect_close(abs(memory%results(10)%euler(1, tip)), 1.0_wp, 1.0e-9_wp, "one full turn")
    end do
  end subroutine roll_up

  !> Exact boundary-value problem; Exudyn with 1024 elements: 0.15097102, 0.71056836.
  subroutine reissner()
    type(memory_t) :: memory
    type(model_t) :: model
    integer :: tip

    call run_sound("reissner", memory, model)
    if (memory%steps == 0) return
    tip = node(model, 2)
    associate (r => memory%results(memory%steps))
      call expect_close([r%displacement(1, tip)/(-0.15097114423924163_wp), &
                         r%displacement(3, tip)/0.7105685978535591_wp, &
                         2*asin(norm2(r%euler(2:4, tip)))/0.520173166011599_wp], [1, 1, 1]*1.0_wp, &
                        1.0e-3_wp, "ux, uy, theta over the exact ones")
    end associate
    call run_sound("reissner", memory, model, ["f=62500"])
    if (memory%steps == 0) return
    associate (r => memory%results(memory%steps))
      call expect_close([r%displacement(3, tip)/0.000809903253976943_wp, &
                         2*asin(norm2(r%euler(2:4, tip)))/0.0005797100700099412_wp], &
                        [1, 1]*1.0_wp, 1.0e-4_wp, "small load")
    end associate
  end subroutine reissner

  !> phi and alpha at the tip, bimoment at root and middle, phi in the middle; signs by theory 3.
  subroutine torsion()
    real(wp), parameter :: vlasov(5) = [0.1429933847944761_wp, 0.06764367865736184_wp, &
      1462.1116462809773_wp, 478.4280824277234_wp, 0.04800727871506671_wp]
    real(wp), parameter :: reissner(5) = [0.14319147184269163_wp, 0.06758276781921033_wp, &
      1459.9812276961538_wp, 478.18180419941837_wp, 0.0481824667294339_wp]

    call compare("shear=OFF", vlasov)
    call compare("shear=ON ", reissner)

  contains

    subroutine compare(setting, wanted)
      character(len=*), intent(in) :: setting
      real(wp), intent(in) :: wanted(5)
      type(memory_t) :: memory
      type(model_t) :: model
      real(wp) :: got(5)

      call run_sound("torsion", memory, model, [setting])
      if (memory%steps == 0) return
      associate (r => memory%results(1))
        got(1) = 2*r%euler(2, node(model, 3))
        got(2) = r%warping(node(model, 3))
        got(3) = r%force_p(7, member(model, 1, 1))
        got(4) = r%force_p(7, member(model, 2, 1))
        got(5) = 2*r%euler(2, node(model, 2))
        call expect_close(r%reaction(7, node(model, 1))/got(3), -1.0_wp, 1.0e-9_wp, &
                          "bimoment of the clamp")
        call expect_close(r%force_p(4, member(model, 2, 1)), 1.0e-3_wp, 1.0e-9_wp, "torque")
      end associate
      call expect_close(1.0e6_wp*got/wanted, spread(1.0_wp, 1, 5), 1.0e-4_wp, setting)
    end subroutine compare

  end subroutine torsion

  !> Exact Reissner shooting with torsion constant 0.14058.
  subroutine bend()
    real(wp), parameter :: wanted(3, 2) = reshape([58.53593262078093_wp, 22.11261452045166_wp, &
      40.4802615804349_wp, 46.8919247814248_wp, 15.5577858239729_wp, 53.6073692656757_wp], [3, 2])
    type(memory_t) :: memory
    type(model_t) :: model
    integer :: i

    call run_sound("bend45", memory, model)
    if (memory%steps /= 6) return
    associate (tip => node(model, 9))
      do i = 1, 2
        call expect_close((memory%results(3*i)%displacement(:, tip) + model%node(tip)%position) &
                          /wanted(:, i), [1, 1, 1]*1.0_wp, 6.0e-3_wp, "tip over the exact one")
      end do
    end associate
  end subroutine bend

  !> Bending and shear deflection of the shear centre and twist, closed forms per kN.
  subroutine small_channel()
    type(memory_t) :: memory
    type(model_t) :: model

    call run_sound("channel", memory, model, ["f=1e-6  ", "z=0     ", "shear=ON"])
    if (memory%steps == 0) return
    associate (r => memory%results(1))
      call expect_close(-1.0e6_wp*r%marker(3, 2)/(1.43946248968686_wp + 0.0041558409390823_wp), &
                        1.0_wp, 2.0e-3_wp, "deflection of the shear centre")
      call expect_close(-2.0e6_wp*r%euler(2, node(model, 2))/0.010434248783158415_wp, 1.0_wp, &
                        2.0e-3_wp, "twist")
    end associate
  end subroutine small_channel

  !> Theory 10: loads for -w(D) = 3 and 9 cm with ten elements, shear-rigid.
  subroutine large_channel()
    type(memory_t) :: memory
    type(model_t) :: model

    call run_sound("channel", memory, model, ["f=2.0208"])
    if (memory%steps == 0) return
    call expect_close(-memory%results(memory%steps)%marker(3, 1), 3.0_wp, 1.0e-3_wp, "-w(D)")
    call run_sound("channel", memory, model, ["f=5.8472", "steps=8 "])
    if (memory%steps == 0) return
    call expect_close(-memory%results(memory%steps)%marker(3, 1), 9.0_wp, 1.0e-3_wp, "-w(D)")
  end subroutine large_channel

  !> Rigid parts do not move at all; reactions and multipliers follow from statics.
  subroutine rigid_frame()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: force(3, 2), moment(3), place(3)
    integer :: n(2)

    call run_sound("rigid_frame", memory, model)
    if (memory%steps == 0) return
    associate (r => memory%results(1))
      n = [node(model, 3), node(model, 4)]
      call expect_close(r%displacement(:, [node(model, 2), n(1)]), &
                        reshape([0, 0, 0, 0, 0, 0]*1.0_wp, [3, 2]), 1.0e-13_wp, "rigid parts")
      force(:, 1) = [2, -3, -5]
      force(:, 2) = [1.0_wp, 0.5_wp, -2.0_wp]
      place = model%node(n(2))%position + r%displacement(:, n(2))
      moment = [7, 11, 13] + cross(model%node(n(1))%position, force(:, 1)) &
               + cross(place, force(:, 2))
      call expect_close(r%reaction(1:3, node(model, 1)), -sum(force, 2), 1.0e-9_wp, "clamp's force")
      call expect_close(r%reaction(4:6, node(model, 1)), -moment, 1.0e-8_wp, "moment of the clamp")
      call expect_close(r%stress(1, 1), -7.0_wp, 1.0e-9_wp, "multiplier of the column's elongation")
    end associate
  end subroutine rigid_frame

  !> Two cantilevers joined by a hinge share the load by 3EI/L**3.
  subroutine release()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: u(2)

    call run_sound("release", memory, model)
    if (memory%steps == 0) return
    u = 1.0e-8_wp*[3, 5]/(3*[3, 2]*(1.0_wp/8 + 1.0_wp/27))
    associate (r => memory%results(1), middle => node(model, 2))
      call expect_close(r%displacement(2:3, middle), u, 1.0e-9_wp*u(2), "deflection")
      call expect_close(2*r%euler(3:4, middle), [0.5_wp*u(2), -0.5_wp*u(1)], 1.0e-9_wp*u(2), &
                        "slope of the right cantilever")
      call expect_close(r%force_q(5:6, 1), [0, 0]*1.0_wp, 1.0e-15_wp, "no moment in the hinge")
    end associate
  end subroutine release

  !> q L**4/(8 EI), q L**3/(6 EI): nodal values of the cubic element are exact.
  subroutine weight()
    real(wp), parameter :: q = 2.0e-8_wp
    type(memory_t) :: memory
    type(model_t) :: model

    call run_sound("weight", memory, model)
    if (memory%steps == 0) return
    associate (r => memory%results(1), tip => node(model, 2))
      call expect_close(r%displacement(3, tip), -q*625/24, 1.0e-9_wp*q*625/24, "deflection")
      call expect_close(2*r%euler(3, tip), q*125/18, 1.0e-9_wp*q*125/18, "slope")
      call expect_close(r%reaction(3, node(model, 1)), 5*q, 1.0e-12_wp*q, "reaction")
      call expect_close(r%reaction(5, node(model, 1)), -12.5_wp*q, 1.0e-7_wp*q, "clamp's moment")
    end associate
    call run_sound("weight", memory, model, ["mass=LUMPED"])
    if (memory%steps == 0) return
    call expect_close(memory%results(1)%displacement(3, node(model, 2)), &
                      -lumped_deflection(q), 1.0e-9_wp*q*30, "lumped weight")
  end subroutine weight

  !> Forces q L/2 in the middle and q L/4 at the tip of a cantilever, L = 5, EI = 3.
  pure real(wp) function lumped_deflection(q) result(w)
    real(wp), intent(in) :: q

    w = 5*q/4*5.0_wp**3/9 + 5*q/2*2.5_wp**2*(3*5 - 2.5_wp)/18
  end function lumped_deflection

  !> A rigid BEAM has no part in alpha: its section's shear centre does not matter.
  subroutine neighbour_weight()
    type(memory_t) :: memory
    type(model_t) :: model

    call run_sound("neighbour_weight", memory, model)
    call expect(memory%steps == 1, "one step")
    if (memory%steps /= 1) return
    call expect_close(memory%results(1)%warping, spread(0.0_wp, 1, 3), 1.0e-12_wp, "no warping")
    call expect(all(abs(memory%results(1)%load(7, :)) <= 0), "no bimoment")
  end subroutine neighbour_weight

  !> The benchmark's cantilever: its exact tip with shear and stretch, to 5e-6 of the length with 10
  !> elements and 1e-8 with 100, in 5 steps of at most 5 iterations.
  subroutine cantilever()
    real(wp), parameter :: wanted(2) = [6.123556717_wp, 7.138589642_wp]
    character(len=5), parameter :: mesh(2) = ["n=10 ", "n=100"]
    real(wp), parameter :: tolerance(2) = [5.0e-6_wp, 1.0e-8_wp]
    type(memory_t) :: memory
    type(model_t) :: model
    integer :: i, tip

    do i = 1, 2
      call run_sound("../../bench/cantilever", memory, model, [mesh(i)])
      call expect(memory%steps == 5, "all steps")
      if (memory%steps /= 5) cycle
      tip = node(model, 2)
      call expect_close((memory%results(5)%displacement(1:2, tip) + [10, 0] - wanted)/10, &
                        [0, 0]*1.0_wp, tolerance(i), "tip "//mesh(i))
      call expect(sum(memory%record(:5)%iterations) <= 25, "at most 25 iterations")
    end do
  end subroutine cantilever

  !> Propped cantilever: q L**2/8 at the clamp, 3/8 q L at the support, no moment there.
  subroutine propped_weight()
    real(wp), parameter :: q = 2.0e-9_wp, l = 5
    type(memory_t) :: memory
    type(model_t) :: model

    call run_sound("propped_weight", memory, model)
    if (memory%steps == 0) return
    associate (r => memory%results(1)%reaction)
      call expect_close(r(5, 1), -q*l**2/8, 1.0e-7_wp*q*l**2, "moment of the clamp")
      call expect_close(r([3, 5], 2), [3*q*l/8, 0.0_wp], 1.0e-7_wp*q*l**2, "support")
    end associate
  end subroutine propped_weight

  !> Loads and reactions balance in the deformed state, forces and moments about the origin.
  subroutine equilibrium()
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: sum_of(6), largest(6), force(7), moment(3)
    integer :: i

    call run_sound("space_frame", memory, model)
    if (memory%steps /= 4) return
    sum_of = 0
    largest = 0
    associate (r => memory%results(4))
      do i = 1, size(model%node)
        force = r%load(:, i) + r%reaction(:, i)
        moment = cross(model%node(i)%position + r%displacement(:, i), force(1:3)) + force(4:6)
        sum_of = sum_of + [force(1:3), moment]
        largest = max(largest, abs([force(1:3), moment]))
      end do
      call expect(maxval(abs(r%displacement)) > 300, "large displacements")
      call expect_close(sum_of(1:3)/maxval(largest(1:3)), [0, 0, 0]*1.0_wp, 1.0e-7_wp, "forces")
      call expect_close(sum_of(4:6)/maxval(largest(4:6)), [0, 0, 0]*1.0_wp, 1.0e-7_wp, "moments")
    end associate
    call expect(all(memory%record(:4)%iterations <= 8), "quadratic convergence with dead moments")
  end subroutine equilibrium

  !> phi = T/(2 GIt k) (kL/2 - tanh(kL/2)) under a torque T in the middle.
  subroutine forks()
    real(wp), parameter :: e = 210.0e9_wp, git = e/2.6_wp*1.3315667e-07_wp, eiw = e*1.1826562e-07_wp
    type(memory_t) :: memory
    type(model_t) :: model
    real(wp) :: k, phi

    call run_sound("fork", memory, model)
    if (memory%steps == 0) return
    k = sqrt(git/eiw)
    phi = 1000/(2*git*k)*(1.5_wp*k - tanh(1.5_wp*k))
    associate (r => memory%results(1))
      call expect_close(2.0e6_wp*r%euler(2, node(model, 2))/phi, 1.0_wp, 1.0e-4_wp, "twist")
      call expect_close(r%reaction(4, [node(model, 1), node(model, 3)]), [-5, -5]*1.0e-4_wp, &
                        1.0e-12_wp, "torques of the forks")
      call expect_close(r%euler(2, node(model, 1)), 0.0_wp, 1.0e-16_wp, "held rotation")
    end associate
  end subroutine forks

  !> One element is exact for end loads (CONSISTENT), so five unequal ones give the same.
  subroutine patch()
    type(memory_t) :: one, five
    type(model_t) :: model
    integer :: tip

    call run_sound("patch", one, model)
    tip = node(model, 2)
    call run_sound("patch", five, model, ["n=5"])
    if (one%steps == 0 .or. five%steps == 0) return
    associate (a => one%results(1), b => five%results(1), end => node(model, 6))
      call expect_close(a%displacement(:, tip)/b%displacement(:, end), [1, 1, 1]*1.0_wp, &
                        1.0e-6_wp, "displacement")
      call expect_close(a%euler(2:4, tip)/b%euler(2:4, end), [1, 1, 1]*1.0_wp, 1.0e-6_wp, "turn")
      call expect_close(a%warping(tip)/b%warping(end), 1.0_wp, 1.0e-6_wp, "warping")
    end associate
  end subroutine patch

end module test_static
