!> Which way a motion leaves a singular position it starts in.
!>
!> There velocities v with C v = rates of the targets are not determined: v = w + N p. Constraints
!> that depend on the others there, y'C = 0, can go on only if y'(second rates - v'Hv) = 0, a
!> quadratic equation for p for each. A simple root is a motion that goes on; of several, initial
!> velocities that are given choose. Where everything starts from rest the accelerations take the
!> place of velocities.
module singular_start
  use kinds, only: wp
  use errors, only: error_t
  use model_data, only: model_t
  use nodal_state, only: state_t, node_coordinates
  use element_base, only: element_t
  use linalg_dense, only: dense_symmetric_t
  use system_data, only: system_t
  use system_build, only: number_multipliers
  use system_unstressed, only: unstressed_t, new_unstressed
  use system_motion, only: target_rates
  use system_rates, only: strain_rates
  use system_unknowns, only: by_coordinate, held_entries
  use start_velocity, only: given_lacks
  implicit none
  private

  public :: departure_t, find_departure

  !> What is found.
  type :: departure_t
    logical :: singular = .false.        !< the position is; else nothing else is known
    integer :: ways = 0                  !< motions that go on: none, one, or 2 for more
    integer :: order = 0                 !< they differ in velocity 1, acceleration 2; at rest 0
    integer :: freedoms = 0              !< by which more velocities are open than equations tell
    real(wp), allocatable :: rate(:)     !< the velocity or acceleration of one way, by coordinate
    integer :: strain = 0                !< one that depends on others
    integer :: coordinate = 0            !< one by whose velocity ways differ
  end type departure_t

  !> What velocities there are, and what they have to satisfy.
  type :: fork_t
    type(unstressed_t) :: at             !< without the singular constraints
    integer, allocatable :: strain(:)    !< the singular constraints
    real(wp), allocatable :: w(:)        !< a velocity with the rates of the targets, by coordinate
    real(wp), allocatable :: weight(:, :)      !< by strain, of each singular constraint: y
    real(wp), allocatable :: second(:)         !< its y'(second rates of the targets)
    real(wp), allocatable :: form(:, :, :)     !< its y'H between w and the free velocities
    real(wp), allocatable :: given(:), given_by(:, :)  !< what initial velocities lack at w; by free
  end type fork_t

  !> Smaller parts are round-off; roots closer than this to each other are one.
  real(wp), parameter :: none = 1.0e-8_wp, same = 1.0e-6_wp, round_off = 1.0e-12_wp

  integer, parameter :: most_starts = 40, most_iterations = 40

contains

  !> How many motions go on from a state, at the time of the timed patterns' `level`. `velocity`:
  !> one that the prescribed motions allow, if it is known.
  subroutine find_departure(model, system, state, level, departure, error, velocity)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    real(wp), intent(in) :: level(:)
    type(departure_t), intent(out) :: departure
    type(error_t), allocatable, intent(out) :: error
    real(wp), intent(in), optional :: velocity(:)
    type(fork_t) :: fork

    if (.not. any(system%singular .and. .not. system%dropped)) return
    call new_fork(system, state, fork, error)
    if (.not. allocated(error) .and. is_singular(fork)) then
      departure%singular = .true.
      departure%strain = fork%strain(1)
      departure%freedoms = size(fork%at%free, 2) - size(fork%strain)
      departure%coordinate = leader(fork)
      call set_rates(model, system, level, fork, departure%order, error, velocity)
      if (.not. allocated(error)) call add_givens(model, departure%order, fork)
      if (.not. allocated(error)) call find_ways(fork, departure, error)
    end if
    call fork%at%solver%free()
  end subroutine find_departure

  !> The node's coordinate that the first free velocity changes most; 0: there is none.
  pure integer function leader(self)
    type(fork_t), intent(in) :: self
    integer :: k

    leader = 0
    if (size(self%at%free, 2) == 0) return
    leader = 1
    do k = 2, node_coordinates*self%at%system%nodes
      if (abs(self%at%free(k, 1))/self%at%scale(k) > &
          (1 + same)*abs(self%at%free(leader, 1))/self%at%scale(leader)) leader = k
    end do
  end function leader

  !> w and the equations; of the accelerations where all is at rest and may stay so to first order.
  subroutine set_rates(model, system, level, self, order, error, velocity)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    type(fork_t), intent(inout) :: self
    integer, intent(out) :: order
    type(error_t), allocatable, intent(out) :: error
    real(wp), intent(in), optional :: velocity(:)
    real(wp), dimension(size(system%multiplier)) :: first, second

    call target_rates(system, level, first, second)
    order = 1
    if (present(velocity)) then
      self%w = velocity
    else
      call solve_rates(self, first, self%w, error)
      if (allocated(error)) return
    end if
    self%second = matmul(second, self%weight)
    if (.not. any(abs(self%w) > 0) .and. .not. any(model%start%rate) .and. &
        all(abs(self%second) <= none*maxval(abs(second)))) then
      order = merge(2, 0, any(abs(second) > 0))
      call solve_rates(self, second, self%w, error)
      self%second = 0
    end if
    call find_forms(self)
  end subroutine set_rates

  !> The system without the singular constraints.
  subroutine new_fork(system, state, self, error)
    type(system_t), intent(in) :: system
    type(state_t), intent(in) :: state
    type(fork_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    type(system_t) :: loose
    integer :: k

    self%strain = pack([(k, k=1, size(system%singular))], &
                       system%singular .and. .not. system%dropped)
    loose = system
    loose%dropped(self%strain) = .true.
    call number_multipliers(loose)
    call new_unstressed(loose, state, self%at, error)
    if (allocated(error)) return
    allocate (self%w(system%coordinates))
    call find_weights(self, error)
  end subroutine new_fork

  !> y of each singular constraint: 1 for itself; it is the sum of the others with the weights -y.
  subroutine find_weights(self, error)
    type(fork_t), intent(inout) :: self
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: x(self%at%system%equations())
    integer :: i, j, k, e

    allocate (self%weight(size(self%at%system%multiplier), size(self%strain)))
    self%weight = 0
    do i = 1, size(self%strain)
      e = findloc(self%at%system%first < self%strain(i), .true., 1, back=.true.)
      x = 0
      associate (element => self%at%system%element(e)%e)
        do j = 1, element%coordinates
          k = self%at%system%jacobian(e) + (j - 1)*element%strains + self%strain(i) &
              - self%at%system%first(e)
          associate (at => self%at%system%unknown(element%coordinate(j)))
            if (at > 0) x(at) = x(at) + self%at%iterate%jacobian(k)
          end associate
        end do
      end associate
      call self%at%solver%solve(x, error)
      if (allocated(error)) return
      do k = 1, size(self%weight, 1)
        associate (at => self%at%system%multiplier(k))
          if (at > 0) self%weight(k, i) = -x(at)
        end associate
      end do
      self%weight(self%strain(i), i) = 1
    end do
  end subroutine find_weights

  !> y'H between the velocities w and N.
  subroutine find_forms(self)
    type(fork_t), intent(inout) :: self
    integer :: i, e, n

    n = 1 + size(self%at%free, 2)
    if (allocated(self%form)) deallocate (self%form)
    allocate (self%form(n, n, size(self%strain)))
    self%form = 0
    do i = 1, size(self%strain)
      do e = 1, size(self%at%system%element)
        associate (y => self%weight(self%at%system%first(e) + 1:self%at%system%first(e + 1), i))
          if (any(abs(y) > none)) call add_form(self, self%at%system%element(e)%e, y, &
                                                self%form(:, :, i))
        end associate
      end do
    end do
  end subroutine find_forms

  subroutine add_form(self, element, y, form)
    type(fork_t), intent(in) :: self
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: y(element%strains)
    real(wp), intent(inout) :: form(:, :)
    real(wp) :: strain(element%strains), jacobian(element%strains, element%coordinates)
    real(wp) :: geometric(element%coordinates, element%coordinates)
    real(wp) :: v(element%coordinates, size(form, 1))
    logical :: valid

    call element%evaluate(self%at%iterate%state, y, strain, jacobian, geometric, valid)
    v(:, 1) = self%w(element%coordinate)
    v(:, 2:) = self%at%free(element%coordinate, :)
    form = form + matmul(transpose(v), matmul(geometric, v))
  end subroutine add_form

  !> Whether no singular constraint resists what the others leave free.
  logical function is_singular(self)
    type(fork_t), intent(in) :: self
    real(wp), dimension(size(self%at%system%multiplier)) :: rate
    integer :: i

    is_singular = .true.
    do i = 1, size(self%at%free, 2)
      call strain_rates(self%at%system, self%at%iterate, self%at%free(:, i), rate)
      if (any(abs(rate(self%strain)) > none*self%at%system%length)) is_singular = .false.
    end do
  end function is_singular

  !> Coordinates' rates for rates of the held strains, by strain.
  subroutine solve_rates(self, rate, x, error)
    type(fork_t), intent(inout) :: self
    real(wp), intent(in) :: rate(:)
    real(wp), intent(out) :: x(:)
    type(error_t), allocatable, intent(out) :: error
    real(wp) :: solution(self%at%system%equations())

    solution = held_entries(self%at%system, rate)
    call self%at%solver%solve(solution, error)
    x = by_coordinate(self%at%system, solution)
  end subroutine solve_rates

  !> What the singular constraints' second rates lack for velocities w + N p, N what moves freely.
  pure function lacks(self, p) result(lack)
    type(fork_t), intent(in) :: self
    real(wp), intent(in) :: p(:)
    real(wp) :: lack(size(self%strain))
    integer :: i

    do i = 1, size(lack)
      lack(i) = self%second(i) - dot_product([1.0_wp, p], matmul(self%form(:, :, i), [1.0_wp, p]))
    end do
  end function lacks

  !> Initial velocities that are given.
  subroutine add_givens(model, order, self)
    type(model_t), intent(in) :: model
    integer, intent(in) :: order
    type(fork_t), intent(inout) :: self
    real(wp) :: lack(count(model%start%rate))
    integer :: i, n

    n = merge(size(lack), 0, order == 1)
    allocate (self%given(n), self%given_by(n, size(self%at%free, 2)))
    if (n == 0) return
    call given_lacks(model, self%at%system, self%at%iterate, self%w, self%given)
    do i = 1, size(self%at%free, 2)
      call given_lacks(model, self%at%system, self%at%iterate, self%w + self%at%free(:, i), lack)
      self%given_by(:, i) = lack - self%given
    end do
  end subroutine add_givens

  !> Roots, from irregular starts; two are enough.
  subroutine find_ways(self, departure, error)
    type(fork_t), intent(inout) :: self
    type(departure_t), intent(inout) :: departure
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%at%free, 2)) :: p, first
    real(wp) :: unit
    integer :: start, i
    logical :: found

    allocate (departure%rate, source=self%w)
    if (departure%order == 0 .or. size(p) == 0) return
    unit = maxval(abs(self%w/self%at%scale))
    p = 0
    unit = max(unit, sqrt(maxval(abs(lacks(self, p)))/self%at%system%length))
    if (size(self%given) > 0) unit = max(unit, maxval(abs(self%given)))
    if (.not. unit > 0) then
      departure%order = 0
      return
    end if
    if (departure%freedoms > 0) then
      call find_root(self, unit, p, found, error)
      departure%ways = merge(1, 2, found .and. .not. any(abs(p) > 0))
      return
    end if
    do start = 1, most_starts
      p = [(sin(real(i*(2*start + 1), wp) + 0.1_wp*i*i + start), i=1, size(p))]
      p = 3*unit*p
      call find_root(self, unit, p, found, error)
      if (allocated(error)) return
      if (.not. found) cycle
      if (departure%ways == 0) then
        departure%ways = 1
        first = p
      else if (maxval(abs(p - first)) > same*(unit + maxval(abs(first)))) then
        departure%ways = 2
      end if
      if (departure%ways == 2 .or. size(self%given) >= size(p)) exit
    end do
    if (departure%ways > 0) departure%rate = self%w + matmul(self%at%free, first)
  end subroutine find_ways

  !> Newton for the quadratic equations and the velocities given, as least squares; `found` is a
  !> simple root.
  subroutine find_root(self, unit, p, found, error)
    type(fork_t), intent(in) :: self
    real(wp), intent(in) :: unit           !< size of velocities
    real(wp), intent(inout) :: p(:)
    logical, intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(self%strain) + size(self%given)) :: f, size_of
    real(wp) :: j(size(f), size(p)), normal(size(p), size(p)), change(size(p))
    type(dense_symmetric_t) :: factors
    integer :: iteration, i

    do iteration = 1, most_iterations
      call find_equations(self, p, f, j)
      size_of = 1
      associate (s => size(self%strain))
        size_of(:s) = maxval(abs(j(:s, :)), 2)
        found = all(abs(f(:s)) <= round_off*size_of(:s)*(unit + maxval(abs(p)))) .and. &
                all(abs(f(s + 1:)) <= none*(unit + maxval(abs(p)))) .and. &
                all(size_of(:s) > none*unit*self%at%system%length)
      end associate
      if (found) return
      size_of = max(size_of, unit*none)
      j = j/spread(size_of, 2, size(p))
      normal = matmul(transpose(j), j)
      do i = 1, size(p)
        normal(i, i) = normal(i, i) + none**2
      end do
      change = -matmul(f/size_of, j)
      call factors%factorize(normal, error)
      if (.not. allocated(error)) call factors%solve(change, error)
      if (allocated(error)) return
      p = p + change
      if (.not. maxval(abs(p)) < unit/none) return
    end do
    found = .false.
  end subroutine find_root

  !> What the equations lack for velocities w + N p, and the derivatives to p.
  pure subroutine find_equations(self, p, f, j)
    type(fork_t), intent(in) :: self
    real(wp), intent(in) :: p(:)
    real(wp), intent(out) :: f(:), j(:, :)
    integer :: i, s

    s = size(self%strain)
    f(:s) = lacks(self, p)
    f(s + 1:) = self%given + matmul(self%given_by, p)
    do i = 1, s
      j(i, :) = -2*matmul([1.0_wp, p], self%form(:, 2:, i))
    end do
    j(s + 1:, :) = self%given_by
  end subroutine find_equations

end module singular_start
