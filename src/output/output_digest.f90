!> The results as stable text, for `diff`: `spar digest`.
module output_digest
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use kinds, only: wp, i8
  use errors, only: error_t
  use text, only: string_t, to_text
  use output_reader, only: reader_t, dataset_t, kind_whole, kind_text
  use output_scales, only: get_length, get_scales
  use mode_clusters, only: clusters_t, is_mode_dataset, get_clusters, group_of
  implicit none
  private

  public :: write_digest, rounded

  !> Digits below the last one that is printed of a dataset's largest entry, down to which smaller
  !> entries are told from 0.
  integer, parameter :: margin = 3

  character(len=*), parameter :: left_out(2) = ["/VTKHDF/ ", "/restart/"]

contains

  !> All results of a file with `digits` digits.
  subroutine write_digest(unit, path, digits, error)
    integer, intent(in) :: unit, digits
    character(len=*), intent(in) :: path
    type(error_t), allocatable, intent(out) :: error
    type(reader_t) :: reader
    type(string_t), allocatable :: paths(:)
    type(dataset_t) :: dataset
    real(wp), allocatable :: scale(:)
    logical, allocatable :: shared(:)
    real(wp) :: length
    integer :: i, k

    call reader%open(path, error)
    if (allocated(error)) return
    write (unit, "(a, i0, a, i0, a)") "# ", digits, " digits, none below 1e-", digits + margin, &
      " of the largest entry of a dataset, or of what it follows from"
    call get_length(reader, length, error)
    if (allocated(error)) return
    call reader%list("", paths)
    do i = 1, size(paths)
      if (any([(index(paths(i)%s, trim(left_out(k))) == 1, k=1, size(left_out))])) cycle
      if (index(paths(i)%s, "/convergence/") > 0) cycle
      call reader%read(paths(i)%s, dataset, error)
      if (allocated(error)) exit
      call get_shared(reader, dataset, shared, error)
      if (allocated(error)) exit
      call get_scales(reader, length, dataset, scale, error, shared)
      if (allocated(error)) exit
      call write_dataset(unit, dataset, digits, scale, shared)
    end do
    call reader%close()
  end subroutine write_digest

  !> By mode, of a dataset of modes: whether other modes have the eigenvalue, so that only the space
  !> they span is known, and a machine prints other numbers than the next; none of other datasets.
  subroutine get_shared(reader, dataset, shared, error)
    type(reader_t), intent(in) :: reader
    type(dataset_t), intent(in) :: dataset
    logical, allocatable, intent(out) :: shared(:)
    type(error_t), allocatable, intent(out) :: error
    type(clusters_t) :: clusters
    integer :: i

    allocate (shared(0))
    if (.not. is_mode_dataset(reader, dataset)) return
    call get_clusters(reader, group_of(dataset%path), clusters, error)
    if (.not. allocated(error)) shared = clusters%is_shared([(i, i=1, size(clusters%first))])
  end subroutine get_shared

  !> Path and shape, then a line for each row, or one for all of a mode that is shared.
  subroutine write_dataset(unit, dataset, digits, scale, shared)
    integer, intent(in) :: unit, digits
    type(dataset_t), intent(in) :: dataset
    real(wp), intent(in) :: scale(:)   !< by column, see `rounded`
    logical, intent(in) :: shared(:)   !< by mode; none: no dataset of modes
    character(len=:), allocatable :: line
    integer :: columns, k, mode
    integer(i8) :: i

    columns = dataset%columns()
    line = ""
    do k = 1, size(dataset%extents)
      line = line//" "//to_text(int(dataset%extents(k)))
    end do
    write (unit, "(a)") dataset%path//line
    if (dataset%kind == kind_text) then
      do i = 1, size(dataset%word, kind=i8)
        write (unit, "(a)") "  "//dataset%word(i)%s
      end do
      return
    end if
    line = ""
    do i = 1, size(dataset%value, kind=i8)
      if (size(shared) > 0) then
        mode = 1 + int((i - 1)*size(shared)/size(dataset%value, kind=i8))
        if (shared(mode)) then
          if (modulo((i - 1)*size(shared), size(dataset%value, kind=i8)) == 0) then
            write (unit, "(a, i0, a)") "  mode ", mode, ": others have its eigenvalue"
          end if
          cycle
        end if
      end if
      k = 1 + int(modulo(i - 1, int(columns, i8)))
      if (dataset%kind == kind_whole) then
        line = line//" "//to_text(nint(dataset%value(i)))
      else
        line = line//" "//rounded(dataset%value(i), digits, scale(k))
      end if
      if (k < columns) cycle
      write (unit, "(a)") " "//line
      line = ""
    end do
  end subroutine write_dataset

  !> A number with `digits` digits, fewer where they would stand below the floor, `margin` more
  !> digits down from `scale`; never -0.
  pure function rounded(number, digits, scale) result(word)
    real(wp), intent(in) :: number
    integer, intent(in) :: digits
    real(wp), intent(in) :: scale      !< the largest number beside it
    character(len=:), allocatable :: word
    character(len=40) :: buffer, form
    integer :: shown, last

    if (.not. ieee_is_finite(number)) then
      word = "NaN"
      if (.not. ieee_is_nan(number)) word = merge("-Inf", "Inf ", number < 0)
      word = trim(word)
      return
    end if
    word = "0"
    if (.not. abs(number) > scale*10.0_wp**(-digits - margin)) return
    shown = min(digits, 1 + digits + margin - floor(log10(scale)) + floor(log10(abs(number))))
    if (shown < 1) return
    write (form, "('(es40.', i0, 'e3)')") shown - 1
    write (buffer, form) number
    buffer = adjustl(buffer)
    last = index(buffer, "E") - 1
    do while (buffer(last:last) == "0" .and. index(buffer(:last), ".") > 0)
      last = last - 1
    end do
    if (buffer(last:last) == ".") last = last - 1
    word = buffer(:last)//"e"//short_exponent(trim(buffer(index(buffer, "E") + 1:)))
  end function rounded

  !> "+003" as "3", "-012" as "-12".
  pure function short_exponent(word) result(short)
    character(len=*), intent(in) :: word
    character(len=:), allocatable :: short

    short = "0"
    if (verify(word, "+-0") > 0) short = word(verify(word, "+-0"):)
    if (word(1:1) == "-" .and. short /= "0") short = "-"//short
  end function short_exponent

end module output_digest
