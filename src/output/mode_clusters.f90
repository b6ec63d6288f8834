!> Modes of equal eigenvalues: any basis of their space is as good as another, and one that the end
!> of the list cuts through is not even known as a space.
module mode_clusters
  use kinds, only: wp
  use errors, only: error_t
  use linalg_equality, only: are_equal
  use output_reader, only: reader_t, dataset_t
  implicit none
  private

  public :: clusters_t, is_mode_dataset, group_of, get_clusters, new_clusters

  character(len=*), parameter :: eigenvalues(4) = ["multiplier        ", "eigenvalue        ", &
                                                   "complex_eigenvalue", "frequency         "]

  !> The modes of an analysis by their eigenvalues.
  type :: clusters_t
    integer, allocatable :: first(:)   !< by mode: the first one of its cluster
    logical, allocatable :: cut(:)     !< by mode: its cluster has further modes, not in the list
  contains
    procedure :: is_shared
  end type clusters_t

contains

  !> Whether a dataset depends on sign and mixture of modes: those by mode with further entries.
  logical function is_mode_dataset(reader, dataset)
    type(reader_t), intent(in) :: reader
    type(dataset_t), intent(in) :: dataset
    character(len=:), allocatable :: group

    is_mode_dataset = .false.
    if (index(dataset%axes, "mode*") /= 1 .and. index(dataset%axes, "mode;") /= 1) return
    if (index(dataset%axes, "real imaginary") > 0) return
    group = group_of(dataset%path)
    if (group == "") return
    if (eigenvalue_name(reader, group) == "") return
    is_mode_dataset = reader%has(group//"/modes/nodes/displacement")
  end function is_mode_dataset

  !> The group of the analysis, as in "/analysis/02_eigen".
  pure function group_of(path) result(group)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: group
    integer :: at

    group = ""
    if (index(path, "/analysis/") /= 1) return
    at = len("/analysis/")
    at = at + index(path(at + 1:), "/")
    group = path(:at - 1)
  end function group_of

  function eigenvalue_name(reader, group) result(name)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: group
    character(len=:), allocatable :: name
    integer :: i

    name = ""
    do i = size(eigenvalues), 1, -1
      if (reader%has(group//"/"//trim(eigenvalues(i)))) name = group//"/"//trim(eigenvalues(i))
    end do
  end function eigenvalue_name

  !> The clusters of an analysis.
  subroutine get_clusters(reader, group, clusters, error)
    type(reader_t), intent(in) :: reader
    character(len=*), intent(in) :: group
    type(clusters_t), intent(out) :: clusters
    type(error_t), allocatable, intent(out) :: error
    type(dataset_t) :: dataset
    complex(wp), allocatable :: value(:)
    integer :: cut_first, cut_last

    call reader%read(eigenvalue_name(reader, group), dataset, error)
    if (allocated(error)) return
    value = cmplx(dataset%value, 0.0_wp, wp)
    if (index(dataset%axes, "real imaginary") > 0) then
      value = cmplx(dataset%value(1::2), dataset%value(2::2), wp)
    end if
    call reader%get_number(group, "cut_first", cut_first)
    call reader%get_number(group, "cut_last", cut_last)
    clusters = new_clusters(value, [cut_first, cut_last] == 1)
  end subroutine get_clusters

  !> The clusters of eigenvalues; whether the first and the last one are cut.
  pure function new_clusters(value, cut) result(clusters)
    complex(wp), intent(in) :: value(:)
    logical, intent(in) :: cut(2)
    type(clusters_t) :: clusters
    integer :: i, j, n

    n = size(value)
    allocate (clusters%first(n), clusters%cut(n))
    clusters%first(:) = [(i, i=1, n)]
    associate (first => clusters%first)
      do i = 1, n
        do j = 1, i - 1
          if (first(i) == first(j) .or. .not. are_equal(value(i), value(j))) cycle
          where (first == max(first(i), first(j))) first = min(first(i), first(j))
        end do
      end do
      if (n == 0) return
      clusters%cut(:) = (cut(1) .and. first == first(1)) .or. (cut(2) .and. first == first(n))
    end associate
  end function new_clusters

  !> Whether a mode has no shape of its own: others have its eigenvalue.
  elemental logical function is_shared(self, i)
    class(clusters_t), intent(in) :: self
    integer, intent(in) :: i

    is_shared = self%cut(i) .or. count(self%first == self%first(i)) > 1
  end function is_shared

end module mode_clusters
