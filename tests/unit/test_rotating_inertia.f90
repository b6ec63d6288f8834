module test_rotating_inertia
  use kinds, only: wp
  use check, only: run, expect_close
  use rotation, only: rotated, turned, cross, skew
  use beamw_inertia, only: inertia_t, inertia_mass, kinetic_energy
  use node_inertia, only: node_inertia_t, node_momentum, node_kinetic_energy
  use truss_inertia, only: truss_mass
  use rotating_inertia, only: rotating_beamw, rotating_node, rotating_truss
  use particle_body, only: place_t, line_mass, length, no_turn, unit, some_inertia, some_place, &
                           moved
  implicit none
  private

  public :: run_rotating_inertia_tests

  real(wp), parameter :: w(3) = [0.9_wp, -1.4_wp, 0.6_wp], h = 1.0e-3_wp

contains

  subroutine run_rotating_inertia_tests()
    call run("rotating frame: centrifugal force is the gradient of the energy", centrifugal_force)
    call run("rotating frame: centrifugal tangent of a beam", centrifugal_tangent)
    call run("rotating frame: gyroscopic matrix of a beam is that of Lagrange", lagrange)
    call run("rotating frame: gyroscopic matrix of lumped inertia, closed form", lumped)
    call run("rotating frame: a free mass circles at the frame's rate, backwards", free_mass)
    call run("rotating frame: a node, by energies", node_by_energy)
    call run("rotating frame: a truss", truss)
  end subroutine run_rotating_inertia_tests

  !> Velocities of a model at rest in the frame.
  pure function carried(place) result(v)
    type(place_t), intent(in) :: place
    real(wp) :: v(7, 2)
    integer :: e

    do e = 1, 2
      v(:, e) = [cross(w, place%r(:, e)), w, 0.0_wp]
    end do
  end function carried

  !> Differences of fourth order err by h**4/30 of fifth derivatives, round-off by 1e-16/h.
  subroutine centrifugal_force()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp) :: f(7, 2), wanted(14)
    real(wp), dimension(14, 14) :: m, g, k
    integer :: option, i

    do option = 0, 3
      inertia = some_inertia(mod(option, 2) == 1, option >= 2)
      place = some_place(option + 1)
      call rotating_beamw(inertia, place%euler, place%alpha, place%r, w, f, m, g, k)
      do i = 1, 14
        wanted(i) = -(8*(at(h) - at(-h)) - (at(2*h) - at(-2*h)))/(12*h)
      end do
      call expect_close(reshape(f, [14]), wanted, 1.0e-10_wp, "minus gradient")
    end do

  contains

    function at(step) result(energy)
      real(wp), intent(in) :: step
      real(wp) :: energy
      type(place_t) :: new

      new = moved(place, step*unit(i))
      energy = kinetic_energy(inertia, new%euler, new%alpha, carried(new))
    end function at
  end subroutine centrifugal_force

  !> And, with half of the moments, it is a Hessian.
  subroutine centrifugal_tangent()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp) :: f(7, 2), column(14)
    real(wp), dimension(14, 14) :: m, g, k, wanted_mass
    integer :: option, i

    do option = 0, 3
      inertia = some_inertia(mod(option, 2) == 1, option >= 2)
      place = some_place(option + 1)
      call rotating_beamw(inertia, place%euler, place%alpha, place%r, w, f, m, g, k)
      call inertia_mass(inertia, place%euler, place%alpha, wanted_mass)
      call expect_close(m, wanted_mass, 1.0e-15_wp*norm2(m), "mass")
      do i = 1, 14
        column = reshape(8*(at(h) - at(-h)) - (at(2*h) - at(-2*h)), [14])/(12*h)
        call expect_close(k(:, i), column, 1.0e-11_wp*norm2(k), "column")
      end do
      do i = 1, 2
        k(7*i - 3:7*i - 1, 7*i - 3:7*i - 1) = k(7*i - 3:7*i - 1, 7*i - 3:7*i - 1) &
                                              + 0.5_wp*skew(f(4:6, i))
      end do
      call expect_close(k, transpose(k), 1.0e-14_wp*norm2(k), "symmetric")
    end do

  contains

    function at(step) result(force)
      real(wp), intent(in) :: step
      real(wp) :: force(7, 2)
      real(wp) :: unused(14, 14, 3)
      type(place_t) :: new

      new = moved(place, step*unit(i))
      call rotating_beamw(inertia, new%euler, new%alpha, new%r, w, force, unused(:, :, 1), &
                          unused(:, :, 2), unused(:, :, 3))
    end function at
  end subroutine centrifugal_tangent

  !> With the energy's part linear in the rates q' of coordinates, A(q).q', the matrix is
  !> A,q - (A,q)^T. The spins of dR = skew(theta) R are theta' + theta x theta'/2 + ...
  subroutine lagrange()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp) :: f(7, 2), slope(14, 14)
    real(wp), dimension(14, 14) :: m, g, k
    integer :: option, i

    do option = 0, 3
      inertia = some_inertia(mod(option, 2) == 1, option >= 2)
      place = some_place(option + 1)
      call rotating_beamw(inertia, place%euler, place%alpha, place%r, w, f, m, g, k)
      call expect_close(g, -transpose(g), 1.0e-14_wp*norm2(g), "skew-symmetric")
      do i = 1, 14
        slope(:, i) = (8*(at(h) - at(-h)) - (at(2*h) - at(-2*h)))/(12*h)
      end do
      call expect_close(g, slope - transpose(slope), 1.0e-10_wp, "gyroscopic matrix")
    end do

  contains

    function at(step) result(linear)
      real(wp), intent(in) :: step
      real(wp) :: linear(14), mass(14, 14), theta(7, 2)
      type(place_t) :: new
      integer :: j

      theta = step*unit(i)
      new = moved(place, theta)
      call inertia_mass(inertia, new%euler, new%alpha, mass)
      linear = matmul(mass, reshape(carried(new), [14]))
      do j = 1, 2
        linear(7*j - 3:7*j - 1) = linear(7*j - 3:7*j - 1) &
                                  - 0.5_wp*cross(theta(4:6, j), linear(7*j - 3:7*j - 1))
      end do
    end function at
  end subroutine lagrange

  !> Theory 8: 2 m skew(W) and skew(tr(J) W - 2 J W), J as the end stands.
  subroutine lumped()
    type(inertia_t) :: inertia
    type(place_t) :: place
    real(wp) :: f(7, 2), wanted(14, 14), x(3, 3), j(3, 3)
    real(wp), dimension(14, 14) :: m, g, k
    integer :: e, i

    inertia = some_inertia(.false., .true.)
    place = some_place(3)
    call rotating_beamw(inertia, place%euler, place%alpha, place%r, w, f, m, g, k)
    wanted = 0
    do e = 1, 2
      i = 7*e - 7
      x = rotated(place%euler(:, e), inertia%triad)
      j = matmul(matmul(x, inertia%section), transpose(x))
      wanted(i + 1:i + 3, i + 1:i + 3) = line_mass*length*skew(w)
      wanted(i + 4:i + 6, i + 4:i + 6) = skew((j(1, 1) + j(2, 2) + j(3, 3))*w - 2*matmul(j, w))
      call expect_close(f(1:3, e), 0.5_wp*line_mass*length*cross(w, cross(w, place%r(:, e))), &
                        1.0e-14_wp, "centrifugal force")
      call expect_close(f(4:6, e), cross(w, matmul(j, w)), 1.0e-14_wp, "centrifugal moment")
    end do
    call expect_close(g, wanted, 1.0e-13_wp, "gyroscopic matrix")
  end subroutine lumped

  !> At rest in an inertial frame, r' = -W x r in the rotating one: M r'' + G r' + K r = 0.
  subroutine free_mass()
    type(node_inertia_t) :: node
    real(wp) :: f(6), r(3), v(3), a(3), x(3)
    real(wp), dimension(6, 6) :: m, g, k

    node%mass = 1.8_wp
    r = [0.4_wp, 1.1_wp, -0.8_wp]
    v = -cross(w, r)
    a = -cross(w, v)
    call rotating_node(node, no_turn(:, 1), r, w, f, m, g, k)
    x = matmul(m(1:3, 1:3), a) + matmul(g(1:3, 1:3), v) + matmul(k(1:3, 1:3), r)
    call expect_close(x, [0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, "no force")
    call expect_close(f(1:3), matmul(k(1:3, 1:3), r), 1.0e-14_wp, "centrifugal force")
  end subroutine free_mass

  !> As for the beam, with node_kinetic_energy and node_momentum.
  subroutine node_by_energy()
    type(node_inertia_t) :: node
    real(wp) :: f(6), wanted(6), slope(6, 6), column(6), euler(0:3), r(3), all(13)
    real(wp), dimension(6, 6) :: m, g, k, x, y, z
    integer :: i

    node = node_inertia_t(1.8_wp, reshape([1.9_wp, 0.3_wp, -0.2_wp, 0.3_wp, 1.1_wp, 0.4_wp, &
                                           -0.2_wp, 0.4_wp, 2.3_wp], [3, 3]))
    euler = turned(no_turn(:, 1), [0.9_wp, -1.4_wp, 0.5_wp])
    r = [0.4_wp, 1.1_wp, -0.8_wp]
    call rotating_node(node, euler, r, w, f, m, g, k)
    do i = 1, 6
      all = (8*(at(h) - at(-h)) - (at(2*h) - at(-2*h)))/(12*h)
      wanted(i) = -all(1)
      slope(:, i) = all(2:7)
      column = all(8:13)
      call expect_close(k(:, i), column, 1.0e-11_wp, "centrifugal tangent")
    end do
    call expect_close(f, wanted, 1.0e-11_wp, "minus gradient")
    call expect_close(g, slope - transpose(slope), 1.0e-11_wp, "gyroscopic matrix")
    call expect_close(g, -transpose(g), 1.0e-14_wp, "skew-symmetric")

  contains

    !> Energy of rest in the frame, part of it linear in velocities, force.
    function at(step) result(values)
      real(wp), intent(in) :: step
      real(wp) :: values(13), move(6), p(0:3), v(6), momentum(6)

      move = 0
      move(i) = step
      p = turned(euler, move(4:6))
      v = [cross(w, r + move(1:3)), w]
      momentum = node_momentum(node, p, v)
      momentum(4:6) = momentum(4:6) - 0.5_wp*cross(move(4:6), momentum(4:6))
      values(1) = node_kinetic_energy(node, p, v)
      values(2:7) = momentum
      call rotating_node(node, p, r + move(1:3), w, values(8:13), x, y, z)
    end function at
  end subroutine node_by_energy

  !> Its mass matrix times 2 W x v and W x (W x r) of the ends.
  subroutine truss()
    real(wp) :: m(6, 6), r(3, 2), f(6)
    real(wp), dimension(6, 6) :: g, k, w6, wanted
    integer :: option

    w6 = 0
    w6(1:3, 1:3) = skew(w)
    w6(4:6, 4:6) = skew(w)
    r = reshape([0.4_wp, 1.1_wp, -0.8_wp, 2.0_wp, 0.3_wp, 0.9_wp], [3, 2])
    do option = 0, 1
      m = truss_mass(1.7_wp, 2.4_wp, option == 1)
      call rotating_truss(m, r, w, f, g, k)
      wanted = 2*matmul(m, w6)
      call expect_close(g, wanted, 1.0e-13_wp, "gyroscopic matrix")
      call expect_close(g, -transpose(g), 1.0e-13_wp, "skew-symmetric")
      call expect_close(k, transpose(k), 1.0e-13_wp, "symmetric")
      call expect_close(f, matmul(m, [cross(w, cross(w, r(:, 1))), cross(w, cross(w, r(:, 2)))]), &
                        1.0e-13_wp, "centrifugal force")
    end do
  end subroutine truss

end module test_rotating_inertia
