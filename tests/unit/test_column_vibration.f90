!> Frequencies of columns on forks, from the stiffness and the mass matrix of BEAMW.
module test_column_vibration
  use kinds, only: wp
  use errors, only: error_t
  use check, only: run, expect, expect_close
  use rotation, only: identity3, no_rotation
  use linalg_dense, only: dense_symmetric_t
  use nodal_state, only: state_t, new_state
  use element_base, only: element_t
  use element_beamw, only: new_element_beamw
  use beamw_rigidity, only: rigidity_t
  use beamw_constants, only: beamw_t, new_beamw, beamw_consistent
  use beamw_inertia, only: inertia_t, new_inertia, inertia_mass
  implicit none
  private

  public :: run_column_vibration_tests

  !> A column: section (N, m, kg), elastic constants, options.
  type :: column_t
    real(wp) :: e, g, rho, length
    real(wp) :: a, iy, iz, it, iw
    real(wp) :: centre(2)                  !< shear centre
    real(wp) :: d(3, 3) = 0.0_wp
    logical :: shear = .false.
    logical :: consistent = .true.
    logical :: follows_alpha = .true.      !< slope of the centroid line with its alpha term
    integer :: plane(2) = [2, 6]           !< coordinates that bend with the twist: Y RZ or Z RY
  end type column_t

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  subroutine run_column_vibration_tests()
    call run("inertia: eccentric column, rigid in shear, against closed form", rigid_in_shear)
    call run("inertia: eccentric column with shear, against the exact frequency", with_shear)
    call run("inertia: frequencies converge to the closed form", convergence)
  end subroutine run_column_vibration_tests

  !> The channel of the paper's table 1.
  pure function channel() result(c)
    type(column_t) :: c

    c = column_t(e=144.0e9_wp, g=4.14e9_wp, rho=1389.0_wp, length=6.0_wp, a=5.4e-2_wp, &
                 iy=3.78e-3_wp, iz=2.16e-3_wp, it=1.62e-5_wp, iw=1.3886e-4_wp, &
                 centre=[0.4571_wp, 0.0_wp], plane=[3, 5])
    c%d(1, 1) = 2.79e-2_wp
    c%d(2, 2) = 1.58e-2_wp
    c%d(3, 3) = 3.65e-3_wp
    c%d(2, 3) = -3.7e-3_wp
    c%d(3, 2) = -3.7e-3_wp
  end function channel

  !> Mono-symmetric I, flanges 150x10 and 75x10, web 290x7 mm.
  pure function i_section() result(c)
    type(column_t) :: c

    c = column_t(e=210.0e9_wp, g=210.0e9_wp/2.6_wp, rho=7850.0_wp, length=6.0_wp, a=0.00428_wp, &
                 iy=5.8769951e-05_wp, iz=3.1640625e-06_wp, it=1.0815667e-07_wp, &
                 iw=2.628125e-08_wp, centre=[0.0_wp, -0.087368899_wp])
  end function i_section

  !> The errors of two elements that theory 7 tells: 0.12 %, and 8.7 % without the alpha term.
  subroutine rigid_in_shear()
    type(column_t) :: c

    c = channel()
    call expect_close(frequency(c, 2)/exact(c) - 1, 0.0012_wp, 0.00005_wp, "two elements")
    c%follows_alpha = .false.
    call expect_close(frequency(c, 2)/exact(c) - 1, 0.087_wp, 0.0005_wp, "without alpha")
  end subroutine rigid_in_shear

  !> Reference case EIG-01, table 1 with rotary inertia: 33.164 Hz; 0.4 and 6.4 % (theory 7).
  subroutine with_shear()
    type(column_t) :: c
    real(wp), parameter :: wanted = 33.164_wp

    c = channel()
    c%shear = .true.
    call expect_close(frequency(c, 2)/wanted - 1, 0.004_wp, 0.0005_wp, "two elements")
    call expect_close(frequency(c, 16)/wanted - 1, 0.0_wp, 0.0002_wp, "sixteen elements")
    c%follows_alpha = .false.
    call expect_close(frequency(c, 2)/wanted - 1, 0.064_wp, 0.0005_wp, "without alpha")
  end subroutine with_shear

  !> Both mass matrices, at least of second order; the closed form is that of case EIG-07.
  subroutine convergence()
    type(column_t) :: c(4)
    real(wp) :: coarse, fine
    integer :: i

    c = [channel(), channel(), i_section(), i_section()]
    c%consistent = [.true., .false., .true., .false.]
    call expect_close(exact(c(3)), 5.663352124_wp, 1.0e-7_wp, "EIG-07, lowest frequency")
    do i = 1, 4
      coarse = abs(frequency(c(i), 8)/exact(c(i)) - 1)
      fine = abs(frequency(c(i), 16)/exact(c(i)) - 1)
      call expect(fine < 3.0e-6_wp, "sixteen elements")
      call expect(fine < coarse/3.8_wp, "order")
    end do
  end subroutine convergence

  !> Lowest frequency [Hz] of sin(pi x/L) of shear centre and twist, rigid in shear: two equations
  !> with the centroid at v = vs + zs phi, w = ws - ys phi.
  pure function exact(c) result(f)
    type(column_t), intent(in) :: c
    real(wp) :: f, k, arm, i, k1, k2, m1, m2, m12, p

    k = pi/c%length
    arm = merge(c%centre(2), -c%centre(1), c%plane(1) == 2)
    i = merge(c%iz, c%iy, c%plane(1) == 2)
    k1 = c%e*i*k**4
    k2 = c%e*c%iw*k**4 + c%g*c%it*k**2
    m1 = c%rho*(c%a + i*k**2)
    m12 = c%rho*c%a*arm
    m2 = c%rho*(c%a*arm**2 + c%iy + c%iz + c%iw*k**2)
    p = 0.5_wp*(k1*m2 + k2*m1)
    f = sqrt((p - sqrt(p**2 - k1*k2*(m1*m2 - m12**2)))/(m1*m2 - m12**2))/(2*pi)
  end function exact

  !> Lowest frequency [Hz] of n equal elements in a plane of bending and in torsion.
  function frequency(c, n) result(f)
    type(column_t), intent(in) :: c
    integer, intent(in) :: n
    real(wp) :: f, k(7*n + 7, 7*n + 7), m(7*n + 7, 7*n + 7), ke(14, 14), me(14, 14)
    logical :: free(7*n + 7)
    integer :: i
    integer, allocatable :: unknown(:)

    call element_matrices(c, c%length/n, ke, me)
    k = 0
    m = 0
    free = .false.
    do i = 0, 7*(n - 1), 7
      k(i + 1:i + 14, i + 1:i + 14) = k(i + 1:i + 14, i + 1:i + 14) + ke
      m(i + 1:i + 14, i + 1:i + 14) = m(i + 1:i + 14, i + 1:i + 14) + me
      free(i + [c%plane, 4, 7]) = .true.
    end do
    free(7*n + [c%plane, 4, 7]) = .true.
    free([c%plane(1), 4, 7*n + c%plane(1), 7*n + 4]) = .false.
    if (.not. c%iw > 0) free(7::7) = .false.
    unknown = pack([(i, i=1, 7*n + 7)], free)
    f = lowest(k(unknown, unknown), m(unknown, unknown))/(2*pi)
  end function frequency

  subroutine element_matrices(c, l, k, m)
    type(column_t), intent(in) :: c
    real(wp), intent(in) :: l
    real(wp), intent(out), dimension(14, 14) :: k, m
    type(rigidity_t) :: rigidity
    type(beamw_t), target :: constants
    type(beamw_t), pointer :: shared
    class(element_t), allocatable :: element
    type(state_t) :: state
    type(inertia_t) :: inertia
    real(wp) :: strain(9), b(9, 14), geometric(14, 14), s(9, 9)
    logical :: valid

    rigidity = rigidity_t(ea=c%e*c%a, eiy=c%e*c%iy, eiz=c%e*c%iz, git=c%g*c%it, eiw=c%e*c%iw, &
                          gd=c%g*c%d, shear_rigid=spread(.not. c%shear, 1, 3), &
                          ys=c%centre(1), zs=c%centre(2), polar=(c%iy + c%iz)/c%a)
    constants = new_beamw(rigidity, l, beamw_consistent)
    shared => constants
    call new_element_beamw(reshape([1, 1, 1, 2, 2, 2], [3, 2]), 2, [l, 0.0_wp, 0.0_wp], &
                           identity3, spread(.false., 1, 8), spread(0, 1, 8), shared, element)
    call new_state(2, 0, 0, state)
    call element%law(s)
    call element%evaluate(state, spread(0.0_wp, 1, 9), strain, b, geometric, valid)
    k = matmul(transpose(b), matmul(s, b))
    inertia = new_inertia(c%rho*[c%a, c%iy + c%iz, c%iy, c%iz, 0.0_wp, c%iw], l, identity3, &
                          merge(c%centre, [0.0_wp, 0.0_wp], c%follows_alpha), c%consistent, .true.)
    call inertia_mass(inertia, spread(no_rotation, 2, 2), [0.0_wp, 0.0_wp], m)
  end subroutine element_matrices

  !> Lowest w of K x = w**2 M x, by inverse iteration.
  function lowest(k, m) result(w)
    real(wp), intent(in), contiguous :: k(:, :), m(:, :)
    real(wp) :: w, x(size(k, 1))
    type(dense_symmetric_t) :: factor
    type(error_t), allocatable :: error
    integer :: i

    call factor%factorize(k, error)
    call expect(.not. allocated(error), "stiffness factorized")
    x = 1
    do i = 1, 60
      x = matmul(m, x/norm2(x))
      call factor%solve(x, error)
    end do
    w = sqrt(dot_product(x, matmul(k, x))/dot_product(x, matmul(m, x)))
  end function lowest

end module test_column_vibration
