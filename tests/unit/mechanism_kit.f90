!> Mechanisms put together by hand, and their analyses.
module mechanism_kit
  use kinds, only: wp
  use errors, only: error_t
  use diagnostics, only: report_t
  use model_data, only: model_t, member_t, joint_t, mass_t, motion_t, analysis_t, node_t, type_beam, &
                        mode_released, mode_prescribed, mode_fixed, joint_hinge, translational, &
                        rotational, warping
  use model_axes, only: orient_members
  use analysis_run, only: run_analyses
  use memory_recorder, only: memory_t
  implicit none
  private

  public :: new_mechanism, add_node, add_bar, add_hinge, add_mass, drive, add_analysis, run_mechanism

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

end module mechanism_kit
