!> Rigid modes as limits, and the work of what drives a model.
module test_driving_forces
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use model_data, only: model_t, mode_flexible, mode_prescribed
  use memory_recorder, only: memory_t, run_deck
  use system_results, only: results_t
  implicit none
  private

  public :: run_driving_forces_tests

contains

  subroutine run_driving_forces_tests()
    call run("driving: rigid modes are the limit of stiff ones", rigid_limit)
    call run("driving: work of motions at finite rotations", work_balance)
  end subroutine run_driving_forces_tests

  subroutine solve(deck, settings, memory, model)
    character(len=*), intent(in) :: deck, settings(:)
    type(memory_t), intent(out) :: memory
    type(model_t), intent(out) :: model
    type(error_t), allocatable :: error

    call run_deck(deck, memory, model, error, settings)
    if (allocated(error)) call expect(.false., "no error, got: "//error%message)
  end subroutine solve

  !> Modes left out of DYNE against all modes flexible with 1e7 times the stiffness: six digits of
  !> displacements, stresses and frequencies. What is stiff is so in both decks, since Ip/A is
  !> (EIy + EIz)/EA.
  subroutine rigid_limit()
    call compare([character(len=16) :: "a=2", "ea=1e12"])
    call compare([character(len=16) :: "b=3", "git=9e9"])
    call compare([character(len=16) :: "a=2", "c=5", "d=6", "ea=1e12", "eiy=1.4e10"])
    call compare([character(len=16) :: "a=2", "e=3", "f=4", "ea=1e12", "eiz=1e10"])
  end subroutine rigid_limit

  !> `settings`: first those that leave modes out of DYNE, of one letter, then stiffnesses.
  subroutine compare(settings)
    character(len=*), intent(in) :: settings(:)
    type(memory_t) :: rigid, stiff
    type(model_t) :: model
    integer :: first

    first = count(index(settings, "=") == 2) + 1
    call solve("rigid_limit", settings, rigid, model)
    call solve("rigid_limit", settings(first:), stiff, model)
    call expect(rigid%steps == 5 .and. stiff%steps == 5, "all steps")
    call expect(size(rigid%spectrum) == 1 .and. size(stiff%spectrum) == 1, "frequencies of both")
    if (size(rigid%spectrum) /= 1 .or. size(stiff%spectrum) /= 1) return
    associate (a => rigid%results(5), b => stiff%results(5))
      call expect(norm2(a%displacement(:, 4)) > 0.5_wp, "large displacements")
      call expect_close(a%displacement, b%displacement, 1.0e-6_wp, "displacements")
      call expect_close(a%stress, b%stress, 1.0e-5_wp*maxval(abs(a%stress)), "stresses")
    end associate
    associate (a => rigid%spectrum(1)%frequency(:5), b => stiff%spectrum(1)%frequency(:5))
      call expect_close(b/a, spread(1.0_wp, 1, 5), 1.0e-6_wp, "frequencies")
    end associate
  end subroutine compare

  !> Reactions and stresses of prescribed strains do the work that springs and beams store. Summed
  !> by trapezia with 20 and 40 steps and extrapolated to fourth order.
  subroutine work_balance()
    real(wp) :: work(2), energy(2)

    call sum_up("steps=20", work(1), energy(1))
    call sum_up("steps=40", work(2), energy(2))
    call expect_close(energy(1), energy(2), 1.0e-9_wp*energy(2), "the same state")
    call expect(energy(2) > 1, "energy is stored")
    call expect_close((4*work(2) - work(1))/3, energy(2), 1.0e-7_wp*energy(2), "work")
  end subroutine work_balance

  subroutine sum_up(steps, work, energy)
    character(len=*), intent(in) :: steps
    real(wp), intent(out) :: work, energy
    type(memory_t) :: memory
    type(model_t) :: model
    type(results_t) :: start
    integer :: k

    work = 0
    energy = 0
    call solve("driven_work", [steps], memory, model)
    if (memory%steps < 1) return
    start = memory%results(1)
    start%displacement = 0
    start%euler = spread([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 2, size(start%euler, 2))
    start%reaction = 0
    start%joint_strain = 0
    start%joint_stress = 0
    work = work_between(model, start, memory%results(1))
    do k = 2, memory%steps
      work = work + work_between(model, memory%results(k - 1), memory%results(k))
    end do
    energy = stored(model, memory%results(memory%steps))
  end subroutine sum_up

  !> Mean forces times changes. A prescribed strain takes up the work stress times strain.
  real(wp) function work_between(model, a, b) result(work)
    type(model_t), intent(in) :: model
    type(results_t), intent(in) :: a, b
    integer :: i

    work = 0
    do i = 1, size(model%node)
      work = work + 0.5_wp*dot_product(a%reaction(1:3, i) + b%reaction(1:3, i), &
                                       b%displacement(:, i) - a%displacement(:, i))
      work = work + 0.5_wp*dot_product(a%reaction(4:6, i) + b%reaction(4:6, i), &
                                       rotation_between(a%euler(:, i), b%euler(:, i)))
    end do
    do i = 1, size(model%joint)
      work = work - 0.5_wp*sum((a%joint_stress(:, i) + b%joint_stress(:, i)) &
                               *(b%joint_strain(:, i) - a%joint_strain(:, i)), &
                               model%joint(i)%status == mode_prescribed)
    end do
  end function work_between

  !> The vector of the rotation that leads from p to q: q times the inverse of p.
  pure function rotation_between(p, q) result(theta)
    real(wp), intent(in) :: p(4), q(4)
    real(wp) :: theta(3), d(4), sine

    d(1) = dot_product(p, q)
    d(2:4) = p(1)*q(2:4) - q(1)*p(2:4) - [q(3)*p(4) - q(4)*p(3), q(4)*p(2) - q(2)*p(4), &
                                          q(2)*p(3) - q(3)*p(2)]
    sine = norm2(d(2:4))
    theta = 2*d(2:4)
    if (sine > 0) theta = 2*d(2:4)*atan2(sine, d(1))/sine
  end function rotation_between

  !> Half of strain times stress: SECOND NONE has no other terms.
  real(wp) function stored(model, now) result(energy)
    type(model_t), intent(in) :: model
    type(results_t), intent(in) :: now
    integer :: i

    energy = 0
    do i = 1, size(model%member)
      energy = energy + 0.5_wp*sum(now%strain(:, i)*now%stress(:, i), &
                                   model%member(i)%status == mode_flexible)
    end do
    do i = 1, size(model%joint)
      energy = energy + 0.5_wp*sum(now%joint_strain(:, i)*now%joint_stress(:, i), &
                                   model%joint(i)%status == mode_flexible)
    end do
  end function stored

end module test_driving_forces
