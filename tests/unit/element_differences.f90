!> Derivatives of strains against differences.
module element_differences
  use kinds, only: wp
  use check, only: expect, expect_close
  use element_base, only: element_t
  use nodal_state, only: state_t, node_coordinates
  use rotation, only: cross, identity3
  implicit none
  private

  public :: compare_with_differences

contains

  !> First and second derivatives of an element against central differences along exp(theta).
  subroutine compare_with_differences(element, state, name)
    class(element_t), intent(in) :: element
    type(state_t), intent(in) :: state
    character(len=*), intent(in) :: name
    real(wp), parameter :: h = 3.0e-6_wp, tolerance = 1.0e-8_wp
    real(wp), parameter :: stress(6) = [1.0_wp, -0.7_wp, 0.4_wp, 0.9_wp, -1.2_wp, 0.3_wp]
    real(wp), dimension(element%strains) :: s, strain, plus, minus
    real(wp), dimension(element%strains, element%coordinates) :: b, bp, bm
    real(wp), dimension(element%coordinates, element%coordinates) :: g, unused
    type(state_t) :: moved
    logical :: valid
    integer :: j

    s = stress(:element%strains)
    call element%evaluate(state, s, strain, b, g, valid)
    call expect(valid, name//" valid")
    do j = 1, element%coordinates
      moved = state
      call moved%move(step(state, element%coordinate(j), h))
      call element%evaluate(moved, s, plus, bp, unused, valid)
      moved = state
      call moved%move(step(state, element%coordinate(j), -h))
      call element%evaluate(moved, s, minus, bm, unused, valid)
      call expect_close(b(:, j), (plus - minus)/(2*h), tolerance*maxval(abs(b)), name//" Jacobian")
      call expect_close(g(:, j), symmetric_difference(element, j, matmul(s, bp - bm)/(2*h), &
                                                      matmul(s, b)), &
                        tolerance*maxval(abs(b)), name//" Hessian")
    end do
    call expect_close(g, transpose(g), 1.0e-14_wp*maxval(abs(b)), name//" symmetry")
  end subroutine compare_with_differences

  function step(state, coordinate, h)
    type(state_t), intent(in) :: state
    integer, intent(in) :: coordinate
    real(wp), intent(in) :: h
    real(wp) :: step(node_coordinates*size(state%warping))

    step = 0
    step(coordinate) = h
  end function step

  !> Column j of the Hessian at theta = 0 of exp(theta): the derivative of the gradient, less half
  !> the cross product of step and gradient in the spin's own block.
  function symmetric_difference(element, j, derivative, gradient) result(column)
    class(element_t), intent(in) :: element
    integer, intent(in) :: j
    real(wp), intent(in) :: derivative(:), gradient(:)
    real(wp) :: column(size(derivative)), axis(3)
    integer :: component, first

    column = derivative
    component = modulo(element%coordinate(j) - 1, node_coordinates) + 1
    if (component < 4 .or. component > 6) return
    first = j - component + 4
    axis = identity3(:, component - 3)
    column(first:first + 2) = column(first:first + 2) &
                              - 0.5_wp*cross(axis, gradient(first:first + 2))
  end function symmetric_difference

end module element_differences
