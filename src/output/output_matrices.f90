!> The matrices of EIGEN with MATRICES ON in the result file, in compressed sparse row form.
module output_matrices
  use kinds, only: wp
  use mode_results, only: modes_t
  use output_hdf5, only: hdf5_file_t, about_t
  implicit none
  private

  public :: write_matrices

contains

  !> K, G, N, C, M and the constraints' Jacobian J, and what their rows are. Dimensions are those
  !> of two displacements.
  subroutine write_matrices(file, group, modes)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(modes_t), intent(in) :: modes

    call file%group(group)
    call file%write(group//"/name", modes%unknown, &
      about_t("1", "coordinate", "node and component, or what else the coordinate is"))
    call file%write(group//"/coordinate", modes%unknown_of - spread([1, 0], 2, &
      size(modes%unknown)), &
      about_t("1", "coordinate; node component", &
              "row of /model/nodes, from 0 (-1: none), and 1 to 7 for X Y Z RX RY RZ W"))
    associate (all => modes%matrices)
      call put("K", all%k, all%unknowns, "FL-1", "stiffness of the strains")
      call put("G", all%g, all%unknowns, "FL-1", "stiffness by the stresses (geometric)")
      call put("N", all%n, all%unknowns, "FL-1", "derivative of loads and centrifugal forces")
      call put("C", all%c, all%unknowns, "FL-1T", "damping (symmetric) and gyroscopic (skew) part")
      call put("M", all%m, all%unknowns, "M", "mass")
      call put("J", all%k, all%equations - all%unknowns, "1", "Jacobian of the fixed strains")
    end associate

  contains

    !> A matrix: rows of the coordinates, or those of the multipliers.
    subroutine put(name, values, rows, dimension, meaning)
      character(len=*), intent(in) :: name, dimension, meaning
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: rows
      integer, allocatable :: start(:), column(:)
      real(wp), allocatable :: value(:)

      associate (all => modes%matrices)
        call compress_rows(all%row - merge(all%unknowns, 0, name == "J"), all%column, values, &
                           rows, all%unknowns, start, column, value)
        call file%group(group//"/"//name)
        call file%set_number(group//"/"//name, "rows", rows)
        call file%set_number(group//"/"//name, "columns", all%unknowns)
      end associate
      call file%write(group//"/"//name//"/row_start", start, &
        about_t("1", "row", "first entry of each row, from 0; one more at the end"))
      call file%write(group//"/"//name//"/column", column, &
        about_t("1", "entry", "column of each entry, from 0"))
      call file%write(group//"/"//name//"/value", value, &
        about_t(dimension, "entry", meaning))
    end subroutine put
  end subroutine write_matrices

  !> Entries that are not zero, by rows; their columns from 0, rising.
  pure subroutine compress_rows(row, column, values, rows, columns, start, index, value)
    integer, intent(in) :: row(:), column(:), rows, columns
    real(wp), intent(in) :: values(:)
    integer, allocatable, intent(out) :: start(:), index(:)
    real(wp), allocatable, intent(out) :: value(:)
    integer, allocatable :: kept(:)
    integer :: k, i, j

    allocate (kept, source=pack([(k, k=1, size(row))], abs(values) > 0 .and. row >= 1 .and. &
                                row <= rows .and. column <= columns))
    allocate (start(rows + 1), index(size(kept)), value(size(kept)))
    start = 0
    do k = 1, size(kept)
      start(row(kept(k)) + 1) = start(row(kept(k)) + 1) + 1
    end do
    do i = 1, rows
      start(i + 1) = start(i) + start(i + 1)
    end do
    block
      integer :: next(rows)

      next = start(:rows)
      do k = 1, size(kept)
        i = row(kept(k))
        next(i) = next(i) + 1
        j = next(i)
        do while (j > start(i) + 1)
          if (index(j - 1) < column(kept(k)) - 1) exit
          index(j) = index(j - 1)
          value(j) = value(j - 1)
          j = j - 1
        end do
        index(j) = column(kept(k)) - 1
        value(j) = values(kept(k))
      end do
    end block
  end subroutine compress_rows

end module output_matrices
