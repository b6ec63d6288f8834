!> Where the energy of a motion is and what passed in and out, by the trapezoidal rule over the
!> steps; results of a motion.
module energy_account
  use kinds, only: wp
  use model_data, only: model_t
  use nodal_state, only: node_coordinates
  use system_dynamics, only: kinetic_energy, momentum
  use system_results, only: results_t, get_results, joint_strains
  use dynamic_equilibrium, only: dynamics_t
  implicit none
  private

  public :: account_t, open_account, reopen_account, enter_step, motion_results, rate_results
  public :: motion_energy

  !> Energies at the start, works since then [F L], and what the next step's trapezes begin with.
  type :: account_t
    real(wp) :: opening = 0.0_wp
    real(wp) :: loads = 0.0_wp, motion = 0.0_wp, dissipated = 0.0_wp
    real(wp), allocatable :: external(:), stress(:), target(:)
    real(wp) :: power = 0.0_wp             !< lost in dampers [F L T^-1]
  end type account_t

contains

  !> Start the account with the present state, which is assembled.
  subroutine open_account(motion, account)
    type(dynamics_t), intent(in) :: motion
    type(account_t), intent(out) :: account

    account%opening = motion_energy(motion) + strain_energy(motion)
    call reopen_account(motion, account)
  end subroutine open_account

  !> Begin new trapezes with the present forces, after they jumped. Where prescribed motions did too
  !> that was work, and if velocities did, a drive gave them the difference of their energy to
  !> `kinetic`, that before [F L].
  subroutine reopen_account(motion, account, kinetic)
    type(dynamics_t), intent(in) :: motion
    type(account_t), intent(inout) :: account
    real(wp), intent(in), optional :: kinetic

    if (allocated(account%target)) account%motion = account%motion + drive_work(motion, account)
    account%external = motion%iterate%external
    account%stress = motion%iterate%stress
    account%target = motion%iterate%target
    account%power = lost_power(motion)
    if (present(kinetic)) account%motion = account%motion + motion_energy(motion) - kinetic
  end subroutine reopen_account

  !> Enter a step of length h with its increment of the coordinates.
  subroutine enter_step(motion, h, increment, account)
    type(dynamics_t), intent(in) :: motion
    real(wp), intent(in) :: h, increment(:)
    type(account_t), intent(inout) :: account
    real(wp) :: power

    associate (now => motion%iterate)
      account%loads = account%loads &
                      + 0.5_wp*dot_product(account%external + now%external, increment)
      account%motion = account%motion + drive_work(motion, account)
      power = lost_power(motion)
      account%dissipated = account%dissipated + 0.5_wp*h*(account%power + power)
      account%power = power
      account%external = now%external
      account%stress = now%stress
      account%target = now%target
    end associate
  end subroutine enter_step

  !> Of prescribed motions, since the account's forces and targets [F L].
  pure real(wp) function drive_work(motion, account) result(work)
    type(dynamics_t), intent(in) :: motion
    type(account_t), intent(in) :: account

    associate (now => motion%iterate)
      work = -0.5_wp*sum((account%stress + now%stress)*(now%target - account%target), &
                         motion%system%multiplier > 0)
    end associate
  end function drive_work

  !> Energy of the strains that have a law.
  pure real(wp) function strain_energy(motion) result(energy)
    type(dynamics_t), intent(in) :: motion

    energy = 0.5_wp*dot_product(motion%iterate%elastic + motion%system%initial_stress, &
                                motion%iterate%strain)
  end function strain_energy

  !> Power of the dampers: of strains, and of the mass.
  pure real(wp) function lost_power(motion) result(power)
    type(dynamics_t), intent(in) :: motion

    power = dot_product(motion%iterate%viscous, motion%iterate%rate)
    if (motion%mass_damping > 0) power = power + 2*motion%mass_damping*motion_energy(motion)
  end function lost_power

  pure real(wp) function motion_energy(motion) result(energy)
    type(dynamics_t), intent(in) :: motion

    energy = kinetic_energy(motion%system, motion%masses, motion%iterate%state, &
                            motion%flow%velocity)
  end function motion_energy

  !> Results at the present state of a motion: those of an equilibrium, rates, energies, momentum.
  subroutine motion_results(model, motion, account, results)
    type(model_t), intent(in) :: model
    type(dynamics_t), intent(in) :: motion
    type(account_t), intent(in) :: account
    type(results_t), intent(out) :: results
    real(wp) :: kinetic, strain

    call rate_results(model, motion, results)
    allocate (results%momentum(6))
    call momentum(motion%system, motion%masses, motion%iterate%state, motion%flow%velocity, &
                  kinetic, results%momentum)
    strain = strain_energy(motion)
    results%energy = [kinetic, strain, account%loads, account%motion, account%dissipated, &
                      kinetic + strain + account%dissipated - account%opening - account%loads &
                      - account%motion]
  end subroutine motion_results

  !> Results of an equilibrium and of the rates.
  subroutine rate_results(model, motion, results)
    type(model_t), intent(in) :: model
    type(dynamics_t), intent(in) :: motion
    type(results_t), intent(out) :: results
    integer :: n, i, j, k

    call get_results(model, motion%system, motion%iterate, results)
    n = node_coordinates*motion%system%nodes
    results%velocity = reshape(motion%flow%velocity(:n), [node_coordinates, motion%system%nodes])
    results%acceleration = reshape(motion%flow%acceleration(:n), &
                                   [node_coordinates, motion%system%nodes])
    allocate (results%joint_rate(joint_strains, motion%system%joints))
    results%joint_rate = 0
    do j = 1, motion%system%joints
      k = motion%system%first(motion%system%members + j)
      do i = 1, motion%system%element(motion%system%members + j)%e%strains
        results%joint_rate(i, j) = motion%iterate%rate(k + i)
      end do
    end do
  end subroutine rate_results

end module energy_account
