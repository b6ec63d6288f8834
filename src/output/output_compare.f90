!> Comparison of two result files: `spar compare`.
module output_compare
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_is_finite
  use kinds, only: wp, i8
  use errors, only: error_t, fail, exit_usage
  use text, only: string_t, to_text, quoted
  use output_reader, only: reader_t, dataset_t, kind_other, kind_whole, kind_text
  use output_differences, only: differences_t, tolerance_t, index_text, noise
  use output_scales, only: get_length, get_scales, column_scales
  use mode_clusters, only: is_mode_dataset
  use mode_compare, only: compare_modes
  implicit none
  private

  public :: compare_files

  !> Not results: left out unless they are asked for.
  character(len=*), parameter :: left_out(3) = ["/VTKHDF     ", "/restart    ", "/convergence"]
  integer, parameter :: of_root = 2   !< the first of them are groups of the file itself

contains

  !> Find what differs. `only`: paths of datasets or groups; none for all results.
  subroutine compare_files(first, second, tolerance, only, found, error)
    character(len=*), intent(in) :: first, second
    type(tolerance_t), intent(in) :: tolerance
    type(string_t), intent(in) :: only(:)
    type(differences_t), intent(out) :: found
    type(error_t), allocatable, intent(out) :: error
    type(reader_t) :: a, b

    call a%open(first, error)
    if (.not. allocated(error)) call b%open(second, error)
    if (.not. allocated(error)) call check_only(a, b, only, error)
    if (.not. allocated(error)) then
      call compare_attributes(a, b, only, found)
      call compare_all(a, b, tolerance, only, found, error)
    end if
    call a%close()
    call b%close()
  end subroutine compare_files

  !> A path with a slash in front and none behind.
  pure function clean(path)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: clean

    clean = path
    if (index(path, "/") /= 1) clean = "/"//clean
    if (len(clean) > 1 .and. index(clean, "/", back=.true.) == len(clean)) then
      clean = clean(:len(clean) - 1)
    end if
  end function clean

  !> What is asked for has to be in one of the files: else a misspelt path would pass every test.
  subroutine check_only(a, b, only, error)
    type(reader_t), intent(in) :: a, b
    type(string_t), intent(in) :: only(:)
    type(error_t), allocatable, intent(out) :: error
    integer :: i

    do i = 1, size(only)
      if (a%has(clean(only(i)%s))) cycle
      if (b%has(clean(only(i)%s))) cycle
      call fail(error, exit_usage, "neither file has "//quoted(only(i)%s))
      return
    end do
  end subroutine check_only

  !> Whether a path is to be compared.
  pure logical function selected(path, only)
    character(len=*), intent(in) :: path
    type(string_t), intent(in) :: only(:)
    character(len=:), allocatable :: wanted
    integer :: i

    selected = size(only) == 0 .and. .not. is_left_out(path, "")
    do i = 1, size(only)
      if (selected) return
      wanted = clean(only(i)%s)
      if (wanted /= "/" .and. index(path//"/", wanted//"/") /= 1) cycle
      selected = .not. is_left_out(path, wanted)
    end do
  end function selected

  !> Whether a path belongs to what is left out and is not asked for by `wanted`.
  pure logical function is_left_out(path, wanted)
    character(len=*), intent(in) :: path, wanted
    integer :: k, at

    is_left_out = .false.
    do k = 1, size(left_out)
      at = index(path//"/", trim(left_out(k))//"/")
      if (at > merge(1, huge(at), k <= of_root)) cycle
      if (at > 0 .and. index(wanted//"/", trim(left_out(k))//"/") == 0) is_left_out = .true.
    end do
  end function is_left_out

  !> Title and layout of the files, kind and completeness of the analyses.
  subroutine compare_attributes(a, b, only, found)
    type(reader_t), intent(in) :: a, b
    type(string_t), intent(in) :: only(:)
    type(differences_t), intent(inout) :: found
    type(string_t), allocatable :: groups(:)
    integer :: i

    call found%start_dataset()
    if (size(only) == 0) then
      call compare_number(a, b, "/", "layout_version", found)
      call compare_number(a, b, "/", "complete", found)
      call compare_text(a, b, "/", "title", found)
    end if
    call a%groups("/analysis", groups)
    do i = 1, size(groups)
      if (.not. selected(groups(i)%s, only)) cycle
      if (.not. b%has(groups(i)%s)) cycle
      call compare_text(a, b, groups(i)%s, "kind", found)
      call compare_number(a, b, groups(i)%s, "complete", found)
      call compare_number(a, b, groups(i)%s, "spectrum_complete", found)
    end do
  end subroutine compare_attributes

  subroutine compare_text(a, b, path, name, found)
    type(reader_t), intent(in) :: a, b
    character(len=*), intent(in) :: path, name
    type(differences_t), intent(inout) :: found
    character(len=:), allocatable :: first, second

    call a%get_text(path, name, first)
    call b%get_text(path, name, second)
    if (first /= second) call found%add(path, name, "", quoted(first), quoted(second))
  end subroutine compare_text

  subroutine compare_number(a, b, path, name, found)
    type(reader_t), intent(in) :: a, b
    character(len=*), intent(in) :: path, name
    type(differences_t), intent(inout) :: found
    integer :: first, second

    call a%get_number(path, name, first)
    call b%get_number(path, name, second)
    if (first /= second) call found%add(path, name, "", to_text(first), to_text(second))
  end subroutine compare_number

  !> All datasets of either file, in the order of the first.
  subroutine compare_all(a, b, tolerance, only, found, error)
    type(reader_t), intent(in) :: a, b
    type(tolerance_t), intent(in) :: tolerance
    type(string_t), intent(in) :: only(:)
    type(differences_t), intent(inout) :: found
    type(error_t), allocatable, intent(out) :: error
    type(string_t), allocatable :: paths(:)
    real(wp) :: length
    integer :: i

    call get_length(a, length, error)
    if (allocated(error)) return
    call a%list("", paths)
    do i = 1, size(paths)
      if (.not. selected(paths(i)%s, only)) cycle
      call found%start_dataset()
      if (b%has(paths(i)%s)) then
        call compare_one(a, b, length, paths(i)%s, tolerance, found, error)
        if (allocated(error)) return
      else
        call found%add(paths(i)%s, "missing", "", "", "")
      end if
    end do
    call b%list("", paths)
    do i = 1, size(paths)
      call found%start_dataset()
      if (.not. selected(paths(i)%s, only)) cycle
      if (.not. a%has(paths(i)%s)) call found%add(paths(i)%s, "extra", "", "", "")
    end do
  end subroutine compare_all

  !> A dataset that both files have.
  subroutine compare_one(a, b, length, path, tolerance, found, error)
    type(reader_t), intent(in) :: a, b
    real(wp), intent(in) :: length     !< of the model, 0: unknown
    character(len=*), intent(in) :: path
    type(tolerance_t), intent(in) :: tolerance
    type(differences_t), intent(inout) :: found
    type(error_t), allocatable, intent(out) :: error
    character(len=*), parameter :: kinds(0:3) = ["unknown      ", "whole numbers", &
                                                 "reals        ", "texts        "]
    type(dataset_t) :: first, second
    real(wp), allocatable :: scale(:), other(:)

    call a%read(path, first, error)
    if (.not. allocated(error)) call b%read(path, second, error)
    if (allocated(error)) return
    if (first%kind /= second%kind .or. first%kind == kind_other) then
      call found%add(path, "type", "", trim(kinds(first%kind)), trim(kinds(second%kind)))
    else if (.not. same_shape(first, second)) then
      call found%add(path, "shape", "", shape_text(first), shape_text(second))
    else if (is_mode_dataset(a, first)) then
      call compare_modes(a, b, length, first, second, tolerance, found, error)
    else if (first%kind == kind_text) then
      call compare_words(first, second, found)
    else if (index(first%axes, "real imaginary") > 0 .and. modulo(first%columns(), 2) == 0) then
      call compare_pairs(first, second, tolerance, found)
    else
      call get_scales(a, length, first, scale, error)
      if (.not. allocated(error)) call get_scales(b, length, second, other, error)
      if (.not. allocated(error)) call compare_values(first, second, max(scale, other), tolerance, &
                                                      found)
    end if
  end subroutine compare_one

  pure logical function same_shape(first, second)
    type(dataset_t), intent(in) :: first, second

    same_shape = size(first%extents) == size(second%extents)
    if (same_shape) same_shape = all(first%extents == second%extents)
  end function same_shape

  pure function shape_text(dataset) result(phrase)
    type(dataset_t), intent(in) :: dataset
    character(len=:), allocatable :: phrase
    integer :: i

    phrase = ""
    do i = 1, size(dataset%extents)
      if (i > 1) phrase = phrase//", "
      phrase = phrase//to_text(int(dataset%extents(i)))
    end do
    phrase = "("//phrase//")"
  end function shape_text

  subroutine compare_words(first, second, found)
    type(dataset_t), intent(in) :: first, second
    type(differences_t), intent(inout) :: found
    integer(i8) :: i

    do i = 1, size(first%word, kind=i8)
      if (first%word(i)%s /= second%word(i)%s) then
        call found%add(first%path, "text", index_text(first, i), quoted(first%word(i)%s), &
                       quoted(second%word(i)%s))
      end if
    end do
  end subroutine compare_words

  !> Numbers one by one; whole ones have to be equal.
  subroutine compare_values(first, second, scale, tolerance, found)
    type(dataset_t), intent(in) :: first, second
    real(wp), intent(in) :: scale(:)   !< by column
    type(tolerance_t), intent(in) :: tolerance
    type(differences_t), intent(inout) :: found
    real(wp) :: allowed(first%columns()), relative
    integer(i8) :: i
    integer :: k

    allowed = max(tolerance%absolute, noise*tolerance%relative*scale)
    relative = tolerance%relative
    if (first%kind == kind_whole) allowed = 0
    if (first%kind == kind_whole) relative = 0
    do i = 1, size(first%value, kind=i8)
      k = 1 + int(modulo(i - 1, int(first%columns(), i8)))
      if (.not. near(first%value(i), second%value(i), relative, allowed(k))) then
        call found%add_values(first%path, index_text(first, i), first%value(i), second%value(i))
      end if
    end do
  end subroutine compare_values

  !> NaN is near nothing, an infinite number only to itself.
  pure logical function near(a, b, relative, absolute)
    real(wp), intent(in) :: a, b, relative, absolute

    if (ieee_is_finite(a) .and. ieee_is_finite(b)) then
      near = abs(a - b) <= absolute + relative*max(abs(a), abs(b))
    else
      near = .false.
      if (ieee_is_nan(a) .or. ieee_is_nan(b)) return
      if (ieee_is_finite(a) .or. ieee_is_finite(b)) return
      near = a > 0 .eqv. b > 0
    end if
  end function near

  !> Complex numbers, real and imaginary part side by side: their distance against their size.
  subroutine compare_pairs(first, second, tolerance, found)
    type(dataset_t), intent(in) :: first, second
    type(tolerance_t), intent(in) :: tolerance
    type(differences_t), intent(inout) :: found
    real(wp) :: allowed, size_of
    integer(i8) :: i
    integer :: k

    allowed = max(tolerance%absolute, noise*tolerance%relative* &
                  maxval(max(column_scales(first, 0.0_wp), column_scales(second, 0.0_wp))))
    do i = 1, size(first%value, kind=i8), 2
      associate (a => first%value(i:i + 1), b => second%value(i:i + 1))
        if (all(ieee_is_finite(a)) .and. all(ieee_is_finite(b))) then
          size_of = max(norm2(a), norm2(b))
          if (norm2(a - b) <= allowed + tolerance%relative*size_of) cycle
          call found%add(first%path, "value", index_text(first, i), pair_text(a), pair_text(b), &
                         norm2(a - b)/size_of, .true.)
        else
          do k = 1, 2
            if (.not. near(a(k), b(k), tolerance%relative, allowed)) then
              call found%add_values(first%path, index_text(first, i + k - 1), a(k), b(k))
            end if
          end do
        end if
      end associate
    end do
  end subroutine compare_pairs

  pure function pair_text(pair) result(phrase)
    real(wp), intent(in) :: pair(2)
    character(len=:), allocatable :: phrase

    phrase = "("//to_text(pair(1), 17)//", "//to_text(pair(2), 17)//")"
  end function pair_text

end module output_compare
