!> Name and version of the program.
module program_version
  implicit none
  private

  character(len=*), parameter, public :: program_name = "spar", version = "0.1.0"

end module program_version
