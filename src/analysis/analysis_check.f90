!> `spar check`: what the model is, what holds it, what it cannot resist.
module analysis_check
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use text, only: to_text, plural
  use model_data, only: model_t, mode_fixed, mode_released
  use linalg_solver, only: solver_t
  use nodal_state, only: state_t
  use system_data, only: system_t
  use system_build, only: build_system, find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble
  use system_constraints, only: drop_redundant, free_motions
  use system_names, only: coordinate_name, strain_name
  use start_assembly, only: assemble_start
  implicit none
  private

  public :: check_model

contains

  !> Print counts, redundant constraints and free motions; an unsound model (one that moves freely)
  !> is an error.
  subroutine check_model(model, unit, error)
    type(model_t), intent(in) :: model
    integer, intent(in) :: unit
    type(error_t), allocatable, intent(out) :: error
    type(system_t) :: system
    type(state_t) :: state
    integer, allocatable :: dropped(:)
    integer :: i, constraints

    call build_system(model, system)
    constraints = system%multipliers
    call assemble_start(model, system, state, error)
    if (.not. allocated(error)) call drop_redundant(system, state, dropped, error)
    if (.not. allocated(error)) then
      call print_counts(model, system, constraints, unit)
      call print_defaults(model, unit)
      do i = 1, size(dropped)
        write (unit, "(a)") "overconstrained: "//strain_name(model, system, dropped(i))// &
          " follows from other constraints"
      end do
      call check_motions(model, system, state, unit, error)
    end if
    call system%free()
  end subroutine check_model

  subroutine print_counts(model, system, constraints, unit)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    integer, intent(in) :: constraints, unit
    integer :: i, fixed, released

    fixed = 0
    released = 0
    do i = 1, size(model%member)
      fixed = fixed + count(model%member(i)%status == mode_fixed)
      released = released + count(model%member(i)%status == mode_released)
    end do
    call line("nodes", size(model%node))
    call line("elements", size(model%member))
    call line("coordinates in use", count(system%used))
    call line("  held by FIX or by rigid torsion (W)", count(system%used .and. system%unknown == 0))
    call line("  free", system%unknowns)
    call line("rigid modes of elements", fixed)
    call line("released modes of elements", released)
    call line("constraint equations", constraints)
    call line("  redundant", constraints - system%multipliers)
    call line("degrees of freedom", system%unknowns - system%multipliers)

  contains

    subroutine line(what, number)
      character(len=*), intent(in) :: what
      integer, intent(in) :: number

      write (unit, "(a, t42, i9)") what, number
    end subroutine line

  end subroutine print_counts

  !> What the cards of the sections left to the program.
  subroutine print_defaults(model, unit)
    type(model_t), intent(in) :: model
    integer, intent(in) :: unit
    integer :: i

    do i = 1, size(model%section)
      associate (section => model%section(i))
        if (section%defaults /= "") write (unit, "(a)") "defaults of SECTION "// &
          trim(section%name)//": "//section%defaults
      end associate
    end do
  end subroutine print_defaults

  !> Factorize the unloaded model and name what moves without strain.
  subroutine check_motions(model, system, state, unit, error)
    type(model_t), intent(in) :: model
    type(system_t), intent(inout) :: system
    type(state_t), intent(in) :: state
    integer, intent(in) :: unit
    type(error_t), allocatable, intent(out) :: error
    type(solver_t) :: solver
    type(iterate_t) :: iterate
    integer, allocatable :: free(:)
    real(wp) :: level(size(model%pattern))
    integer :: i

    if (system%unknowns == 0) return
    call find_system_pattern(system)
    call new_iterate(system, iterate)
    iterate%state = state
    level = 0
    call assemble(system, level, iterate)
    call solver%prepare(system%equations(), system%pattern%row, system%pattern%column, &
                        system%pattern%symmetric, error)
    if (.not. allocated(error)) call solver%factorize(iterate%values, error)
    if (.not. allocated(error)) call free_motions(system, iterate, solver, free, error)
    call solver%free()
    if (allocated(error)) return
    do i = 1, size(free)
      write (unit, "(a)") "moves freely: "//coordinate_name(model, free(i))
    end do
    if (size(free) > 0) call fail(error, exit_deck, "the model is not a structure: "// &
                                  plural(size(free), "free motion")//" without strain")
    if (size(free) == 0) write (unit, "(a)") "the model resists every motion"
  end subroutine check_motions

end module analysis_check
