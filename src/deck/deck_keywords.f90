!> The keyword table: what the reader, `spar keywords` and the manual know of a keyword.
module deck_keywords
  use deck_handler, only: keyword_t
  use deck_model_cards, only: read_title, read_set, read_include, read_nothing, &
                              read_visualization, read_outlevel, read_node, read_material, &
                              read_group_nodes, read_group_elements, read_halt
  use deck_section_cards, only: read_constants, read_shape, read_plates, read_point, read_plate, &
                                shape_options
  use section_shapes, only: shape_rules
  use deck_function_cards, only: read_ramp, read_sine, read_step, read_table, &
                                 read_spline, read_formula
  use deck_element_keywords, only: beam_keywords, joint_keywords, mode_keywords, motion_keywords
  use deck_load_cards, only: read_fix, read_marker, read_xf, read_delxf, read_gravity, &
                             read_rotation, read_stationary, &
                             read_static, read_buckling, read_eigen, read_iterstep
  use deck_targets, only: read_imperfection
  use deck_time_keywords, only: time_keywords, output_keywords, spacar_keywords
  implicit none
  private

  public :: keywords

contains

  !> All keywords, in the order of the manual; variants of one keyword stand together.
  function keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [form_keywords(), model_keywords(), shape_keywords(), drawing_keywords(), &
             beam_keywords(), joint_keywords(), mode_keywords(), name_keywords(), &
             function_keywords(), load_keywords(), motion_keywords(), analysis_keywords(), &
             time_keywords(), output_keywords(), spacar_keywords()]
  end function keywords

  !> What concerns the deck itself.
  function form_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("TITLE", "form", "text:text+", "", &
        "names the model in the result file", &
        "TITLE ""Channel cantilever""", "", read_title), &
      keyword_t("SET", "form", "name:word value:text", "", &
        "defines a name for expressions, a number or a word; once, and `-D name=value` "// &
        "replaces the value", &
        "SET L 900|NODE 2 {L/2} 0 0", "", read_set), &
      keyword_t("INCLUDE", "form", "file:text", "", &
        "reads another file here; its path counts from the folder of the file with this card", &
        "INCLUDE ""sections.deck""", "", read_include), &
      keyword_t("END", "form", "", "", "separates parts of a deck, without meaning", &
        "END", "END", read_nothing), &
      keyword_t("HALT", "form", "", "", "ends the first part of a deck in SPACAR's form: "// &
        "INPUTX and INPUTE before it name what is prescribed, behind it they give values", &
        "HALT", "HALT", read_halt), &
      keyword_t("VISUALIZATION", "form", "text:text*", "", &
        "ends the deck: nothing behind it is read", "VISUALIZATION", "VISUALIZATION", &
          read_visualization), &
      keyword_t("OUTLEVEL", "form", "level:text*", "", "is ignored, with a note", &
        "OUTLEVEL 0 1", "OUTLEVEL", read_outlevel)]
  end function form_keywords

  !> Nodes, materials, sections by constants.
  function model_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("NODE", "model", "id:id x:L y:L z:L", "", &
        "places a node; a range as id repeats the card with `i` = the id", &
        "NODE 1 0 0 0|NODE 2:9 {100*(i-1)} 0 0", "X", read_node), &
      keyword_t("X", "model", "id:id x:L y:L z:L", "", "is NODE in SPACAR's words", &
        "X 1 0 0 0", "X", read_node), &
      keyword_t("MATERIAL", "model", "name:word", &
        "E e:F*L^-2! | G g:F*L^-2 | NU nu:1 | RHO rho:M*L^-3=0 | DAMPING beta:T=0", &
        "gives Young's modulus, the shear modulus or Poisson's ratio, density and "// &
        "stiffness-proportional damping", &
        "MATERIAL steel E 21000 NU 0.3 RHO 7.85e-8", "", read_material), &
      keyword_t("SECTION", "model", "name:word CONSTANTS", &
        "A a:L^2! | IY iy:L^4! | IZ iz:L^4! | IT it:L^4! | IW iw:L^6=0 | YS ys:L=0 | "// &
        "ZS zs:L=0 | DY dy:L^2 | DZ dz:L^2 | DW dw:L^4 | DYZ dyz:L^2=0 | DYW dyw:L^3=0 | DZW "// &
        "dzw:L^3=0 | "// &
        "BY by:L=0 | BZ bz:L=0 | BW bw:1=0 | IR ir:L^6=0", &
        "gives a section by its constants about the principal axes through the centroid: area, "// &
        "second moments, torsion and warping constants, shear centre, shear rigidities over G "// &
        "(rigid where DY, DZ or DW is not given), Wagner constants. `spar section` prints "// &
        "those of a shape or a drawing", &
        "SECTION tube CONSTANTS A 10 IY 80 IZ 90 IT 170|SECTION c CONSTANTS A 58.8 IY 8038.7 "// &
        "IZ 559.9 IT 35.4 IW 78943 YS -6.08 &| DY 13.4 DZ 26.8 DW 4339 DZW 59.4 BZ 31.6", &
        "", read_constants)]
  end function model_keywords

  !> Sections by name: a row for each shape, its options those of the shape's rule.
  function shape_keywords() result(table)
    type(keyword_t) :: table(size(shape_rules))
    character(len=*), parameter :: faces = ". OUTER (default): sizes over the faces; MIDLINE: "// &
      "between the midlines of the walls"
    character(len=*), parameter :: shear = ". Its shear coefficients are for Poisson's ratio "// &
      "of the material it is used with (of several: the first; of none: 0.3)"
    character(len=*), parameter :: help(size(shape_rules)) = [character(len=400) :: &
      "is a channel: height H along z, flanges B, T (upper) and B2, T2 (lower) towards +y, web "// &
      "TW at the left, lips LIP turned inwards. Points: 1 upper tip, 2 3 corners, 4 lower tip, "// &
      "5 6 ends of the lips"//faces, &
      "is an I: height H along z, flanges B, T (upper) and B2, T2 (lower), web TW. Points: "// &
      "1 2 3 upper flange from -y to +y, 4 5 6 lower flange"//faces, &
      "is a tee: height H along z, flange B, T above, web TW. Points: 1 2 3 flange from -y to "// &
      "+y, 4 tip of the web"//faces, &
      "is an angle: upright leg H, T at the left, lower leg B, T2 towards +y. Points: 1 upper "// &
      "tip, 2 corner, 3 tip of the lower leg"//faces, &
      "is a zed: height H along z, web TW, upper flange B, T towards -y, lower flange B2, T2 "// &
      "towards +y, lips LIP turned inwards. Points as of C"//faces, &
      "is a hat: height H along z, top B, brims C at both sides, T thick. Points 1 to 6 along "// &
      "the midline from -y to +y"//faces//"; C counts from the inner face of the web", &
      "is a solid rectangle, H along z, B along y. Points: its corners from +y, +z, "// &
      "counter-clockwise"//shear, &
      "is a rectangular box: H, webs TW along z, B, flanges T along y. Points: its corners "// &
      "from +y, +z, counter-clockwise"//faces//shear, &
      "is a solid circle of diameter D. Points: +y, +z, -y, -z on its face"//shear, &
      "is a round tube of diameter D. Points: +y, +z, -y, -z on its face"//faces//shear]
    character(len=*), parameter :: example(size(shape_rules)) = [character(len=80) :: &
      "C H 30 B 10 T 1.6 TW 1|SECTION lipped C H 20 B 7.5 T 0.2 TW 0.2 LIP 2", &
      "I H 30 B 15 T 1.07 TW 0.71|SECTION girder I H 80 B 30 T 2 TW 1 B2 20 T2 1.5", &
      "T H 10 B 10 T 1 TW 0.8", "L H 10 B 8 T 1", "Z H 20 B 7 T 0.2 TW 0.2 LIP 1.5", &
      "HAT H 5 B 8 T 0.15 C 2.5", "RECT H 20 B 10", "BOX H 20 B 10 T 0.8 TW 0.5", "CIRC D 5", &
      "TUBE D 10 T 0.5"]
    integer :: i

    do i = 1, size(table)
      associate (rule => shape_rules(i))
        table(i) = keyword_t("SECTION", "model", "name:word "//trim(rule%name), &
                             shape_options(rule), trim(help(i)), "SECTION s "//example(i), "", &
                             read_shape)
      end associate
    end do
  end function shape_keywords

  !> Sections drawn point by point.
  function drawing_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: angle = "SECTION angle PLATES|POINT 1 0 8|POINT 2 0 0|"// &
      "POINT 3 5 0|PLATE 1 2 0.6|PLATE 2 3 0.8"

    table = [ &
      keyword_t("SECTION", "model", "name:word PLATES", "", &
        "is drawn by the POINT and PLATE cards behind it: any open, tree-shaped midline of "// &
        "straight walls. Centroid and principal axes are found; AT counts from the drawing's "// &
        "origin", angle, "", read_plates), &
      keyword_t("POINT", "model", "n:id y:L z:L", "", &
        "is a point of the drawing of the last SECTION name PLATES", angle, "", read_point), &
      keyword_t("PLATE", "model", "i:id j:count t:L", "", &
        "is a wall of thickness t between points i and j of the last SECTION name PLATES; a "// &
        "range as i repeats the card", &
        "SECTION arc PLATES|POINT 1:9 {5*sin((i-5)*pi/10)} {5*cos((i-5)*pi/10)}|"// &
        "PLATE 1:8 {i+1} 0.2", "", read_plate)]
  end function drawing_keywords

  !> Groups and markers.
  function name_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("GROUP", "load", "name:word NODES list:text+", "", &
        "names a list of nodes; a list is an id, a:b, a:b:s, ALL or a group", &
        "GROUP tip NODES 4 11:15 20:30:2", "", read_group_nodes), &
      keyword_t("GROUP", "load", "name:word ELEMENTS list:text+", "", &
        "names a list of elements", "GROUP legs ELEMENTS 1 4:6 7.2", "", read_group_elements), &
      keyword_t("MARKER", "model", "name:word node:node", &
        "AT oy:place oz:L! | OF element:element", &
        "names a point fixed to a section at a node, at (oy, oz) or AT POINT k of the section; "// &
        "OF says whose section where several meet", &
        "MARKER corner 2 AT -2.456 14.2", "", read_marker)]
  end function name_keywords

  !> Functions of the load factor.
  function function_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("FUNCTION", "load", "name:word RAMP s0:1 s1:1", "", &
        "rises from 0 at s0 to 1 at s1; s is the load factor in STATIC, else time. A motion in "// &
        "time that it drives starts and stops at once, by blows", &
        "FUNCTION lift RAMP 0 0.5", "", read_ramp), &
      keyword_t("FUNCTION", "load", "name:word SINE amplitude:1 cycles:1 phase:1?", "", &
        "is amplitude sin(2 pi cycles s + phase)", &
        "FUNCTION wave SINE 1 3 0.5", "", read_sine), &
      keyword_t("FUNCTION", "load", "name:word STEP s0:1", "", &
        "is 0 before s0 and 1 from s0 on", "FUNCTION drop STEP 0.4", "", read_step), &
      keyword_t("FUNCTION", "load", "name:word TABLE s:1 v:1+", "", &
        "runs straight between pairs of s and value, is constant outside and jumps where an s "// &
        "comes twice", &
        "FUNCTION path TABLE 0 0  0.5 1  0.5 0.8  1 0.2", "", read_table), &
      keyword_t("FUNCTION", "load", "name:word SPLINE s:1 v:1+", "", &
        "runs smoothly through pairs of s and value, a cubic spline, and is constant outside: "// &
        "for measured motions, whose accelerations a TABLE has only as blows at its points", &
        "FUNCTION path SPLINE 0 0  0.3 0.2  0.6 0.8  1 1", "", read_spline), &
      keyword_t("FUNCTION", "load", "name:word EXPR expression:text", "", &
        "is an expression in t, which stands for s. TRANSIENT does not look for its kinks: for "// &
        "a motion with such, use RAMP or TABLE", &
        "FUNCTION soft EXPR {t^2*(3-2*t)}", "", read_formula)]
  end function function_keywords

  !> Supports and loads.
  function load_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: load_options = &
      "FUNCTION name:word | AT oy:place oz:L | OF element:element | FOLLOWER"

    table = [ &
      keyword_t("FIX", "model", "nodes:nodes component:component*", "", &
        "holds coordinates: X Y Z RX RY RZ W, none: all that exist, warping included. SPACAR's "// &
        "numbers count within a kind (translational 1-3, rotational 2-4, warping 1)", &
        "FIX 1|FIX 2:4 Y RX RZ", "FIX", read_fix), &
      keyword_t("XF", "load", "nodes:nodes B:F*L^2 | nodes:nodes Fx:F Fy:F Fz:F | "// &
        "nodes:nodes Fx:F Fy:F Fz:F Mx:F*L My:F*L Mz:F*L | "// &
        "nodes:nodes Fx:F Fy:F Fz:F Mx:F*L My:F*L Mz:F*L B:F*L^2", load_options, &
        "is a dead load: a force (a moment on a node that is only rotational), force and "// &
        "moment, these and a bimoment, or a bimoment (node that is only warping); at the node, "// &
        "AT a point of the section or at a marker; FUNCTION replaces the load factor, FOLLOWER "// &
        "turns force and moment with the node", &
        "XF 2 0 0 -6|XF 3 0 0 -1 AT -2.456 14.2|XF 4 0 0 0 5 0 0 FUNCTION wave|"// &
        "XF 5 0 -3 0 FOLLOWER", &
        "XF", read_xf), &
      keyword_t("DELXF", "load", "nodes:nodes B:F*L^2 | nodes:nodes Fx:F Fy:F Fz:F | "// &
        "nodes:nodes Fx:F Fy:F Fz:F Mx:F*L My:F*L Mz:F*L | "// &
        "nodes:nodes Fx:F Fy:F Fz:F Mx:F*L My:F*L Mz:F*L B:F*L^2", load_options, &
        "is XF after an implied STATIC that applies the XF loads first", &
        "XF 2 10 0 0|DELXF 2 0 0 -1", "DELXF", read_delxf), &
      keyword_t("GRAVITY", "load", "gx:L*T^-2 gy:L*T^-2 gz:L*T^-2", "", &
        "is an acceleration of gravity that acts on all mass", &
        "GRAVITY 0 0 -981", "", read_gravity), &
      keyword_t("ROTATION", "load", "w:T^-1 ax:1 ay:1 az:1 | "// &
        "w:T^-1 ax:1 ay:1 az:1 ox:L oy:L oz:L", "", &
        "turns the model steadily with the rate w about an axis, through the origin or a "// &
        "point: STATIONARY ramps w, and what follows is about the turning model. Coordinates, "// &
        "loads and supports are those of the frame that turns with it; later cards, about the "// &
        "same axis, add to w", &
        "ROTATION 0.001 0 0 1|STATIONARY", "", read_rotation)]
  end function load_keywords

  function analysis_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: static_options = "STEPS n:count=10 | TO factor:1=1 | "// &
        "CONTROL | LOAD | ARC | DISPLACEMENT node:nodes component:component value:1 | "// &
        "INITIAL factor:1 | MAXSTEPS n:count=200 | "// &
        "STOP node:nodes component:component value:1 | TOL tolerance:1=1e-7 | "// &
        "MAXITER n:count=30 | STABILITY kind:OFF/ON/REQUIRED=OFF | NAME name:word | "// &
        "BRANCH switch:OFF/ON=OFF | COMPLIANCE nodes:nodes"

    table = [ &
      keyword_t("STATIC", "analysis", "", static_options, &
        "ramps the loads given since the last analysis. CONTROL LOAD (default): equal steps of "// &
        "the load factor to TO; CONTROL DISPLACEMENT: equal steps of a displacement of a node "// &
        "or marker to a value; CONTROL ARC: along the path, past limit points, to TO (1 unless "// &
        "given) or STOP, whichever comes first. STABILITY ON counts unstable modes and "// &
        "locates critical points, REQUIRED ends where stability is lost, OFF only warns if the "// &
        "path ends in an unstable equilibrium; BRANCH ON switches to the "// &
        "secondary branch at the first bifurcation; COMPLIANCE finds that of nodes at each step", &
        "STATIC STEPS 12 NAME lift", "mode 10", read_static), &
      keyword_t("STATIONARY", "analysis", "", static_options, &
        "finds the equilibrium of a model that turns steadily, in the frame that turns too: "// &
        "STATIC with the centrifugal forces of ROTATION, whose rate grows with the load factor", &
        "ROTATION 0.001 0 0 1|STATIONARY", "", read_stationary), &
      keyword_t("BUCKLING", "analysis", "", "MODES n:count=10 | NAME name:word", &
        "finds the multipliers of the loads given since the last STATIC, or of those it "// &
        "applied, at which the state becomes unstable: n nearest zero of each sign", &
        "XF 2 -1 0 0|BUCKLING MODES 2", "mode 8", read_buckling), &
      keyword_t("IMPERFECTION", "load", "mode:count scale:L", "", &
        "adds a mode of the last BUCKLING, by its row in the table of multipliers and with "// &
        "this largest displacement, to the undeformed shape; the next analysis starts from there", &
        "XF 2 -1 0 0|BUCKLING MODES 2|IMPERFECTION 1 0.01|STATIC", "", read_imperfection), &
      keyword_t("EIGEN", "analysis", "", "MODES n:count=10 | NAME name:word | DAMPED | "// &
        "MATRICES state:OFF/ON=OFF", &
        "finds the n lowest natural frequencies about the present state; complex ones, with "// &
        "damping ratios and unstable motions, of a model that turns (ROTATION) or that has "// &
        "follower loads, and with DAMPED, which counts what DAMP, EDAMP and MATERIAL DAMPING "// &
        "say. MATRICES ON keeps the matrices in the result file", &
        "EIGEN MODES 6", "mode 7", read_eigen), &
      keyword_t("ITERSTEP", "analysis", &
        "iterations:count n:count? tolerance:1? -:text? -:text? m:count?", "", &
        "sets the defaults of STATIC: iterations and tolerance, m steps for the XF loads and n "// &
        "for the DELXF loads", &
        "ITERSTEP 20 10 1e-7 0 0 5", "ITERSTEP", read_iterstep)]
  end function analysis_keywords

end module deck_keywords
