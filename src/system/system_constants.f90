!> Element constants shared by all elements that are alike: found by hashing what they depend on.
module system_constants
  use kinds, only: wp, i8
  use model_data, only: model_t, member_t, mode_flexible, second_none, second_jonker, &
                        type_beam
  use beamw_rigidity, only: rigidity_t, section_rigidity, spacar_rigidity
  use beamw_constants, only: beamw_t, new_beamw, beamw_none, beamw_jonker, beamw_consistent
  use system_data, only: constants_slot_t
  implicit none
  private

  public :: constants_table_t, member_rigidity, member_damping

  integer, parameter :: key_length = 13

  !> The constants made so far and a hash table to find them again.
  type :: constants_table_t
    integer :: entries = 0
    type(constants_slot_t), allocatable :: constants(:)
    real(wp), allocatable :: key(:, :)
    integer, allocatable :: slot(:)
  contains
    procedure :: get
  end type constants_table_t

contains

  !> The constants of a member, made new or found.
  subroutine get(self, model, member, constants)
    class(constants_table_t), intent(inout) :: self
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(beamw_t), pointer, intent(out) :: constants
    real(wp) :: key(key_length)
    integer :: at

    key = member_key(member)
    if (2*(self%entries + 1) > size_of(self%slot)) call grow(self)
    at = slot_of(self, key)
    if (self%slot(at) == 0) then
      self%entries = self%entries + 1
      self%slot(at) = self%entries
      self%key(:, self%entries) = key
      allocate (self%constants(self%entries)%constants)
      self%constants(self%entries)%constants = member_constants(model, member)
    end if
    constants => self%constants(self%slot(at))%constants
  end subroutine get

  !> What the constants depend on. Lengths that differ by round-off count as one: the stiffness
  !> then differs by 1e-11, strains not at all, as each element keeps its own length for them.
  pure function member_key(member) result(key)
    type(member_t), intent(in) :: member
    real(wp) :: key(key_length), length, unit

    length = norm2(member%chord)
    unit = 2.0_wp**(exponent(length) - 36)
    key(1) = anint(length/unit)*unit
    key(2) = member%section
    key(3) = member%material
    key(4) = member%second
    key(5) = merge(1, 0, member%shear) + merge(2, 0, is_flexible(member)) &
             + merge(4, 0, member%has_stiffness)
    key(6) = member%kind
    key(7:) = merge(member%stiffness, 0.0_wp, member%has_stiffness)
  end function member_key

  pure logical function is_flexible(member)
    type(member_t), intent(in) :: member

    is_flexible = any(member%status == mode_flexible) .and. .not. member%rigid
  end function is_flexible

  pure function member_constants(model, member) result(constants)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(beamw_t) :: constants
    integer :: second, i

    if (.not. is_flexible(member)) then
      constants%length = norm2(member%chord)
      constants%warping = .false.
      do i = 1, 8
        constants%w(i, i) = 1
      end do
      return
    end if
    second = beamw_consistent
    if (member%second == second_none) second = beamw_none
    if (member%second == second_jonker) second = beamw_jonker
    constants = new_beamw(member_rigidity(model, member), norm2(member%chord), second)
  end function member_constants

  !> Rigidities of a flexible member: ESTIFF where given, else section and material.
  pure function member_rigidity(model, member) result(rigidity)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(rigidity_t) :: rigidity

    if (member%has_stiffness) then
      rigidity = spacar_rigidity(member%stiffness, member%shear)
    else
      associate (material => model%material(member%material))
        rigidity = section_rigidity(model%section(member%section)%constants, material%e, &
                                    material%g, member%shear)
      end associate
    end if
    if (member%kind /= type_beam) return
    rigidity%eiw = 0
    rigidity%bw = 0
    rigidity%shear_rigid(3) = .true.
    rigidity%gd(3, :) = 0
    rigidity%gd(:, 3) = 0
  end function member_rigidity

  !> Viscous stresses of a flexible member per rate of strain, not allocated if it has none: its
  !> stiffness times the damping of material and Rayleigh, and that of rigidities by EDAMP.
  pure subroutine member_damping(model, member, constants, viscosity)
    type(model_t), intent(in) :: model
    type(member_t), intent(in) :: member
    type(beamw_t), intent(in) :: constants
    real(wp), allocatable, intent(out) :: viscosity(:, :)
    type(beamw_t) :: dashpots
    real(wp) :: beta

    if (.not. is_flexible(member)) return
    beta = model%rayleigh(2)
    if (member%material > 0) beta = beta + model%material(member%material)%damping
    if (.not. beta > 0 .and. .not. member%has_damping) return
    viscosity = beta*constants%s
    if (.not. member%has_damping) return
    dashpots = new_beamw(spacar_rigidity([member%damping(1:4), 0.0_wp, 0.0_wp, &
                                          member%damping(5)], .false.), norm2(member%chord), &
                         beamw_none)
    viscosity = viscosity + dashpots%s
  end subroutine member_damping

  pure integer function size_of(slot)
    integer, allocatable, intent(in) :: slot(:)

    size_of = 0
    if (allocated(slot)) size_of = size(slot)
  end function size_of

  !> Twice the room; slots are found anew.
  subroutine grow(self)
    class(constants_table_t), intent(inout) :: self
    type(constants_slot_t), allocatable :: constants(:)
    real(wp), allocatable :: key(:, :)
    integer :: n, i

    n = max(64, 2*size_of(self%slot))
    allocate (constants(n/2), key(key_length, n/2))
    if (self%entries > 0) then
      constants(:self%entries) = self%constants(:self%entries)
      key(:, :self%entries) = self%key(:, :self%entries)
      deallocate (self%slot)
    end if
    call move_alloc(constants, self%constants)
    call move_alloc(key, self%key)
    allocate (self%slot(n))
    self%slot = 0
    do i = 1, self%entries
      self%slot(slot_of(self, self%key(:, i))) = i
    end do
  end subroutine grow

  !> The slot that holds a key or should.
  pure integer function slot_of(self, key) result(at)
    class(constants_table_t), intent(in) :: self
    real(wp), intent(in) :: key(key_length)
    integer(i8) :: bits(key_length), hash
    integer :: i

    bits = transfer(key, bits)
    hash = 0
    do i = 1, key_length
      hash = ieor(ishftc(hash, 13), bits(i))
      hash = ieor(hash, ishft(hash, -29))
    end do
    at = 1 + int(modulo(hash, int(size(self%slot), i8)))
    do while (self%slot(at) /= 0)
      if (all(abs(self%key(:, self%slot(at)) - key) <= 0)) return
      at = 1 + modulo(at, size(self%slot))
    end do
  end function slot_of

end module system_constants
