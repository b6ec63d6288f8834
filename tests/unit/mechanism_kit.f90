!> Mechanisms put together by hand, and their analyses.
module mechanism_kit
  use kinds, only: wp
  use errors, only: error_t
  use diagnostics, only: report_t
  use model_data, only: model_t, member_t, joint_t, mass_t, motion_t, analysis_t, node_t, &
                        type_beam, mode_released, mode_prescribed, mode_fixed, joint_hinge, &
                        translational, rotational, warping
  use model_axes, only: orient_members
  use analysis_run, only: run_analyses
  use memory_recorder, only: memory_t
  implicit none
  private

  public :: new_mechanism, add_node, add_bar, add_hinge, add_mass, drive, add_analysis
  public :: run_mechanism, make_slider_crank, slider_jet
  public :: make_four_bar, four_bar_angles, unit, across

  integer, parameter :: x = 1, y = 2, z = 3, rx = 4, ry = 5, rz = 6

contains

  !> Nothing yet, with one pattern.
  subroutine new_mechanism(model)
    type(model_t), intent(out) :: model

    allocate (model%node(0), model%material(0), model%section(0), model%member(0), model%joint(0))
    allocate (model%mass(0), model%start(0), model%kept_node(0), model%kept_member(0))
    allocate (model%marker(0), model%point(0), model%function(0), model%pattern(1))
    allocate (model%analysis(0), model%setting(0), model%imperfection(0))
    allocate (model%pattern(1)%motion(0), model%pattern(1)%load(0))
    model%title = ""
    model%deck = ""
  end subroutine new_mechanism

  !> A node; its index. `fixed`: components X Y Z RX RY RZ W.
  integer function add_node(model, position, fixed) result(n)
    type(model_t), intent(inout) :: model
    real(wp), intent(in) :: position(3)
    integer, intent(in), optional :: fixed(:)
    type(node_t) :: node

    node%position = position
    node%placed = .true.
    if (present(fixed)) node%fixed(fixed) = .true.
    n = size(model%node) + 1
    node%id = n
    model%node = [model%node, node]
  end function add_node

  !> A rigid beam between translational nodes p and q with rotational nodes rp and rq; its index.
  integer function add_bar(model, p, q, rp, rq) result(n)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: p, q, rp, rq
    type(member_t) :: bar

    bar%kind = type_beam
    bar%node(:, 1) = [p, rp, rp]
    bar%node(:, 2) = [q, rq, rq]
    bar%chord = model%node(q)%position - model%node(p)%position
    bar%status(7:8) = mode_released
    n = size(model%member) + 1
    bar%id = n
    model%member = [model%member, bar]
    model%node([p, q])%exists(translational) = .true.
    model%node([rp, rq])%exists(rotational) = .true.
    model%node([rp, rq])%exists(warping) = .false.
  end function add_bar

  !> A hinge about z between rotational nodes; its index. It is free or driven.
  integer function add_hinge(model, p, q, driven) result(n)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: p, q
    logical, intent(in) :: driven
    type(joint_t) :: hinge

    hinge%kind = joint_hinge
    hinge%node(2, :) = [p, q]
    hinge%axis(:, 1) = [0, 0, 1]
    hinge%status = [merge(mode_prescribed, mode_released, driven), mode_fixed, mode_fixed, &
                    mode_fixed, mode_fixed, mode_fixed]
    n = size(model%joint) + 1
    hinge%id = 100 + n
    model%joint = [model%joint, hinge]
    model%node([p, q])%exists(rotational) = .true.
  end function add_hinge

  subroutine add_mass(model, node, mass)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: node
    real(wp), intent(in) :: mass
    type(mass_t) :: point

    point%node = node
    point%mass = mass
    model%mass = [model%mass, point]
  end subroutine add_mass

  !> Prescribe the angle of a hinge.
  subroutine drive(model, joint, value, velocity, acceleration)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: joint
    real(wp), intent(in) :: value, velocity, acceleration
    type(motion_t) :: motion

    motion%joint = joint
    motion%mode = 1
    motion%value = value
    motion%velocity = velocity
    motion%acceleration = acceleration
    model%pattern(1)%motion = [model%pattern(1)%motion, motion]
    model%pattern(1)%motions = size(model%pattern(1)%motion)
  end subroutine drive

  subroutine add_analysis(model, kind, end_time, step)
    type(model_t), intent(inout) :: model
    integer, intent(in) :: kind
    real(wp), intent(in) :: end_time, step
    type(analysis_t) :: analysis

    analysis%kind = kind
    analysis%pattern = 1
    analysis%end_time = end_time
    analysis%time_step = step
    allocate (analysis%node(0))
    model%analysis = [model%analysis, analysis]
  end subroutine add_analysis

  subroutine run_mechanism(model, memory, error)
    type(model_t), intent(inout) :: model
    type(memory_t), intent(out) :: memory
    type(error_t), allocatable, intent(out) :: error
    type(report_t) :: report

    allocate (memory%record(1000), memory%results(1000), memory%remarks(0), memory%completed(0))
    allocate (memory%spectrum(0), memory%critical(0))
    call orient_members(model, report)
    call run_analyses(model, memory, error)
  end subroutine run_mechanism

  !> Base, crank, coupler and rocker with hinges about z at all four ends, drawn with the crank at
  !> `start`; nodes `b` and `c` are the coupler's ends. The hinge of the crank drives.
  subroutine make_four_bar(base, crank, coupler, rocker, start, model, b, c)
    real(wp), intent(in) :: base, crank, coupler, rocker, start
    type(model_t), intent(out) :: model
    integer, intent(out) :: b, c
    real(wp) :: angle(2)
    integer :: i, a, d, ground(2), b_of_coupler, c_of_coupler

    angle = four_bar_angles(base, crank, coupler, rocker, start)
    call new_mechanism(model)
    a = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    d = add_node(model, [base, 0.0_wp, 0.0_wp], [x, y, z])
    b = add_node(model, crank*unit(start))
    c = add_node(model, crank*unit(start) + coupler*unit(angle(1)))
    b_of_coupler = add_node(model, model%node(b)%position)
    c_of_coupler = add_node(model, model%node(c)%position)
    ground(1) = add_node(model, model%node(a)%position, [rx, ry, rz])
    ground(2) = add_node(model, model%node(d)%position, [rx, ry, rz])
    i = add_bar(model, a, b, a, b)
    i = add_bar(model, b, c, b_of_coupler, c_of_coupler)
    i = add_bar(model, d, c, d, c)
    i = add_hinge(model, ground(1), a, .true.)
    call drive(model, i, 0.0_wp, 1.0_wp, 0.0_wp)
    i = add_hinge(model, b, b_of_coupler, .false.)
    i = add_hinge(model, c, c_of_coupler, .false.)
    i = add_hinge(model, ground(2), d, .false.)
  end subroutine make_four_bar

  pure function unit(angle) result(u)
    real(wp), intent(in) :: angle
    real(wp) :: u(3)

    u = [cos(angle), sin(angle), 0.0_wp]
  end function unit

  !> Angles of coupler and rocker, the coupler above the diagonal: law of cosines.
  pure function four_bar_angles(base, crank, coupler, rocker, angle) result(others)
    real(wp), intent(in) :: base, crank, coupler, rocker, angle
    real(wp) :: others(2), diagonal(3), d, tip(3)

    diagonal = base*unit(0.0_wp) - crank*unit(angle)
    d = norm2(diagonal)
    others(1) = atan2(diagonal(2), diagonal(1)) &
                + acos((coupler**2 + d**2 - rocker**2)/(2*coupler*d))
    tip = crank*unit(angle) + coupler*unit(others(1)) - base*unit(0.0_wp)
    others(2) = atan2(tip(2), tip(1))
  end function four_bar_angles

  pure function across(angle) result(u)
    real(wp), intent(in) :: angle
    real(wp) :: u(3)

    u = [-sin(angle), cos(angle), 0.0_wp]
  end function across

  !> Crank and rod along x, the slider at `slider`; hinge 1 drives.
  subroutine make_slider_crank(crank, rod, speed, model, slider)
    real(wp), intent(in) :: crank, rod, speed
    type(model_t), intent(out) :: model
    integer, intent(out) :: slider
    integer :: ground, pin, pin_of_rod, base, i

    call new_mechanism(model)
    ground = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [x, y, z])
    pin = add_node(model, [crank, 0.0_wp, 0.0_wp])
    slider = add_node(model, [crank + rod, 0.0_wp, 0.0_wp], [y])
    pin_of_rod = add_node(model, [crank, 0.0_wp, 0.0_wp])
    base = add_node(model, [0.0_wp, 0.0_wp, 0.0_wp], [rx, ry, rz])
    i = add_bar(model, ground, pin, ground, pin)
    i = add_bar(model, pin, slider, pin_of_rod, slider)
    i = add_hinge(model, base, ground, .true.)
    call drive(model, i, 0.0_wp, speed, 0.0_wp)
    i = add_hinge(model, pin, pin_of_rod, .false.)
  end subroutine make_slider_crank

  !> Place of the slider, and its derivatives to the crank's angle.
  pure function slider_jet(r, l, angle) result(jet)
    real(wp), intent(in) :: r, l, angle
    real(wp) :: jet(0:2), q

    q = sqrt(l**2 - (r*sin(angle))**2)
    jet(0) = r*cos(angle) + q
    jet(1) = -r*sin(angle) - r**2*sin(angle)*cos(angle)/q
    jet(2) = -r*cos(angle) - r**2*cos(2*angle)/q - (r**2*sin(angle)*cos(angle))**2/q**3
  end function slider_jet

end module mechanism_kit
