!> The part of the keyword table about motions in time, what is put out, and SPACAR's run modes.
module deck_time_keywords
  use deck_handler, only: keyword_t
  use deck_time_cards, only: read_transient, read_kinematic, read_inverse, read_timestep
  use deck_output_cards, only: read_compliance, read_kept_nodes, read_kept_elements, read_damp, &
                               read_ignored
  implicit none
  private

  public :: time_keywords, output_keywords, spacar_keywords

contains

  !> Motions in time.
  function time_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: times = "TEND t:T! | STEP h:T! | EVERY dt:T | NAME name:word"

    table = [ &
      keyword_t("TRANSIENT", "analysis", "", "TEND t:T! | STEP h:T | EVERY dt:T | "// &
        "NAME name:word | TOL tolerance:1 | RHOINF r:1=0.9 | STABILISED state:OFF/ON=ON | "// &
        "MAXITER n:count=30", &
        "follows the motion to the time TEND, which counts from 0 through all analyses: by "// &
        "equal steps STEP, or by steps whose error is below TOL. Loads not yet applied act in "// &
        "full, or as their FUNCTION of time says. RHOINF from 1 (no numerical damping) to 0 "// &
        "(most); EVERY: time from one output to the next, default each step. STABILISED OFF "// &
        "holds the places of constraints alone, not their velocities: the classical form, "// &
        "whose multipliers are less accurate and with RHOINF 1 may grow", &
        "XF 2 0 0 -6 FUNCTION wave|TRANSIENT TEND 2 STEP 0.01 EVERY 0.05|TRANSIENT TEND 3 "// &
        "TOL 1e-4", "mode 1", read_transient), &
      keyword_t("KINEMATIC", "analysis", "", times, &
        "follows the prescribed motions to the time TEND without forces: positions, "// &
        "velocities, accelerations", "KINEMATIC TEND 1 STEP 0.05", "", read_kinematic), &
      keyword_t("INVERSE", "analysis", "", times, &
        "follows the prescribed motions to the time TEND and finds the forces that they need", &
        "INVERSE TEND 1 STEP 0.05 NAME drive", "mode 2", read_inverse), &
      keyword_t("DAMP", "model", "alpha:T^-1 beta:T", "", &
        "is Rayleigh damping: alpha times mass plus beta times stiffness", &
        "DAMP 0.2 1e-4", "", read_damp)]
  end function time_keywords

  !> What is put out.
  function output_keywords() result(table)
    type(keyword_t), allocatable :: table(:)

    table = [ &
      keyword_t("COMPLIANCE", "analysis", "nodes:nodes+", "NAME name:word", &
        "finds the displacements of nodes by unit forces on each of them, about the present "// &
        "state", &
        "COMPLIANCE 2 5:7 NAME tips", "", read_compliance), &
      keyword_t("OUTPUT", "load", "NODES list:text+", "", &
        "says which nodes the histories of motions in time keep, default all; several cards "// &
        "add up", &
        "OUTPUT NODES 2 5:7", "", read_kept_nodes), &
      keyword_t("OUTPUT", "load", "ELEMENTS list:text+", "", &
        "says which elements the histories of motions in time keep, default all", &
        "OUTPUT ELEMENTS 1 7.2", "", read_kept_elements)]
  end function output_keywords

  !> SPACAR's cards for its run modes.
  function spacar_keywords() result(table)
    type(keyword_t), allocatable :: table(:)
    character(len=*), parameter :: ignored = "is ignored, with a note: it is for a "// &
      "linearization to state space, which is not available yet"

    table = [ &
      keyword_t("TIMESTEP", "analysis", "tend:T n:count", "", &
        "gives `spar run --mode 1` and `--mode 2` their end time and number of equal steps", &
        "TIMESTEP 2 200", "TIMESTEP", read_timestep), &
      keyword_t("DYNX", "form", "node:text*", "", ignored, "DYNX 2 1", "DYNX", read_ignored), &
      keyword_t("INPUTF", "form", "input:text*", "", ignored, "INPUTF 1 2 1", "INPUTF", &
                read_ignored), &
      keyword_t("OUTX", "form", "output:text*", "", ignored, "OUTX 1 2 1", "OUTX", read_ignored), &
      keyword_t("OUTXP", "form", "output:text*", "", ignored, "OUTXP 1 2 1", "OUTXP", &
                read_ignored)]
  end function spacar_keywords

end module deck_time_keywords
