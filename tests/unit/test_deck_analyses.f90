module test_deck_analyses
  implicit none
  private
  public :: run_deck_analyses_tests
contains
  subroutine run_deck_analyses_tests()
  end subroutine run_deck_analyses_tests
end module test_deck_analyses
