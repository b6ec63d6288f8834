program run_tests
  use check, only: finish
  use test_element_beamw, only: run_element_beamw_tests
  implicit none

  call run_element_beamw_tests()
  call finish()
end program run_tests
