module test_element_beamw
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use json_numbers, only: read_text, member, elements, numbers, word
  use section_data, only: section_constants_t
  use beamw_rigidity, only: rigidity_t, section_rigidity
  use beamw_constants, only: beamw_t, new_beamw, beamw_none, beamw_jonker, beamw_consistent
  use beam_strains, only: kinematics_t, beam_kinematics, reduced
  use element_base, only: element_t
  use element_beamw, only: new_element_beamw
  use nodal_state, only: state_t, new_state, coordinate_number
  use rotation, only: cross, rotated, turned
  implicit none
  private

  public :: run_element_beamw_tests

  real(wp), parameter :: no_release(8) = 0

  !> One element of the reference file, ready to be evaluated.
  type :: case_t
    character(len=:), allocatable :: text, name, mode
    type(rigidity_t) :: rigidity
    type(beamw_t), pointer :: constants => null()
    class(element_t), allocatable :: element
    type(state_t) :: state
    real(wp) :: chord(3), triad(3, 3), length
  end type case_t

contains

  subroutine run_element_beamw_tests()
    call run("beamw: reference file, strains and Jacobian of the paper", reference_strains)
    call run("beamw: reference file, stiffness and second-order forms", reference_constants)
    call run("beamw: reference file, second-order strain, force, tangent", reference_tangent)
    call run("beamw: Jacobian and Hessian agree with differences", differences)
    call run("beamw: released strains agree with differences", released_differences)
    call run("beamw: rigid motion leaves no strain", rigid_motion)
    call run("beamw: without warping stiffness twist is uniform", uniform_twist)
  end subroutine run_element_beamw_tests

  !> Relative difference of two arrays, by norm; 1 if their sizes differ.
  function distance(a, b)
    real(wp), intent(in) :: a(:), b(:)
    real(wp) :: distance

    distance = 1
    if (size(a) == size(b)) distance = norm2(a - b)/max(norm2(b), tiny(1.0_wp))
  end function distance

  function reference_file() result(content)
    character(len=:), allocatable :: content
    character(len=1000) :: path

    call get_environment_variable("SPAR_BEAMW_REFERENCE", path)
    if (path == "") path = "tests/reference/beamw_element.json"
    content = read_text(trim(path))
  end function reference_file

  function reference_cases() result(n)
    integer :: n
    character(len=:), allocatable :: all

    all = member(reference_file(), "elements")
    n = 0
    do while (elements(all, n + 1) /= "")
      n = n + 1
    end do
    call expect(n >= 1, "elements in the reference file")
  end function reference_cases

  subroutine get_case(i, c)
    integer, intent(in) :: i
    type(case_t), intent(out) :: c
    character(len=:), allocatable :: file, section
    type(section_constants_t) :: s
    integer :: second

    file = reference_file()
    c%text = elements(member(file, "elements"), i)
    c%mode = word(member(c%text, "mode"))
    c%name = word(member(c%text, "section"))//" "//c%mode
    section = member(member(file, "sections"), word(member(c%text, "section")))
    s%a = get(section, "A")
    s%iy = get(section, "Iy")
    s%iz = get(section, "Iz")
    s%it = get(section, "It")
    s%iw = get(section, "Iomega")
    s%ys = get(section, "ys")
    s%zs = get(section, "zs")
    s%d(1, :) = [get(section, "Dy"), get(section, "Dyz"), get(section, "Dyomega")]
    s%d(2, :) = [get(section, "Dyz"), get(section, "Dz"), get(section, "Dzomega")]
    s%d(3, :) = [get(section, "Dyomega"), get(section, "Dzomega"), get(section, "Domega")]
    s%by = get(section, "beta_y")
    s%bz = get(section, "beta_z")
    s%bw = get(section, "beta_omega")
    s%ir = get(section, "IR")
    s%shear_given = .true.
    c%rigidity = section_rigidity(s, get(c%text, "E"), get(c%text, "G"), &
                                  member(c%text, "shear") == "true")
    second = beamw_consistent
    if (c%mode == "NONE") second = beamw_none
    if (c%mode == "JONKER") second = beamw_jonker
    c%chord = numbers(member(c%text, "rq_initial")) - numbers(member(c%text, "rp_initial"))
    c%length = norm2(c%chord)
    c%triad = triad_of(c%chord, numbers(member(c%text, "ey_initial")))
    allocate (c%constants)
    c%constants = new_beamw(c%rigidity, c%length, second)
    call new_element_beamw(reshape([1, 1, 1, 2, 2, 2], [3, 2]), 2, c%chord, c%triad, &
                           spread(.false., 1, 8), spread(0, 1, 8), c%constants, c%element)
    call new_state(2, 0, 0, c%state)
    c%state%displacement(:, 1) = numbers(member(c%text, "r_p")) &
                                 - numbers(member(c%text, "rp_initial"))
    c%state%displacement(:, 2) = numbers(member(c%text, "r_q")) &
                                 - numbers(member(c%text, "rq_initial"))
    c%state%euler(:, 1) = numbers(member(c%text, "euler_p"))
    c%state%euler(:, 2) = numbers(member(c%text, "euler_q"))
    c%state%warping = [get(c%text, "alpha_p"), get(c%text, "alpha_q")]
  end subroutine get_case

  subroutine free_case(c)
    type(case_t), intent(inout) :: c

    deallocate (c%element, c%constants)
  end subroutine free_case

  function get(object, key) result(x)
    character(len=*), intent(in) :: object, key
    real(wp) :: x, found(1)

    found = numbers(member(object, key))
    x = found(1)
  end function get

  function triad_of(chord, y) result(triad)
    real(wp), intent(in) :: chord(3), y(3)
    real(wp) :: triad(3, 3)

    triad(:, 1) = chord/norm2(chord)
    triad(:, 2) = y - dot_product(y, triad(:, 1))*triad(:, 1)
    triad(:, 2) = triad(:, 2)/norm2(triad(:, 2))
    triad(:, 3) = cross(triad(:, 1), triad(:, 2))
  end function triad_of

  !> (7) and (13): the raw strains are those of the kernel without angles.
  subroutine reference_strains()
    type(case_t) :: c
    type(kinematics_t) :: k
    real(wp) :: triad(3, 3, 2), d(8, 14)
    integer :: i, e

    do i = 1, reference_cases()
      call get_case(i, c)
      do e = 1, 2
        triad(:, :, e) = rotated(c%state%euler(:, e), c%triad)
      end do
      call beam_kinematics(c%chord + c%state%displacement(:, 2) - c%state%displacement(:, 1), &
                           triad, c%state%warping, no_release, c%length, .false., k)
      call expect(distance(k%strain, numbers(member(c%text, "strain"))) < 1.0e-9_wp, &
                  c%name//" strain")
      d = node_columns(transpose(k%gradient))
      call expect(distance(reshape(transpose(d), [112]), &
                           numbers(member(c%text, "D_u"))) < 1.0e-9_wp, c%name//" D_u")
      if (c%mode == "CONSISTENT") then
        call beam_kinematics(c%chord + c%state%displacement(:, 2) - c%state%displacement(:, 1), &
                             triad, c%state%warping, no_release, c%length, .true., k)
        call expect(distance(k%strain, numbers(member(c%text, "strain_finite"))) < 1.0e-9_wp, &
                    c%name//" strain_finite")
      end if
      call free_case(c)
    end do
  end subroutine reference_strains

  function node_columns(b) result(d)
    real(wp), intent(in) :: b(8, reduced)
    real(wp) :: d(8, 14)

    d = reshape([-b(:, 1:3), b(:, 4:6), b(:, 10), b(:, 1:3), b(:, 7:9), b(:, 11)], [8, 14])
  end function node_columns

  subroutine reference_constants()
    type(case_t) :: c
    real(wp), allocatable :: wanted(:)
    integer :: i

    do i = 1, reference_cases()
      call get_case(i, c)
      wanted = numbers(member(c%text, "S_s"))
      call expect(distance(reshape(c%constants%s(1:8, 1:8), [64]), wanted) < 1.0e-9_wp, &
                  c%name//" S_s")
      if (member(c%text, "Q") /= "") then
        wanted = numbers(member(c%text, "Q"))
        call expect(distance(pack(c%constants%q(:, :, :size(wanted)/64), .true.), wanted) &
                    < 1.0e-9_wp, c%name//" Q")
      end if
      call free_case(c)
    end do
  end subroutine reference_constants

  subroutine reference_tangent()
    type(case_t) :: c
    real(wp) :: strain(9), b(9, 14), g(14, 14), s(9, 9), stress(9), tangent(14, 14)
    logical :: valid
    integer :: i

    do i = 1, reference_cases()
      call get_case(i, c)
      call c%element%law(s)
      stress = 0
      call c%element%evaluate(c%state, stress, strain, b, g, valid)
      stress = matmul(s, strain)
      call c%element%evaluate(c%state, stress, strain, b, g, valid)
      tangent = g + matmul(transpose(b), matmul(s, b))
      call expect(valid, c%name//" is valid")
      call expect(distance(strain, numbers(member(c%text, "strain_bar_s"))) < 1.0e-9_wp, &
                  c%name//" strain_bar_s")
      call expect(distance([0.5_wp*dot_product(strain, stress)], &
                           numbers(member(c%text, "energy"))) < 1.0e-9_wp, c%name//" energy")
      call expect(distance(matmul(stress, b), numbers(member(c%text, "force"))) < 1.0e-9_wp, &
                  c%name//" force")
      call expect(distance(reshape(tangent, [196]), &
                           numbers(member(c%text, "tangent"))) < 1.0e-9_wp, c%name//" tangent")
      call free_case(c)
    end do
  end subroutine reference_tangent

  !> Central differences of the strains, h = 1e-6 of the element: errors of about 1e-9.
  subroutine differences()
    type(case_t) :: c
    integer :: i

    do i = 1, reference_cases()
      call get_case(i, c)
      call compare_with_differences(c, c%name)
      call free_case(c)
    end do
  end subroutine differences

  subroutine released_differences()
    type(case_t) :: c
    integer, parameter :: release(8) = [0, 0, 1, 0, 0, 2, 0, 0]
    integer :: i

    do i = 1, reference_cases()
      call get_case(i, c)
      deallocate (c%element)
      call new_element_beamw(reshape([1, 1, 1, 2, 2, 2], [3, 2]), 2, c%chord, c%triad, &
                             spread(.false., 1, 8), release, c%constants, c%element)
      deallocate (c%state%release)
      c%state%release = [0.03_wp, -0.05_wp]*c%length
      call compare_with_differences(c, c%name//" released")
      call free_case(c)
    end do
  end subroutine released_differences

  subroutine compare_with_differences(c, name)
    type(case_t), intent(in) :: c
    character(len=*), intent(in) :: name
    real(wp), parameter :: h = 1.0e-5_wp
    real(wp), dimension(9) :: strain, stress, plus, minus
    real(wp), allocatable :: b(:, :), g(:, :), bp(:, :), bm(:, :), unused(:, :), step(:), scale(:)
    real(wp) :: largest
    type(state_t) :: moved
    integer :: n, j
    logical :: valid

    n = c%element%coordinates
    allocate (b(9, n), g(n, n), bp(9, n), bm(9, n), unused(n, n), step(n), scale(n))
    stress = [1.0_wp, -0.7_wp, 0.4_wp, 0.9_wp, -1.2_wp, 0.3_wp, 0.8_wp, -0.5_wp, 0.6_wp]
    scale = c%length
    scale([4, 5, 6, 11, 12, 13]) = 1
    scale([7, 14]) = 1/c%length
    call c%element%evaluate(c%state, stress, strain, b, g, valid)
    largest = maxval(abs(b)*spread(scale, 1, 9))
    do j = 1, n
      step = 0
      step(j) = h*scale(j)
      moved = c%state
      call moved%move(step)
      call c%element%evaluate(moved, stress, plus, bp, unused, valid)
      moved = c%state
      call moved%move(-step)
      call c%element%evaluate(moved, stress, minus, bm, unused, valid)
      call expect_close(b(:, j)*scale(j), (plus - minus)/(2*h), 1.0e-8_wp*largest, &
                        name//" Jacobian")
      step = symmetric_difference(matmul(stress, bp), matmul(stress, bm), scale(j)*h, j, &
                                  matmul(stress, b))
      call expect_close(g(:, j)*scale*scale(j), step*scale*scale(j), 1.0e-8_wp*largest, &
                        name//" Hessian")
    end do
  end subroutine compare_with_differences

  !> Difference of a gradient in moving frames, made symmetric: with spins, the Hessian at theta = 0
  !> of exp(theta) is the derivative of the gradient plus half the cross product of step and moment.
  function symmetric_difference(plus, minus, h, j, gradient) result(column)
    real(wp), intent(in) :: plus(:), minus(:), h, gradient(:)
    integer, intent(in) :: j
    real(wp) :: column(size(plus)), axis(3)
    integer :: first

    column = (plus - minus)/(2*h)
    first = 0
    if (j >= 4 .and. j <= 6) first = 4
    if (j >= 11 .and. j <= 13) first = 11
    if (first == 0) return
    axis = 0
    axis(j - first + 1) = 1
    column(first:first + 2) = column(first:first + 2) &
                              - 0.5_wp*cross(axis, gradient(first:first + 2))
  end function symmetric_difference

  !> Any rigid motion on top of the undeformed state gives strains of round-off size.
  subroutine rigid_motion()
    type(case_t) :: c
    real(wp) :: strain(9), b(9, 14), g(14, 14), theta(3), euler(0:3)
    logical :: valid
    integer :: i, k

    do i = 1, reference_cases()
      call get_case(i, c)
      c%state%warping = 0
      do k = 1, 8
        theta = [0.7_wp, -0.4_wp, 0.9_wp]*k
        euler = turned([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], theta)
        c%state%euler = spread(euler, 2, 2)
        c%state%displacement(:, 1) = [3.0_wp, -2.0_wp, 1.0_wp]*c%length
        c%state%displacement(:, 2) = c%state%displacement(:, 1) - c%chord &
                                     + reshape(rotated(euler, spread(c%chord, 2, 3)), [3])
        call c%element%evaluate(c%state, spread(0.0_wp, 1, 9), strain, b, g, valid)
        call expect_close(strain/c%length, spread(0.0_wp, 1, 9), 40*epsilon(1.0_wp), &
                          c%name//" strain")
      end do
      call free_case(c)
    end do
  end subroutine rigid_motion

  !> With EIw = 0 the torque is GIt times the twist per length, whatever alpha is.
  subroutine uniform_twist()
    type(rigidity_t) :: r
    type(beamw_t) :: constants
    integer :: second

    r = rigidity_t(ea=1.0e5_wp, eiy=20.0_wp, eiz=30.0_wp, git=7.0_wp, polar=0.1_wp)
    do second = beamw_none, beamw_consistent
      constants = new_beamw(r, 2.0_wp, second)
      call expect_close(constants%s(2, 2), 7.0_wp/2.0_wp**3, 1.0e-14_wp, "GIt/l0**3")
      call expect_close(constants%s(7:8, 1:8), reshape(spread(0.0_wp, 1, 16), [2, 8]), 0.0_wp, &
                        "no warping stiffness")
    end do
    call expect(second == beamw_jonker + 2, "three options")
  end subroutine uniform_twist

end module test_element_beamw
