!> Nanoseconds per tangent of a BEAMW element: strains, Jacobian, geometric stiffness and their
!> product with the law, as the assembly does it, on one core. Prints the median of eleven rounds.
program bench_tangent
  use, intrinsic :: iso_fortran_env, only: output_unit
  use kinds, only: wp, i8
  use beamw_rigidity, only: rigidity_t
  use beamw_constants, only: beamw_t, new_beamw, beamw_consistent
  use element_base, only: element_t
  use element_beamw, only: new_element_beamw
  use nodal_state, only: state_t, new_state
  use rotation, only: turned
  implicit none
  integer, parameter :: rounds = 11, repeats = 20000
  type(beamw_t), pointer :: constants
  class(element_t), allocatable :: element
  type(state_t) :: state
  type(rigidity_t) :: rigidity
  real(wp) :: strain(9), stress(9), b(9, 14), g(14, 14), s(9, 9), sb(9, 14)
  real(wp) :: time(rounds), swap, check
  integer(i8) :: start, finish, rate
  integer :: round, i, j, k
  logical :: valid

  rigidity = rigidity_t(ea=58.8_wp*21000, eiy=8038.7_wp*21000, eiz=559.9_wp*21000, &
                        git=35.4_wp*8077, eiw=78943.0_wp*21000, ys=-6.08_wp, zs=1.0_wp, &
                        by=1.0_wp, bz=31.6_wp, bw=0.1_wp, eir=189469.0_wp*21000, polar=146.2_wp)
  rigidity%gd = 8077*reshape([13.4_wp, 1.0_wp, 3.0_wp, 1.0_wp, 26.8_wp, 59.0_wp, 3.0_wp, 59.0_wp, &
                              4338.0_wp], [3, 3])
  rigidity%shear_rigid = .false.
  allocate (constants)
  constants = new_beamw(rigidity, 90.0_wp, beamw_consistent)
  call new_element_beamw(reshape([1, 1, 1, 2, 2, 2], [3, 2]), 2, [90, 0, 0]*1.0_wp, &
                         reshape([1, 0, 0, 0, 1, 0, 0, 0, 1]*1.0_wp, [3, 3]), &
                         [(.false., i=1, 8)], [(0, i=1, 8)], constants, element)
  call new_state(2, 0, 0, state)
  state%euler(:, 2) = turned(state%euler(:, 2), [0.1_wp, 0.05_wp, -0.02_wp])
  state%displacement(:, 2) = [-0.5_wp, 1.0_wp, 2.0_wp]
  stress = [(1.0_wp*i, i=1, 9)]
  check = 0
  do round = 1, rounds
    call system_clock(start, rate)
    do k = 1, repeats
      call element%evaluate(state, stress, strain, b, g, valid)
      call element%law(s)
      sb = matmul(s, b)
      do j = 1, 14
        do i = 1, j
          g(i, j) = g(i, j) + dot_product(b(:, i), sb(:, j))
          g(j, i) = g(i, j)
        end do
      end do
      stress = matmul(s, strain)
      check = check + g(1, 1)
    end do
    call system_clock(finish)
    time(round) = 1.0e9_wp*real(finish - start, wp)/real(rate, wp)/repeats
  end do
  do i = 2, rounds
    do j = i, 2, -1
      if (time(j) >= time(j - 1)) exit
      swap = time(j)
      time(j) = time(j - 1)
      time(j - 1) = swap
    end do
  end do
  if (check < 0) write (output_unit, "(a)") "unexpected tangent"
  write (output_unit, "(i0)") nint(time(rounds/2 + 1))
end program bench_tangent
