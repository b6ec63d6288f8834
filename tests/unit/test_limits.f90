!> Models at the limit of what can be solved: over- and underconstrained, beyond a limit load,
!> interrupted.
module test_limits
  use kinds, only: wp
  use text, only: to_text
  use check, only: run, expect, expect_close
  use errors, only: error_t, exit_deck, exit_solve, exit_interrupt
  use model_data, only: model_t
  use memory_recorder, only: memory_t, run_sound, node => node_index, run_deck
  implicit none
  private

  public :: run_limits_tests

contains

  subroutine run_limits_tests()
    call run("limits: redundant constraints are named and solved", redundant)
    call run("limits: constraints that contradict each other", contradiction)
    call run("limits: free motion is named", mechanism)
    call run("limits: beyond a limit load, converged steps are kept", limit)
    call run("limits: interruption keeps converged steps", interruption)
    call run("limits: large displacement increments in one step", one_step)
  end subroutine run_limits_tests

  subroutine redundant()
    type(memory_t) :: memory
    type(model_t) :: model
    integer :: i

    call run_sound("redundant", memory, model)
    call expect(size(memory%remarks) == 6, "six warnings")
    do i = 1, size(memory%remarks)
      call expect(index(memory%remarks(i)%s, "warning: overconstrained, "//to_text(i)// &
                        " of 6: element ") == 1, memory%remarks(i)%s)
      call expect(index(memory%remarks(i)%s, "element 3 mode ") > 0 .and. &
                  index(memory%remarks(i)%s, "; RLSE ") > 0, "element 3 named, a release: "// &
                  memory%remarks(i)%s)
    end do
    if (memory%steps == 0) return
    call expect_close(memory%results(1)%displacement(3, node(model, 4)), 8.0e-6_wp/(3*1000*2), &
                      1.0e-14_wp, "the arm bends alone, EIz in its vertical plane")
  end subroutine redundant

  subroutine contradiction()
    call expect_failure("contradiction", exit_solve, "contradict each other: element 2 mode 1")
  end subroutine contradiction

  subroutine mechanism()
    call expect_failure("mechanism", exit_deck, "the model can move freely: node")
  end subroutine mechanism

  subroutine expect_failure(name, status, message)
    character(len=*), intent(in) :: name, message
    integer, intent(in) :: status
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck(name, memory, model, error)
    call expect(allocated(error), name//": an error")
    if (.not. allocated(error)) return
    call expect(error%status == status, name//": its status")
    call expect(index(error%message, message) > 0, "'"//message//"', got '"//error%message//"'")
  end subroutine expect_failure

  !> Williams' toggle, limit load 33.861: three steps of 33.9/4 converge, the last cannot.
  subroutine limit()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    call run_deck("limit", memory, model, error)
    call expect(allocated(error), "an error")
    call expect(memory%steps == 3, "three steps kept")
    if (.not. allocated(error)) return
    call expect(error%status == exit_solve, "status 4")
    call expect(index(error%message, "no equilibrium found in step 4 of 4") > 0, error%message)
    call expect(index(error%message, " beyond load factor 0.99") > 0, error%message)
    call expect(index(error%message, "at node ") > 0, "the worst node, got '"//error%message//"'")
  end subroutine limit

  subroutine interruption()
    type(memory_t) :: memory
    type(model_t) :: model
    type(error_t), allocatable :: error

    memory%stop_after = 12
    call run_deck("elastica", memory, model, error)
    call expect(allocated(error), "an error")
    if (.not. allocated(error)) return
    call expect(error%status == exit_interrupt, "status 130")
    call expect(memory%steps > 0 .and. memory%steps < 5, "the steps so far are kept")
    call expect(size(memory%completed) == 1, "one analysis ended")
    call expect(.not. any(memory%completed), "and is not complete")
  end subroutine interruption

  !> The whole roll-up in one step: increments that turn elements too far are shortened.
  subroutine one_step()
    type(memory_t) :: memory
    type(model_t) :: model

    call run_sound("rollup", memory, model, ["steps=1", "n=40   "])
    if (memory%steps == 0) return
    call expect_close(memory%results(1)%displacement(:, node(model, 2)), [-1, 0, 0]*1.0_wp, &
                      1.0e-9_wp, "a full circle in one step")
  end subroutine one_step

end module test_limits
