!> What a deck says up to one of its analyses besides the model's shape, as lists of numbers: to
!> find out whether a run may go on with another deck.
module model_statement
  use kinds, only: wp
  use model_data, only: model_t, load_t, motion_t, marker_t
  implicit none
  private

  public :: statement_t, get_statements

  integer, parameter, public :: topics = 7
  integer, parameter :: of_loads = 1, of_gravity = 2, of_motions = 3, of_functions = 4, &
                        of_starts = 5, of_damping = 6, of_analyses = 7
  character(len=18), parameter, public :: topic_names(topics) = [character(len=18) :: &
    "loads", "gravity", "prescribed motions", "functions", "start values", "damping", &
    "analyses before"]

  !> The numbers of a topic.
  type :: statement_t
    real(wp), allocatable :: value(:)
    integer, private :: used = 0
  contains
    procedure, private :: add
  end type statement_t

contains

  !> All topics, some perhaps without numbers.
  pure subroutine get_statements(model, analysis, statement)
    type(model_t), intent(in) :: model
    integer, intent(in) :: analysis          !< number of the analysis, with its loads
    type(statement_t), intent(out) :: statement(topics)
    integer :: i, k

    do i = 1, topics
      allocate (statement(i)%value(64))
    end do
    do i = 1, maxval([model%analysis(:analysis)%pattern, 0])
      call statement(of_gravity)%add(model%pattern(i)%gravity)
      do k = 1, model%pattern(i)%loads
        call add_load(model, i, model%pattern(i)%load(k), statement)
      end do
      do k = 1, model%pattern(i)%motions
        call add_motion(model, i, model%pattern(i)%motion(k), statement)
      end do
    end do
    do i = 1, size(model%start)
      associate (s => model%start(i))
        call statement(of_starts)%add([real([s%member, s%joint, s%mode, s%node, s%component], wp), &
                                       flag(s%rate), s%value])
      end associate
    end do
    call statement(of_damping)%add(model%rayleigh)
    call add_analyses(model, analysis, statement(of_analyses))
    do i = 1, topics
      statement(i)%value = statement(i)%value(:statement(i)%used)
    end do
  end subroutine get_statements

  pure subroutine add(self, more)
    class(statement_t), intent(inout) :: self
    real(wp), intent(in) :: more(:)

    if (self%used + size(more) > size(self%value)) self%value = [self%value, more, self%value]
    self%value(self%used + 1:self%used + size(more)) = more
    self%used = self%used + size(more)
  end subroutine add

  pure elemental real(wp) function flag(yes)
    logical, intent(in) :: yes

    flag = merge(1.0_wp, 0.0_wp, yes)
  end function flag

  pure subroutine add_load(model, pattern, load, statement)
    type(model_t), intent(in) :: model
    integer, intent(in) :: pattern
    type(load_t), intent(in) :: load
    type(statement_t), intent(inout) :: statement(:)
    type(marker_t) :: place

    if (load%marker > 0) place = model%point(load%marker)
    call statement(of_loads)%add([real([pattern, load%node, place%node, place%member], wp), &
      place%offset, place%omega, load%force, load%moment, load%bimoment, flag(load%follower)])
    call add_function(model, load%function, statement(of_functions))
  end subroutine add_load

  pure subroutine add_motion(model, pattern, motion, statement)
    type(model_t), intent(in) :: model
    integer, intent(in) :: pattern
    type(motion_t), intent(in) :: motion
    type(statement_t), intent(inout) :: statement(:)

    associate (m => motion)
      call statement(of_motions)%add([real([pattern, m%member, m%joint, m%mode, m%node, &
        m%component], wp), flag(m%euler), m%value, m%velocity, m%acceleration])
    end associate
    call add_function(model, motion%function, statement(of_functions))
  end subroutine add_motion

  !> The function of a load or motion; number 0: none.
  pure subroutine add_function(model, number, statement)
    type(model_t), intent(in) :: model
    integer, intent(in) :: number
    type(statement_t), intent(inout) :: statement

    if (number == 0) then
      call statement%add([0.0_wp])
      return
    end if
    associate (f => model%function(number))
      call statement%add([real(f%kind, wp), f%parameter])
      if (allocated(f%table)) call statement%add(reshape(f%table, [size(f%table)]))
      if (.not. allocated(f%formula%code)) return
      call statement%add([real(f%formula%code(:f%formula%steps), wp), &
                          f%formula%constant(:f%formula%steps)])
    end associate
  end subroutine add_function

  !> Those before, and of the one that goes on what it is and what it ramps.
  pure subroutine add_analyses(model, analysis, statement)
    type(model_t), intent(in) :: model
    integer, intent(in) :: analysis
    type(statement_t), intent(inout) :: statement
    integer :: i

    do i = 1, analysis - 1
      associate (a => model%analysis(i), c => model%analysis(i)%controlled)
        call statement%add([real([a%steps, a%iterations, a%control, c%node, c%marker, &
          c%component, a%most_steps, a%modes], wp), c%value, a%factor, a%tolerance, &
          a%first_increment, flag(a%stops), a%stop%value, flag(a%branch), a%end_time, &
          a%time_step, a%spectral_radius, a%every, flag(a%stabilised), &
          flag(a%damped), flag(a%matrices), &
          real([a%stability, a%stop%node, a%stop%marker, a%stop%component], wp)])
        if (allocated(a%node)) call statement%add(real([size(a%node), a%node], wp))
      end associate
    end do
    do i = 1, analysis
      call statement%add(real([model%analysis(i)%kind, model%analysis(i)%pattern], wp))
    end do
    do i = 1, size(model%imperfection)
      associate (m => model%imperfection(i))
        if (m%analysis <= analysis) call statement%add([real([m%mode, m%analysis], wp), m%scale])
      end associate
    end do
  end subroutine add_analyses

end module model_statement
