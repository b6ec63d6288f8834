!> The part of the keyword table about elements, their modes, motions and masses.
module deck_element_keywords
  use deck_handler, only: keyword_t
  use deck_element_cards, only: read_beamw, read_beam, read_dyne, read_rlse, read_estiff, read_em, &
                                read_edamp, read_esig
  use deck_joint_cards, only: read_truss, read_hinge, read_universal, read_spherical, &
                              read_cylindrical, read_prismatic, read_gear, read_slider, &
                              read_carriage
  use deck_motion_cards, only: read_inputx, read_inpute, read_delinpx, read_delinpe, read_startx, &
                               read_startdx, read_startde, read_xm
  implicit none
  private

  public :: beam_keywords, joint_keywords, mode_keywords, motion_keywords

contains

  function beam_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: options = "SECTION name:word | MATERIAL name:word | "// &
      "SECOND order:CONSISTENT/JONKER/NONE=CONSISTENT | SHEAR state:ON/OFF=ON | "// &
      "MASS kind:CONSISTENT/LUMPED/NONE=CONSISTENT | ROTARY state:ON/OFF=ON | "// &
      "DIVIDE parts:count=1 | RIGID"
    character(len=*), parameter :: parts = "NODE 1 0 0 0|NODE 2 900 0 0|"// &
      "MATERIAL steel E 21000 NU 0.3|SECTION tube CONSTANTS A 10 IY 80 IZ 90 IT 170|"

    table = [ &
      keyword_t("BEAMW", "model", &
        "id:id p:node q:node | id:id p:node q:node ox:1 oy:1 oz:1 | "// &
        "id:id Xp:node Rp:node Wp:node Xq:node Rq:node Wq:node | "// &
        "id:id Xp:node Rp:node Wp:node Xq:node Rq:node Wq:node ox:1 oy:1 oz:1", options, &
        "is a beam with warping between nodes p and q; o is the direction of the section's y "// &
        "axis. With SECTION and MATERIAL all eight modes are flexible, without SECTION none is."// &
        " DIVIDE n makes parts id.1 to id.n and inner nodes id.1 to id.(n-1)", &
        parts//"BEAMW 1 1 2 0 1 0 SECTION tube MATERIAL steel DIVIDE 10", "BEAMW", read_beamw), &
      keyword_t("BEAM", "model", &
        "id:id p:node q:node | id:id p:node q:node ox:1 oy:1 oz:1 | "// &
        "id:id Xp:node Rp:node Xq:node Rq:node | "// &
        "id:id Xp:node Rp:node Xq:node Rq:node ox:1 oy:1 oz:1", options, &
        "is a beam without warping: BEAMW with modes 1 to 6 and Saint-Venant torsion", &
        parts//"BEAM 1 1 2 0 1 0 SECTION tube MATERIAL steel DIVIDE 10", "BEAM", read_beam)]
  end function beam_keywords

  function joint_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("TRUSS", "model", "id:id p:node q:node", &
        "SECTION name:word | MATERIAL name:word | MASS kind:CONSISTENT/LUMPED/NONE=CONSISTENT", &
        "is a bar between two translational nodes with one mode, its elongation. It is "// &
        "flexible with SECTION and MATERIAL, or by DYNE with ESTIFF (EA) and EDAMP: a spring, "// &
        "a damper", &
        "TRUSS 51 1 3|DYNE 51 1|ESTIFF 51 2000|TRUSS 52 2 4 SECTION sec MATERIAL mat", "TRUSS", &
        read_truss), &
      keyword_t("HINGE", "model", "id:id Rp:node Rq:node ax:1 ay:1 az:1", "", &
        "joins two rotational nodes by an axis a, a global direction at the start. Mode 1 is "// &
        "the angle about it, which turns on through full turns; modes 2 and 3 tilt the axis. "// &
        "All are fixed unless DYNE, RLSE or INPUTE say otherwise", &
        "HINGE 51 2 52 0 0 1|RLSE 51 1|BEAM 52 2 52 3 3", "HINGE", read_hinge), &
      keyword_t("UNIVERSAL", "model", "id:id Rp:node Rq:node ax:1 ay:1 az:1 bx:1 by:1 bz:1", "", &
        "is a universal joint between two rotational nodes, with axis a in p and b, "// &
        "perpendicular to it, in q; modes 1 and 2, the angles about them, are released, mode 3 "// &
        "is fixed", &
        "UNIVERSAL 51 2 52 0 1 0 0 0 1|BEAM 52 2 52 3 3", "", read_universal), &
      keyword_t("SPHERICAL", "model", "id:id p:node q:node", "", &
        "keeps two translational nodes together and leaves rotations free: its three modes are "// &
        "the differences of X, Y, Z. Elements with a common translational node need none", &
        "NODE 51 20 0 0|NODE 52 20 10 0|SPHERICAL 51 2 51|BEAM 52 51 52|FIX 52 RX", "", &
        read_spherical), &
      keyword_t("CYLINDRICAL", "model", "id:id p:node q:node ax:1 ay:1 az:1", "", &
        "joins translation and rotation of two nodes so that q slides along and turns about an "// &
        "axis a of p; modes 1 and 2, slide and angle, are released, modes 3 to 6 are fixed", &
        "NODE 51 20 0 0|NODE 52 20 10 0|CYLINDRICAL 51 2 51 1 0 0|BEAM 52 51 52", "", &
        read_cylindrical), &
      keyword_t("PRISMATIC", "model", "id:id p:node q:node ax:1 ay:1 az:1", "", &
        "joins translation and rotation of two nodes so that q slides along an axis a of p; "// &
        "mode 1, the slide, is released, modes 2 to 6 are fixed", &
        "NODE 51 20 0 0|NODE 52 20 10 0|PRISMATIC 51 2 51 1 0 0|DYNE 51 1|ESTIFF 51 300|"// &
        "BEAM 52 51 52", "", read_prismatic), &
      keyword_t("GEAR", "model", "id:id hinge1:element hinge2:element ratio:1", "", &
        "makes the angle of one HINGE the ratio times that of another: its mode is the angle "// &
        "of hinge2 less ratio times the angle of hinge1", &
        "HINGE 51 2 52 0 0 1|HINGE 52 2 53 0 0 1|RLSE 51:52 1|GEAR 53 51 52 -0.5", "", read_gear), &
      keyword_t("SLIDER", "model", "id:id node:node", "ALONG elements:elements!", &
        "lets a node run along the centroid line of beams, bent as it is: of one, divided or "// &
        "not, or of several that follow each other. Mode 1, the way along it, is released, "// &
        "modes 2 and 3, the distances from it along the section's y and z, are fixed. The "// &
        "node's rotation is free", &
        "NODE 51 10 0 0|SLIDER 51 51 ALONG 1|XM 51 2|INPUTE 51 1 5", "", read_slider), &
      keyword_t("CARRIAGE", "model", "id:id node:node", "ALONG elements:elements!", &
        "is a SLIDER that keeps to the direction of the line as well: modes 4, the turn about "// &
        "it, 5 and 6, the tilts, are fixed too", &
        "NODE 51 10 0 0|NODE 52 10 5 0|CARRIAGE 51 51 ALONG 1|INPUTE 51 1 5|BEAM 52 51 52", &
        "", read_carriage)]
  end function joint_keywords

  !> What cards say about the modes of elements.
  function mode_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("DYNE", "model", "elements:elements mode:mode+", "", &
        "makes modes flexible; of a beam with SECTION, these only. Modes 7 and 8 follow mode 2", &
        "DYNE 1:3 2 3 4", "DYNE", read_dyne), &
      keyword_t("RLSE", "model", "elements:elements mode:mode+", "", &
        "releases modes: they deform without stress. Modes 3, 5, 7 of a beam are at end p, 4, "// &
        "6, 8 at q", "RLSE 2 4 6", "RLSE", read_rlse), &
      keyword_t("ESTIFF", "model", "elements:elements EA:F GIt:F*L^2 EIy:F*L^2 EIz:F*L^2 "// &
        "cy:L^2 cz:L^2 EIw:F*L^4 | elements:elements EA:F GIt:F*L^2 EIy:F*L^2 EIz:F*L^2 "// &
        "cy:L^2? cz:L^2? | elements:elements EA:F | elements:elements s1:F*L s2:F*L? s3:F*L? "// &
        "s4:F*L? s5:F*L? s6:F*L?", "", &
        "gives stiffness to an element without SECTION, for the modes that DYNE makes "// &
        "flexible: 7 values for a BEAMW, 4 to 6 for a BEAM, EA for a TRUSS, one for each mode "// &
        "of a joint [F L; of a slide F L^-1]. cy = EIy/(G A k), likewise cz; without them a "// &
        "BEAM is rigid in shear", &
        "ESTIFF 1 2e6 4e5 3e5 2e5 0.1 0.2 5e4", "ESTIFF", read_estiff), &
      keyword_t("EM", "model", "elements:elements rhoA:M*L^-1 rhoIp:M*L rhoIy:M*L rhoIz:M*L "// &
        "rhoIyz:M*L rhoIw:M*L^3 | elements:elements rhoA:M*L^-1 rhoIp:M*L rhoIy:M*L rhoIz:M*L "// &
        "rhoIyz:M*L? | elements:elements rhoA:M*L^-1", "", &
        "gives mass to an element without SECTION: 6 values for a BEAMW, 4 or 5 for a BEAM, "// &
        "rhoA for a TRUSS", "EM 1 7.85 0.2 0.15 0.05 0 0.01", "EM", read_em), &
      keyword_t("EDAMP", "model", "elements:elements EA:F*T GIt:F*L^2*T EIy:F*L^2*T "// &
        "EIz:F*L^2*T EIw:F*L^4*T? | elements:elements EA:F*T | elements:elements d1:F*L*T "// &
        "d2:F*L*T? d3:F*L*T? d4:F*L*T? d5:F*L*T? d6:F*L*T?", "", &
        "gives viscous damping, like ESTIFF per rate of strain, besides that of the MATERIAL: "// &
        "4 values for a beam, a fifth for the warping of a BEAMW, EA for a TRUSS, one for each "// &
        "mode of a joint", "EDAMP 1 200 40 30 20", "EDAMP", read_edamp), &
      keyword_t("ESIG", "model", "elements:elements stress:F stress2:F? stress3:F? stress4:F? "// &
        "stress5:F? stress6:F? stress7:F? stress8:F?", "", &
        "gives stress resultants that an element has where its strains are zero, in the order "// &
        "of the modes; those left out are 0", "ESIG 1 -50", "ESIG", read_esig), &
      keyword_t("XM", "model", "nodes:nodes m:M | nodes:nodes Ixx:M*L^2 Ixy:M*L^2 Ixz:M*L^2 "// &
        "Iyy:M*L^2 Iyz:M*L^2 Izz:M*L^2 | nodes:nodes m:M Ixx:M*L^2 Ixy:M*L^2 Ixz:M*L^2 "// &
        "Iyy:M*L^2 Iyz:M*L^2 Izz:M*L^2", "", &
        "gives mass, inertias or both to nodes; inertias are entries of the matrix about the "// &
        "node, in global axes at the start, and turn with it. Several cards of a node add up", &
        "XM 2 5|XM 3 5 0.2 0 0 0.2 0 0.3", "XM", read_xm)]
  end function mode_keywords

  !> Prescribed motion, and what a motion in time starts from.
  function motion_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: coordinate = "nodes:nodes component:component value:1 "// &
      "velocity:T^-1? acceleration:T^-2?"
    character(len=*), parameter :: strain = "elements:elements mode:mode value:1 "// &
      "velocity:T^-1? acceleration:T^-2?"

    table = [ &
      keyword_t("INPUTX", "load", coordinate//" | nodes:nodes component:component*", &
        "FUNCTION name:word", &
        "prescribes a coordinate of a node: X Y Z are its position, RX RY RZ angles [rad] (all "// &
        "three: the rotation vector; one alone: less than pi), W the rate of twist, SPACAR's "// &
        "numbers 2 3 4 of a rotational node its Euler parameters. STATIC goes there from where "// &
        "it stands; in time velocity t + acceleration t^2/2 is added. With FUNCTION f it goes "// &
        "to the initial coordinate + value f. Without values, before HALT: the coordinate is "// &
        "prescribed", "INPUTX 2 Z 12.5|INPUTX 3 RX {pi/6} FUNCTION wave", "INPUTX", &
        read_inputx), &
      keyword_t("INPUTE", "load", strain//" | elements:elements mode:mode+", &
        "FUNCTION name:word", &
        "prescribes a strain of an element, as INPUTX a coordinate: an elongation, the angle "// &
        "of a HINGE. Mode 7 or 8 is prescribed as INPUTX node W", &
        "HINGE 51 2 52 0 0 1|INPUTE 51 1 {4*pi}|BEAM 52 2 52 3 3", "INPUTE", read_inpute), &
      keyword_t("DELINPX", "load", coordinate, "FUNCTION name:word", &
        "adds value to a coordinate after an implied STATIC that applies what comes before, as "// &
        "DELXF adds a load", "XF 2 0 0 -1|DELINPX 3 Z 0.5", "DELINPX", read_delinpx), &
      keyword_t("DELINPE", "load", strain, "FUNCTION name:word", &
        "adds value to a strain after an implied STATIC that applies what comes before", &
        "INPUTE 1 1 0.1|DELINPE 1 1 0.05", "DELINPE", read_delinpe), &
      keyword_t("STARTX", "model", "nodes:nodes component:component value:1", "", &
        "gives a coordinate of a node at the start of a motion in time: X Y Z its position, RX "// &
        "RY RZ angles", "STARTX 2 Z 0.5", "STARTX", read_startx), &
      keyword_t("STARTDX", "model", "nodes:nodes component:component rate:T^-1", "", &
        "gives a velocity of a node at the start of a motion in time; RX RY RZ are the "// &
        "components of its angular velocity. What is not given moves with the least kinetic "// &
        "energy. KINEMATIC and INVERSE use it to leave a singular position", "STARTDX 2 Z -3", &
        "STARTDX", read_startdx), &
      keyword_t("STARTDE", "model", "elements:elements mode:mode rate:T^-1", "", &
        "gives the rate of a strain at the start of a motion in time", "STARTDE 3 2 0.1", &
        "STARTDE", read_startde)]
  end function motion_keywords

end module deck_element_keywords
