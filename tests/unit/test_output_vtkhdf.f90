!> Group /VTKHDF of result files: layout, and where the points of deformed beams are.
module test_output_vtkhdf
  use kinds, only: wp
  use rotation, only: turned, rotation_vector, cross, identity3, no_rotation
  use beam_curve, only: beam_ends_t, station_t, new_curve, beam_station
  use check, only: run, expect, expect_close
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  use result_reader, only: get_reals, get_integers, get_numbers, get_text
  implicit none
  private

  public :: run_output_vtkhdf_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: single = 2.0_wp**(-24)   !< relative rounding of fields in single precision
  character(len=*), parameter :: steps = "VTKHDF/Steps/"

contains

  subroutine run_output_vtkhdf_tests()
    call run("vtkhdf: layout", test_layout)
    call run("vtkhdf: points on a circle", test_circle)
    call run("vtkhdf: a section swept along a twisted beam", test_twist)
    call run("vtkhdf: warping of a section", test_warping)
    call run("vtkhdf: the rate of twist is alpha and the shear", test_twist_rate)
    call run("vtkhdf: sections turn about the shear centre", test_eccentric)
    call run("vtkhdf: modes", test_modes)
    call run("vtkhdf: stress of modes", test_mode_stress)
    call run("vtkhdf: modes of critical points", test_critical)
    call run("vtkhdf: --no-vtk", test_without)
  end subroutine run_output_vtkhdf_tests

  subroutine solve(arguments, name, path)
    character(len=*), intent(in) :: arguments, name
    character(len=:), allocatable, intent(out) :: path
    type(outcome_t) :: outcome

    path = scratch(name)
    call run_spar("run "//arguments//" --quiet -o "//path, outcome)
    call expect(outcome%status == 0, arguments//" runs: "//outcome%errors)
  end subroutine solve

  subroutine expect_integers(path, name, wanted)
    character(len=*), intent(in) :: path, name
    integer, intent(in) :: wanted(:)
    integer, allocatable :: values(:), extents(:)

    call get_integers(path, name, values, extents)
    call expect(size(values) == size(wanted), name//": size")
    if (size(values) == size(wanted)) call expect(all(values == wanted), name//": values")
  end subroutine expect_integers

  !> Three lines of four pieces, six steps in two analyses.
  subroutine test_layout()
    character(len=:), allocatable :: path, type_name
    integer, allocatable :: numbers(:), extents(:)
    real(wp), allocatable :: reals(:)
    integer, parameter :: points = 15, cells = 12
    integer :: i

    call solve("tests/cases/program/cantilever.deck -D parts=3", "layout.h5", path)
    call get_text(path, "VTKHDF", "Type", type_name)
    call expect(type_name == "UnstructuredGrid", "Type")
    call get_numbers(path, "VTKHDF", "Version", numbers)
    call expect(all(numbers == [2, 0]), "Version")
    call get_numbers(path, "VTKHDF/Steps", "NSteps", numbers)
    call expect(all(numbers == [6]), "NSteps")
    call expect_integers(path, "VTKHDF/NumberOfPoints", [points])
    call expect_integers(path, "VTKHDF/NumberOfCells", [cells])
    call expect_integers(path, "VTKHDF/NumberOfConnectivityIds", [2*cells])
    call expect_integers(path, "VTKHDF/Offsets", [(2*i, i=0, cells)])
    call expect_integers(path, "VTKHDF/Types", [(3, i=1, cells)])
    call expect_integers(path, "VTKHDF/Connectivity", &
      [0, 1, 1, 2, 2, 3, 3, 4, 5, 6, 6, 7, 7, 8, 8, 9, 10, 11, 11, 12, 12, 13, 13, 14])
    call expect_integers(path, steps//"PartOffsets", [(0, i=1, 6)])
    call expect_integers(path, steps//"NumberOfParts", [(1, i=1, 6)])
    call expect_integers(path, steps//"PointOffsets", [(0, i=1, 6)])
    call expect_integers(path, steps//"CellOffsets", [(0, i=1, 6)])
    call expect_integers(path, steps//"ConnectivityIdOffsets", [(0, i=1, 6)])
    call expect_integers(path, steps//"PointDataOffsets/displacement", [(points*i, i=0, 5)])
    call expect_integers(path, steps//"PointDataOffsets/rotation", [(points*i, i=0, 5)])
    call expect_integers(path, steps//"CellDataOffsets/section_force", [(cells*i, i=0, 5)])
    call expect_integers(path, steps//"Origin", [1, 0, 1, 1, 1, 2, 1, 3, 2, 0, 2, 1])
    call get_reals(path, steps//"Values", reals, extents)
    call expect_close(reals, [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], 0.0_wp, "Values")
    call get_reals(path, "VTKHDF/Points", reals, extents)
    call expect(all(extents == [points, 3]), "Points: shape")
    call expect_close(reals(1::3), [(5.0_wp/12*[0, 1, 2, 3, 4] + 5.0_wp/3*i, i=0, 2)], 1.0e-14_wp, &
                      "x of Points")
    call get_reals(path, "VTKHDF/PointData/displacement", reals, extents)
    call expect(all(extents == [6*points, 3]), "displacement: shape")
    call get_reals(path, steps//"CellOffsets", reals, extents)
    call expect(all(extents == [6, 1]), "CellOffsets: shape")
    call expect_ends(path)
  end subroutine test_layout

  !> The ends of the drawn beams are the nodes, in every step.
  subroutine expect_ends(path)
    character(len=*), intent(in) :: path
    real(wp), allocatable :: drawn(:), native(:)
    integer, allocatable :: extents(:)
    integer :: step

    call get_reals(path, "VTKHDF/PointData/displacement", drawn, extents)
    call get_reals(path, "analysis/01_static/nodes/displacement", native, extents)
    call expect(size(drawn) >= 3*15*4 .and. size(native) == 3*4*4, "all points and nodes")
    if (size(drawn) < 3*15*4 .or. size(native) /= 3*4*4) return
    do step = 0, 3
      call expect_close(drawn(45*step + 43:45*step + 45), native(12*step + 4:12*step + 6), &
                        single*maxval(abs(native)), "the tip is node 2")
      call expect_close(drawn(45*step + 13:45*step + 15), drawn(45*step + 16:45*step + 18), &
                        2*single*maxval(abs(native)), "two beams meet")
    end do
  end subroutine expect_ends

  !> The nodes are the corners of a regular decagon, the tangents those of the circle round it: a
  !> cubic is beside the circle by R b**4/384 in the middle, b = pi/5, and by 9/16 of it half-way to
  !> the middle (16 x**2 (1 - x)**2 at x = 1/4).
  subroutine test_circle()
    character(len=:), allocatable :: path
    real(wp), allocatable :: points(:), motion(:)
    integer, allocatable :: extents(:)
    real(wp) :: place(3), radius, beside
    real(wp), parameter :: share(0:4) = [0.0_wp, 9/16.0_wp, 1.0_wp, 9/16.0_wp, 0.0_wp]
    integer, parameter :: n = 50
    integer :: i

    call solve("tests/cases/static/rollup.deck", "circle.h5", path)
    call get_reals(path, "VTKHDF/Points", points, extents)
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call expect(size(motion) == 10*3*n, "five points of ten beams, ten steps")
    if (size(motion) /= 10*3*n .or. size(points) /= 3*n) return
    motion = motion(9*3*n + 1:)
    radius = norm2(points(13:15) + motion(13:15))/(2*sin(pi/10))
    call expect_close(radius, 1/(2*pi), 1.0e-3_wp/(2*pi), "the circle is as long as the beam")
    do i = 1, n
      place = points(3*i - 2:3*i) + motion(3*i - 2:3*i)
      beside = radius - norm2(place - [0.0_wp, 0.0_wp, radius])
      call expect_close(beside, share(modulo(i - 1, 5))*radius*(pi/5)**4/384, &
                        0.03_wp*radius*(pi/5)**4/384, "beside the circle")
    end do
  end subroutine test_circle

  !> A tube, held at one end, in pure torsion, which does not warp: every section stays a circle
  !> and turns in proportion to x.
  subroutine test_twist()
    character(len=:), allocatable :: path
    real(wp), allocatable :: points(:), motion(:), euler(:), u(:)
    integer, allocatable :: extents(:), kinds(:), corners(:)
    real(wp) :: angle, place(3), x(3)
    integer :: i

    call make_file(scratch("shaft.deck"), "MATERIAL m E 1000 G 400"//new_line("a")// &
      "SECTION s TUBE D 2 T 0.2"//new_line("a")//"NODE 1 0 0 0"//new_line("a")// &
      "NODE 2 4 0 0"//new_line("a")//"BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m DIVIDE 2"// &
      new_line("a")//"FIX 1"//new_line("a")//"XF 2 0 0 0 40 0 0"//new_line("a")//"STATIC STEPS 1")
    call solve(scratch("shaft.deck"), "shaft.h5", path)
    call get_reals(path, "VTKHDF/Points", points, extents)
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call get_reals(path, "analysis/01_static/nodes/euler", euler, extents)
    call get_reals(path, "analysis/01_static/nodes/displacement", u, extents)
    call get_integers(path, "VTKHDF/Types", kinds, extents)
    call expect(size(points) == 3*2*4*64 .and. size(motion) == size(points), "two circles")
    call expect(size(kinds) == 2*3*64 + 2*32, "sides and two ends, a ring each")
    call expect(all(kinds == 9), "of quadrangles")
    call get_integers(path, "VTKHDF/Connectivity", corners, extents)
    call expect(size(corners) == 4*size(kinds), "four corners each")
    call expect_close(area(corners, points), 4*64*(1 + 0.8_wp)*sin(pi/32) &
                      + 32*(1 - 0.8_wp**2)*sin(pi/16), 1.0e-12_wp, "the tube's surface")
    if (size(motion) /= size(points) .or. size(euler) < 8) return
    do i = 1, size(points)/3
      x = points(3*i - 2:3*i)
      place = x + motion(3*i - 2:3*i)
      angle = 2*atan2(euler(6), euler(5))*x(1)/4
      call expect_close(place(2:3), [x(2)*cos(angle) - x(3)*sin(angle), &
                                     x(2)*sin(angle) + x(3)*cos(angle)], single, "a corner")
      call expect(abs(place(1) - x(1)) <= 1.01_wp*abs(u(4)), "not beyond the end")
    end do
    call expect(angle > 0.3_wp, "a large angle")
  end subroutine test_twist

  !> Area of all quadrangles, from the products of their diagonals.
  pure real(wp) function area(corners, points)
    integer, intent(in) :: corners(:)    !< points from 0, four for each
    real(wp), intent(in) :: points(:)
    integer :: i

    area = 0
    do i = 1, size(corners) - 3, 4
      associate (a => 3*corners(i), b => 3*corners(i + 1), c => 3*corners(i + 2), &
                 d => 3*corners(i + 3))
        area = area + 0.5_wp*norm2(cross(points(c + 1:c + 3) - points(a + 1:a + 3), &
                                         points(d + 1:d + 3) - points(b + 1:b + 3)))
      end associate
    end do
  end function area

  !> A doubly symmetric I, a bimoment and no torque at a warping-free, twist-free end: the corners
  !> of the flanges move by -omega alpha along the beam, omega = +-h b/4 at the flanges' middles.
  subroutine test_warping()
    character(len=:), allocatable :: path
    real(wp), allocatable :: points(:), motion(:), alpha(:)
    integer, allocatable :: extents(:)
    real(wp), parameter :: h = 10, b = 6
    integer :: i, corners, n

    call make_file(scratch("flange.deck"), "MATERIAL m E 1000 G 400"//new_line("a")// &
      "SECTION s I H 10 B 6 T 0.1 TW 0.1 MIDLINE"//new_line("a")//"NODE 1 0 0 0"// &
      new_line("a")//"NODE 2 50 0 0"//new_line("a")// &
      "BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m DIVIDE 4"//new_line("a")//"FIX 1"// &
      new_line("a")//"FIX 2 RX"//new_line("a")//"XF 2 0 0 0 0 0 0 0.001"// &
      new_line("a")//"STATIC STEPS 1")
    call solve(scratch("flange.deck"), "flange.h5", path)
    call get_reals(path, "VTKHDF/Points", points, extents)
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call get_reals(path, "analysis/01_static/nodes/warping", alpha, extents)
    n = size(points)/3
    corners = 0
    if (size(motion) /= size(points) .or. size(alpha) < 2) return
    do i = 1, n
      associate (x => points(3*i - 2:3*i), u => motion(3*i - 2:3*i))
        if (x(1) < 50 - 1.0e-9_wp .or. abs(abs(x(2)) - b/2) > 1.0e-9_wp) cycle
        corners = corners + 1
        call expect_close(abs(u(1)), h*b/4*abs(alpha(2)), 1.0e-5_wp*abs(alpha(2)), "-omega alpha")
        call expect(u(1)*alpha(2)*omega(x) < 0, "of the right sign")
      end associate
    end do
    call expect(corners == 8, "eight corners of flanges at the end")
    call expect(abs(alpha(2)) > 1.0e-9_wp, "the end warps")
  contains
    !> d omega = (y - ys) dz - (z - zs) dy along the flange from its middle, where omega is 0.
    pure real(wp) function omega(x)
      real(wp), intent(in) :: x(3)

      omega = -x(3)*x(2)
    end function omega
  end subroutine test_warping

  !> A straight beam twisted about its axis: phi' = alpha + gamma, by differences, gamma the share
  !> of the mean difference of theory 4; alpha of the ends and a length of 2 in the fields 5 c.
  subroutine test_twist_rate()
    type(beam_ends_t) :: ends
    real(wp), parameter :: twist = 0.3_wp, share = 0.4_wp, h = 1.0e-5_wp
    real(wp) :: ahead(3), behind(3), gamma, middle
    integer :: i

    ends%chord = [2.0_wp, 0.0_wp, 0.0_wp]
    ends%triad = identity3
    ends%warps = .true.
    ends%shear = share
    ends%warping = [0.1_wp, -0.05_wp]
    ends%euler(:, 1) = no_rotation
    ends%euler(:, 2) = turned(no_rotation, [twist, 0.0_wp, 0.0_wp])
    gamma = share*(twist/2 - 0.025_wp)
    do i = 0, 10
      associate (xi => 0.05_wp + 0.09_wp*i)
        ahead = rotation_vector(beam_euler(ends, xi + h))
        behind = rotation_vector(beam_euler(ends, xi - h))
        call expect_close((ahead(1) - behind(1))/(4*h), alpha_at(ends, xi) + gamma, 1.0e-9_wp, &
                          "rate of twist")
      end associate
    end do
    call expect_close([alpha_at(ends, 0.0_wp), alpha_at(ends, 1.0_wp)], ends%warping, &
                      1.0e-14_wp, "alpha of the ends")
    middle = 1.5_wp*twist/2 - 0.25_wp*0.05_wp - 1.5_wp*gamma
    call expect_close(alpha_at(ends, 0.5_wp), middle, 1.0e-14_wp, "alpha in the middle")
    ahead = rotation_vector(beam_euler(ends, 1.0_wp))
    call expect_close(ahead, [twist, 0.0_wp, 0.0_wp], 1.0e-14_wp, "the end as it is")
  end subroutine test_twist_rate

  !> An eccentric beam twisted evenly about the line of its shear centres, which stays straight: the
  !> centroids follow a helix, the sections stay in planes x = constant.
  subroutine test_eccentric()
    type(beam_ends_t) :: ends
    type(station_t) :: station
    real(wp), parameter :: twist = 0.1_wp, centre(2) = [0.3_wp, -0.2_wp], length = 2
    real(wp) :: xi, angle, helix(3)
    integer :: i

    ends%chord = [length, 0.0_wp, 0.0_wp]
    ends%triad = identity3
    ends%warps = .true.
    ends%shear_centre = centre
    ends%warping = twist/length
    ends%euler(:, 1) = no_rotation
    ends%euler(:, 2) = turned(no_rotation, [twist, 0.0_wp, 0.0_wp])
    ends%displacement(:, 2) = centroid(twist)
    do i = 0, 4
      xi = 0.25_wp*i
      angle = xi*twist
      station = beam_station(new_curve(ends), xi)
      helix = centroid(angle)
      call expect_close(rotation_vector(station%euler), [angle, 0.0_wp, 0.0_wp], 1.0e-14_wp, &
                        "the sections turn about x")
      call expect_close(station%displacement, helix, norm2(centre)*twist**4/384, &
                        "the centroids are on a helix, but for the error of a cubic")
    end do
  contains
    !> Displacement of the centroid where the section has turned about its shear centre.
    pure function centroid(angle) result(u)
      real(wp), intent(in) :: angle
      real(wp) :: u(3)

      u = [0.0_wp, centre(1)*(1 - cos(angle)) + centre(2)*sin(angle), &
           centre(2)*(1 - cos(angle)) - centre(1)*sin(angle)]
    end function centroid
  end subroutine test_eccentric

  pure function beam_euler(ends, xi) result(euler)
    type(beam_ends_t), intent(in) :: ends
    real(wp), intent(in) :: xi
    real(wp) :: euler(0:3)
    type(station_t) :: station

    station = beam_station(new_curve(ends), xi)
    euler = station%euler
  end function beam_euler

  pure real(wp) function alpha_at(ends, xi)
    type(beam_ends_t), intent(in) :: ends
    real(wp), intent(in) :: xi
    type(station_t) :: station

    station = beam_station(new_curve(ends), xi)
    alpha_at = station%warping
  end function alpha_at

  !> BUCKLING before and after STATIC: steps in order, modes drawn about their state, ends of beams
  !> as the mode says.
  subroutine test_modes()
    character(len=:), allocatable :: path
    real(wp), allocatable :: points(:), motion(:), mode(:), u(:)
    integer, allocatable :: extents(:), offsets(:), origin(:)
    integer, parameter :: n = 5*3
    integer :: i, k

    call make_file(scratch("modes.deck"), "MATERIAL m E 1000 G 400"//new_line("a")// &
      "SECTION s CONSTANTS A 10 IY 1 IZ 2 IT 1 IW 1"//new_line("a")//"NODE 1 0 0 0"// &
      new_line("a")//"NODE 2 12 0 0"//new_line("a")//"BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m"// &
      " DIVIDE 3"//new_line("a")//"FIX 1"//new_line("a")//"XF 2 -5 0 0.5"//new_line("a")// &
      "BUCKLING MODES 1"//new_line("a")//"STATIC STEPS 2"//new_line("a")//"BUCKLING MODES 1")
    call solve(scratch("modes.deck"), "modes.h5", path)
    call get_integers(path, steps//"Origin", origin, extents)
    call get_integers(path, steps//"PointOffsets", offsets, extents)
    call get_reals(path, "VTKHDF/Points", points, extents)
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    k = count(origin(1::2) == 1)
    call expect(k > 0 .and. count(origin(1::2) == 2) == 2, "modes, then two steps")
    call expect(size(points) == 2*3*n, "two sets of points")
    call expect(all(offsets(:k + 2) == 0), "the undeformed ones first")
    call expect(all(offsets(k + 3:) == n) .and. size(offsets) > k + 2, "then those of the state")
    if (size(points) /= 2*3*n .or. size(motion) < 3*n*(k + 3)) return
    call expect_close(points(3*n + 1:), points(:3*n) + motion(3*n*(k + 1) + 1:3*n*(k + 2)), &
                      single*maxval(abs(motion(:3*n*(k + 2)))), "the second step's places")
    call get_reals(path, "analysis/01_buckling/modes/nodes/displacement", mode, extents)
    u = motion(3*n - 2:3*n)
    call expect_close(u, mode(4:6), single*maxval(abs(mode)), "the tip in the first mode")
    call get_reals(path, "analysis/03_buckling/modes/nodes/displacement", mode, extents)
    i = 3*n*(k + 2)
    u = motion(i + 3*n - 2:i + 3*n)
    call expect_close(u, mode(4:6), single*maxval(abs(mode)), &
                      "the tip in a mode of the deformed state")
  end subroutine test_modes

  !> Euler's column in shear-rigid bending about the weak axis: with the amplitude 1 the moment in
  !> the middle is E I (pi/L)**2, the stress E y (pi/L)**2. The curvature of the cubics with the
  !> right nodal values is larger by (pi/n)**2/12 and has an error of fourth order besides.
  subroutine test_mode_stress()
    character(len=:), allocatable :: path
    real(wp), allocatable :: stress(:), force(:)
    integer, allocatable :: extents(:), corners(:)
    integer, parameter :: n = 16, points = 4*4*n
    real(wp), parameter :: e = 1000.0_wp, length = 80.0_wp, width = 1.0_wp, height = 2.0_wp
    real(wp) :: wanted, interpolated

    call make_file(scratch("euler.deck"), "MATERIAL m E 1000 G 400"//new_line("a")// &
      "SECTION s RECT B 1 H 2"//new_line("a")//"NODE 1 0 0 0"//new_line("a")// &
      "NODE 2 80 0 0"//new_line("a")//"BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m SHEAR OFF"// &
      " DIVIDE 16"//new_line("a")//"FIX 1 X Y Z RX"//new_line("a")//"FIX 2 Y Z RX"// &
      new_line("a")//"XF 2 -1 0 0"//new_line("a")//"BUCKLING MODES 1")
    call solve(scratch("euler.deck"), "euler.h5", path)
    call get_reals(path, "VTKHDF/PointData/axial_stress", stress, extents)
    call expect(size(stress) >= points, "a stress at all points")
    if (size(stress) < points) return
    wanted = e*width/2*(pi/length)**2
    interpolated = wanted*(1 + (pi/n)**2/12)
    call expect_close(maxval(abs(stress(:points))), interpolated, 0.05_wp*(interpolated - wanted), &
                      "stress in the middle")
    associate (middle => stress(points/2 - 3:points/2))
      call expect_close(sum(middle), 0.0_wp, 1.0e-5_wp*wanted, "bending alone")
    end associate
    call expect_close(maxval(abs(stress(:4))), 0.0_wp, 0.01_wp*wanted, "no moment at the end")
    call get_reals(path, "VTKHDF/CellData/section_force", force, extents)
    call get_integers(path, "VTKHDF/Types", corners, extents)
    call expect_close(maxval(abs(force(6:7*size(corners):7))), &
                      interpolated*height*width**2/6, 0.01_wp*wanted, "largest Mz of a cell")
  end subroutine test_mode_stress

  !> Lateral-torsional buckling along a path: the critical mode stands behind all states, about the
  !> state before it.
  subroutine test_critical()
    character(len=:), allocatable :: path
    integer, allocatable :: origin(:), offsets(:), step(:), extents(:)
    real(wp), allocatable :: points(:), motion(:), mode(:)
    integer, parameter :: n = 3*8*5, states = 9
    integer :: before

    call solve("tests/cases/path/lateral.deck", "critical.h5", path)
    call get_integers(path, steps//"Origin", origin, extents)
    call get_integers(path, steps//"PointOffsets", offsets, extents)
    call get_reals(path, "VTKHDF/Points", points, extents)
    call get_reals(path, "VTKHDF/PointData/displacement", motion, extents)
    call get_reals(path, "analysis/01_static/critical/0001/displacement", mode, extents)
    call get_numbers(path, "analysis/01_static/critical/0001", "step", step)
    call expect(size(origin) == 2*(states + 1), "nine states and a critical point")
    call expect(size(points) == 2*n .and. size(motion) == (states + 1)*n, "two sets of points")
    if (size(motion) /= (states + 1)*n .or. size(points) /= 2*n .or. size(step) /= 1) return
    call expect(all(origin(2*states + 1:) == [1, -1]), "the critical point comes last")
    call expect(all(offsets == [(0, before=1, states), n/3]), "about another state")
    before = (step(1) - 2)*n
    call expect_close(points(n + 1:), points(:n) + motion(before + 1:before + n), &
                      single*maxval(abs(motion)), "the one recorded before it")
    call expect_close(motion(states*n + 58:states*n + 60), mode(16:18), single*abs(mode(17)), &
                      "the motion of the node in the middle")
    call expect_close(abs(mode(17)), maxval(abs(mode)), 0.0_wp, "largest there, sideways")
  end subroutine test_critical

  subroutine test_without()
    character(len=:), allocatable :: path
    integer, allocatable :: numbers(:)

    call solve("tests/cases/program/cantilever.deck --no-vtk", "without.h5", path)
    call get_numbers(path, "VTKHDF/Steps", "NSteps", numbers)
    call expect(size(numbers) == 0, "no /VTKHDF")
    call get_numbers(path, "/", "complete", numbers)
    call expect(all(numbers == [1]), "but results")
  end subroutine test_without

end module test_output_vtkhdf
