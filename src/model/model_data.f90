!> The mechanical model that a deck describes: plain data, in the units of the deck.
!>
!> Entities refer to each other by index. A place that is kept is that of the card that made the
!> entity.
module model_data
  use kinds, only: wp
  use diagnostics, only: place_t
  use formula, only: formula_t
  use section_data, only: section_constants_t, section_geometry_t
  use section_shapes, only: shape_dimensions_t
  implicit none
  private

  public :: model_t, node_t, material_t, section_t, member_t, load_t, pattern_t, marker_t
  public :: function_t, analysis_t, setting_t, target_t, imperfection_t
  public :: joint_t, mass_t, motion_t, start_t, rotation_t

  !> Kinds of nodes; an id names up to one of each.
  integer, parameter, public :: translational = 1, rotational = 2, warping = 3

  !> Status of a generalized strain.
  integer, parameter, public :: mode_fixed = 0, mode_flexible = 1, mode_released = 2, &
                                mode_prescribed = 3

  !> Types of beams; a BEAM has six modes and no warping.
  integer, parameter, public :: type_beamw = 1, type_beam = 2

  !> Types of joints: all elements that are not beams.
  integer, parameter, public :: joint_truss = 1, joint_hinge = 2, joint_universal = 3, &
                                joint_spherical = 4, joint_cylindrical = 5, joint_prismatic = 6, &
                                joint_gear = 7, joint_slider = 8, joint_carriage = 9
  character(len=11), parameter, public :: joint_names(9) = &
    ["TRUSS      ", "HINGE      ", "UNIVERSAL  ", "SPHERICAL  ", "CYLINDRICAL", "PRISMATIC  ", &
     "GEAR       ", "SLIDER     ", "CARRIAGE   "]
  integer, parameter, public :: joint_modes(9) = [1, 3, 3, 3, 6, 6, 1, 3, 6]  !< of strains

  !> Options of a beam.
  integer, parameter, public :: second_none = 0, second_jonker = 1, second_consistent = 2
  integer, parameter, public :: mass_none = 0, mass_lumped = 1, mass_consistent = 2

  !> Kinds of functions of the load factor (or time).
  integer, parameter, public :: function_ramp = 1, function_sine = 2, function_step = 3, &
                                function_table = 4, function_formula = 5, &
                                function_spline = 6

  !> Kinds of analyses.
  integer, parameter, public :: analysis_static = 1, analysis_buckling = 2, analysis_eigen = 3, &
                                analysis_transient = 4, analysis_kinematic = 5, &
                                analysis_inverse = 6, analysis_compliance = 7, &
                                analysis_check = 8, analysis_stationary = 9
  character(len=10), parameter, public :: analysis_names(9) = &
    ["STATIC    ", "BUCKLING  ", "EIGEN     ", "TRANSIENT ", "KINEMATIC ", "INVERSE   ", &
     "COMPLIANCE", "CHECK     ", "STATIONARY"]

  !> Those that ramp a pattern, those that follow time, those that end with modes, those that need a
  !> structure.
  integer, parameter, public :: static_analyses(2) = [analysis_static, analysis_stationary]
  integer, parameter, public :: time_analyses(3) = [analysis_transient, analysis_kinematic, &
                                                    analysis_inverse]
  integer, parameter, public :: mode_analyses(3) = [analysis_buckling, analysis_eigen, &
                                                    analysis_check]
  integer, parameter, public :: structure_analyses(4) = [static_analyses, analysis_buckling, &
                                                         analysis_compliance]

  !> What a STATIC analysis controls, and what it does about stability.
  integer, parameter, public :: control_load = 0, control_displacement = 1, control_arc = 2
  integer, parameter, public :: stability_off = 0, stability_on = 1, stability_required = 2

  integer, parameter, public :: name_length = 64  !< longest name of a material, section, ...
  integer, parameter, public :: components = 7    !< of a node: X Y Z RX RY RZ W

  !> Poisson's ratio of a section that no material is used with.
  real(wp), parameter, public :: standard_poisson = 0.3_wp

  !> A node id: position and which of its three nodes exist.
  type :: node_t
    integer :: id = 0                   !< id of the deck; of an inner node, its element's
    integer :: part = 0                 !< 0, or the number of the inner node
    real(wp) :: position(3) = 0.0_wp    !< initial position [L]
    logical :: placed = .false.         !< has a position
    logical :: exists(3) = .false.      !< by kind: an element uses it
    logical :: fixed(components) = .false.
    type(place_t) :: place              !< its NODE card, or the first card that names it
    type(place_t) :: fix_place          !< its last FIX card
  end type node_t

  type :: material_t
    character(len=name_length) :: name = ""
    real(wp) :: e = 0.0_wp        !< Young's modulus [F L^-2]
    real(wp) :: g = 0.0_wp        !< shear modulus [F L^-2]
    real(wp) :: rho = 0.0_wp      !< density [M L^-3]
    real(wp) :: damping = 0.0_wp  !< stiffness-proportional damping [T]
    type(place_t) :: place
  end type material_t

  type :: section_t
    character(len=name_length) :: name = ""
    character(len=9) :: shape = ""                !< of section_shapes, PLATES or CONSTANTS
    type(shape_dimensions_t) :: sizes             !< of a shape
    real(wp) :: poisson = standard_poisson        !< Poisson's ratio in the shear coefficients
    type(section_constants_t) :: constants
    type(section_geometry_t) :: geometry
    character(len=:), allocatable :: defaults     !< what its card left to the program, as text
    type(place_t) :: place
  end type section_t

  !> One element (a part of a divided one counts as one).
  type :: member_t
    integer :: id = 0
    integer :: part = 0                 !< 0, or 1..n for the parts of a divided element
    integer :: kind = type_beamw        !< one of `type_*`
    integer :: node(3, 2) = 0           !< node index by kind and end (1 = p, 2 = q); 0: none
    real(wp) :: chord(3) = 0.0_wp       !< initial vector from p to q [L]; the same for all parts
    real(wp) :: orientation(3) = 0.0_wp !< section's y axis as given; 0: default rule
    real(wp) :: triad(3, 3) = 0.0_wp    !< columns eX eY eZ, principal axes (set by model_check)
    integer :: section = 0              !< index; 0: none
    integer :: material = 0             !< index; 0: none
    integer :: second = second_consistent
    integer :: mass = mass_consistent
    logical :: shear = .true.
    logical :: rotary = .true.
    logical :: rigid = .false.          !< RIGID given: no mode flexible, mass kept
    integer :: status(8) = mode_fixed   !< of each mode, one of `mode_*` (final: defaults resolved)
    logical :: has_stiffness = .false.  !< ESTIFF given
    !> ESTIFF: EA [F], GIt EIy EIz [F L^2], cy cz [L^2], EIw [F L^4]
    real(wp) :: stiffness(7) = 0.0_wp
    logical :: has_inertia = .false.    !< EM given
    !> EM: rho A [M L^-1], rho Ip, Iy, Iz, Iyz [M L], rho Iw [M L^3]
    real(wp) :: inertia(6) = 0.0_wp
    logical :: has_damping = .false.    !< EDAMP given
    !> EDAMP, per rate of strain: EA [F T], GIt EIy EIz [F L^2 T], EIw [F L^4 T]
    real(wp) :: damping(5) = 0.0_wp
    real(wp) :: initial_stress(8) = 0.0_wp  !< ESIG: stress resultants at zero strain [F]
    type(place_t) :: place
  end type member_t

  !> An element that is not a beam. Its strains are lengths [L] or angles [1]; what `node` holds
  !> depends on the kind: translational ends of TRUSS and SPHERICAL in row 1, rotational ends of
  !> HINGE and UNIVERSAL in row 2, both of CYLINDRICAL and PRISMATIC, none of
  !> GEAR; of SLIDER and CARRIAGE the node that slides, as end q.
  type :: joint_t
    integer :: id = 0
    integer :: kind = joint_truss           !< one of `joint_*`
    integer :: node(2, 2) = 0               !< node index by kind and end (1 = p, 2 = q); 0: none
    real(wp) :: chord(3) = 0.0_wp           !< initial vector from p to q [L]
    real(wp) :: axis(3, 2) = 0.0_wp         !< initially, global: a, and of UNIVERSAL b at q
    integer :: gear(2) = 0                  !< GEAR: the hinges, indices of joints
    real(wp) :: ratio = 1.0_wp              !< GEAR: strain = angle of the second - ratio * first
    integer, allocatable :: track(:)        !< SLIDER, CARRIAGE: the beams, indices of members
    integer :: section = 0, material = 0    !< TRUSS: indices; 0: none
    integer :: mass = mass_consistent       !< TRUSS: one of `mass_*`
    integer :: status(6) = mode_fixed       !< of each mode, one of `mode_*`
    logical :: has_stiffness = .false., has_damping = .false., has_inertia = .false.
    real(wp) :: stiffness(6) = 0.0_wp       !< ESTIFF, by mode; of a TRUSS EA [F]
    real(wp) :: damping(6) = 0.0_wp         !< EDAMP, by mode; of a TRUSS [F T]
    real(wp) :: inertia = 0.0_wp            !< EM of a TRUSS: rho A [M L^-1]
    real(wp) :: initial_stress(6) = 0.0_wp  !< ESIG, by mode
    type(place_t) :: place
  end type joint_t

  !> Mass and rotary inertia of a node (XM).
  type :: mass_t
    integer :: node = 0
    real(wp) :: mass = 0.0_wp               !< [M]
    real(wp) :: inertia(3, 3) = 0.0_wp      !< about the node, global axes at the start [M L^2]
    type(place_t) :: place
  end type mass_t

  !> A point fixed to a section: marker or place of a load.
  type :: marker_t
    character(len=name_length) :: name = ""
    integer :: node = 0
    integer :: member = 0             !< element whose section it is fixed to; 0: at the node itself
    real(wp) :: offset(2) = 0.0_wp    !< y, z from the centroid in principal axes [L]
    real(wp) :: omega = 0.0_wp        !< sectorial coordinate there [L^2]
    logical :: omega_known = .false.
    type(place_t) :: place
  end type marker_t

  !> Dead load at a node or at a point of a section.
  type :: load_t
    integer :: node = 0
    real(wp) :: force(3) = 0.0_wp     !< [F]
    real(wp) :: moment(3) = 0.0_wp    !< [F L]
    real(wp) :: bimoment = 0.0_wp     !< conjugate to the warping coordinate [F L^2]
    integer :: marker = 0             !< index in `model%point`; 0: at the node itself
    integer :: function = 0           !< index; 0: the load factor itself
    logical :: follower = .false.     !< turns with the node it acts on
    type(place_t) :: place
  end type load_t

  !> A prescribed strain (INPUTE) or coordinate (INPUTX): from where it stands it goes by `value`
  !> times the load factor or function, and in time by velocity t + acceleration t**2/2 besides.
  type :: motion_t
    integer :: member = 0, joint = 0  !< of a strain: index of the element; else 0
    integer :: mode = 0
    integer :: node = 0               !< of a coordinate
    integer :: component = 0          !< 1 to 7: X Y Z RX RY RZ W
    logical :: euler = .false.        !< components 4 to 6 are Euler parameters 1 to 3, not angles
    real(wp) :: value = 0.0_wp        !< what it adds to the motions of earlier patterns
    real(wp) :: velocity = 0.0_wp, acceleration = 0.0_wp
    integer :: function = 0           !< index; 0: the load factor itself
    type(place_t) :: place
  end type motion_t

  !> What a motion in time starts from.
  type :: start_t
    integer :: member = 0, joint = 0  !< STARTDE: index of the element; else 0
    integer :: mode = 0
    integer :: node = 0               !< STARTX, STARTDX
    integer :: component = 0          !< 1 to 7: X Y Z RX RY RZ W
    logical :: rate = .false.         !< a velocity or rate of strain, not a position
    real(wp) :: value = 0.0_wp        !< STARTX: the coordinate itself, X not displacement
    type(place_t) :: place
  end type start_t

  !> A steady turn of the whole model about an axis (ROTATION).
  type :: rotation_t
    real(wp) :: rate = 0.0_wp               !< [T^-1]; adds to that of earlier patterns
    real(wp) :: axis(3) = 0.0_wp            !< unit vector; zero: there is none
    real(wp) :: origin(3) = 0.0_wp          !< a point of the axis [L]
    type(place_t) :: place
  end type rotation_t

  !> The loads and motions given between two analyses; ramped together.
  type :: pattern_t
    type(motion_t), allocatable :: motion(:)
    integer :: motions = 0                !< how many of `motion` are in use
    type(load_t), allocatable :: load(:)
    integer :: loads = 0                  !< how many of `load` are in use
    real(wp) :: gravity(3) = 0.0_wp       !< acceleration [L T^-2]
    type(rotation_t) :: rotation
  end type pattern_t

  !> A named function of the load factor.
  type :: function_t
    character(len=name_length) :: name = ""
    integer :: kind = 0                      !< one of `function_*`
    real(wp) :: parameter(3) = 0.0_wp        !< RAMP s0 s1; SINE amplitude cycles phase; STEP s0
    real(wp), allocatable :: table(:, :)     !< 2 x n: abscissas and values; SPLINE 3 x n: and
                                             !< second derivatives
    type(formula_t) :: formula
    type(place_t) :: place
  end type function_t

  !> A displacement of a node or marker and a value it is to take.
  type :: target_t
    integer :: node = 0                       !< index; 0 if a marker
    integer :: marker = 0                     !< index in `model%marker`; 0 if a node
    integer :: component = 0                  !< 1 to 7: X Y Z RX RY RZ W
    real(wp) :: value = 0.0_wp                !< [L], rotations in radians, W [1/L]
  end type target_t

  !> One analysis, in the order of the deck.
  type :: analysis_t
    integer :: kind = analysis_static
    character(len=name_length) :: name = ""   !< NAME; empty: the default group name
    integer :: pattern = 0                    !< the pattern it ramps; 0: none
    integer :: steps = 10                     !< equal steps to record; in time, about how many
    real(wp) :: factor = 1.0_wp               !< TO: load factor at the end
    real(wp) :: tolerance = 0.0_wp            !< TOL; 0: the default of the analysis
    integer :: iterations = 0                 !< MAXITER; 0: the default
    integer :: control = control_load         !< one of `control_*`
    type(target_t) :: controlled              !< DISPLACEMENT: what is controlled, and its end value
    real(wp) :: first_increment = 0.0_wp      !< INITIAL of ARC: of the factor; 0: TO/20
    integer :: most_steps = 200               !< MAXSTEPS of ARC
    logical :: stops = .false.                !< STOP given
    type(target_t) :: stop                    !< STOP: ends where this value is passed
    integer :: stability = stability_off      !< one of `stability_*`
    logical :: branch = .false.               !< BRANCH ON: switch to the secondary branch
    integer :: modes = 10                     !< MODES of BUCKLING (of each sign) and EIGEN
    logical :: damped = .false.               !< DAMPED of EIGEN
    logical :: matrices = .false.             !< MATRICES ON of EIGEN
    real(wp) :: end_time = 0.0_wp             !< TEND, absolute [T]
    real(wp) :: time_step = 0.0_wp            !< STEP [T]; 0: adaptive, with `tolerance` TOL
    real(wp) :: spectral_radius = 0.9_wp      !< RHOINF, 0 to 1
    logical :: stabilised = .true.            !< TRANSIENT: velocities satisfy constraints too
    real(wp) :: every = 0.0_wp                !< EVERY: interval of the output [T]; 0: each step
    integer, allocatable :: node(:)           !< COMPLIANCE, also of STATIC: nodes
    type(place_t) :: place
  end type analysis_t

  !> A mode of the last BUCKLING to be added to the undeformed shape before an analysis.
  type :: imperfection_t
    integer :: mode = 0                       !< its row among the multipliers
    real(wp) :: scale = 0.0_wp                !< largest displacement [L]
    integer :: analysis = 0                   !< index of the analysis it stands before
    integer :: block = 0                      !< of the deck's reader
    type(place_t) :: place
  end type imperfection_t

  !> A name defined by SET or -D, as text.
  type :: setting_t
    character(len=name_length) :: name = ""
    character(len=:), allocatable :: value
  end type setting_t

  !> Everything the deck says.
  type :: model_t
    character(len=:), allocatable :: title
    type(node_t), allocatable :: node(:)
    type(material_t), allocatable :: material(:)
    type(section_t), allocatable :: section(:)
    type(member_t), allocatable :: member(:)
    type(joint_t), allocatable :: joint(:)
    type(mass_t), allocatable :: mass(:)
    type(start_t), allocatable :: start(:)
    real(wp) :: rayleigh(2) = 0.0_wp           !< DAMP: of mass [1/T], of stiffness [T]
    integer, allocatable :: kept_node(:)       !< OUTPUT NODES: what histories keep; none: all
    integer, allocatable :: kept_member(:)     !< OUTPUT ELEMENTS, beams; none: all
    type(marker_t), allocatable :: marker(:)   !< those with a name, of MARKER cards
    type(marker_t), allocatable :: point(:)    !< places of loads given with AT
    type(function_t), allocatable :: function(:)
    type(pattern_t), allocatable :: pattern(:)
    type(analysis_t), allocatable :: analysis(:)
    type(setting_t), allocatable :: setting(:)
    type(imperfection_t), allocatable :: imperfection(:)
    character(len=:), allocatable :: deck      !< the text as read, includes expanded
  end type model_t

end module model_data
