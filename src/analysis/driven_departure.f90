!> The start of a driven motion in a singular position: what the position leaves open comes from
!> positions a little later on the same way.
module driven_departure
  use kinds, only: wp
  use errors, only: error_t
  use nodal_state, only: state_t
  use system_assembly, only: assemble
  use system_dynamics, only: inertia_forces
  use driven_motion, only: driven_t, find_undriven, find_motion
  use singular_start, only: departure_t
  use newton_method, only: newton_outcome_t, newton_converged, newton_diverged
  implicit none
  private

  public :: depart

  !> The first of the later positions is this far away, in lengths of the model or radians, for
  !> motions that differ in velocity and in acceleration.
  real(wp), parameter :: first_step(2) = [1.5e-2_wp, 3.0e-3_wp]

  !> Weights of values at 1, 2, ... 6 that give that at 0 of a polynomial of fifth degree.
  real(wp), parameter :: weight(6) = [6, -15, 20, -15, 6, -1]

  !> The same of a polynomial of fourth degree. Forces for which both differ by more are not finite.
  real(wp), parameter :: fewer(6) = [5, -10, 10, -5, 1, 0], unlike = 1.0e-2_wp

  !> The rates found and those of the way agree to this.
  real(wp), parameter :: on_the_way = 1.0e-3_wp

contains

  !> Rates and stress resultants at the start, which stays; the rate by which ways differ is known.
  !> `finite`: the stress resultants at the start are.
  subroutine depart(driven, departure, time, level, finite, outcome, error)
    type(driven_t), intent(inout) :: driven
    type(departure_t), intent(in) :: departure
    real(wp), intent(in) :: time
    real(wp), intent(inout) :: level(:)    !< of the patterns, at the start
    logical, intent(out) :: finite
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(departure%rate), 2) :: rate, known
    type(state_t) :: start

    associate (motion => driven%motion, order => departure%order)
      start = motion%iterate%state
      known = 0
      known(:, order) = departure%rate
      rate = known
      call extrapolate(driven, departure, time, level, rate, finite, outcome, error)
      where (motion%system%timed) level = time
      motion%iterate%state = start
      if (allocated(error) .or. outcome%status /= newton_converged) return
      if (maxval(abs(rate(:, order) - departure%rate)/motion%scale) > &
          on_the_way*maxval(abs(departure%rate)/motion%scale)) outcome%status = newton_diverged
      if (order == 1) known(:, 2) = rate(:, 2)
      motion%flow%velocity = known(:, 1)
      motion%flow%acceleration = known(:, 2)
      motion%flow%pseudo = known(:, 2)
      if (driven%inertia) then
        motion%iterate%velocity = motion%flow%velocity
        call inertia_forces(motion%masses, motion%iterate%state, motion%flow%velocity, &
                            motion%flow%acceleration + motion%mass_damping*motion%flow%velocity, &
                            motion%iterate%inertial)
      end if
      call assemble(motion%system, level, motion%iterate)
    end associate
  end subroutine depart

  !> Velocity and acceleration at the start from those a little later; stress resultants too, in
  !> `driven`.
  subroutine extrapolate(driven, departure, time, level, rate, finite, outcome, error)
    type(driven_t), intent(inout) :: driven
    type(departure_t), intent(in) :: departure
    real(wp), intent(in) :: time
    real(wp), intent(inout) :: level(:)
    real(wp), intent(inout) :: rate(:, :)  !< first guess in, result out
    logical, intent(out) :: finite
    type(newton_outcome_t), intent(out) :: outcome
    type(error_t), allocatable, intent(out) :: error
    real(wp), dimension(size(driven%motion%iterate%stress)) :: stress, other
    real(wp) :: h
    integer, allocatable :: undriven(:)
    integer :: k

    associate (motion => driven%motion)
      h = first_step(departure%order)/maxval(abs(departure%rate)/motion%scale)
      if (departure%order == 2) h = sqrt(2*h)
      motion%flow%velocity = rate(:, 1)
      motion%flow%acceleration = rate(:, 2)
      rate = 0
      stress = 0
      other = 0
      finite = .false.
      do k = 1, size(weight)
        call motion%iterate%state%move(h*motion%flow%velocity &
                                       + 0.5_wp*h**2*motion%flow%acceleration)
        where (motion%system%timed) level = time + k*h
        if (k == 1) call find_undriven(driven, level, undriven, error)
        if (.not. allocated(error)) call find_motion(driven, level, outcome, error)
        if (allocated(error) .or. outcome%status /= newton_converged) return
        rate(:, 1) = rate(:, 1) + weight(k)*motion%flow%velocity
        rate(:, 2) = rate(:, 2) + weight(k)*motion%flow%acceleration
        stress = stress + weight(k)*motion%iterate%stress
        other = other + fewer(k)*motion%iterate%stress
      end do
      finite = maxval(abs(stress - other)) <= unlike*maxval(abs(stress))
      motion%iterate%stress = stress
    end associate
  end subroutine extrapolate

end module driven_departure
