!> An order of the unknowns that keeps the entries of a sparse matrix close to its diagonal.
module linalg_order
  implicit none
  private

  public :: narrow_order

contains

  !> Cuthill-McKee order of a pattern: unknowns are met as from an end of the graph, neighbours with
  !> few neighbours first; pieces that do not hang together come one after the other.
  pure subroutine narrow_order(n, row, column, order, width)
    integer, intent(in) :: n                              !< number of unknowns
    integer, intent(in), contiguous :: row(:), column(:)  !< entries
    integer, intent(out) :: order(n)                      !< the unknown at each place
    integer, intent(out) :: width                         !< largest distance of an entry's places
    integer :: start(n + 1), place(n), first, last, seed, i, k
    integer, allocatable :: neighbour(:)

    call find_neighbours(n, row, column, start, neighbour)
    place = 0
    last = 0
    do seed = 1, n
      if (place(seed) > 0) cycle
      first = last + 1
      k = seed
      do i = 1, 3  ! the last one met lies at an end: begin there
        place(order(first:last)) = 0
        call meet_all(start, neighbour, k, first, last, order, place)
        k = order(last)
      end do
    end do
    width = maxval([0, abs(place(row) - place(column))])
  end subroutine narrow_order

  !> For each unknown those it shares an entry with, twice if there are two entries.
  pure subroutine find_neighbours(n, row, column, start, neighbour)
    integer, intent(in) :: n
    integer, intent(in), contiguous :: row(:), column(:)
    integer, intent(out) :: start(n + 1)  !< unknown i has those from start(i) to start(i + 1) - 1
    integer, allocatable, intent(out) :: neighbour(:)
    integer :: next(n), k

    next = 0
    do k = 1, size(row)
      next(row(k)) = next(row(k)) + 1
      next(column(k)) = next(column(k)) + 1
    end do
    start(1) = 1
    do k = 1, n
      start(k + 1) = start(k) + next(k)
    end do
    next = start(:n)
    allocate (neighbour(2*size(row)))
    do k = 1, size(row)
      neighbour(next(row(k))) = column(k)
      next(row(k)) = next(row(k)) + 1
      neighbour(next(column(k))) = row(k)
      next(column(k)) = next(column(k)) + 1
    end do
  end subroutine find_neighbours

  !> Append an unknown, then the new neighbours of each that was appended.
  pure subroutine meet_all(start, neighbour, seed, first, last, order, place)
    integer, intent(in) :: start(:), neighbour(:), seed
    integer, intent(in) :: first               !< place of the first one
    integer, intent(out) :: last               !< and of the last
    integer, intent(inout) :: order(:), place(:)
    integer :: next, i, k, from

    last = first
    order(first) = seed
    place(seed) = first
    next = first
    do while (next <= last)
      from = last + 1
      do i = start(order(next)), start(order(next) + 1) - 1
        k = neighbour(i)
        if (place(k) > 0) cycle
        last = last + 1
        order(last) = k
        place(k) = last
      end do
      call sort_by_degree(start, order(from:last))
      do i = from, last
        place(order(i)) = i
      end do
      next = next + 1
    end do
  end subroutine meet_all

  !> Few neighbours first, else by number: a short list.
  pure subroutine sort_by_degree(start, list)
    integer, intent(in) :: start(:)
    integer, intent(inout) :: list(:)
    integer :: i, at, k

    do i = 2, size(list)
      k = list(i)
      at = i
      do while (at > 1)
        if (comes_first(list(at - 1), k)) exit
        list(at) = list(at - 1)
        at = at - 1
      end do
      list(at) = k
    end do

  contains

    pure logical function comes_first(a, b)
      integer, intent(in) :: a, b
      integer :: more

      more = start(a + 1) - start(a) - (start(b + 1) - start(b))
      comes_first = more < 0 .or. (more == 0 .and. a < b)
    end function comes_first

  end subroutine sort_by_degree

end module linalg_order
