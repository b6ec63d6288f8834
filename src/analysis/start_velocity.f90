!> The velocities a motion starts with: those of STARTDX and STARTDE and of the prescribed motions,
!> and of all that have these the ones with the least kinetic energy.
!>
!> v'Mv/2 alone may leave velocities open: of nodes without mass, spins of slender bars. Among them
!> those count that strain the elements least, then the smallest. Both come from a small matrix R
!> beside M by proximal iteration,
!>     v(n+1): least of v'Mv/2 + (v - v(n))'R(v - v(n))/2, v(0) = 0,
!> which ends at the least kinetic energy itself: R only says where on that set. The conditions that
!> are given are taken in the same way, with a small compliance between them and v: where they
!> contradict each other they end up half-way, and what each lacks tells.
module start_velocity
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use text, only: to_text
  use model_data, only: model_t, start_t, mode_released
  use nodal_state, only: state_t, coordinate_number
  use linalg_solver, only: solver_t
  use system_data, only: system_t
  use system_build, only: find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: coordinate_scale
  use system_inertia, only: masses_t, new_masses, assemble_mass
  use system_motion, only: target_rates
  use system_names, only: strain_name, coordinate_name
  use system_results, only: shear_centre_shift
  implicit none
  private

  public :: find_velocities, given_lacks

  !> R: stiffness and identity, each over its largest entry, against the largest mass.
  real(wp), parameter :: stiffness_part = 1.0e-6_wp, identity_part = 1.0e-10_wp

  !> Compliance of a condition, in the same units.
  real(wp), parameter :: compliance = 1.0e-6_wp

  integer, parameter :: most_iterations = 100
  integer, parameter :: beam_coordinates = 14  !< of its nodes; those of released strains follow
  real(wp), parameter :: settled = 1.0e-14_wp, agreed = 1.0e-8_wp

  !> A sum of velocities that has a given value.
  type :: condition_t
    integer :: start = 0                   !< index in `model%start`
    integer, allocatable :: coordinate(:)
    real(wp), allocatable :: factor(:)
    real(wp) :: value = 0.0_wp
  end type condition_t

  !> [M + R, C', A'; C, 0, 0; A, 0, -compliance], lower triangle, and R apart.
  type :: problem_t
    type(system_t) :: system               !< without loads
    type(iterate_t) :: rest                !< the state, without stress
    type(condition_t), allocatable :: given(:)
    integer, allocatable :: row(:), column(:)
    integer :: entries = 0
    real(wp), allocatable :: values(:)
    real(wp), allocatable :: near(:)       !< entries of R, zero behind those of the coordinates
    real(wp), allocatable :: demand(:)     !< right-hand side of the rows of C and A, zero before
    real(wp), allocatable :: unit(:)       !< by unknown: what counts as one
  end type problem_t

contains

  !> Velocities by coordinate at a state whose held strains are on their targets, the patterns
  !> standing at `level`. Zero if nothing is given and no target moves.
  subroutine find_velocities(model, system, state, level, velocity, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    real(wp), intent(out) :: velocity(:)
    type(error_t), allocatable, intent(out) :: error
    type(problem_t) :: problem
    real(wp), dimension(size(system%multiplier)) :: rate, unused

    velocity = 0
    call target_rates(system, level, rate, unused)
    if (.not. any(model%start%rate) .and. .not. any(abs(rate) > 0)) return
    call new_problem(model, system, state, level, problem)
    call add_conditions(model, rate, problem)
    call solve(problem, velocity, error)
    if (.not. allocated(error)) call check_given(model, problem, velocity, error)
    if (.not. allocated(error)) call check_constraints(model, problem, rate, velocity, error)
  end subroutine find_velocities

  !> What velocities lack of those given for the start, each in units in which a motion as large as
  !> the model counts 1.
  subroutine given_lacks(model, system, rest, velocity, lack)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: rest     !< assembled
    real(wp), intent(in) :: velocity(:)
    real(wp), intent(out) :: lack(:)        !< by rate given
    type(problem_t) :: problem
    type(condition_t) :: condition
    integer :: i, n

    problem%system = system
    problem%rest = rest
    n = 0
    do i = 1, size(model%start)
      if (.not. model%start(i)%rate) cycle
      call find_condition(model, model%start(i), problem, condition)
      n = n + 1
      lack(n) = dot_product(condition%factor, velocity(condition%coordinate)) - condition%value
    end do
  end subroutine given_lacks

  !> The matrix of M, R and C.
  subroutine new_problem(model, system, state, level, self)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    type(problem_t), intent(out) :: self
    type(masses_t) :: masses
    real(wp), allocatable :: mass(:)
    integer :: k

    self%system = system
    deallocate (self%system%load)
    allocate (self%system%load(0))
    call find_system_pattern(self%system)
    call new_iterate(self%system, self%rest)
    self%rest%state = state
    call assemble(self%system, level, self%rest)
    allocate (self%unit(system%unknowns))
    do k = 1, system%coordinates
      if (system%unknown(k) > 0) self%unit(system%unknown(k)) = coordinate_scale(system, k)
    end do
    self%row = self%system%pattern%row
    self%column = self%system%pattern%column
    allocate (mass(size(self%row)))
    call new_masses(model, self%system, masses)
    call assemble_mass(self%system, masses, state, mass)
    self%near = merge(self%rest%values, 0.0_wp, self%row <= system%unknowns)
    self%near = stiffness_part/largest_diagonal(self, self%near)*self%near
    do k = 1, size(self%row)
      if (self%row(k) /= self%column(k) .or. self%row(k) > system%unknowns) cycle
      self%near(k) = self%near(k) + identity_part/self%unit(self%row(k))**2
    end do
    self%values = mass/largest_diagonal(self, mass) + self%near
    where (self%row > system%unknowns) self%values = self%rest%values
  end subroutine new_problem

  !> Largest entry of a positive semidefinite matrix in scaled coordinates; 1 if it is zero.
  pure real(wp) function largest_diagonal(self, values) result(largest)
    type(problem_t), intent(in) :: self
    real(wp), intent(in) :: values(:)
    integer :: k

    largest = 0
    do k = 1, size(values)
      if (self%row(k) /= self%column(k) .or. self%row(k) > size(self%unit)) cycle
      largest = max(largest, values(k)*self%unit(self%row(k))**2)
    end do
    if (.not. largest > 0) largest = 1
  end function largest_diagonal

  !> Rows of what is given, and the right-hand side.
  subroutine add_conditions(model, rate, self)
    type(model_t), intent(in) :: model
    real(wp), intent(in) :: rate(:)
    type(problem_t), intent(inout) :: self
    integer, allocatable :: start(:)
    integer :: i, k, n

    start = pack([(i, i=1, size(model%start))], model%start%rate)
    allocate (self%given(size(start)), self%demand(self%system%equations() + size(start)))
    self%demand = 0
    do k = 1, size(rate)
      associate (at => self%system%multiplier(k))
        if (at > 0) self%demand(at) = rate(k)
      end associate
    end do
    n = 0
    do i = 1, size(start)
      self%given(i)%start = start(i)
      call find_condition(model, model%start(start(i)), self, self%given(i))
      n = n + 1 + size(self%given(i)%coordinate)
    end do
    call make_room(self, n)
    do i = 1, size(start)
      n = self%system%equations() + i
      self%demand(n) = self%given(i)%value
      call add_entry(self, n, n, -compliance)
      do k = 1, size(self%given(i)%coordinate)
        associate (unknown => self%system%unknown(self%given(i)%coordinate(k)))
          if (unknown > 0) call add_entry(self, n, unknown, self%given(i)%factor(k))
        end associate
      end do
    end do
    self%row = self%row(:self%entries)
    self%column = self%column(:self%entries)
    self%values = self%values(:self%entries)
    self%near = self%near(:self%entries)
  end subroutine add_conditions

  !> Room for `n` entries more.
  subroutine make_room(self, n)
    type(problem_t), intent(inout) :: self
    integer, intent(in) :: n
    integer :: k

    self%entries = size(self%row)
    self%row = [self%row, (0, k=1, n)]
    self%column = [self%column, (0, k=1, n)]
    self%values = [self%values, (0.0_wp, k=1, n)]
    self%near = [self%near, (0.0_wp, k=1, n)]
  end subroutine make_room

  subroutine add_entry(self, row, column, entry)
    type(problem_t), intent(inout) :: self
    integer, intent(in) :: row, column
    real(wp), intent(in) :: entry

    self%entries = self%entries + 1
    self%row(self%entries) = row
    self%column(self%entries) = column
    self%values(self%entries) = entry
  end subroutine add_entry

  !> A card as a condition, scaled so that its largest factor is one for a motion as large as the
  !> model.
  subroutine find_condition(model, start, self, condition)
    type(model_t), intent(in) :: model
    type(start_t), intent(in) :: start
    type(problem_t), intent(in) :: self
    type(condition_t), intent(inout) :: condition
    real(wp) :: largest
    integer :: i

    if (start%node > 0) then
      condition%coordinate = [coordinate_number(start%node, start%component)]
      condition%factor = [1.0_wp]
    else if (start%member > 0) then
      call member_condition(model, start, self, condition)
    else
      call strain_condition(self, self%system%members + start%joint, start%mode, condition)
    end if
    largest = tiny(1.0_wp)
    do i = 1, size(condition%coordinate)
      largest = max(largest, abs(condition%factor(i)) &
                    *coordinate_scale(self%system, condition%coordinate(i)))
    end do
    condition%factor = condition%factor/largest
    condition%value = start%value/largest
  end subroutine find_condition

  !> A strain of a beam, about its centroid as in the results; a released one that has a coordinate
  !> of its own is that coordinate.
  subroutine member_condition(model, start, self, condition)
    type(model_t), intent(in) :: model
    type(start_t), intent(in) :: start
    type(problem_t), intent(in) :: self
    type(condition_t), intent(inout) :: condition
    type(condition_t) :: twist
    real(wp) :: shift(3:6)

    associate (element => self%system%element(start%member)%e, &
               status => model%member(start%member)%status)
      if (status(start%mode) == mode_released .and. element%coordinates > beam_coordinates) then
        condition%coordinate = [element%coordinate(beam_coordinates + &
                                                   count(status(:start%mode) == mode_released))]
        condition%factor = [1.0_wp]
        return
      end if
    end associate
    call strain_condition(self, start%member, start%mode, condition)
    if (start%mode < 3 .or. start%mode > 6) return
    shift = shear_centre_shift(model, start%member)
    call strain_condition(self, start%member, 2, twist)
    condition%factor = condition%factor - shift(start%mode)*twist%factor
  end subroutine member_condition

  !> The rate of strain `i` of element `e`.
  pure subroutine strain_condition(self, e, i, condition)
    type(problem_t), intent(in) :: self
    integer, intent(in) :: e, i
    type(condition_t), intent(inout) :: condition

    associate (element => self%system%element(e)%e)
      condition%coordinate = element%coordinate
      condition%factor = self%rest%jacobian(self%system%jacobian(e) + i: &
                                            self%system%jacobian(e + 1):element%strains)
    end associate
  end subroutine strain_condition

  !> The proximal iteration, one factorization.
  subroutine solve(self, velocity, error)
    type(problem_t), intent(in) :: self
    real(wp), intent(inout) :: velocity(:)
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver
    real(wp), dimension(size(self%demand)) :: x, next
    integer :: i, k

    x = 0
    call solver%prepare(size(x), self%row, self%column, .true., error)
    if (.not. allocated(error)) call solver%factorize(self%values, error)
    do i = 1, most_iterations
      if (allocated(error)) exit
      next = self%demand + near_product(self, x)
      call solver%solve(next, error)
      associate (n => size(self%unit))
        if (maxval(abs(next(:n) - x(:n))/self%unit) <= settled*maxval(abs(next(:n))/self%unit)) exit
      end associate
      x = next
    end do
    call solver%free()
    do k = 1, size(velocity)
      if (self%system%unknown(k) > 0) velocity(k) = x(self%system%unknown(k))
    end do
  end subroutine solve

  !> R v, and what the compliance adds to the rows of the conditions.
  pure function near_product(self, x) result(product)
    type(problem_t), intent(in) :: self
    real(wp), intent(in) :: x(:)
    real(wp) :: product(size(x))
    integer :: k, n

    n = self%system%equations()
    product = 0
    product(n + 1:) = -compliance*x(n + 1:)
    do k = 1, size(self%near)
      associate (i => self%row(k), j => self%column(k))
        product(i) = product(i) + self%near(k)*x(j)
        if (i /= j) product(j) = product(j) + self%near(k)*x(i)
      end associate
    end do
  end function near_product

  !> Everything given must have come true.
  subroutine check_given(model, self, velocity, error)
    type(model_t), intent(in) :: model
    type(problem_t), intent(in) :: self
    real(wp), intent(in) :: velocity(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%given)) :: found, lack
    character(len=:), allocatable :: name
    integer :: i, e

    do i = 1, size(self%given)
      found(i) = dot_product(self%given(i)%factor, velocity(self%given(i)%coordinate))
      lack(i) = abs(found(i) - self%given(i)%value)
    end do
    if (.not. any(lack > agreed*maxval(abs(self%demand)))) return
    i = maxloc(lack*(1 - 1.0e-6_wp*[(1.0_wp/i, i=1, size(lack))]), 1)
    associate (start => model%start(self%given(i)%start))
      if (start%node > 0) then
        name = "STARTDX: "//coordinate_name(model, coordinate_number(start%node, start%component))
      else
        e = max(start%member, self%system%members + start%joint)
        if (start%member > 0) e = start%member
        name = "STARTDE: "//strain_name(model, self%system, self%system%first(e) + start%mode)
      end if
      call fail(error, exit_deck, name//" cannot change at a rate of "//to_text(start%value, 4)// &
                ": constraints, prescribed motions and other initial velocities contradict it")
    end associate
  end subroutine check_given

  !> Held strains that follow from others must move as these make them.
  subroutine check_constraints(model, self, rate, velocity, error)
    type(model_t), intent(in) :: model
    type(problem_t), intent(in) :: self
    real(wp), intent(in) :: rate(:), velocity(:)
    type(error_t), allocatable, intent(out) :: error
    type(condition_t) :: held
    real(wp) :: found, tolerance
    integer :: e, i, k

    do e = 1, size(self%system%element)
      do i = 1, self%system%element(e)%e%strains
        k = self%system%first(e) + i
        if (.not. self%system%element(e)%e%fixed(i)) cycle
        call strain_condition(self, e, i, held)
        found = dot_product(held%factor, velocity(held%coordinate))
        tolerance = agreed*(abs(rate(k)) + dot_product(abs(held%factor), &
                                                       abs(velocity(held%coordinate)))) &
                    + settled*maxval(abs(held%factor))*maxval(abs(velocity))
        if (abs(found - rate(k)) <= tolerance) cycle
        call fail(error, exit_deck, "the prescribed motions contradict each other at the "// &
                  "start: "//strain_name(model, self%system, k)//" should change at a rate of "// &
                  to_text(rate(k), 4)//", the others make it "//to_text(found, 4))
        return
      end do
    end do
  end subroutine check_constraints

end module start_velocity
