!> Sections from decks: shapes, drawings, constants; turned axes in whole decks; stresses.
module test_deck_sections
  use kinds, only: wp
  use check, only: run, expect, expect_close
  use errors, only: error_t
  use diagnostics, only: report_t
  use text, only: to_text
  use section_data, only: section_constants_t, section_geometry_t
  use section_shapes, only: shape_dimensions_t, shape_rules, shape_rule_t, set_dimension, &
                            shape_section
  use model_data, only: model_t, setting_t
  use deck_reader, only: read_deck
  use deck_samples, only: read_sample, read_sound, frame
  use memory_recorder, only: memory_t, run_deck
  use system_stress, only: stress_place_t, stress_places
  use test_section_kit, only: expect_same, scaled
  implicit none
  private

  public :: run_deck_sections_tests

  character(len=*), parameter :: beam = "MATERIAL m E 200 NU 0.25|NODE 1 0 0 0|NODE 2 4 0 0|"// &
    "BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m|FIX 1|XF 2 1 0 0|"

contains

  subroutine run_deck_sections_tests()
    call run("deck sections: every shape is its kernel's", shapes)
    call run("deck sections: shapes are drawings made by hand", drawings)
    call run("deck sections: tables 1 and 4 of the paper", tables)
    call run("deck sections: points in any order, ranges, words in any case", forms)
    call run("deck sections: constants that are not given", constants)
    call run("deck sections: Poisson's ratio", poisson)
    call run("deck sections: places in sections", places)
    call run("deck sections: a broken drawing is reported once", broken)
    call run("static: an angle in its own and in principal axes", turned_angle)
    call run("static: a zed drawn twice, loads at its points", turned_zed)
    call run("static: stresses of an axial force off the centroid", stresses)
  end subroutine run_deck_sections_tests

  !> All sizes of a shape, also the optional ones, walls thin: H 30, B 14, T 0.3, ...
  subroutine all_sizes(rule, card, size_of)
    type(shape_rule_t), intent(in) :: rule
    character(len=:), allocatable, intent(out) :: card
    type(shape_dimensions_t), intent(out) :: size_of
    character(len=3), parameter :: name(9) = ["H  ", "B  ", "T  ", "TW ", "B2 ", "T2 ", "LIP", &
                                              "C  ", "D  "]
    real(wp), parameter :: value(9) = [30.0_wp, 14.0_wp, 0.5_wp, 0.25_wp, 12.0_wp, 0.75_wp, &
                                       4.0_wp, 6.0_wp, 20.0_wp]
    logical :: known
    integer :: i

    card = "SECTION s "//trim(rule%name)
    do i = 1, size(name)
      if (.not. (any(rule%required == name(i)) .or. any(rule%optional == name(i)))) cycle
      card = card//" "//trim(name(i))//" "//to_text(value(i))
      call set_dimension(size_of, trim(name(i)), value(i), known)
    end do
  end subroutine all_sizes

  subroutine shapes()
    type(model_t) :: model
    type(shape_dimensions_t) :: size_of
    type(section_constants_t) :: wanted
    type(section_geometry_t) :: geometry
    type(error_t), allocatable :: error
    character(len=:), allocatable :: card
    integer :: i, midline

    do i = 1, size(shape_rules)
      do midline = 0, 1
        call all_sizes(shape_rules(i), card, size_of)
        if (midline == 1 .and. .not. any(shape_rules(i)%required == "T")) cycle
        size_of%midline = midline == 1
        if (midline == 1) card = card//" MIDLINE"
        call read_sound(beam//card, model)
        call shape_section(trim(shape_rules(i)%name), size_of, 0.25_wp, wanted, geometry, error)
        call expect(.not. allocated(error), card//" is sound")
        if (allocated(error) .or. size(model%section) /= 1) cycle
        call expect_same(model%section(1)%constants, wanted, 1.0e-14_wp, card)
        call expect_close(model%section(1)%geometry%principal, geometry%principal, 1.0e-14_wp, &
                          card//", points")
        call expect(model%section(1)%shape == shape_rules(i)%name, card//", shape")
      end do
    end do
  end subroutine shapes

  !> One deck, two sections: the second draws the midline of the first.
  subroutine drawings()
    call expect_drawn("C H 20 B 9 T 0.5 TW 0.25 B2 7 T2 1", "POINT 1 8.875 19.25|"// &
      "POINT 2 0 19.25|POINT 3 0 0|POINT 4 6.875 0|PLATE 1 2 0.5|PLATE 2 3 0.25|PLATE 3 4 1")
    call expect_drawn("C H 20 B 9 T 0.5 TW 0.25 LIP 2 MIDLINE", "POINT 1 9 20|POINT 2 0 20|"// &
      "POINT 3 0 0|POINT 4 9 0|POINT 5 9 18|POINT 6 9 2|PLATE 1 2 0.5|PLATE 2 3 0.25|"// &
      "PLATE 3 4 0.5|PLATE 1 5 0.5|PLATE 4 6 0.5")
    call expect_drawn("Z H 20 B 9 T 0.5 TW 0.25 B2 7 T2 1 MIDLINE", "POINT 1 -9 20|"// &
      "POINT 2 0 20|POINT 3 0 0|POINT 4 7 0|PLATE 1 2 0.5|PLATE 2 3 0.25|PLATE 3 4 1")
    call expect_drawn("I H 20 B 9 T 0.5 TW 0.25 B2 7 T2 1 MIDLINE", "POINT 1 -4.5 20|"// &
      "POINT 2 0 20|POINT 3 4.5 20|POINT 4 -3.5 0|POINT 5 0 0|POINT 6 3.5 0|PLATE 1 2 0.5|"// &
      "PLATE 2 3 0.5|PLATE 2 5 0.25|PLATE 4 5 1|PLATE 5 6 1")
    call expect_drawn("T H 20 B 9 T 0.5 TW 0.25", "POINT 1 -4.5 0|POINT 2 0 0|POINT 3 4.5 0|"// &
      "POINT 4 0 -19.75|PLATE 1 2 0.5|PLATE 2 3 0.5|PLATE 2 4 0.25")
    call expect_drawn("L H 20 B 9 T 0.5 T2 0.25 MIDLINE", "POINT 1 0 20|POINT 2 0 0|"// &
      "POINT 3 9 0|PLATE 1 2 0.5|PLATE 2 3 0.25")
    call expect_drawn("HAT H 20 B 9 T 0.5 C 4 MIDLINE", "POINT 1 0 0|POINT 2 4 0|POINT 3 4 20|"// &
      "POINT 4 13 20|POINT 5 13 0|POINT 6 17 0|PLATE 1:5 {i+1} 0.5")
  end subroutine drawings

  subroutine expect_drawn(shape, drawing)
    character(len=*), intent(in) :: shape, drawing
    type(model_t) :: model

    call read_sound(beam//"SECTION s "//shape//"|SECTION p PLATES|"//drawing, model)
    if (size(model%section) /= 2) return
    call expect_same(model%section(1)%constants, model%section(2)%constants, 1.0e-11_wp, shape)
    call expect_close(model%section(1)%geometry%principal, model%section(2)%geometry%principal, &
                      1.0e-11_wp, shape//", points")
    call expect_close(model%section(1)%geometry%omega, model%section(2)%geometry%omega, &
                      1.0e-9_wp, shape//", omega")
  end subroutine expect_drawn

  !> In cm; the paper's table 1 is in mm and prints D omega = 3.65e6 for 3.65e9 mm4 (see
  !> test_section_plates), the other shear rigidities 0.8 to 3 % off.
  subroutine tables()
    real(wp), parameter :: table1(7) = [540.0_wp, 45.71_wp, 3.78e5_wp, 2.16e5_wp, 1.62e3_wp, &
                                        1.3886e8_wp, 1.1e3_wp]
    real(wp), parameter :: shear(4) = [279.0_wp, 158.0_wp, 3.65e5_wp, -3.7e3_wp]
    real(wp), parameter :: table4(6) = [58.8_wp, -6.0779_wp, 8038.7_wp, 559.92_wp, 35.408_wp, &
                                        78943.0_wp]
    type(model_t) :: model
    type(report_t) :: report
    type(error_t), allocatable :: error
    type(setting_t) :: none(0)
    integer :: i, k

    call read_deck("decks/sections.deck", none, model, report, error)
    call expect(.not. allocated(error) .and. report%errors() + report%warnings() == 0, "sound")
    if (allocated(error)) return
    i = findloc(model%section%name == "column", .true., 1)
    k = findloc(model%section%name == "channel", .true., 1)
    associate (c => model%section(i)%constants)
      call expect_close([c%a, c%ys, c%iy, c%iz, c%it, c%iw, c%ip()/c%a]/table1, &
                        spread(1.0_wp, 1, 7), 1.0e-4_wp, "table 1")
      call expect_close([c%d(1, 1), c%d(2, 2), c%d(3, 3), c%d(2, 3)]/shear, &
                        spread(1.0_wp, 1, 4), 0.035_wp, "shear rigidities of table 1")
    end associate
    associate (c => model%section(k)%constants)
      call expect_close([c%a, c%ys, c%iy, c%iz, c%it, c%iw]/table4, spread(1.0_wp, 1, 6), &
                        1.0e-5_wp, "table 4")
    end associate
  end subroutine tables

  subroutine forms()
    type(model_t) :: model

    call read_sound(beam//"section s plates|plate 1:2 {i+1} 0.5|SET h 6|POINT 3 4 0|"// &
                    "POINT 1:2 0 {h*(2-i)}|SECTION q l h 6 b 4 t 0.5 midline", model)
    if (size(model%section) /= 2) return
    call expect_same(model%section(1)%constants, model%section(2)%constants, 1.0e-12_wp, "angle")
    call expect(all(model%section(1)%geometry%number == [3, 1, 2]), "numbers of the points")
    call expect(all(model%section(1)%geometry%plates(:, 1) == [2, 3]), "a plate by numbers")
  end subroutine forms

  !> Each shear rigidity that is missing makes the beam rigid in that shear; all defaults are told.
  subroutine constants()
    type(model_t) :: model

    call read_sound(beam//"SECTION s CONSTANTS A 1 IY 2 IZ 3 IT 4 IW 5 DY 6 YS 1 BZ 2", model)
    if (size(model%section) /= 1) return
    associate (section => model%section(1))
      call expect(section%constants%shear_given, "shear is given")
      call expect(all(section%constants%shear_rigid .eqv. [.false., .true., .true.]), "in y only")
      call expect(section%defaults == "ZS = BY = BW = IR = 0; rigid in shear: no DZ, DW", &
                  "defaults, not "//section%defaults)
    end associate
    call read_sound(beam//"SECTION s C H 9 B 4 T 0.1 TW 0.1", model)
    call expect(model%section(1)%defaults == "B2 = B, T2 = T, no LIP, OUTER sizes", "of a shape")
  end subroutine constants

  !> Cowper's coefficient of a rectangle, 10 (1 + nu)/(12 + 11 nu).
  subroutine poisson()
    type(model_t) :: model

    call read_sound(beam//"SECTION s RECT H 2 B 1|SECTION t RECT H 2 B 1", model)
    if (size(model%section) /= 2) return
    call expect_close(model%section(1)%constants%d(1, 1), 2*12.5_wp/14.75_wp, 1.0e-14_wp, "of m")
    call expect_close(model%section(2)%constants%d(1, 1), 2*13.0_wp/15.3_wp, 1.0e-14_wp, "0.3")
    call read_sound("MATERIAL m E 20 G 1|NODE 1:2 {i} 0 0|SECTION s RECT H 2 B 1|"// &
                    "BEAMW 1 1 2 SECTION s MATERIAL m|FIX 1|XF 2 1 0 0", model)
    call expect_close(model%section(1)%constants%d(1, 1), 2*15.0_wp/17.5_wp, 1.0e-14_wp, &
                      "at most 0.5")
  end subroutine poisson

  !> AT counts from the drawing's origin for PLATES, from the centroid for a shape.
  subroutine places()
    type(model_t) :: model
    real(wp), parameter :: r = sqrt(0.5_wp)

    call read_sound(beam//"SECTION s PLATES|POINT 7 10 8|POINT 5 10 2|POINT 6 16 2|"// &
                    "PLATE 7 5 0.1|PLATE 5 6 0.1|MARKER a 2 AT POINT 7|MARKER b 2 AT 10 2|"// &
                    "MARKER c 2 AT 13 5", model)
    call expect_close(model%section(1)%geometry%theta, 0.25_wp*acos(-1.0_wp), 1.0e-12_wp, "45")
    ! the centroid is at (11.5, 3.5)
    call expect_close(model%marker(1)%offset, r*[3.0_wp, 6.0_wp], 1.0e-12_wp, "POINT 7")
    call expect_close(model%marker(2)%offset, r*[-3.0_wp, 0.0_wp], 1.0e-12_wp, "the corner")
    call expect_close(model%marker(3)%offset, r*[3.0_wp, 0.0_wp], 1.0e-12_wp, "in the air")
    call expect(model%marker(2)%omega_known .and. .not. model%marker(3)%omega_known, &
                "omega is known on walls only")
    call read_sound(beam//"SECTION s L H 6 B 6 T 0.1 MIDLINE|MARKER b 2 AT -1.5 -1.5", model)
    call expect_close(model%marker(1)%offset, r*[-3.0_wp, 0.0_wp], 1.0e-12_wp, "of a shape")
    call read_sound(beam//"SECTION s C H 20 B 8 T 0.2 TW 0.1 MIDLINE|MARKER a 2 AT POINT 1", model)
    call expect(model%marker(1)%omega_known, "omega of a point")
    call expect_close(model%marker(1)%omega, model%section(1)%geometry%omega(1), 0.0_wp, "omega")
  end subroutine places

  !> Cards of a drawing with errors leave no further errors behind.
  subroutine broken()
    type(model_t) :: model
    type(report_t) :: report

    call read_sample(beam//"SECTION s PLATES|POINT 1 0 0|POINT 2 x 0|PLATE 1 2 0.1", model, report)
    call expect(report%errors() == 1, "one error, a point without number")
    call read_sample(beam//"SECTION s PLATS|POINT 1 0 0|POINT 2 1 0|PLATE 1 2 0.1", model, report)
    call expect(report%errors() == 1, "one error, a card with a wrong word")
    call read_sample(frame//"SECTION bar PLATES|POINT 1 0 0|POINT 2 1 0|PLATE 1 2 0.1|FIX 1|"// &
                     "XF 2 1 0 0", model, report)
    call expect(report%errors() == 1, "one error, a name taken")
  end subroutine broken

  !> Both markers move alike; the principal axes are the ones by hand.
  subroutine turned_angle()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    real(wp) :: x(17), wanted(17)

    call run_deck("turned_angle", memory, model, error)
    call expect(.not. allocated(error) .and. memory%steps == 2, "solved")
    if (allocated(error)) return
    call expect_close(model%member(1)%triad, model%member(4)%triad, 1.0e-12_wp, "axes")
    associate (c => model%section(1)%constants, hand => model%section(2)%constants)
      x = scaled(c, hand)
      wanted = scaled(hand, hand)
      x(13) = wanted(13)   ! D omega has no meaning here
      call expect_close(x, wanted, 1.0e-12_wp, "by hand")
    end associate
    associate (u => memory%results(2)%marker)
      call expect(norm2(u(:, 1)) > 1.5_wp, "it moves")
      call expect_close(u(:, 1), u(:, 2), 1.0e-7_wp*norm2(u(:, 1)), "displacements")
    end associate
  end subroutine turned_angle

  subroutine turned_zed()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    integer :: a, b

    call run_deck("turned_zed", memory, model, error)
    call expect(.not. allocated(error) .and. memory%steps == 2, "solved")
    if (allocated(error)) return
    call expect_close(model%member(1)%triad, model%member(4)%triad, 1.0e-12_wp, "axes")
    a = findloc(model%node%id == 2 .and. model%node%part == 0, .true., 1)
    b = findloc(model%node%id == 4, .true., 1)
    associate (r => memory%results(2))
      call expect(norm2(r%displacement(:, a)) > 1.5_wp, "it moves")
      call expect_close(r%displacement(:, b), r%displacement(:, a), &
                        1.0e-7_wp*norm2(r%displacement(:, a)), "tip")
      call expect_close(r%marker(:, 2), r%marker(:, 1), 1.0e-7_wp*norm2(r%marker(:, 1)), "marker")
      call expect_close(r%warping(b)/r%warping(a), 1.0_wp, 1.0e-6_wp, "warping")
    end associate
  end subroutine turned_zed

  !> At the loaded end F (1/A + y1 y/Iz + z1 z/Iy + omega1 omega/Iw); at the other end the
  !> integrals over the section give the section forces back.
  subroutine stresses()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error
    type(stress_place_t), allocatable :: place(:)
    real(wp) :: wanted(4), force
    integer :: i

    call run_deck("point_stress", memory, model, error)
    call expect(.not. allocated(error), "solved")
    if (allocated(error)) return
    allocate (place, source=stress_places(model))
    call expect(size(place) == 16, "two elements, two ends, four points")
    call expect(all(shape(memory%results(1)%point_stress) == [4, 16]), "as many stresses")
    if (size(place) /= 16) return
    force = 1.0e-3_wp
    associate (c => model%section(1)%constants, g => model%section(1)%geometry, &
               stress => memory%results(1)%point_stress)
      do i = 1, 4
        associate (p => g%principal(:, i), p1 => g%principal(:, 1))
          wanted(2) = force/c%a
          wanted(3) = force*(p1(1)*p(1)/c%iz + p1(2)*p(2)/c%iy)
          wanted(4) = force*g%omega(1)*g%omega(i)/c%iw
          wanted(1) = sum(wanted(2:4))
        end associate
        call expect(place(12 + i)%member == 2 .and. place(12 + i)%end == 2 .and. &
                    place(12 + i)%point == i, "the places' order")
        call expect_close(stress(:, 12 + i)/force, wanted/force, 1.0e-5_wp, "at the loaded end")
      end do
      call expect_close(integral(stress(1, 1:4)), force, 1.0e-6_wp*force, "axial force at p")
    end associate

  contains

    !> Of a stress linear along the three walls.
    pure real(wp) function integral(stress)
      real(wp), intent(in) :: stress(4)

      integral = 0.5_wp*(7*0.4_wp*(stress(1) + stress(2)) + 20*0.3_wp*(stress(2) + stress(3)) &
                         + 6*0.5_wp*(stress(3) + stress(4)))
    end function integral
  end subroutine stresses

end module test_deck_sections
