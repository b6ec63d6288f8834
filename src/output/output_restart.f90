!> Group /restart of the result file: for each motion in time the instant from which it can go on.
!>
!> The group itself is there from the start of the file. Two places are written in turn, so that one
!> is whole whenever the program is killed; at the end of the analysis only the first is left.
module output_restart
  use, intrinsic :: iso_c_binding, only: c_loc
  use hdf5, only: hid_t, h5dopen_f, h5dwrite_f, h5dclose_f, h5t_native_double
  use kinds, only: wp
  use errors, only: error_t
  use model_statement, only: statement_t, topics, topic_names
  use restart_point, only: point_t
  use output_hdf5, only: hdf5_file_t, about_t
  implicit none
  private

  public :: restart_writer_t, topic_path

  character(len=*), parameter, public :: restart_root = "restart"
  character(len=6), parameter, public :: restart_places(2) = ["first ", "second"]

  type :: restart_writer_t
    private
    character(len=:), allocatable :: group
    type(statement_t) :: statement(topics)
    logical :: started = .false.                     !< the group is there
    integer :: place = 0                             !< written last
    real(wp), allocatable :: list(:)                 !< what is there
  contains
    procedure :: begin
    procedure :: keep
    procedure :: finish
  end type restart_writer_t

contains

  !> An analysis starts; `statement`: what its deck says, for whoever wants to go on.
  subroutine begin(self, name, statement)
    class(restart_writer_t), intent(inout) :: self
    character(len=*), intent(in) :: name      !< of its group
    type(statement_t), intent(in) :: statement(:)

    self%group = restart_root//"/"//name
    self%statement = statement
    self%started = .false.
    self%place = 0
  end subroutine begin

  !> Write a point, and flush.
  subroutine keep(self, file, point, error)
    class(restart_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(point_t), intent(in) :: point
    type(error_t), allocatable, intent(out) :: error

    self%list = point%pack()
    if (.not. self%started) call start(self, file, size(self%list))
    self%place = 3 - max(1, self%place)
    call overwrite(self, file, self%place, self%list)
    call file%flush(error)
  end subroutine keep

  subroutine start(self, file, numbers)
    type(restart_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: numbers
    real(wp) :: nothing(numbers)
    integer :: i

    nothing = 0
    call file%group(self%group)
    do i = 1, size(restart_places)
      call file%write(self%group//"/"//trim(restart_places(i)), nothing, about_t("1", "number", &
                      "an instant from which the analysis can go on, or zeros"))
    end do
    call file%group(self%group//"/deck")
    do i = 1, topics
      call file%write(self%group//topic_path(i), self%statement(i)%value, about_t("1", "number", &
                      "what the deck says about "//trim(topic_names(i))))
    end do
    self%started = .true.
  end subroutine start

  !> Where a topic of the deck stands in the group of an analysis.
  pure function topic_path(topic) result(path)
    integer, intent(in) :: topic
    character(len=:), allocatable :: path
    integer :: i

    path = "/deck/"//trim(topic_names(topic))
    do i = 1, len(path)
      if (path(i:i) == " ") path(i:i) = "_"
    end do
  end function topic_path

  subroutine overwrite(self, file, place, list)
    type(restart_writer_t), intent(in) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: place
    real(wp), intent(in), target, contiguous :: list(:)
    integer(hid_t) :: dataset
    integer :: status

    if (allocated(file%failure)) return
    call h5dopen_f(file%id, self%group//"/"//trim(restart_places(place)), dataset, status)
    call file%check(status, "h5dopen_f")
    if (status < 0) return
    call h5dwrite_f(dataset, h5t_native_double, c_loc(list), status)
    call file%check(status, "h5dwrite_f")
    call h5dclose_f(dataset, status)
    call file%check(status, "h5dclose_f")
  end subroutine overwrite

  !> The analysis has ended: leave its last point in the first place.
  subroutine finish(self, file)
    class(restart_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(error_t), allocatable :: error
    real(wp), allocatable :: nothing(:)

    if (.not. self%started) return
    self%started = .false.
    if (self%place == 2) call overwrite(self, file, 1, self%list)
    call file%flush(error)
    if (allocated(error)) return
    allocate (nothing(size(self%list)))
    nothing = 0
    call overwrite(self, file, 2, nothing)
  end subroutine finish

end module output_restart
