module test_section_plates
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use json_numbers, only: read_text, member, elements, numbers
  use section_data, only: section_constants_t, section_geometry_t
  use section_plates, only: principal_turn
  use test_section_kit, only: draw, expect_same, scaled, zed_points, zed_plates, zed_thickness
  implicit none
  private

  public :: run_section_plates_tests

  real(wp), parameter :: pi = acos(-1.0_wp)
  integer, parameter :: chain(2, 3) = reshape([1, 2, 2, 3, 3, 4], [2, 3])

contains

  subroutine run_section_plates_tests()
    call run("section: constants of the reference file", reference_file)
    call run("section: channel SEC-01", channel_case)
    call run("section: tables 1 and 4 of the paper", paper_tables)
    call run("section: finite elements", finite_elements)
    call run("section: turning the drawing", turned_drawing)
    call run("section: a quarter turn exchanges the axes", quarter_turn)
    call run("section: mirroring the drawing", mirrored_drawing)
    call run("section: moving and renumbering the drawing", moved_drawing)
    call run("section: principal turn and its ties", principal_ties)
    call run("section: slit tube", slit_tube)
    call run("section: I section against Cowper's coefficient", cowper_i)
    call run("section: Wagner constant of an I with unequal flanges", wagner_i)
    call run("section: strip", strip)
    call run("section: plates that meet in one point", one_point)
  end subroutine run_section_plates_tests

  !> An independent implementation's C600, U300 and Z.
  subroutine reference_file()
    character(len=4), parameter :: names(3) = ["C600", "U300", "Z   "]
    character(len=:), allocatable :: file, text
    type(section_constants_t) :: c, wanted
    type(section_geometry_t) :: geometry
    real(wp), allocatable :: segments(:, :), omega(:), place(:)
    integer :: i

    file = member(read_text("tests/reference/beamw_element.json"), "sections")
    do i = 1, size(names)
      text = member(file, trim(names(i)))
      call expect(len(text) > 0, "section "//names(i)//" in the reference file")
      if (len(text) == 0) cycle
      segments = reshape(numbers(member(text, "segments")), [3, 3])
      call draw(reshape(numbers(member(text, "nodes")), [2, 4]), nint(segments(1:2, :)) + 1, &
                segments(3, :), c, geometry)
      wanted = reference_constants(text)
      call expect_same(c, wanted, 1.0e-11_wp, trim(names(i)))
      call expect_close(geometry%theta, value(text, "theta_principal"), 1.0e-12_wp, "theta")
      call expect_close(geometry%centroid, numbers(member(text, "centroid")), 1.0e-10_wp, &
                        "centroid")
      omega = numbers(member(text, "omega_at_nodes"))
      call expect_close(geometry%omega, omega, 1.0e-12_wp*maxval(abs(omega)), "omega")
      place = numbers(member(text, "nodes_principal"))
      call expect_close(reshape(geometry%principal, [8]), place, 1.0e-12_wp*maxval(place), &
                        "places")
    end do
  end subroutine reference_file

  !> The number of a key.
  function value(text, key)
    character(len=*), intent(in) :: text, key
    real(wp) :: value, x(1)

    x = numbers(member(text, key))
    value = x(1)
  end function value

  function reference_constants(text) result(c)
    character(len=*), intent(in) :: text
    type(section_constants_t) :: c

    c%a = value(text, "A")
    c%iy = value(text, "Iy")
    c%iz = value(text, "Iz")
    c%it = value(text, "It")
    c%iw = value(text, "Iomega")
    c%ys = value(text, "ys")
    c%zs = value(text, "zs")
    c%d(1, :) = [value(text, "Dy"), value(text, "Dyz"), value(text, "Dyomega")]
    c%d(2, :) = [c%d(1, 2), value(text, "Dz"), value(text, "Dzomega")]
    c%d(3, :) = [c%d(1, 3), c%d(2, 3), value(text, "Domega")]
    c%by = value(text, "beta_y")
    c%bz = value(text, "beta_z")
    c%bw = value(text, "beta_omega")
    c%ir = value(text, "IR")
    c%shear_given = .true.
  end function reference_constants

  !> Channel with web left: y, z of tip, corners, tip.
  pure function channel(b, h) result(points)
    real(wp), intent(in) :: b, h
    real(wp) :: points(2, 4)
    points = reshape([b, h/2, 0.0_wp, h/2, 0.0_wp, -h/2, b, -h/2], [2, 4])
  end function channel

  !> Case SEC-01, by another program, whose numbers differ by up to 4e-7.
  subroutine channel_case()
    real(wp), parameter :: wanted(11) = [54000.0_wp, -457.14285714285717_wp, 3780000067.5_wp, &
      2160000135.0_wp, 16200000.0_wp, 138857159470426.17_wp, 110000.00375_wp, &
      27692.313150889207_wp, 15989.012529986603_wp, 3693654743.655423_wp, 3814757.857988114_wp]
    type(section_constants_t) :: c
    real(wp) :: actual(11)

    call draw(channel(600.0_wp, 600.0_wp), chain, [30.0_wp, 30.0_wp, 30.0_wp], c)
    actual = [c%a, c%ys, c%iy, c%iz, c%it, c%iw, c%ip()/c%a, c%d(1, 1), c%d(2, 2), c%d(3, 3), &
              c%d(2, 3)]
    call expect_close(actual/wanted, spread(1.0_wp, 1, 11), 1.0e-6_wp, "SEC-01")
  end subroutine channel_case

  !> Table 1 has the shear centre at +y: the web is right there. It prints D omega = 3.65e6 mm4;
  !> that must be 3.65e9, as with 3.65e6 its column would buckle at 0.26e3 kN, not 11.94e3. The
  !> other shear rigidities printed are 0.8 to 3 % off the exact integrals; table 4 is exact.
  subroutine paper_tables()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    real(wp), parameter :: table1(7) = [5.4e4_wp, 457.1_wp, 3.78e9_wp, 2.16e9_wp, 1.62e7_wp, &
                                        1.3886e14_wp, 1.1e5_wp]
    real(wp), parameter :: shear(4) = [2.79e4_wp, 1.58e4_wp, 3.65e9_wp, -3.7e6_wp]
    real(wp), parameter :: table4(6) = [58.8_wp, -6.0779_wp, 8038.7_wp, 559.92_wp, 35.408_wp, &
                                        78943.0_wp]

    call draw(channel(-600.0_wp, 600.0_wp), chain, [30.0_wp, 30.0_wp, 30.0_wp], c)
    call expect_close([c%a, c%ys, c%iy, c%iz, c%it, c%iw, c%ip()/c%a]/table1, &
                      spread(1.0_wp, 1, 7), 1.0e-4_wp, "table 1")
    call expect_close([c%d(1, 1), c%d(2, 2), c%d(3, 3), c%d(2, 3)]/shear, spread(1.0_wp, 1, 4), &
                      0.035_wp, "shear rigidities of table 1")

    call draw(channel(9.5_wp, 28.4_wp), chain, [1.6_wp, 1.0_wp, 1.6_wp], c, geometry)
    call expect_close([c%a, c%ys, c%iy, c%iz, c%it, c%iw]/table4, spread(1.0_wp, 1, 6), &
                      1.0e-5_wp, "table 4")
    call expect_close(geometry%principal(1, 2), -2.456_wp, 5.0e-4_wp, "the web of table 4")
  end subroutine paper_tables

  !> Two-dimensional finite elements; the tolerances come with the file, from thin-wall theory.
  subroutine finite_elements()
    character(len=:), allocatable :: list, text, tolerance
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    real(wp), allocatable :: points(:), plates(:), thickness(:), moments(:)
    real(wp) :: centre(2), height
    integer :: i

    list = member(read_text("tests/reference/sections_fe.json"), "sections")
    do i = 1, 5
      text = elements(list, i)
      call expect(len(text) > 0, "five sections in the reference file")
      if (len(text) == 0) return
      tolerance = member(text, "tolerance")
      points = numbers(member(text, "points"))
      plates = numbers(member(text, "plates"))
      thickness = numbers(member(text, "thickness"))
      call draw(reshape(points, [2, size(points)/2]), &
                reshape(nint(plates), [2, size(thickness)]), thickness, c, geometry)
      associate (name => member(text, "name")//": ")
        call expect_close(c%a/value(text, "A"), 1.0_wp, value(tolerance, "A"), name//"A")
        moments = [max(c%iy, c%iz), min(c%iy, c%iz)]/numbers(member(text, "I"))
        call expect_close(moments, [1.0_wp, 1.0_wp], value(tolerance, "I"), name//"I")
        call expect_close(c%it/value(text, "It"), 1.0_wp, value(tolerance, "It"), name//"It")
        call expect_close(c%iw/value(text, "Iw"), 1.0_wp, value(tolerance, "Iw"), name//"Iw")
        centre = geometry%centroid + [c%ys*cos(geometry%theta) - c%zs*sin(geometry%theta), &
                                      c%ys*sin(geometry%theta) + c%zs*cos(geometry%theta)]
        height = maxval(geometry%points(2, :)) - minval(geometry%points(2, :))
        call expect_close(centre, numbers(member(text, "shear_centre")), &
                          height*value(tolerance, "shear_centre"), name//"shear centre")
      end associate
    end do
  end subroutine finite_elements

  !> Points turned about the origin.
  pure function turned(points, angle)
    real(wp), intent(in) :: points(:, :), angle
    real(wp) :: turned(2, size(points, 2))

    turned(1, :) = points(1, :)*cos(angle) - points(2, :)*sin(angle)
    turned(2, :) = points(1, :)*sin(angle) + points(2, :)*cos(angle)
  end function turned

  !> The principal axes turn with the drawing as long as their angle stays within 45 degrees.
  subroutine turned_drawing()
    type(section_constants_t) :: c, wanted
    type(section_geometry_t) :: geometry, original
    real(wp) :: angle
    integer :: i

    call draw(zed_points, zed_plates, zed_thickness, wanted, original)
    do i = 0, 40
      angle = -pi/4 - original%theta + 0.5_wp*pi*(i + 0.5_wp)/41
      call draw(turned(zed_points, angle), zed_plates, zed_thickness, c, geometry)
      call expect_same(c, wanted, 1.0e-11_wp, "turned")
      call expect_close(geometry%theta, original%theta + angle, 1.0e-12_wp, "turned: theta")
      call expect_close(reshape(geometry%principal - original%principal, [8]), &
                        spread(0.0_wp, 1, 8), 1.0e-10_wp, "turned: places")
    end do
  end subroutine turned_drawing

  !> Turned by 90 degrees the old y is the new z, the old z the new -y.
  subroutine quarter_turn()
    type(section_constants_t) :: c, old, wanted

    call draw(zed_points, zed_plates, zed_thickness, old)
    call draw(turned(zed_points, pi/2), zed_plates, zed_thickness, c)
    wanted = old
    wanted%iy = old%iz
    wanted%iz = old%iy
    wanted%ys = -old%zs
    wanted%zs = old%ys
    wanted%by = old%bz
    wanted%bz = -old%by
    wanted%d(1, :) = [old%d(2, 2), -old%d(1, 2), -old%d(2, 3)]
    wanted%d(2, :) = [-old%d(1, 2), old%d(1, 1), old%d(1, 3)]
    wanted%d(3, :) = [-old%d(2, 3), old%d(1, 3), old%d(3, 3)]
    call expect_same(c, wanted, 1.0e-11_wp, "quarter turn")
  end subroutine quarter_turn

  !> y -> -y turns the sign of omega: that of ys, Dyz, Dz omega, bz and bw.
  subroutine mirrored_drawing()
    real(wp), parameter :: signs(17) = [1, 1, 1, 1, 1, -1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1, 1]
    type(section_constants_t) :: c, old
    type(section_geometry_t) :: geometry, original
    real(wp) :: points(2, 4)

    call draw(zed_points, zed_plates, zed_thickness, old, original)
    points = zed_points
    points(1, :) = -points(1, :)
    call draw(points, zed_plates, zed_thickness, c, geometry)
    call expect_close(scaled(c, old), signs*scaled(old, old), 1.0e-11_wp, "mirrored")
    call expect_close(geometry%theta, -original%theta, 1.0e-12_wp, "mirrored: theta")
    call expect_close(geometry%omega, -original%omega, 1.0e-8_wp, "mirrored: omega")
    call expect(abs(old%ys) > 1 .and. abs(old%d(2, 3)) > 1, "something that can change sign")
  end subroutine mirrored_drawing

  !> Another origin, points and plates in another order, a plate drawn backwards or in two pieces.
  subroutine moved_drawing()
    type(section_constants_t) :: c, wanted
    type(section_geometry_t) :: geometry
    real(wp) :: points(2, 5)

    call draw(zed_points, zed_plates, zed_thickness, wanted)
    call draw(zed_points + spread([1000.0_wp, -300.0_wp], 2, 4), zed_plates, zed_thickness, c)
    call expect_same(c, wanted, 1.0e-11_wp, "moved")
    points(:, 1:4) = zed_points(:, [3, 1, 4, 2])
    points(:, 5) = [0.0_wp, 37.0_wp]
    call draw(points, reshape([1, 3, 5, 1, 4, 2, 5, 4], [2, 4]), &
              [10.0_wp, 6.0_wp, 8.0_wp, 6.0_wp], c, geometry)
    call expect_same(c, wanted, 1.0e-11_wp, "renumbered")
    call expect_close(geometry%omega(5), &
                      geometry%omega(1) + 0.685_wp*(geometry%omega(4) - geometry%omega(1)), &
                      1.0e-9_wp, "omega is linear along a plate")
  end subroutine moved_drawing

  !> The turned product of inertia vanishes; ties go to +45 degrees; nothing to turn is not turned.
  subroutine principal_ties()
    type(section_geometry_t) :: geometry
    type(section_constants_t) :: c
    real(wp) :: theta, product, noise
    real(wp), parameter :: leg = 10, degree = pi/180
    integer :: i

    do i = -17, 17
      theta = principal_turn(1.0_wp, 1.0_wp + 2*cos(10*i*degree), sin(10*i*degree))
      product = sin(10*i*degree)*cos(2*theta) - cos(10*i*degree)*sin(2*theta)
      call expect_close(product, 0.0_wp, 1.0e-14_wp, "product of inertia in principal axes")
      call expect(abs(theta) <= 45*degree + 1.0e-6_wp, "within 45 degrees")
    end do
    call expect_close(principal_turn(2.0_wp, 2.0_wp, 0.0_wp), 0.0_wp, 0.0_wp, "equal moments")
    call expect_close(principal_turn(2.0_wp, 1.0_wp, 1.0e-13_wp), 0.0_wp, 0.0_wp, "round-off")
    do i = -1, 1
      noise = 1.0e-9_wp*i
      call draw(reshape([leg + noise, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, leg], [2, 3]), &
                chain(:, 1:2), [1.0_wp, 1.0_wp], c, geometry)
      call expect_close(geometry%theta, 45*degree, 1.0e-6_wp, "equal angle")
      call draw(reshape([-leg + noise, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, leg], [2, 3]), &
                chain(:, 1:2), [1.0_wp, 1.0_wp], c, geometry)
      call expect_close(geometry%theta, 45*degree, 1.0e-6_wp, "mirrored equal angle")
    end do
  end subroutine principal_ties

  !> Circle open at a slit (Vlasov): shear centre 2 r from the middle, opposite to the slit,
  !> Iw = 2 pi t r**5 (pi**2/3 - 2). The polygon is off by some (side/r)**2/24 = 1e-5.
  subroutine slit_tube()
    integer, parameter :: n = 400
    real(wp), parameter :: r = 50, t = 1
    real(wp) :: points(2, n + 1), angle
    type(section_constants_t) :: c
    integer :: i

    do i = 0, n
      angle = 1.0e-6_wp + (2*pi - 2.0e-6_wp)*i/n
      points(:, i + 1) = r*[cos(angle), sin(angle)]
    end do
    call draw(points, reshape([(i, i + 1, i=1, n)], [2, n]), spread(t, 1, n), c)
    call expect_close([c%a/(2*pi*r*t), c%iy/(pi*r**3*t), c%iz/(pi*r**3*t), c%it/(2*pi*r*t**3/3)], &
                      spread(1.0_wp, 1, 4), 1.0e-4_wp, "A, Iy, Iz, It")
    call expect_close([c%ys, c%zs]/r, [-2.0_wp, 0.0_wp], 1.0e-4_wp, "shear centre")
    call expect_close(c%iw/(2*pi*t*r**5*(pi**2/3 - 2)), 1.0_wp, 2.0e-4_wp, "Iw")
  end subroutine slit_tube

  !> Cowper (1966) for a thin-walled I, nu = 0, m = 2 b tf/(h tw), n = b/h.
  subroutine cowper_i()
    real(wp), parameter :: b = 120, h = 200, tf = 4, tw = 3, m = 2*b*tf/(h*tw), n = b/h
    real(wp), parameter :: k = 10*(1 + 3*m)**2/(12 + 72*m + 150*m**2 + 90*m**3 + 30*n**2*(m + m**2))
    type(section_constants_t) :: c

    call draw(i_points(b, b, h), i_plates(), [tf, tf, tw, tf, tf], c)
    call expect_close(c%d(2, 2)/c%a, k, 1.0e-12_wp, "along the web")
    call expect_close(c%d(1, 1)/(2*b*tf), 5.0_wp/6, 1.0e-12_wp, "along the flanges")
    call expect_close(c%d(3, 3)/(2*b*tf*h**2/4), 5.0_wp/6, 1.0e-12_wp, "warping: flanges apart")
    call expect_close(c%iw/(tf*h**2*b**3/24), 1.0_wp, 1.0e-12_wp, "Iw")
  end subroutine cowper_i

  !> I with the upper flange b1, the lower b2.
  pure function i_points(b1, b2, h) result(points)
    real(wp), intent(in) :: b1, b2, h
    real(wp) :: points(2, 6)
    points = reshape([-b1/2, h, 0.0_wp, h, b1/2, h, -b2/2, 0.0_wp, 0.0_wp, 0.0_wp, b2/2, 0.0_wp], &
                     [2, 6])
  end function i_points

  pure function i_plates() result(plates)
    integer :: plates(2, 5)

    plates = reshape([1, 2, 2, 3, 2, 5, 4, 5, 5, 6], [2, 5])
  end function i_plates

  !> The girder of theory.md section 10, beta y = -214.689 mm with the large flange up; its
  !> shear centre divides the web as the flanges' Iz do, h I1/(I1 + I2) = 8/9 h from the lower.
  subroutine wagner_i()
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry

    call draw(i_points(200.0_wp, 100.0_wp, 300.0_wp), i_plates(), &
              [20.0_wp, 20.0_wp, 10.0_wp, 20.0_wp, 20.0_wp], c, geometry)
    call expect_close(c%by, -214.689_wp, 5.0e-4_wp, "beta y")
    call expect_close(c%zs + geometry%centroid(2), 800.0_wp/3, 1.0e-9_wp, "shear centre")
    call expect_close(c%iw/(20*(200.0_wp**3/12)*300.0_wp**2/9), 1.0_wp, 1.0e-12_wp, "Iw")
    call expect_close([c%bz, c%bw], [0.0_wp, 0.0_wp], 1.0e-9_wp, "no other asymmetry")
  end subroutine wagner_i

  !> Everything on a line: own wall thickness for what the midline leaves at zero.
  subroutine strip()
    real(wp), parameter :: l = 100, t = 2
    real(wp), parameter :: ends(2, 3) = reshape([0, 0, 30, 0, 100, 0]*1.0_wp, [2, 3])
    type(section_constants_t) :: c, wanted
    integer :: i

    wanted%a = l*t
    wanted%iy = l*t**3/12
    wanted%iz = t*l**3/12
    wanted%it = l*t**3/3
    wanted%d(1, 1) = 5*wanted%a/6
    wanted%d(2, 2) = 5*wanted%a/6
    wanted%d(3, 3) = 5*wanted%ip()/6
    wanted%ir = t*l**5*(1.0_wp/80 - 1.0_wp/144)
    wanted%shear_given = .true.
    wanted%shear_rigid = [.false., .true., .true.]
    do i = -4, 4
      call draw(turned(ends, 10*i*pi/180), chain(:, 1:2), [t, t], c)
      call expect_same(c, wanted, 1.0e-12_wp, "strip")
    end do
    call draw(turned(ends(:, [1, 3]), pi/2), chain(:, 1:1), [t], c)
    call expect(all(c%shear_rigid .eqv. [.true., .false., .true.]), "upright strip: y and omega")
    call expect_close([c%iy/wanted%iz, c%iz/wanted%iy], [1.0_wp, 1.0_wp], 1.0e-12_wp, "upright")
  end subroutine strip

  !> Angle, tee, cross: no warping, the shear centre where the plates meet.
  subroutine one_point()
    real(wp), parameter :: b = 50, t = 3
    real(wp), parameter :: star(2, 5) = reshape([0.0_wp, 0.0_wp, b, 0.0_wp, 0.0_wp, b, &
                                                 -b, 0.0_wp, 0.0_wp, -b], [2, 5])
    integer, parameter :: legs(2, 4) = reshape([1, 2, 1, 3, 1, 4, 1, 5], [2, 4])
    type(section_constants_t) :: c
    type(section_geometry_t) :: geometry
    real(wp) :: centre(2)
    integer :: n

    do n = 2, 4
      call draw(star(:, :n + 1), legs(:, :n), spread(t, 1, n), c, geometry)
      centre = geometry%principal(:, 1)
      call expect_close([c%ys, c%zs], centre, 1.0e-12_wp*b, "shear centre")
      call expect_close(c%iw, 0.0_wp, 0.0_wp, "Iw")
      call expect_close(geometry%omega, spread(0.0_wp, 1, n + 1), 0.0_wp, "omega")
      call expect_close([c%d(1, 3), c%d(2, 3), c%d(3, 1), c%d(3, 2)], spread(0.0_wp, 1, 4), &
                        0.0_wp, "no coupling with warping")
      call expect(c%d(3, 3) > 0, "D positive definite")
      call expect(all(c%shear_rigid .eqv. [.false., .false., .true.]), "rigid in warping shear")
      ! angle: parabolic flow in each leg; cross: a leg along the force carries its 5/6
      if (n == 2) call expect_close([c%d(1, 1), c%d(2, 2)]/(b*t), [5.0_wp, 5.0_wp]/6, &
                                    1.0e-12_wp, "angle")
      if (n == 4) call expect_close([c%d(1, 1), c%d(2, 2)]/(2*b*t), [5.0_wp, 5.0_wp]/6, &
                                    1.0e-12_wp, "cross")
    end do
  end subroutine one_point

end module test_section_plates
