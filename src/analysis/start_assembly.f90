!> The initial assembly: positions at which every held strain is on its target and the values of
!> STARTX hold, as near as may be to those given.
!>
!> Near means that strains with a stiffness change least, in energy, and of what costs none the
!> coordinates, in the sum of the squares of displacements over the model's length and of angles.
!> Models as drawn are closed almost always; then nothing is done.
module start_assembly
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use text, only: to_text
  use model_data, only: model_t, pattern_t, motion_t
  use system_motion, only: mark_timed
  use nodal_state, only: state_t, new_state, node_coordinates
  use rotation, only: turned, rotation_vector
  use element_base, only: element_t
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: coordinate_scale
  use system_names, only: strain_name
  use system_newton, only: right_hand_side, advance
  use equilibrium_path, only: check_angles
  use strain_gaps, only: is_open, row_size, closed_gap
  implicit none
  private

  public :: assemble_start, assemble_model

  !> Gaps that are closed end below this, in lengths of the model or radians.
  real(wp), parameter :: no_gap = 1.0e-12_wp

  !> Weight of the coordinates' change against the largest stiffness: softer than any beam.
  real(wp), parameter :: softness = 1.0e-9_wp

  !> An iteration moves by this at most, lengths or radians; after `most_settling` iterations the
  !> place need not be the nearest one any more.
  real(wp), parameter :: farthest = 1.0_wp, settled = 1.0e-9_wp
  integer, parameter :: most_settling = 60, most_iterations = 200, most_halvings = 10

  !> Gaps below this may grow for the sake of a nearer place.
  real(wp), parameter :: small_gap = 1.0e-3_wp

  !> Where the gaps shrink less than this the constraints are made compliant (Levenberg, Marquardt),
  !> the more the longer that lasts: at the last only gaps as small as may be are sought.
  real(wp), parameter :: slow = 1.0e-3_wp, least_compliance = 1.0e-4_wp, most_compliance = 1.0e3_wp

  !> What is iterated.
  type :: closing_t
    type(system_t) :: system             !< without loads, STARTX among its motions
    type(iterate_t) :: iterate
    type(solver_t) :: solver
    real(wp), allocatable :: level(:)
    real(wp), allocatable :: gap(:)      !< by strain, in lengths of the model or radians
    real(wp), allocatable :: size_of(:)  !< by strain: what counts as one
    real(wp), allocatable :: scale(:)    !< by coordinate: what counts as one
    real(wp) :: compliance = 0.0_wp      !< of the constraints, against that of the springs
    integer :: givens = 0                !< the last strains driven are those of STARTX
  end type closing_t

contains

  !> The state of a model before its first analysis. The system's pattern is not needed yet;
  !> patterns that a first time analysis brings are marked as timed.
  subroutine assemble_start(model, system, state, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(out) :: state
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: level(size(model%pattern))

    call new_state(system%nodes, system%coordinates - node_coordinates*system%nodes, &
                   system%angles, state)
    call mark_timed(model, 1, min(1, size(model%analysis)), system%timed)
    level = 0
    call check_angles(model, system, level, error)
    if (allocated(error)) return
    if (any(.not. model%start%rate) .or. is_open(system, level, state)) then
      call close_gaps(model, system, level, .true., state, error)
    end if
  end subroutine assemble_start

  !> Bring a state to positions where every held strain is on its target with the patterns at
  !> `level`. A state that is there already is not touched.
  subroutine assemble_model(model, system, level, state, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)   !< load factor, or time, of each pattern
    type(state_t), intent(inout) :: state
    type(error_t), allocatable, intent(out) :: error

    call check_angles(model, system, level, error)
    if (allocated(error)) return
    if (is_open(system, level, state)) then
      call close_gaps(model, system, level, .false., state, error)
    end if
  end subroutine assemble_model

  !> Newton with steps as short as possible, cut where they widen the gaps; when the place is the
  !> nearest one, what pulled it there is left out, so that it does not strain what is stiff.
  subroutine close_gaps(model, system, level, given, state, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    logical, intent(in) :: given           !< the values of STARTX hold too
    type(state_t), intent(inout) :: state
    type(error_t), allocatable, intent(out) :: error
    type(closing_t) :: self
    type(model_t) :: targets
    real(wp) :: moved, before
    integer :: i
    logical :: pulled

    call new_closing(model, system, level, given, state, targets, self, error)
    pulled = .true.
    do i = 1, most_iterations
      if (allocated(error)) exit
      before = norm2(self%gap)
      call take_step(self, state, pulled, moved, error)
      if (allocated(error)) exit
      if (maxval(self%gap) <= no_gap .and. (moved <= settled .or. i > most_settling)) then
        if (.not. pulled) exit
        pulled = .false.
      end if
      if (i == most_settling) pulled = .false.
      call adapt_compliance(self, before)
      if (self%compliance > most_compliance) exit
    end do
    if (.not. allocated(error)) then
      if (maxval(self%gap) <= closed_gap) then
        state = self%iterate%state
      else
        call complain(targets, self, error)
      end if
    end if
    call self%solver%free()
    call self%system%free()
  end subroutine close_gaps

  !> A system of its own, with what is given as motions, and without stress as it stands.
  subroutine new_closing(model, system, level, given, state, targets, self, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    logical, intent(in) :: given
    type(state_t), intent(in) :: state
    type(model_t), intent(out) :: targets  !< the model it is the system of
    type(closing_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    integer :: k

    targets = model
    do k = 1, size(targets%pattern)
      targets%pattern(k)%loads = 0
      targets%pattern(k)%gravity = 0
    end do
    self%level = level
    if (given) call add_givens(targets, self)
    call build_system(targets, self%system)
    self%system%timed(:size(level)) = system%timed
    self%system%initial_stress = 0
    call find_system_pattern(self%system)
    call new_iterate(self%system, self%iterate)
    self%iterate%state = state
    associate (n => self%system%coordinates, pattern => self%system%pattern)
      self%scale = [(coordinate_scale(self%system, k), k=1, n)]
      call self%solver%prepare(self%system%equations(), pattern%row, pattern%column, &
                               pattern%symmetric, error)
    end associate
    allocate (self%gap(size(self%system%multiplier)), self%size_of(size(self%system%multiplier)))
    call evaluate(self)
    self%system%initial_stress = -self%iterate%elastic
    call evaluate(self)
  end subroutine new_closing

  !> The values of STARTX as motions of one more pattern, in full.
  pure subroutine add_givens(targets, self)
    type(model_t), intent(inout) :: targets
    type(closing_t), intent(inout) :: self
    type(pattern_t), allocatable :: pattern(:)
    integer :: i, n

    allocate (pattern(size(targets%pattern) + 1))
    n = size(pattern)
    pattern(:n - 1) = targets%pattern
    allocate (pattern(n)%load(0), pattern(n)%motion(size(targets%start)))
    do i = 1, size(targets%start)
      associate (start => targets%start(i), motions => pattern(n)%motions)
        if (start%rate) cycle
        motions = motions + 1
        pattern(n)%motion(motions) = motion_t(node=start%node, component=start%component, &
                                              value=start%value)
        if (start%component > 3) cycle
        pattern(n)%motion(motions)%value = start%value &
                                           - targets%node(start%node)%position(start%component)
      end associate
    end do
    self%givens = pattern(n)%motions
    self%level = [self%level, 1.0_wp]
    call move_alloc(pattern, targets%pattern)
  end subroutine add_givens

  !> Assemble without stress: the matrix is that of the stiffness and the constraints.
  pure subroutine evaluate(self)
    type(closing_t), intent(inout) :: self
    integer :: e

    self%gap = huge(1.0_wp)
    self%iterate%stress = 0
    call assemble(self%system, self%level, self%iterate)
    if (self%iterate%invalid > 0) return
    do e = 1, size(self%system%element)
      associate (first => self%system%first(e) + 1, last => self%system%first(e + 1), &
                 from => self%system%jacobian(e) + 1, to => self%system%jacobian(e + 1))
        call find_gaps(self, self%system%element(e)%e, self%iterate%jacobian(from:to), first, last)
      end associate
    end do
  end subroutine evaluate

  pure subroutine find_gaps(self, element, jacobian, first, last)
    type(closing_t), intent(inout) :: self
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates)
    integer, intent(in) :: first, last

    associate (iterate => self%iterate, gap => self%gap(first:last))
      self%size_of(first:last) = row_size(self%system, element, jacobian)
      gap = abs(iterate%strain(first:last) - iterate%target(first:last))/self%size_of(first:last)
      where (.not. element%fixed) gap = 0
    end associate
  end subroutine find_gaps

  pure subroutine adapt_compliance(self, before)
    type(closing_t), intent(inout) :: self
    real(wp), intent(in) :: before  !< norm of the gaps before the last step

    if (maxval(self%gap) > small_gap .and. norm2(self%gap) > (1 - slow)*before) then
      self%compliance = max(least_compliance, 10*self%compliance)
    else
      self%compliance = self%compliance/10
      if (self%compliance < least_compliance) self%compliance = 0
    end if
  end subroutine adapt_compliance

  !> One iteration from where `self` is evaluated; none if no step makes the gaps smaller.
  subroutine take_step(self, given, pulled, moved, error)
    type(closing_t), intent(inout) :: self
    type(state_t), intent(in) :: given     !< where the model was drawn
    logical, intent(in) :: pulled          !< towards it
    real(wp), intent(out) :: moved         !< lengths or radians
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(self%system%equations()), increment(self%system%coordinates)
    real(wp) :: share, before
    type(iterate_t) :: start
    integer :: attempt
    logical :: worse

    call find_increment(self, given, pulled, solution, error)
    if (allocated(error)) return
    start = self%iterate
    before = norm2(self%gap)
    share = min(1.0_wp, farthest/max(largest(self, solution), tiny(1.0_wp)))
    do attempt = 0, most_halvings
      if (attempt > 0) then
        share = share/2
        self%iterate = start
      end if
      call advance(self%system, solution, share, self%iterate, increment)
      call evaluate(self)
      moved = maxval(abs(increment)/self%scale)
      worse = self%iterate%invalid > 0 .or. &
              (maxval(self%gap) > small_gap .and. .not. norm2(self%gap) < before)
      if (.not. worse) return
    end do
    self%iterate = start
    call evaluate(self)
  end subroutine take_step

  !> Stiffness and a soft spring to where each coordinate was drawn, in every one of them.
  subroutine find_increment(self, given, pulled, solution, error)
    type(closing_t), intent(inout) :: self
    type(state_t), intent(in) :: given
    logical, intent(in) :: pulled
    real(wp), intent(out) :: solution(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: spring(self%system%unknowns), away(self%system%coordinates), stiffest
    real(wp) :: diagonal(self%system%equations())
    integer :: i, k

    stiffest = 0
    do k = 1, self%system%coordinates
      i = self%system%unknown(k)
      if (i > 0) spring(i) = self%scale(k)**(-2)
    end do
    associate (pattern => self%system%pattern, values => self%iterate%values)
      do k = 1, size(values)
        i = pattern%row(k)
        if (i /= pattern%column(k) .or. i > size(spring)) cycle
        stiffest = max(stiffest, values(k)/spring(i))
      end do
      stiffest = merge(softness*stiffest, 1.0_wp, stiffest > 0)
      spring = stiffest*spring
      diagonal = [spring, -self%compliance/stiffest &
                  *pack(self%size_of, self%system%multiplier > 0)**2]
      do k = 1, size(values)
        i = pattern%row(k)
        if (i == pattern%column(k)) values(k) = values(k) + diagonal(i)
      end do
    end associate
    solution = right_hand_side(self%system, self%iterate)
    away = distance(self%iterate%state, given)
    do k = 1, self%system%coordinates
      i = self%system%unknown(k)
      if (i == 0) cycle
      if (pulled) solution(i) = solution(i) - spring(i)*away(k)
      if (self%compliance > 0) solution(i) = 0
    end do
    call self%solver%factorize(self%iterate%values, error)
    if (.not. allocated(error)) call self%solver%solve(solution, error)
  end subroutine find_increment

  !> From one state to another, by coordinate; of rotations the spatial vector between them.
  pure function distance(state, from) result(away)
    type(state_t), intent(in) :: state, from
    real(wp) :: away(node_coordinates*size(state%warping) + size(state%release)), back(0:3)
    integer :: i, k

    do i = 1, size(state%warping)
      k = node_coordinates*(i - 1)
      back = from%euler(:, i)*[1, -1, -1, -1]
      away(k + 1:k + 3) = state%displacement(:, i) - from%displacement(:, i)
      away(k + 4:k + 6) = rotation_vector(turned(back, rotation_vector(state%euler(:, i))))
      away(k + 7) = state%warping(i) - from%warping(i)
    end do
    away(node_coordinates*size(state%warping) + 1:) = state%release - from%release
  end function distance

  !> Largest increment, in lengths of the model or radians.
  pure real(wp) function largest(self, solution)
    type(closing_t), intent(in) :: self
    real(wp), intent(in) :: solution(:)
    integer :: k

    largest = 0
    do k = 1, self%system%coordinates
      associate (i => self%system%unknown(k))
        if (i > 0) largest = max(largest, abs(solution(i))/self%scale(k))
      end associate
    end do
  end function largest

  !> Name the largest gap; of STARTX if that is what does not fit.
  subroutine complain(targets, self, error)
    type(model_t), intent(in) :: targets
    type(closing_t), intent(in) :: self
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: problem
    logical :: given(size(self%gap))
    integer :: k

    given = .false.
    associate (drive => self%system%drive)
      given(drive(size(drive) - self%givens + 1:)%strain) = .true.
    end associate
    problem = "the loop does not close: "
    if (self%compliance <= most_compliance) then
      problem = "no way was found in "//to_text(most_iterations)//" iterations to close the "// &
                "loop from where it is drawn: "
    end if
    if (any(given .and. self%gap > closed_gap)) then
      problem = "the constraints do not let STARTX be met: "
    else
      given = .true.
    end if
    k = maxloc(self%gap, 1, given)
    call fail(error, exit_deck, problem//strain_name(targets, self%system, k)//" is off by "// &
              to_text(self%iterate%strain(k) - self%iterate%target(k), 3))
  end subroutine complain

end module start_assembly
