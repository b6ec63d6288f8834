!> The sparsity of the system's matrix, found once, and where each block's entries go.
module system_pattern
  use system_data, only: pattern_t
  implicit none
  private

  public :: find_pattern

contains

  !> Blocks are lists of unknowns (0: none) that all couple with each other, in compressed form:
  !> block b has the unknowns `member(start(b):start(b + 1) - 1)`. Linear cost: each row is
  !> gathered once from the blocks it occurs in. Pairs of a block are placed column by column,
  !> the whole square, upper ones where their mirror is if the matrix is symmetric.
  pure subroutine find_pattern(n, start, member, symmetric, pattern)
    integer, intent(in) :: n                    !< number of unknowns
    integer, intent(in) :: start(:), member(:)  !< the blocks
    logical, intent(in) :: symmetric
    type(pattern_t), intent(out) :: pattern
    integer, allocatable :: touch_start(:), touch_block(:), touch_local(:), mark(:), column(:)
    integer :: b, i, j, k, local, width, blocks, filled

    blocks = size(start) - 1
    pattern%symmetric = symmetric
    allocate (pattern%first(blocks + 1))
    pattern%first(1) = 1
    do b = 1, blocks
      width = start(b + 1) - start(b)
      pattern%first(b + 1) = pattern%first(b) + width**2
    end do
    allocate (pattern%place(pattern%first(blocks + 1) - 1))
    pattern%place = 0
    call transpose_blocks(n, start, member, touch_start, touch_block, touch_local)
    allocate (mark(n), column(count_pairs(start)), pattern%row(0))
    mark = 0
    filled = 0
    deallocate (pattern%row)
    allocate (pattern%row(size(column)))
    do i = 1, n
      local = filled
      do k = touch_start(i), touch_start(i + 1) - 1
        b = touch_block(k)
        width = start(b + 1) - start(b)
        do j = 1, width
          associate (other => member(start(b) + j - 1), &
                     at => pattern%place(pattern%first(b) + (j - 1)*width + touch_local(k) - 1))
            if (other == 0 .or. (symmetric .and. other > i)) cycle
            if (mark(other) <= local) then
              filled = filled + 1
              mark(other) = filled
              column(filled) = other
              pattern%row(filled) = i
            end if
            at = mark(other)
          end associate
        end do
      end do
    end do
    pattern%row = pattern%row(:filled)
    pattern%column = column(:filled)
  end subroutine find_pattern

  pure integer function count_pairs(start)
    integer, intent(in) :: start(:)

    count_pairs = sum((start(2:) - start(:size(start) - 1))**2)
  end function count_pairs

  !> For each unknown the blocks it occurs in, and where.
  pure subroutine transpose_blocks(n, start, member, touch_start, touch_block, touch_local)
    integer, intent(in) :: n, start(:), member(:)
    integer, allocatable, intent(out) :: touch_start(:), touch_block(:), touch_local(:)
    integer, allocatable :: next(:)
    integer :: b, k

    allocate (touch_start(n + 1), touch_block(size(member)), touch_local(size(member)))
    touch_start = 0
    do k = 1, size(member)
      if (member(k) > 0) touch_start(member(k) + 1) = touch_start(member(k) + 1) + 1
    end do
    touch_start(1) = 1
    do k = 1, n
      touch_start(k + 1) = touch_start(k) + touch_start(k + 1)
    end do
    next = touch_start
    do b = 1, size(start) - 1
      do k = start(b), start(b + 1) - 1
        if (member(k) == 0) cycle
        touch_block(next(member(k))) = b
        touch_local(next(member(k))) = k - start(b) + 1
        next(member(k)) = next(member(k)) + 1
      end do
    end do
  end subroutine transpose_blocks

end module system_pattern
