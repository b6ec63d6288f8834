!> Initial velocities against rigid-body kinematics and closed forms of least kinetic energy.
module test_start_velocity
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use deck_samples, only: read_sound
  use memory_recorder, only: memory_t, run_model
  use model_data, only: model_t, joint_t, motion_t, start_t, joint_hinge, mode_flexible, &
                        mode_released
  use nodal_state, only: state_t, coordinate_number, node_coordinates
  use system_data, only: system_t
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_build, only: find_system_pattern
  use system_inertia, only: masses_t, new_masses, mass_product
  use system_results, only: results_t, get_results
  use start_models, only: frame_of_nodes, add_truss, add_joint, add_mass, add_motion, add_start, &
                          start, expect_error
  implicit none
  private

  public :: run_start_velocity_tests

  character(len=*), parameter :: rod = "NODE 1 0 0 0|NODE 2 2 0 0|BEAMW 1 1 2 0 0 1|"// &
                                       "EM 1 3 0 0 0 0 0|", &
    channel = "MATERIAL m E 2e11 G 8e10 RHO 7800|"// &
              "SECTION s C H 0.1 B 0.05 T 0.004 TW 0.003|", &
    finish = "TRANSIENT TEND 0.01 STEP 0.001"

contains

  subroutine run_start_velocity_tests()
    call run("start: a linkage moves as its crank does", linkage)
    call run("start: two links, the second dragged along", dragged_link)
    call run("start: a hinge driven at a rate", driven_hinge)
    call run("start: a free rod, the turn of one end", free_rod)
    call run("start: velocities that contradict each other", conflict)
    call run("start: velocities given twice, in agreement", agreement)
    call run("start: rates of prescribed motions that contradict each other", contrary_motions)
    call run("start: least kinetic energy of a frame", least_energy)
    call run("start: rate of elongation of a spring", elongation_rate)
    call run("start: rates of strain are those of the results", strain_rates)
    call run("start: rate of a released strain", released_rate)
    call run("start: the motion goes on from there", swing)
  end subroutine run_start_velocity_tests

  !> Velocities that must be found.
  subroutine velocities(model, system, state, velocity)
    type(model_t), intent(in) :: model
    type(system_t), intent(out) :: system
    type(state_t), intent(out) :: state
    real(wp), allocatable, intent(out) :: velocity(:)
    type(error_t), allocatable :: error

    call start(model, system, state, velocity, error)
    if (.not. allocated(error)) return
    call expect(.false., "no error, got: "//error%message)
  end subroutine velocities

  !> The six velocities of a node.
  pure function of_node(velocity, node) result(v)
    real(wp), intent(in) :: velocity(:)
    integer, intent(in) :: node
    real(wp) :: v(6)

    v = velocity(node_coordinates*(node - 1) + 1:node_coordinates*(node - 1) + 6)
  end function of_node

  !> Coupler and rocker are rigid: the velocity of their joint along each is known.
  subroutine linkage()
    real(wp), parameter :: at(3, 4) = reshape([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 2.0_wp, 0.0_wp, &
      3.0_wp, 3.0_wp, 0.0_wp, 3.5_wp, 0.0_wp, 0.0_wp], [3, 4])
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)
    real(wp) :: speed

    call frame_of_nodes(at, [1, 4], model)
    call add_truss(model, 1, 2)
    call add_truss(model, 2, 3)
    call add_truss(model, 3, 4)
    call add_mass(model, 3, 2.0_wp)
    call add_start(model, start_t(node=2, component=1, rate=.true., value=5.0_wp))
    call velocities(model, system, state, velocity)
    ! crank vertical: v2 = (5, 0); v3 = speed (3, 0.5), v3.(3, 1) = v2.(3, 1)
    speed = 15/(3*3.0_wp + 0.5_wp)
    call expect_close(velocity(8:10), [5.0_wp, 0.0_wp, 0.0_wp], 1.0e-12_wp, "crank")
    call expect_close(velocity(15:17), speed*[3.0_wp, 0.5_wp, 0.0_wp], 1.0e-12_wp, "rocker")
    call system%free()
  end subroutine linkage

  !> Two rods of length 2 along x with a hinge about z; the first turns about the origin.
  subroutine new_double_pendulum(model)
    type(model_t), intent(out) :: model
    type(joint_t) :: hinge

    call read_sound("NODE 1 0 0 0|NODE 2 2 0 0|NODE 3 4 0 0|NODE 4 2 0 0|"// &
                    "BEAMW 1 1 1 1 2 2 2 0 0 1|BEAMW 2 2 4 4 3 3 3 0 0 1|EM 1:2 3 0 0 0 0 0|"// &
                    "FIX 1 X Y Z RX RY|XF 3 0 0 0|"//finish, model)
    hinge%kind = joint_hinge
    hinge%node(2, :) = [node(model, 2), node(model, 4)]
    hinge%axis(:, 1) = [0.0_wp, 0.0_wp, 1.0_wp]
    hinge%status(1) = mode_released
    call add_joint(model, hinge)
  end subroutine new_double_pendulum

  pure integer function node(model, id)
    type(model_t), intent(in) :: model
    integer, intent(in) :: id

    node = findloc(model%node%id, id, 1)
  end function node

  !> The end of a rod moved across with v: least energy turns it by -3/2 v/l.
  subroutine dragged_link()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)
    real(wp), parameter :: omega = 0.7_wp

    call new_double_pendulum(model)
    call add_start(model, start_t(node=node(model, 1), component=6, rate=.true., value=omega))
    call velocities(model, system, state, velocity)
    call expect_close(of_node(velocity, node(model, 2)), [0.0_wp, 2*omega, 0.0_wp, 0.0_wp, 0.0_wp, &
                                                          omega], 1.0e-12_wp, "the hinge")
    call expect_close(of_node(velocity, node(model, 3)), &
                      [0.0_wp, 2*omega - 1.5_wp*2*omega, 0.0_wp, 0.0_wp, 0.0_wp, -1.5_wp*omega], &
                      1.0e-11_wp, "the far end")
    call system%free()
  end subroutine dragged_link

  !> Both rods at rest in the hinge's frame but for its rate: momenta about the pin balance, so the
  !> angular velocities w and w + 3 give zero total angular momentum.
  subroutine driven_hinge()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)
    real(wp), parameter :: rate = 3.0_wp, m = 6.0_wp, l = 2.0_wp
    real(wp) :: whole, part, omega

    call new_double_pendulum(model)
    call add_motion(model, motion_t(joint=1, mode=1, velocity=rate))
    call velocities(model, system, state, velocity)
    whole = m*(2*l)**2*2/3              ! of both about the pin
    part = m*l**2/12 + m*1.5_wp*l*l/2   ! of the second turning about the hinge, about the pin
    omega = -rate*part/whole
    call expect_close(velocity(coordinate_number(node(model, 1), 6)), omega, 1.0e-11_wp, "first")
    call expect_close(velocity(coordinate_number(node(model, 3), 6)), omega + rate, 1.0e-11_wp, &
                      "second")
    call system%free()
  end subroutine driven_hinge

  !> It turns about its middle.
  subroutine free_rod()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)

    call read_sound(rod//finish, model)
    call add_start(model, start_t(node=1, component=6, rate=.true., value=1.5_wp))
    call velocities(model, system, state, velocity)
    call expect_close(of_node(velocity, 1), [0.0_wp, -1.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.5_wp], &
                      1.0e-12_wp, "one end")
    call expect_close(of_node(velocity, 2), [0.0_wp, 1.5_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.5_wp], &
                      1.0e-12_wp, "the other")
    call system%free()
  end subroutine free_rod

  subroutine conflict()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(error_t), allocatable :: error
    real(wp), allocatable :: velocity(:)

    call read_sound(rod//finish, model)
    call add_start(model, start_t(node=1, component=1, rate=.true., value=1.0_wp))
    call add_start(model, start_t(node=2, component=1, rate=.true., value=2.0_wp))
    call start(model, system, state, velocity, error)
    call expect_error(error, "STARTDX: node 2 X cannot change at a rate of 2: constraints, "// &
                      "prescribed motions and other initial velocities contradict it")
    call system%free()
  end subroutine conflict

  subroutine agreement()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)

    call read_sound(rod//finish, model)
    call add_start(model, start_t(node=1, component=1, rate=.true., value=2.0_wp))
    call add_start(model, start_t(node=2, component=1, rate=.true., value=2.0_wp))
    call velocities(model, system, state, velocity)
    call expect_close(of_node(velocity, 1), [2, 0, 0, 0, 0, 0]*1.0_wp, 1.0e-12_wp, "one end")
    call expect_close(of_node(velocity, 2), [2, 0, 0, 0, 0, 0]*1.0_wp, 1.0e-12_wp, "the other")
    call system%free()
  end subroutine agreement

  !> Both bars of a straight pair between fixed ends are to grow.
  subroutine contrary_motions()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error
    integer :: i

    call frame_of_nodes(reshape([0, 0, 0, 1, 0, 0, 2, 0, 0]*1.0_wp, [3, 3]), [1, 3], model)
    do i = 1, 2
      call add_truss(model, i, i + 1)
      call add_motion(model, motion_t(joint=i, mode=1, velocity=0.5_wp))
    end do
    call add_mass(model, 2, 1.0_wp)
    call run_model(model, memory, error)
    call expect_error(error, "the motions prescribed for element 1 mode 1 (elongation), "// &
                      "element 2 mode 1 (elongation) contradict each other")
  end subroutine contrary_motions

  !> An angled frame, its corner moved: v'M w = 0 for every w that leaves the corner alone.
  subroutine least_energy()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(masses_t) :: masses
    real(wp), allocatable :: velocity(:), v(:, :), product(:, :), w(:)
    real(wp) :: cosine
    integer :: i, k

    call read_sound(channel// &
                    "NODE 1 0 0 0|NODE 2 1 0 0|NODE 3 1 0.5 1|"// &
                    "BEAMW 1:2 {i} {i+1} SECTION s MATERIAL m DIVIDE 2|FIX 1|"//finish, model)
    call add_start(model, start_t(node=node(model, 2), component=3, rate=.true., value=4.0_wp))
    call velocities(model, system, state, velocity)
    call expect_close(velocity(coordinate_number(node(model, 2), 3)), 4.0_wp, 1.0e-12_wp, "given")
    call find_system_pattern(system)
    call new_masses(model, system, masses)
    allocate (v(size(velocity), 1), product(size(velocity), 1))
    v(:, 1) = velocity
    call mass_product(masses, state, v, product)
    call expect(dot_product(velocity, product(:, 1)) > 0, "energy")
    do i = 1, 20
      w = [(sin(1.7_wp*i*k + i), k=1, size(velocity))]
      where (system%unknown == 0) w = 0
      w(coordinate_number(node(model, 2), 3)) = 0
      cosine = dot_product(w, product(:, 1))/(norm2(w)*norm2(product))
      call expect(abs(cosine) < 1.0e-12_wp, "no change of the energy to first order")
    end do
    call system%free()
  end subroutine least_energy

  !> Two masses apart from each other: their momenta are opposite.
  subroutine elongation_rate()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)

    call frame_of_nodes(reshape([0.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 4.0_wp, 0.0_wp], [3, 2]), &
                        [integer ::], model)
    call add_truss(model, 1, 2, 100.0_wp)
    call add_mass(model, 1, 1.0_wp)
    call add_mass(model, 2, 3.0_wp)
    call add_start(model, start_t(joint=1, mode=1, rate=.true., value=2.0_wp))
    call velocities(model, system, state, velocity)
    call expect_close(velocity(1:3), -1.5_wp*[0.6_wp, 0.8_wp, 0.0_wp], 1.0e-12_wp, "light one")
    call expect_close(velocity(8:10), 0.5_wp*[0.6_wp, 0.8_wp, 0.0_wp], 1.0e-12_wp, "heavy one")
    call system%free()
  end subroutine elongation_rate

  !> Given rates against differences of the strains that the results show, of a section whose shear
  !> centre is not its centroid.
  subroutine strain_rates()
    real(wp), parameter :: h = 1.0e-5_wp, &
                           rate(6) = [1.0_wp, 0.3_wp, -0.5_wp, 0.2_wp, 0.7_wp, 0.4_wp]
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    type(iterate_t) :: iterate
    type(results_t) :: results(2)
    real(wp), allocatable :: velocity(:)
    real(wp) :: level(1)
    integer :: i

    call read_sound(channel// &
                    "NODE 1 0 0 0|NODE 2 1 0.3 0.2|BEAMW 1 1 2 SECTION s MATERIAL m|FIX 1|"// &
                    "XF 2 0 0 0|"//finish, model)
    do i = 1, 6
      call add_start(model, start_t(member=1, mode=i, rate=.true., value=rate(i)))
    end do
    call velocities(model, system, state, velocity)
    call find_system_pattern(system)
    level = 0
    do i = 1, 2
      call new_iterate(system, iterate)
      iterate%state = state
      call iterate%state%move((2*i - 3)*h*velocity)
      call assemble(system, level, iterate)
      call get_results(model, system, iterate, results(i))
    end do
    call expect_close((results(2)%strain(1:6, 1) - results(1)%strain(1:6, 1))/(2*h), rate, &
                      1.0e-8_wp, "rates of the strains")
    call system%free()
  end subroutine strain_rates

  !> The released strain takes the rate, the beam stays at rest: its free end turns.
  subroutine released_rate()
    type(model_t) :: model
    type(system_t) :: system
    type(state_t) :: state
    real(wp), allocatable :: velocity(:)

    call read_sound("MATERIAL m E 2e11 G 8e10 RHO 7800|SECTION s RECT H 0.1 B 0.05|"// &
                    "NODE 1 0 0 0|NODE 2 2 0 0|BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m|RLSE 1 4|"// &
                    "FIX 1|XF 2 0 0 0|"//finish, model)
    call add_start(model, start_t(member=1, mode=4, rate=.true., value=0.6_wp))
    call velocities(model, system, state, velocity)
    call expect_close(velocity(size(velocity)), 0.6_wp, 1.0e-12_wp, "the released strain")
    call system%free()
  end subroutine released_rate

  !> A rod on a pin: nothing slows it. The steps' error is (w h)^2/12 of the way.
  subroutine swing()
    type(model_t) :: model
    type(memory_t) :: memory
    type(error_t), allocatable :: error

    call read_sound(rod//"FIX 1 X Y Z RX RY|"//finish, model)
    call add_start(model, start_t(node=2, component=2, rate=.true., value=3.0_wp))
    call run_model(model, memory, error)
    call expect(.not. allocated(error), "no error")
    if (allocated(error)) call expect(.false., error%message)
    if (allocated(error)) return
    call expect(memory%steps == 11, "the start and ten steps")
    call expect_close(memory%results(1)%velocity(:, 2), [0.0_wp, 3.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
                                                         1.5_wp, 0.0_wp], 1.0e-12_wp, "at first")
    call expect_close(memory%results(11)%displacement(:, 2), &
                      2*[cos(0.015_wp) - 1, sin(0.015_wp), 0.0_wp], 2.0e-8_wp, "at the end")
  end subroutine swing

end module test_start_velocity
