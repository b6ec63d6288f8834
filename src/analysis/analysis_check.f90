!> `spar check`: what the model is, what holds it twice, what moves freely, and whether its analyses
!> can do with that.
module analysis_check
  use kinds, only: wp
  use errors, only: error_t
  use text, only: string_t, plural, to_text
  use model_data, only: model_t, type_beamw, type_beam, mode_fixed, mode_flexible, joint_modes, &
                        joint_names
  use section_data, only: section_constants_t
  use model_axes, only: default_orientation
  use nodal_state, only: state_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_dependence, only: dependence_t
  use system_mobility, only: free_motion_t, find_free_motions
  use system_names, only: coordinate_name, strain_name, node_name
  use system_unknowns, only: by_unknown
  use start_assembly, only: assemble_start
  use mode_results, only: modes_t, new_modes, add_mode, unit_factor
  use singular_refusal, only: check_departure
  use model_sentences, only: dependence_sentence, singular_sentence, motion_sentence, &
                             release_card, motion_name, listed
  use model_soundness, only: redundant_t, sort_redundant, begins_with_motion, refusal, &
                             singular_cure, count_line
  implicit none
  private

  public :: check_t, finding_t, check_model

  !> Kinds of elements that are counted, and what is said of strains.
  character(len=11), parameter, public :: element_names(11) = &
    ["BEAMW      ", "BEAM       ", joint_names]
  character(len=10), parameter, public :: status_names(0:3) = &
    ["fixed     ", "flexible  ", "released  ", "prescribed"]

  !> A redundant constraint or a free motion.
  type :: finding_t
    character(len=:), allocatable :: text        !< one sentence
    character(len=:), allocatable :: name        !< strain left out, or coordinate
    type(string_t), allocatable :: part(:)       !< strains that take part, coordinates that move
    real(wp), allocatable :: value(:)            !< their weights, or how far they move
    type(string_t), allocatable :: other(:)      !< fixed nodes that take part; released strains
    character(len=:), allocatable :: card        !< that ends a redundancy, or empty
  end type finding_t

  !> What is found.
  type :: check_t
    integer :: nodes = 0, kind(3) = 0            !< all ids; translational, rotational, warping
    integer :: element(size(element_names)) = 0
    integer :: strain(0:3) = 0                   !< generalized strains by status
    integer :: used = 0, held = 0, free = 0      !< coordinates
    integer :: constraints = 0, redundant = 0    !< equations
    integer :: everywhere = 0, singular = 0      !< redundant: in general, only where it is drawn
    integer :: freedoms = 0                      !< free coordinates less independent constraints
    integer :: mobile = 0                        !< of these: free motions
    !> As many as are explained.
    type(finding_t), allocatable :: overconstrained(:), only_here(:), motion(:)
    type(string_t), allocatable :: defaults(:)   !< what cards of sections left to the program
    character(len=:), allocatable :: contradiction  !< of prescribed motions; empty: none
    character(len=:), allocatable :: refusal     !< what makes the model unsound; empty: nothing
    type(modes_t) :: modes                       !< shapes of the free motions
  end type check_t

  integer, parameter :: most_motions = 20        !< more are counted, but not explained
  character(len=1), parameter :: axis_name(3) = ["X", "Y", "Z"]
  integer, parameter :: most_named = 10          !< elements in a line

contains

  !> Inspect a model at its start. An unsound one is no error.
  subroutine check_model(model, check, error)
    type(model_t), intent(in) :: model
    type(check_t), intent(out) :: check
    type(error_t), allocatable, intent(out) :: error
    type(system_t) :: system
    type(state_t) :: state
    type(redundant_t) :: found
    type(error_t), allocatable :: refused

    check%contradiction = ""
    check%refusal = ""
    allocate (check%motion(0))
    call build_system(model, system)
    check%constraints = system%multipliers
    call assemble_start(model, system, state, error)
    if (.not. allocated(error)) call sort_redundant(model, system, state, found, error)
    if (.not. allocated(error)) then
      check%singular = found%singular
      check%everywhere = found%all - found%singular
      check%contradiction = found%contradiction
      check%refusal = found%contradiction
      call count_parts(model, check)
      call count_equations(system, check)
      call list_defaults(model, check)
      call explain_constraints(model, system, found%everywhere, check%everywhere, .false., &
                               check%overconstrained)
      call explain_constraints(model, system, found%here, check%singular, .true., check%only_here, &
                               found%leads)
      if (check%singular > 0 .and. check%refusal == "") then
        call check_departure(model, system, state, refused)
        if (allocated(refused)) check%refusal = refused%message
      end if
      if (allocated(found%beside) .and. begins_with_motion(model)) state = found%beside
      call explain_motions(model, system, state, check, error)
    end if
    call system%free()
  end subroutine check_model

  !> Nodes, elements, strains.
  pure subroutine count_parts(model, check)
    type(model_t), intent(in) :: model
    type(check_t), intent(inout) :: check
    integer :: i, k

    check%nodes = size(model%node)
    do k = 1, 3
      check%kind(k) = count(model%node%exists(k))
    end do
    do i = 1, size(model%member)
      associate (m => model%member(i))
        k = merge(1, 2, m%kind == type_beamw)
        check%element(k) = check%element(k) + 1
        call count_strains(check, merge(mode_fixed, m%status(:merge(6, 8, m%kind == type_beam)), &
          m%rigid .and. m%status(:merge(6, 8, m%kind == type_beam)) == mode_flexible))
      end associate
    end do
    do i = 1, size(model%joint)
      associate (joint => model%joint(i))
        check%element(2 + joint%kind) = check%element(2 + joint%kind) + 1
        call count_strains(check, joint%status(:joint_modes(joint%kind)))
      end associate
    end do
  end subroutine count_parts

  pure subroutine count_strains(check, status)
    type(check_t), intent(inout) :: check
    integer, intent(in) :: status(:)
    integer :: i

    do i = 1, size(status)
      check%strain(status(i)) = check%strain(status(i)) + 1
    end do
  end subroutine count_strains

  !> Coordinates and equations, redundant ones left out.
  pure subroutine count_equations(system, check)
    type(system_t), intent(in) :: system
    type(check_t), intent(inout) :: check

    check%used = count(system%used)
    check%held = count(system%used .and. system%unknown == 0)
    check%free = system%unknowns
    check%redundant = check%constraints - system%multipliers
    check%freedoms = system%unknowns - system%multipliers
  end subroutine count_equations

  !> What cards left to the program: of sections, and where their y axes are.
  subroutine list_defaults(model, check)
    type(model_t), intent(in) :: model
    type(check_t), intent(inout) :: check
    type(string_t) :: oriented(3)
    integer :: i, n

    call list_orientations(model, oriented)
    n = count([(model%section(i)%defaults /= "", i=1, size(model%section))])
    allocate (check%defaults(n + count([(oriented(i)%s /= "", i=1, 3)])))
    n = 0
    do i = 1, size(model%section)
      associate (section => model%section(i))
        if (section%defaults == "") cycle
        n = n + 1
        check%defaults(n)%s = "defaults of SECTION "//trim(section%name)//": "//section%defaults
      end associate
    end do
    do i = 1, 3
      if (oriented(i)%s == "") cycle
      n = n + 1
      check%defaults(n) = oriented(i)
    end do
  end subroutine list_defaults

  !> For each global axis the beams of unequal second moments whose section's y axis it was made.
  subroutine list_orientations(model, oriented)
    type(model_t), intent(in) :: model
    type(string_t), intent(out) :: oriented(3)
    type(string_t) :: name(size(model%member))
    integer :: e, axis, n

    do axis = 1, 3
      n = 0
      do e = 1, size(model%member)
        associate (member => model%member(e))
          if (member%part > 1 .or. member%section == 0 .or. any(abs(member%orientation) > 0)) cycle
          if (is_round(model%section(member%section)%constants)) cycle
          if (maxloc(default_orientation(member%chord/norm2(member%chord)), 1) /= axis) cycle
          n = n + 1
          name(n)%s = to_text(member%id)
        end associate
      end do
      oriented(axis)%s = ""
      if (n > 0) oriented(axis)%s = "default of "//trim(merge("element ", "elements", n == 1))// &
        " "//listed(name(:n), most_named, n)//": the section's y axis along "//axis_name(axis)
    end do
  end subroutine list_orientations

  !> Bent alike about all axes.
  pure logical function is_round(constants)
    type(section_constants_t), intent(in) :: constants

    is_round = abs(constants%iy - constants%iz) <= 1.0e-9_wp*constants%iy
  end function is_round

  subroutine explain_constraints(model, system, found, all, here, finding, leads)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(dependence_t), intent(in) :: found(:)
    integer, intent(in) :: all
    logical, intent(in) :: here            !< only where the model is drawn
    type(finding_t), allocatable, intent(out) :: finding(:)
    logical, intent(in), optional :: leads !< a motion leads away from there
    integer :: i, k

    allocate (finding(size(found)))
    do i = 1, size(found)
      associate (f => finding(i), d => found(i))
        f%text = "overconstrained"//count_line(i, all)//": "// &
                 dependence_sentence(model, system, d)
        f%card = release_card(model, system, d%release)
        if (here) then
          f%text = singular_sentence(model, system, d, leads)
          f%card = ""
        end if
        f%name = strain_name(model, system, d%dropped)
        f%value = d%weight
        allocate (f%part(size(d%strain)), f%other(size(d%held)))
        do k = 1, size(d%strain)
          f%part(k)%s = strain_name(model, system, d%strain(k))
        end do
        do k = 1, size(d%held)
          f%other(k)%s = node_name(model, d%held(k))
        end do
      end associate
    end do
  end subroutine explain_constraints

  !> Factorize the unloaded model and find what moves without strain.
  subroutine explain_motions(model, system, state, check, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    type(check_t), intent(inout) :: check
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver
    type(iterate_t) :: iterate
    type(free_motion_t), allocatable :: found(:)
    real(wp) :: level(size(model%pattern))

    if (system%unknowns == 0) return
    call find_system_pattern(system)
    call new_iterate(system, iterate)
    iterate%state = state
    level = 0
    call assemble(system, level, iterate)
    call solver%prepare(system%equations(), system%pattern%row, system%pattern%column, &
                        system%pattern%symmetric, error)
    if (.not. allocated(error)) call solver%factorize(iterate%values, error)
    if (.not. allocated(error)) call find_free_motions(model, system, iterate, solver, found, error)
    call solver%free()
    if (allocated(error)) return
    check%mobile = size(found)
    call describe_motions(model, system, found, check)
    call keep_shapes(model, system, iterate, found, check%modes)
    if (check%mobile == 0 .or. check%refusal /= "") return
    check%refusal = refusal(model)
    if (check%refusal /= "") check%refusal = "the model has "// &
      plural(check%mobile, "free motion")//", but "//check%refusal//singular_cure(system)
  end subroutine explain_motions

  subroutine describe_motions(model, system, found, check)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(free_motion_t), intent(in) :: found(:)
    type(check_t), intent(inout) :: check
    integer :: i, k

    deallocate (check%motion)
    allocate (check%motion(min(size(found), most_motions)))
    do i = 1, size(check%motion)
      associate (f => check%motion(i), d => found(i))
        f%text = "moves freely"//count_line(i, size(found))//": "//motion_sentence(model, system, d)
        if (size(found) == 1) f%text = "moves freely: "//motion_sentence(model, system, d)
        f%name = motion_name(model, system, d)
        f%card = ""
        f%value = d%shape(d%moves)
        allocate (f%part(size(d%moves)), f%other(size(d%strain)))
        do k = 1, size(d%moves)
          f%part(k)%s = coordinate_name(model, d%moves(k))
        end do
        do k = 1, size(d%strain)
          f%other(k)%s = strain_name(model, system, d%strain(k))
        end do
      end associate
    end do
  end subroutine describe_motions

  !> The motions as modes, the largest displacement 1.
  subroutine keep_shapes(model, system, iterate, found, modes)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    type(free_motion_t), intent(in) :: found(:)
    type(modes_t), intent(out) :: modes
    real(wp) :: solution(system%equations())
    integer :: i

    call new_modes(system, size(found), modes)
    do i = 1, size(found)
      solution = by_unknown(system, found(i)%shape)
      solution = unit_factor(system, solution)*solution
      call add_mode(model, system, iterate, solution, modes)
    end do
  end subroutine keep_shapes

end module analysis_check
