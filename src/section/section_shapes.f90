!> Sections by name: C I T L Z HAT as plates, RECT BOX CIRC TUBE by formulas.
!>
!> H is along z, B along y. T is the thickness of what lies along y (flanges, the top), TW that
!> of what lies along z (webs); B2, T2 the lower flange, at -z, by default like the upper one.
!>
!> Sizes are OUTER ones, over the faces, or those of the MIDLINE. Points of the plates:
!>
!>     C, Z  1 upper tip, 2 upper corner, 3 lower corner, 4 lower tip; lips: 5 upper, 6 lower tip.
!>           The web of C is left, its flanges run to +y; the upper flange of Z runs to -y.
!>           LIP is the free edge of both flanges, turned inwards, as thick as its flange.
!>     I     1 2 3 upper flange from -y to +y, 4 5 6 lower flange; 2-5 is the web
!>     T     1 2 3 flange, at +z, from -y to +y, 4 the web's lower tip
!>     L     1 tip of the upright leg (left, T thick), 2 corner, 3 tip of the lower leg (to +y, T2)
!>     HAT   1 tip of the brim at -y, 2 to 5 corners over the top, 6 tip at +y; C is one brim,
!>           OUTER from the inner face of the web
module section_shapes
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use section_data, only: section_constants_t, section_geometry_t
  use section_topology, only: plate_fault_t
  use section_plates, only: plates_section
  use section_solids, only: rectangle_section, box_section, round_section
  implicit none
  private

  public :: shape_dimensions_t, shape_rule_t, shape_rules, shape_rule, set_dimension, shape_section

  real(wp), parameter, public :: not_given = -huge(1.0_wp)

  !> The sizes of a shape, each `not_given` at first [L].
  type :: shape_dimensions_t
    real(wp) :: h = not_given
    real(wp) :: b = not_given
    real(wp) :: t = not_given
    real(wp) :: tw = not_given
    real(wp) :: b2 = not_given
    real(wp) :: t2 = not_given
    real(wp) :: lip = not_given
    real(wp) :: c = not_given
    real(wp) :: d = not_given
    logical :: midline = .false.  !< sizes are those of the midline, not over the faces
  end type shape_dimensions_t

  !> Which sizes a shape has; unused places are blank.
  type :: shape_rule_t
    character(len=4) :: name = ""
    character(len=3) :: required(4) = ""
    character(len=3) :: optional(3) = ""
    character(len=24) :: help = ""
  end type shape_rule_t

  character(len=3), parameter :: none(3) = ["   ", "   ", "   "]

  !> All shapes, in the order of the manual.
  type(shape_rule_t), parameter :: shape_rules(10) = [ &
    shape_rule_t("C   ", ["H  ", "B  ", "T  ", "TW "], ["B2 ", "T2 ", "LIP"], "channel, lips"), &
    shape_rule_t("I   ", ["H  ", "B  ", "T  ", "TW "], ["B2 ", "T2 ", "   "], "I, two flanges"), &
    shape_rule_t("T   ", ["H  ", "B  ", "T  ", "TW "], none, "tee, flange above"), &
    shape_rule_t("L   ", ["H  ", "B  ", "T  ", "   "], ["T2 ", "   ", "   "], "angle"), &
    shape_rule_t("Z   ", ["H  ", "B  ", "T  ", "TW "], ["B2 ", "T2 ", "LIP"], "zed, lips"), &
    shape_rule_t("HAT ", ["H  ", "B  ", "T  ", "C  "], none, "hat with two brims"), &
    shape_rule_t("RECT", ["H  ", "B  ", "   ", "   "], none, "solid rectangle"), &
    shape_rule_t("BOX ", ["H  ", "B  ", "T  ", "TW "], none, "rectangular box"), &
    shape_rule_t("CIRC", ["D  ", "   ", "   ", "   "], none, "solid circle"), &
    shape_rule_t("TUBE", ["D  ", "T  ", "   ", "   "], none, "circular tube")]

contains

  !> The rule of a shape; its name is blank for an unknown shape.
  pure function shape_rule(shape) result(rule)
    character(len=*), intent(in) :: shape  !< in upper case
    type(shape_rule_t) :: rule
    integer :: i

    do i = 1, size(shape_rules)
      if (shape_rules(i)%name == shape) rule = shape_rules(i)
    end do
  end function shape_rule

  !> Store a size under its name, in upper case; `known` is false for a name that is none.
  pure subroutine set_dimension(dimensions, name, value, known)
    type(shape_dimensions_t), intent(inout) :: dimensions
    character(len=*), intent(in) :: name
    real(wp), intent(in) :: value
    logical, intent(out) :: known

    known = .true.
    select case (name)
    case ("H")
      dimensions%h = value
    case ("B")
      dimensions%b = value
    case ("T")
      dimensions%t = value
    case ("TW")
      dimensions%tw = value
    case ("B2")
      dimensions%b2 = value
    case ("T2")
      dimensions%t2 = value
    case ("LIP")
      dimensions%lip = value
    case ("C")
      dimensions%c = value
    case ("D")
      dimensions%d = value
    case default
      known = .false.
    end select
  end subroutine set_dimension

  !> Constants and geometry of a shape; `poisson` only enters the shear coefficients of RECT, BOX,
  !> CIRC and TUBE. Errors: an unknown shape; a size that is missing, not the shape's, not
  !> positive, or too small for the walls; lips that meet.
  subroutine shape_section(shape, dimensions, poisson, constants, geometry, error)
    character(len=*), intent(in) :: shape  !< in upper case
    type(shape_dimensions_t), intent(in) :: dimensions
    real(wp), intent(in) :: poisson
    type(section_constants_t), intent(out) :: constants
    type(section_geometry_t), intent(out) :: geometry
    type(error_t), allocatable, intent(out) :: error
    type(shape_dimensions_t) :: m

    call check_dimensions(shape, dimensions, error)
    if (allocated(error)) return
    call find_midline(shape, dimensions, m, error)
    if (allocated(error)) return
    select case (shape)
    case ("RECT")
      call rectangle_section(m%h, m%b, poisson, constants, geometry)
    case ("BOX")
      call box_section(m%h, m%b, m%t, m%tw, poisson, constants, geometry)
    case ("CIRC")
      call round_section(m%d, 0.0_wp, poisson, constants, geometry)
    case ("TUBE")
      call round_section(m%d + m%t, m%d - m%t, poisson, constants, geometry)
    case default
      call open_shape(shape, m, constants, geometry, error)
    end select
  end subroutine shape_section

  !> All sizes that a shape needs, none that it has not, all positive.
  subroutine check_dimensions(shape, dimensions, error)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: dimensions
    type(error_t), allocatable, intent(out) :: error
    character(len=3), parameter :: names(9) = ["H  ", "B  ", "T  ", "TW ", "B2 ", "T2 ", "LIP", &
                                               "C  ", "D  "]
    type(shape_rule_t) :: rule
    real(wp) :: values(9)
    logical :: given
    integer :: i

    rule = shape_rule(shape)
    if (rule%name == "") then
      call fail(error, exit_deck, "'"//shape//"' is not a shape of a section")
      return
    end if
    values = [dimensions%h, dimensions%b, dimensions%t, dimensions%tw, dimensions%b2, &
              dimensions%t2, dimensions%lip, dimensions%c, dimensions%d]
    do i = 1, size(names)
      given = values(i) > not_given
      if (any(rule%required == names(i)) .and. .not. given) then
        call fail(error, exit_deck, shape//" needs "//trim(names(i)))
      else if (given .and. .not. (any(rule%required == names(i)) &
                                  .or. any(rule%optional == names(i)))) then
        call fail(error, exit_deck, shape//" has no "//trim(names(i)))
      else if (given .and. .not. (values(i) > 0.0_wp .and. values(i) < huge(1.0_wp))) then
        call fail(error, exit_deck, trim(names(i))//" has to be positive")
      end if
      if (allocated(error)) return
    end do
  end subroutine check_dimensions

  !> Defaults, and the sizes of the midline. Errors: nothing is left of a size.
  subroutine find_midline(shape, dimensions, m, error)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: dimensions
    type(shape_dimensions_t), intent(out) :: m
    type(error_t), allocatable, intent(out) :: error
    logical :: lips

    m = dimensions
    if (.not. m%b2 > 0.0_wp) m%b2 = m%b
    if (.not. m%t2 > 0.0_wp) m%t2 = m%t
    if (.not. dimensions%midline) then
      lips = m%lip > 0.0_wp
      select case (shape)
      case ("C", "Z")
        m%h = m%h - 0.5_wp*(m%t + m%t2)
        m%b = m%b - 0.5_wp*(m%tw + merge(m%t, 0.0_wp, lips))
        m%b2 = m%b2 - 0.5_wp*(m%tw + merge(m%t2, 0.0_wp, lips))
      case ("I")
        m%h = m%h - 0.5_wp*(m%t + m%t2)
      case ("T")
        m%h = m%h - 0.5_wp*m%t
      case ("L")
        m%h = m%h - 0.5_wp*m%t2
        m%b = m%b - 0.5_wp*m%t
      case ("HAT")
        m%h = m%h - m%t
        m%b = m%b - m%t
        m%c = m%c - 0.5_wp*m%t
      case ("BOX")
        m%h = m%h - m%t
        m%b = m%b - m%tw
      case ("TUBE")
        m%d = m%d - m%t
      case default  ! RECT, CIRC: no walls
      end select
    end if
    call check_midline(shape, m, error)
  end subroutine find_midline

  !> Something is left of the sizes, within a cell too.
  subroutine check_midline(shape, m, error)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: m
    type(error_t), allocatable, intent(out) :: error
    character(len=:), allocatable :: name
    real(wp) :: edge

    edge = 0.0_wp
    if (m%lip > 0.0_wp .and. .not. m%midline) edge = 0.5_wp*max(m%t, m%t2)
    name = ""
    if (too_small(m%h, merge(m%t, 0.0_wp, shape == "BOX"))) name = "H"
    if (too_small(m%b, merge(m%tw, 0.0_wp, shape == "BOX"))) name = "B"
    if (too_small(m%b2, 0.0_wp) .and. name == "") name = "B2"
    if (too_small(m%c, 0.0_wp)) name = "C"
    if (too_small(m%d, merge(m%t, 0.0_wp, shape == "TUBE"))) name = "D"
    if (too_small(m%lip, edge)) name = "LIP"
    if (name == "") return
    call fail(error, exit_deck, name//" is too small for the thickness of the walls")

  contains

    pure function too_small(size, least)
      real(wp), intent(in) :: size, least
      logical :: too_small

      too_small = size > not_given .and. size <= least
    end function too_small

  end subroutine check_midline

  !> A shape of plates from the sizes of its midline.
  subroutine open_shape(shape, m, constants, geometry, error)
    character(len=*), intent(in) :: shape
    type(shape_dimensions_t), intent(in) :: m
    type(section_constants_t), intent(out) :: constants
    type(section_geometry_t), intent(out) :: geometry
    type(error_t), allocatable, intent(out) :: error
    type(plate_fault_t) :: fault
    real(wp), allocatable :: points(:), thickness(:)
    integer, allocatable :: plates(:)

    select case (shape)
    case ("C")
      call draw_channel(m, 1.0_wp, points, plates, thickness)
    case ("Z")
      call draw_channel(m, -1.0_wp, points, plates, thickness)
    case ("I")
      points = [-0.5_wp*m%b, m%h, 0.0_wp, m%h, 0.5_wp*m%b, m%h, &
                -0.5_wp*m%b2, 0.0_wp, 0.0_wp, 0.0_wp, 0.5_wp*m%b2, 0.0_wp]
      plates = [1, 2, 2, 3, 2, 5, 4, 5, 5, 6]
      thickness = [m%t, m%t, m%tw, m%t2, m%t2]
    case ("T")
      points = [-0.5_wp*m%b, m%h, 0.0_wp, m%h, 0.5_wp*m%b, m%h, 0.0_wp, 0.0_wp]
      plates = [1, 2, 2, 3, 2, 4]
      thickness = [m%t, m%t, m%tw]
    case ("L")
      points = [0.0_wp, m%h, 0.0_wp, 0.0_wp, m%b, 0.0_wp]
      plates = [1, 2, 2, 3]
      thickness = [m%t, m%t2]
    case default  ! HAT
      points = [-0.5_wp*m%b - m%c, 0.0_wp, -0.5_wp*m%b, 0.0_wp, -0.5_wp*m%b, m%h, &
                0.5_wp*m%b, m%h, 0.5_wp*m%b, 0.0_wp, 0.5_wp*m%b + m%c, 0.0_wp]
      plates = [1, 2, 2, 3, 3, 4, 4, 5, 5, 6]
      thickness = [m%t, m%t, m%t, m%t, m%t]
    end select
    call plates_section(reshape(points, [2, size(points)/2]), &
                        reshape(plates, [2, size(thickness)]), thickness, &
                        constants, geometry, fault, error)
    if (allocated(error)) error%message = "the lips of this "//shape//" meet"
    geometry%origin_at_centroid = .true.
  end subroutine open_shape

  !> C, or with `upper = -1` Z.
  pure subroutine draw_channel(m, upper, points, plates, thickness)
    type(shape_dimensions_t), intent(in) :: m
    real(wp), intent(in) :: upper  !< where the upper flange runs: 1 to +y, -1 to -y
    real(wp), allocatable, intent(out) :: points(:), thickness(:)
    integer, allocatable, intent(out) :: plates(:)
    real(wp) :: lip(2)

    points = [upper*m%b, m%h, 0.0_wp, m%h, 0.0_wp, 0.0_wp, m%b2, 0.0_wp]
    plates = [1, 2, 2, 3, 3, 4]
    thickness = [m%t, m%tw, m%t2]
    if (.not. m%lip > 0.0_wp) return
    lip = m%lip - merge(0.0_wp, 0.5_wp, m%midline)*[m%t, m%t2]
    points = [points, upper*m%b, m%h - lip(1), m%b2, lip(2)]
    plates = [plates, 1, 5, 4, 6]
    thickness = [thickness, m%t, m%t2]
  end subroutine draw_channel

end module section_shapes
