!> Prescribed strains and coordinates: where they are to be at a load factor or time, and how fast
!> that changes.
module system_motion
  use kinds, only: wp
  use model_data, only: model_t, motion_t, time_analyses
  use model_functions, only: function_value, function_jet
  use system_data, only: system_t, drive_t, turn_t
  implicit none
  private

  public :: make_motions, set_targets, target_rates, target_direction, overturned
  public :: mark_timed

  !> An angle driven to this, in radians, has no rotation of its own any more: lambda = sin(angle/2)
  !> turns back.
  real(wp), parameter, public :: largest_angle = acos(-1.0_wp)

contains

  !> The motions of all patterns, each with the strain it drives, and the rotations that are held or
  !> driven. Elements and the numbers of their strains are known.
  subroutine make_motions(model, system)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    integer :: p, i, n
    logical :: euler(size(system%element))

    n = 0
    do p = 1, size(model%pattern)
      n = n + model%pattern(p)%motions
    end do
    allocate (system%drive(n))
    euler = .false.
    n = 0
    do p = 1, size(model%pattern)
      do i = 1, model%pattern(p)%motions
        n = n + 1
        associate (motion => model%pattern(p)%motion(i))
          system%drive(n) = drive_t(driven_strain(system, motion), p, motion%function, &
                                    motion%value, motion%velocity, motion%acceleration)
          if (motion%euler) euler(system%holder(motion%component, motion%node)) = .true.
        end associate
      end do
    end do
    allocate (system%turn(count([(any(system%holder(4:6, i) > 0), i=1, system%nodes)])))
    n = 0
    do i = 1, system%nodes
      associate (e => maxval(system%holder(4:6, i)))
        if (e == 0) cycle
        n = n + 1
        system%turn(n) = turn_t(system%first(e) + 1, system%element(e)%e%strains, euler(e))
      end associate
    end do
  end subroutine make_motions

  !> The patterns that the motions in time among the analyses `from` to `to` bring.
  pure subroutine mark_timed(model, from, to, timed)
    type(model_t), intent(in) :: model
    integer, intent(in) :: from, to
    logical, intent(inout) :: timed(:)
    integer :: i

    do i = from, to
      associate (analysis => model%analysis(i))
        if (.not. any(time_analyses == analysis%kind) .or. analysis%pattern == 0) cycle
        timed(analysis%pattern) = .true.
      end associate
    end do
  end subroutine mark_timed

  !> The strain that a motion drives: of an element, or the one that stands for a coordinate.
  pure integer function driven_strain(system, motion) result(strain)
    type(system_t), intent(in) :: system
    type(motion_t), intent(in) :: motion

    if (motion%member > 0) then
      strain = system%first(motion%member) + motion%mode
    else if (motion%joint > 0) then
      strain = system%first(system%members + motion%joint) + motion%mode
    else
      associate (holder => system%holder(:, motion%node), c => motion%component)
        strain = system%first(holder(c)) + count(holder(:c) == holder(c))
      end associate
    end if
  end function driven_strain

  !> Where held strains are to be, by strain; zero where nothing drives them.
  pure subroutine set_targets(system, level, target)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)   !< load factor, or time, of each pattern
    real(wp), intent(out) :: target(:)
    real(wp), dimension(size(target)) :: first, second
    integer :: p

    call derivatives(system, level, [(.false., p=1, size(level))], target, first, second)
  end subroutine set_targets

  !> Velocities and accelerations of the held strains at the time of the timed patterns.
  pure subroutine target_rates(system, level, velocity, acceleration)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    real(wp), intent(out) :: velocity(:), acceleration(:)  !< by strain
    real(wp) :: target(size(velocity))

    call derivatives(system, level, system%timed, target, velocity, acceleration)
  end subroutine target_rates

  !> Derivative of the targets to the level of one pattern, by strain, and their second one.
  pure subroutine target_direction(system, level, pattern, direction, curvature)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    integer, intent(in) :: pattern
    real(wp), intent(out) :: direction(:)
    real(wp), intent(out), optional :: curvature(:)
    real(wp) :: target(size(direction)), second(size(direction))
    integer :: p

    direction = 0
    second = 0
    if (size(system%drive) > 0) call derivatives( &
      system, level, [(p == pattern, p=1, size(level))], target, direction, second)
    if (present(curvature)) curvature = second
  end subroutine target_direction

  !> Targets and their first and second derivatives to the levels of the patterns marked, which
  !> all grow alike.
  pure subroutine derivatives(system, level, growing, target, first, second)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    logical, intent(in) :: growing(:)
    real(wp), intent(out) :: target(:), first(:), second(:)
    real(wp) :: jet(0:2, size(system%drive)), turned(0:2, 3)
    integer :: i, j

    target = 0
    first = 0
    second = 0
    call parameters(system, level, growing, jet)
    do i = 1, size(system%drive)
      associate (k => system%drive(i)%strain)
        target(k) = target(k) + jet(0, i)
        first(k) = first(k) + jet(1, i)
        second(k) = second(k) + jet(2, i)
      end associate
    end do
    do i = 1, size(system%turn)
      if (system%turn(i)%euler) cycle
      turned = 0
      do j = 1, system%turn(i)%strains
        associate (k => system%turn(i)%first + j - 1)
          turned(:, j) = [target(k), first(k), second(k)]
        end associate
      end do
      call to_euler(turned)
      do j = 1, system%turn(i)%strains
        associate (k => system%turn(i)%first + j - 1)
          target(k) = turned(0, j)
          first(k) = turned(1, j)
          second(k) = turned(2, j)
        end associate
      end do
    end do
  end subroutine derivatives

  !> A rotation that its motions drive to a half turn or further, where its Euler parameters are
  !> stationary or do not exist: its first strain, and the angle [rad]. 0: none.
  pure subroutine overturned(system, level, strain, angle)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)  !< load factor, or time, of each pattern
    integer, intent(out) :: strain
    real(wp), intent(out) :: angle
    real(wp) :: jet(0:2, size(system%drive)), driven(3)
    integer :: i, j, p

    strain = 0
    angle = 0
    if (size(system%drive) == 0) return
    call parameters(system, level, [(.false., p=1, size(level))], jet)
    do i = 1, size(system%turn)
      associate (turn => system%turn(i))
        do j = 1, turn%strains
          driven(j) = sum(jet(0, :), system%drive%strain == turn%first + j - 1)
        end do
        angle = norm2(driven(:turn%strains))
        if (turn%euler) angle = 2*asin(min(angle, 1.0_wp))
        if (angle < largest_angle) cycle
        strain = turn%first
        return
      end associate
    end do
  end subroutine overturned

  !> What each motion contributes, with derivatives to the level of its pattern where that grows.
  pure subroutine parameters(system, level, growing, jet)
    type(system_t), intent(in) :: system
    real(wp), intent(in) :: level(:)
    logical, intent(in) :: growing(:)
    real(wp), intent(out) :: jet(0:, :)
    integer :: i

    do i = 1, size(system%drive)
      associate (d => system%drive(i), s => level(system%drive(i)%pattern))
        if (d%function > 0) then
          jet(1:2, i) = 0
          if (growing(d%pattern)) then
            call function_jet(system%function(d%function), s, jet(:, i))
          else
            jet(0, i) = function_value(system%function(d%function), s)
          end if
          jet(:, i) = d%value*jet(:, i)
        else if (system%timed(d%pattern)) then
          jet(:, i) = [d%value, 0.0_wp, 0.0_wp]
        else
          jet(:, i) = [d%value*s, d%value, 0.0_wp]
        end if
        if (system%timed(d%pattern)) jet(:, i) = jet(:, i) + &
          [d%velocity*s + 0.5_wp*d%acceleration*s**2, d%velocity + d%acceleration*s, d%acceleration]
        if (.not. growing(d%pattern)) jet(1:2, i) = 0
      end associate
    end do
  end subroutine parameters

  !> From a rotation vector, its first and second derivatives, to Euler parameters:
  !> lambda = g(s) theta with g = sin(sqrt(s)/2)/sqrt(s), s = theta.theta.
  pure subroutine to_euler(jet)
    real(wp), intent(inout) :: jet(0:2, 3)
    real(wp) :: s, ds, dds, t, g, dg, ddg, theta(0:2, 3)

    theta = jet
    s = dot_product(theta(0, :), theta(0, :))
    ds = 2*dot_product(theta(0, :), theta(1, :))
    dds = 2*(dot_product(theta(1, :), theta(1, :)) + dot_product(theta(0, :), theta(2, :)))
    if (s < 1.0e-2_wp) then  ! the next terms are below round-off
      g = 0.5_wp - s/48 + s**2/3840 - s**3/645120 + s**4/185794560
      dg = -1.0_wp/48 + s/1920 - s**2/215040 + s**3/46448640
      ddg = 1.0_wp/1920 - s/107520 + s**2/15482880
    else
      t = sqrt(s)
      g = sin(0.5_wp*t)/t
      dg = (0.5_wp*cos(0.5_wp*t) - g)/(2*s)
      ddg = (-g/4 - 6*dg)/(4*s)
    end if
    jet(0, :) = g*theta(0, :)
    jet(1, :) = g*theta(1, :) + dg*ds*theta(0, :)
    jet(2, :) = g*theta(2, :) + 2*dg*ds*theta(1, :) + (ddg*ds**2 + dg*dds)*theta(0, :)
  end subroutine to_euler

end module system_motion
