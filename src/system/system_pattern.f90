!> The sparsity of the system's matrix, found once, and where each block's entries go.
module system_pattern
  use kinds, only: wp
  use system_data, only: pattern_t
  implicit none
  private

  public :: find_pattern, add_block

contains

  !> Blocks are lists of unknowns (0: none) that all couple with each other, in compressed form:
  !> block b has the unknowns `member(start(b):start(b + 1) - 1)`. Linear cost: each row is
  !> gathered once from the blocks it occurs in.
  pure subroutine find_pattern(n, start, member, symmetric, pattern)
    integer, intent(in) :: n                    !< number of unknowns
    integer, intent(in) :: start(:), member(:)  !< the blocks
    logical, intent(in) :: symmetric
    type(pattern_t), intent(out) :: pattern
    integer, allocatable :: touch_start(:), touch_block(:), touch_local(:), mark(:), column(:)
    integer :: b, i, j, k, local, width, blocks, filled

    blocks = size(start) - 1
    pattern%symmetric = symmetric
    allocate (pattern%first(blocks + 1), pattern%width(blocks))
    pattern%width = start(2:) - start(:blocks)
    pattern%first(1) = 1
    do b = 1, blocks
      width = pattern%width(b)
      pattern%first(b + 1) = pattern%first(b) + merge(width*(width + 1)/2, width**2, symmetric)
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
          associate (other => member(start(b) + j - 1), at => pattern%place(pattern%first(b) &
                       + pair(touch_local(k), j, width, symmetric)))
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

  !> Where a pair of a block stands behind the block's start, from 0.
  pure integer function pair(i, j, width, symmetric)
    integer, intent(in) :: i, j, width
    logical, intent(in) :: symmetric
    integer :: row, column

    row = i
    column = j
    if (symmetric) then
      row = max(i, j)
      column = min(i, j)
    end if
    pair = (column - 1)*width + row - 1
    if (symmetric) pair = pair - column*(column - 1)/2
  end function pair

  !> Add the matrix of a block, or of its first unknowns, to the entries; of a symmetric matrix
  !> only the lower triangle is used.
  pure subroutine add_block(pattern, block, matrix, values)
    type(pattern_t), intent(in) :: pattern
    integer, intent(in) :: block
    real(wp), intent(in) :: matrix(:, :)
    real(wp), intent(inout) :: values(:)
    integer :: i, j, k, top

    k = pattern%first(block) - 1
    do j = 1, size(matrix, 2)
      top = merge(j, 1, pattern%symmetric)
      do i = top, size(matrix, 1)
        associate (at => pattern%place(k + i - top + 1))
          if (at > 0) values(at) = values(at) + matrix(i, j)
        end associate
      end do
      k = k + pattern%width(block) - top + 1
    end do
  end subroutine add_block

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
