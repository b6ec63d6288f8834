!> The matrices of small motions about a state, each alone (theory 8):
!> M x'' + C x' + (K + G - N) x + J' mu = 0, J x = 0.
module system_linear
  use kinds, only: wp
  use element_base, only: element_t
  use model_data, only: model_t
  use system_data, only: system_t, masses_t
  use system_build, only: find_system_pattern
  use system_assembly, only: iterate_t, new_iterate, assemble_elements, assemble_loads
  use system_geometric, only: add_geometric
  use system_inertia, only: assemble_mass
  use system_pattern, only: add_block
  use system_rotation, only: spin_at, assemble_gyroscopic
  implicit none
  private

  public :: matrices_t, linearize

  !> Entries of square matrices in one sparsity, unknowns first, then multipliers.
  type :: matrices_t
    integer :: unknowns = 0, equations = 0
    integer, allocatable :: row(:), column(:)
    real(wp), allocatable :: k(:)   !< of the strains' laws, and J with its transpose
    real(wp), allocatable :: g(:)   !< of the stresses
    real(wp), allocatable :: n(:)   !< of the loads and centrifugal forces: their derivative
    real(wp), allocatable :: c(:)   !< damping, the symmetric part, and gyroscopic, the other
    real(wp), allocatable :: m(:)   !< mass
  end type matrices_t

contains

  !> About the state and stresses of `iterate`, with the patterns at `level`; with damping if asked
  !> for.
  subroutine linearize(model, system, masses, level, iterate, damped, matrices)
    type(model_t), intent(in) :: model
    type(system_t), intent(in) :: system
    type(masses_t), intent(in) :: masses
    real(wp), intent(in) :: level(:)
    type(iterate_t), intent(in) :: iterate
    logical, intent(in) :: damped
    type(matrices_t), intent(out) :: matrices
    type(system_t) :: square
    type(iterate_t) :: bare
    real(wp) :: unused(system%coordinates)
    integer :: entries

    square = system
    call find_system_pattern(square, unsymmetric=.true.)
    call new_iterate(square, bare)
    bare%state = iterate%state
    call assemble_elements(square, bare)
    matrices%unknowns = square%unknowns
    matrices%equations = square%equations()
    entries = size(square%pattern%row)
    allocate (matrices%g(entries), matrices%n(entries), matrices%c(entries), matrices%m(entries))
    matrices%k = bare%values
    matrices%g = 0
    call add_geometric(square, bare, iterate%stress, matrices%g)
    matrices%n = 0
    unused = 0
    call assemble_loads(square, level, bare%state, unused, matrices%n)
    matrices%n = -matrices%n
    call assemble_mass(square, masses, bare%state, matrices%m)
    matrices%c = 0
    if (damped) then
      matrices%c = model%rayleigh(1)*matrices%m
      call add_damping(square, bare, matrices%c)
    end if
    if (size(square%rotor) > 0) then
      call assemble_gyroscopic(square, bare%state, spin_at(square, level), matrices%c)
    end if
    call move_alloc(square%pattern%row, matrices%row)
    call move_alloc(square%pattern%column, matrices%column)
  end subroutine linearize

  !> D' viscosity D of all elements that are damped.
  pure subroutine add_damping(system, iterate, values)
    type(system_t), intent(in) :: system
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(inout) :: values(:)
    integer :: e

    do e = 1, size(system%element)
      if (.not. system%element(e)%e%damped) cycle
      associate (element => system%element(e)%e, &
                 jacobian => iterate%jacobian(system%jacobian(e) + 1:system%jacobian(e + 1)))
        if (allocated(element%part)) then
          call add_part(system, e, size(element%part, 1), iterate, values)
        else
          call add_element(system, e, element, jacobian, values)
        end if
      end associate
    end do
  end subroutine add_damping

  pure subroutine add_element(system, e, element, jacobian, values)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e
    class(element_t), intent(in) :: element
    real(wp), intent(in) :: jacobian(element%strains, element%coordinates)
    real(wp), intent(inout) :: values(:)
    real(wp) :: viscosity(element%strains, element%strains)

    call element%damping(viscosity)
    call add_block(system%pattern, e, matmul(transpose(jacobian), matmul(viscosity, jacobian)), &
                   values)
  end subroutine add_element

  !> The same of an element with parts, where the iterate was assembled.
  pure subroutine add_part(system, e, n, iterate, values)
    type(system_t), intent(in) :: system
    integer, intent(in) :: e, n           !< n: coordinates of a part
    type(iterate_t), intent(in) :: iterate
    real(wp), intent(inout) :: values(:)
    real(wp), dimension(system%first(e + 1) - system%first(e)) :: strain, none
    real(wp) :: jacobian(size(none), n), unused(n, n), viscosity(size(none), size(none))
    integer :: part
    logical :: valid

    none = 0
    associate (element => system%element(e)%e)
      call element%evaluate_part(iterate%state, none, part, strain, jacobian, unused, valid)
      if (.not. valid) return
      call element%damping(viscosity)
    end associate
    call add_block(system%pattern, system%parts(e) + part, &
                   matmul(transpose(jacobian), matmul(viscosity, jacobian)), values)
  end subroutine add_part

end module system_linear
