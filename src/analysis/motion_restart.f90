!> Restart points of TRANSIENT: what a motion is made of, put into a point and taken from it.
module motion_restart
  use kinds, only: wp
  use errors, only: error_t, fail, exit_deck
  use model_data, only: model_t
  use motion_steps, only: passage_t
  use restart_point, only: point_t
  implicit none
  private

  public :: make_point, take_up, restore_shape

  integer, parameter :: numbers = 10  !< in front of the lists in `rest`

contains

  !> The point of a motion on its way. Which analysis it is and what that has recorded is the
  !> caller's to say.
  pure subroutine make_point(model, passage, point)
    type(model_t), intent(in) :: model
    type(passage_t), intent(in) :: passage
    type(point_t), intent(inout) :: point

    point%time = passage%time
    point%state = passage%motion%iterate%state
    associate (motion => passage%motion, flow => passage%motion%flow, a => passage%account, &
               level => passage%level)
      point%rest = [passage%step, a%opening, a%loads, a%motion, a%dissipated, a%power, flow%step, &
                    real([passage%record%iterations, passage%record%cutbacks, size(level)], wp), &
                    level, motion%iterate%stress, flow%velocity, flow%acceleration, flow%pseudo, &
                    motion%solver%scales(), a%external, a%stress, a%target, shape_of(model)]
    end associate
  end subroutine make_point

  !> Put a motion, made for the same model, where a point stands; levels of patterns that the point
  !> does not know are left.
  subroutine take_up(point, model, passage, error)
    type(point_t), intent(in) :: point
    type(model_t), intent(in) :: model
    type(passage_t), intent(inout) :: passage
    type(error_t), allocatable, intent(out) :: error
    real(wp), allocatable :: scales(:)
    integer :: at, patterns

    patterns = nint(point%rest(numbers))
    associate (motion => passage%motion, r => point%rest, a => passage%account)
      allocate (scales, source=motion%solver%scales())
      associate (n => motion%system%coordinates, strains => size(motion%iterate%stress))
        if (patterns > size(passage%level) .or. size(r) /= numbers + patterns + 4*n + 3*strains &
            + size(scales) + size(shape_of(model))) then
          call fail(error, exit_deck, "the restart point is that of another model")
          return
        end if
        allocate (a%external(n), a%stress(strains), a%target(strains))
      end associate
      passage%time = point%time
      passage%step = r(1)
      a%opening = r(2)
      a%loads = r(3)
      a%motion = r(4)
      a%dissipated = r(5)
      a%power = r(6)
      motion%flow%step = r(7)
      passage%record%step = point%states - 1
      passage%record%iterations = nint(r(8))
      passage%record%cutbacks = nint(r(9))
      motion%iterate%state = point%state
      at = numbers
      call take(passage%level(:patterns))
      call take(motion%iterate%stress)
      call take(motion%flow%velocity)
      call take(motion%flow%acceleration)
      call take(motion%flow%pseudo)
      call take(scales)
      call motion%solver%set_scales(scales)
      call take(a%external)
      call take(a%stress)
      call take(a%target)
    end associate

  contains

    !> The next list of the point.
    subroutine take(list)
      real(wp), intent(out) :: list(:)

      list = point%rest(at + 1:at + size(list))
      at = at + size(list)
    end subroutine take

  end subroutine take_up

  !> What IMPERFECTION cards have made of a model; nothing without them.
  pure function shape_of(model) result(shape)
    type(model_t), intent(in) :: model
    real(wp), allocatable :: shape(:)
    integer :: i

    allocate (shape(merge(3*size(model%node) + 12*size(model%member), 0, &
                          size(model%imperfection) > 0)))
    if (size(shape) == 0) return
    do i = 1, size(model%node)
      shape(3*i - 2:3*i) = model%node(i)%position
    end do
    associate (nodes => 3*size(model%node))
      do i = 1, size(model%member)
        shape(nodes + 12*i - 11:nodes + 12*i - 9) = model%member(i)%chord
        shape(nodes + 12*i - 8:nodes + 12*i) = reshape(model%member(i)%triad, [9])
      end do
    end associate
  end function shape_of

  !> Give a model the shape that it had at a point.
  pure subroutine restore_shape(point, model)
    type(point_t), intent(in) :: point
    type(model_t), intent(inout) :: model
    integer :: i, at

    at = size(point%rest) - size(shape_of(model))
    if (at < 0 .or. at == size(point%rest)) return
    do i = 1, size(model%node)
      model%node(i)%position = point%rest(at + 1:at + 3)
      at = at + 3
    end do
    do i = 1, size(model%member)
      model%member(i)%chord = point%rest(at + 1:at + 3)
      model%member(i)%triad = reshape(point%rest(at + 4:at + 12), [3, 3])
      at = at + 12
    end do
  end subroutine restore_shape

end module motion_restart
