!> Modes that mean the same: complex ones turned in phase, bases of the space of equal eigenvalues,
!> and what the end of a list leaves of these; and that nothing else is taken for the same.
module test_mode_clusters
  use kinds, only: wp
  use errors, only: error_t
  use text, only: string_t
  use check, only: run, expect
  use program_runs, only: outcome_t, run_spar, scratch, make_file
  use result_samples, only: sample_t, new_sample, write_sample
  use output_reader, only: reader_t
  use output_compare, only: compare_files
  use output_differences, only: differences_t, tolerance_t
  use mode_clusters, only: clusters_t, new_clusters
  implicit none
  private

  public :: run_mode_clusters_tests

  character(len=*), parameter :: newline = new_line("a")
  complex(wp), parameter :: one = (1.0_wp, 0.0_wp), none = (0.0_wp, 0.0_wp), i = (0.0_wp, 1.0_wp)

contains

  subroutine run_mode_clusters_tests()
    call run("compare: eigenvalues in a chain are one cluster", test_chain)
    call run("compare: complex modes turned in phase", test_phase)
    call run("compare: complex modes that are others", test_other)
    call run("compare: complex modes of a double eigenvalue", test_complex_double)
    call run("compare: a cluster that the end of the list cuts", test_cut)
    call run("digest: modes of equal eigenvalues", test_digest)
    call run("modes: the file says which cluster is cut", test_cut_said)
  end subroutine run_mode_clusters_tests

  !> Neighbours are equal, the ends are not: all or none; 0 equals 0, and nothing else.
  subroutine test_chain()
    type(clusters_t) :: clusters

    clusters = new_clusters(one*[2.0_wp, 1 + 1.6e-6_wp, 1.0_wp, 1 + 0.8e-6_wp, 1.01_wp], &
                            [.false., .true.])
    call expect(all(clusters%first == [1, 2, 2, 2, 5]), "a chain")
    call expect(all(clusters%cut .eqv. [.false., .false., .false., .false., .true.]), "the last")
    clusters = new_clusters([none, none, 1.0e-9_wp*one], [.true., .false.])
    call expect(all(clusters%first == [1, 1, 3]), "zeros")
    call expect(all(clusters%cut .eqv. [.true., .true., .false.]), "the first")
    clusters = new_clusters([i + 1.0e-5_wp, i - 1.0e-5_wp], [.false., .false.])
    call expect(.not. any(clusters%is_shared([1, 2])), "equal frequencies, other dampings")
  end subroutine test_chain

  !> A sample with complex modes, no two of an eigenvalue.
  subroutine new_complex_sample(sample)
    type(sample_t), intent(out) :: sample

    call new_sample(sample)
    associate (m => sample%modes)
      m%lambda = [cmplx(-0.5_wp, 6.0_wp, wp), cmplx(-0.1_wp, 6.0_wp, wp), cmplx(0.0_wp, 9.0_wp, wp)]
      allocate (m%quadrature)
      m%quadrature%displacement = 0.3_wp*cos(7*m%displacement)
      m%quadrature%rotation = 0.1_wp*sin(30*m%rotation)
      m%quadrature%warping = 0.01_wp*cos(200*m%warping)
      m%quadrature%strain = 0.2_wp*sin(5*m%strain)
      m%quadrature%stress = 100*m%quadrature%strain
      m%quadrature%joint_strain = m%joint_strain
      m%quadrature%joint_stress = m%joint_stress
    end associate
  end subroutine new_complex_sample

  !> Mode k becomes the sum of t(:, k) times the modes.
  subroutine mix(sample, t)
    type(sample_t), intent(inout) :: sample
    complex(wp), intent(in) :: t(3, 3)

    associate (m => sample%modes, q => sample%modes%quadrature)
      call mix_one(size(m%displacement)/3, m%displacement, q%displacement, t)
      call mix_one(size(m%rotation)/3, m%rotation, q%rotation, t)
      call mix_one(size(m%warping)/3, m%warping, q%warping, t)
      call mix_one(size(m%strain)/3, m%strain, q%strain, t)
      call mix_one(size(m%stress)/3, m%stress, q%stress, t)
    end associate
  end subroutine mix

  subroutine mix_one(n, part, quadrature, t)
    integer, intent(in) :: n
    real(wp), intent(inout) :: part(n, 3), quadrature(n, 3)
    complex(wp), intent(in) :: t(3, 3)
    complex(wp) :: old(n, 3), mixed(n, 3)

    old = cmplx(part, quadrature, wp)
    mixed = matmul(old, t)
    part = real(mixed)
    quadrature = aimag(mixed)
  end subroutine mix_one

  !> Number of differences between two samples.
  integer function differences(first, second)
    type(sample_t), intent(in) :: first, second
    type(differences_t) :: found
    type(string_t) :: everything(0)
    type(error_t), allocatable :: error

    call write_sample(scratch("first.h5"), first)
    call write_sample(scratch("second.h5"), second)
    call compare_files(scratch("first.h5"), scratch("second.h5"), tolerance_t(), everything, &
                       found, error)
    call expect(.not. allocated(error), "both files can be read")
    differences = int(found%all)
  end function differences

  subroutine test_phase()
    type(sample_t) :: first, second
    real(wp) :: angle
    integer :: k

    call new_complex_sample(first)
    call expect(differences(first, first) == 0, "equal files")
    do k = 1, 7
      angle = 0.9_wp*k
      second = first
      call mix(second, reshape([exp(i*angle), none, none, none, -one, none, none, none, i], [3, 3]))
      call expect(differences(first, second) == 0, "turned in phase")
    end do
  end subroutine test_phase

  !> The size counts, the sense in which a point circles, a mode of the same frequency and other
  !> damping, and each entry of either part.
  subroutine test_other()
    type(sample_t) :: first, second

    call new_complex_sample(first)
    second = first
    call mix(second, reshape([1.001_wp*i, none, none, none, one, none, none, none, one], [3, 3]))
    call expect(differences(first, second) > 0, "the size")
    second = first
    second%modes%quadrature%displacement(:, :, 1) = -first%modes%quadrature%displacement(:, :, 1)
    call expect(differences(first, second) > 0, "the other way round")
    second = first
    call mix(second, reshape([0.6_wp*one, 0.8_wp*i, none, 0.8_wp*i, 0.6_wp*one, none, &
                              none, none, one], [3, 3]))
    call expect(differences(first, second) > 0, "modes of equal frequencies and other dampings")
    second = first
    call mix(second, reshape([i, none, none, none, one, none, none, none, one], [3, 3]))
    second%modes%quadrature%stress(3, 2, 1) = second%modes%quadrature%stress(3, 2, 1) + 0.01_wp
    call expect(differences(first, second) == 1, "an imaginary part of a turned mode")
    second%modes%stress(3, 2, 1) = second%modes%stress(3, 2, 1) + 0.01_wp
    call expect(differences(first, second) == 2, "and a real one")
  end subroutine test_other

  !> A unitary mixture of two is accepted, not one with 1e-3 of the third.
  subroutine test_complex_double()
    type(sample_t) :: first, second
    complex(wp) :: t(3, 3)

    call new_complex_sample(first)
    first%modes%lambda(2) = first%modes%lambda(1)*(1 + 1.0e-12_wp)
    second = first
    t = reshape([0.6_wp*one, 0.8_wp*i, none, 0.8_wp*i, 0.6_wp*one, none, none, none, one], [3, 3])
    call mix(second, t)
    call expect(differences(first, second) == 0, "another basis")
    second = first
    t(3, 2) = 1.0e-3_wp
    call mix(second, t)
    call expect(differences(first, second) > 0, "another space")
  end subroutine test_complex_double

  !> Where the last mode is one of more, any shape is right, not that of the modes before.
  subroutine test_cut()
    type(sample_t) :: first, second

    call new_sample(first)
    second = first
    second%modes%displacement(:, :, 3) = first%modes%displacement(:, :, 2)
    second%modes%strain(:, :, 3) = first%modes%strain(:, :, 2)
    call expect(differences(first, second) > 0, "another shape of the last mode")
    first%modes%cut = [.false., .true.]
    second%modes%cut = first%modes%cut
    call expect(differences(first, second) == 0, "one of a cluster that is cut")
    second%modes%strain(1, 1, 2) = second%modes%strain(1, 1, 2) + 0.01_wp
    call expect(differences(first, second) == 1, "the mode before it")
    second = first
    second%modes%eigenvalue(3) = second%modes%eigenvalue(3)*(1 + 1.0e-4_wp)
    call expect(differences(first, second) == 1, "its eigenvalue")
  end subroutine test_cut

  !> A turned basis prints the same, its frequency and the modes beside it are printed.
  subroutine test_digest()
    type(sample_t) :: sample
    type(outcome_t) :: first, second
    complex(wp) :: t(3, 3)

    call new_complex_sample(sample)
    t = reshape([0.6_wp*one, 0.8_wp*i, none, 0.8_wp*i, 0.6_wp*one, none, none, none, one], [3, 3])
    call digest_both()
    call expect(first%output /= second%output, "modes of different eigenvalues")
    call expect(index(first%output, "others have") == 0, "have a shape")
    call new_complex_sample(sample)
    sample%modes%lambda(2) = sample%modes%lambda(1)
    sample%modes%strain(1, 2, 3) = 1.234567e-7_wp
    call digest_both()
    call expect(first%output == second%output, "modes of one eigenvalue")
    call expect(index(first%output, "strain 9 8"//newline// &
                      "  mode 1: others have its eigenvalue"//newline// &
                      "  mode 2: others have its eigenvalue"//newline//"  ") > 0, "say so")
    sample%modes%strain(:, :, 1:2) = 20*sample%modes%strain(:, :, 1:2)
    call write_sample(scratch("digest.h5"), sample)
    call run_spar("digest "//scratch("digest.h5"), second)
    call expect(first%output == second%output, "they are no measure of others' round-off")
    sample%modes%strain(1, 1, 3) = 2*sample%modes%strain(1, 1, 3)
    call write_sample(scratch("digest.h5"), sample)
    call run_spar("digest "//scratch("digest.h5"), second)
    call expect(first%output /= second%output, "the mode beside them is printed")

  contains

    subroutine digest_both()
      call write_sample(scratch("digest.h5"), sample)
      call run_spar("digest "//scratch("digest.h5"), first)
      call mix(sample, t)
      call write_sample(scratch("digest.h5"), sample)
      call run_spar("digest "//scratch("digest.h5"), second)
      call expect(first%status == 0 .and. second%status == 0, "status 0")
    end subroutine digest_both
  end subroutine test_digest

  !> Of a round cantilever all that bends is double, real or damped, in vibrations, under a load and
  !> a torque of either sense; two masses in space have five free motions.
  subroutine test_cut_said()
    character(len=*), parameter :: rod = &
      "MATERIAL m E 1 G 1e4 RHO 1"//newline// &
      "SECTION s CONSTANTS A 100 IY 1 IZ 1 IT 1"//newline// &
      "NODE 1 0 0 0"//newline//"NODE 2 100 0 0"//newline// &
      "BEAMW 1 1 2 0 1 0 SECTION s MATERIAL m DIVIDE 4"//newline//"FIX 1"//newline// &
      "SET n 1"//newline
    character(len=*), parameter :: column = &
      "DAMP 0.001 0"//newline//"EIGEN MODES {n}"//newline// &
      "EIGEN MODES {n} DAMPED"//newline//"XF 2 -1 0 0"//newline//"BUCKLING MODES {n}"//newline
    character(len=*), parameter :: torque = &
      "XF 2 0 0 0 1 0 0"//newline//"BUCKLING MODES {n}"//newline
    character(len=*), parameter :: pair = &
      "NODE 1 0 0 0"//newline//"NODE 2 2 0 0"//newline//"TRUSS 1 1 2"//newline// &
      "DYNE 1 1"//newline//"ESTIFF 1 100"//newline//"EDAMP 1 1"//newline//"XM 1 2"//newline// &
      "XM 2 3"//newline//"SET n 1"//newline//"EIGEN MODES {n}"//newline// &
      "EIGEN MODES {n} DAMPED"//newline
    integer :: k

    call make_file(scratch("column.deck"), rod//column)
    call make_file(scratch("torque.deck"), rod//torque)
    call make_file(scratch("pair.deck"), pair)
    do k = 1, 4
      call run_deck("column", k)
      call expect_cut("01_eigen", [.false., modulo(k, 2) == 1])
      call expect_cut("02_eigen", [.false., modulo(k, 2) == 1])
      call expect_cut("03_buckling", [.false., modulo(k, 2) == 1])
      call run_deck("torque", k)
      call expect_cut("01_buckling", [modulo(k, 2) == 1, modulo(k, 2) == 1])
    end do
    do k = 3, 6
      call run_deck("pair", k)
      call expect_cut("01_eigen", [.false., k < 5])
      call expect_cut("02_eigen", [.false., k < 5])
    end do
  end subroutine test_cut_said

  subroutine run_deck(name, modes)
    character(len=*), intent(in) :: name
    integer, intent(in) :: modes
    type(outcome_t) :: outcome
    character(len=1) :: digit

    write (digit, "(i1)") modes
    call run_spar("run "//scratch(name//".deck")//" --quiet --no-vtk -D n="//digit//" -o "// &
                  scratch("cut.h5"), outcome)
    call expect(outcome%status == 0, name//" with "//digit//" modes: "//outcome%errors)
  end subroutine run_deck

  !> Whether the clusters of the first and of the last mode are cut.
  subroutine expect_cut(analysis, cut)
    character(len=*), intent(in) :: analysis
    logical, intent(in) :: cut(2)
    type(reader_t) :: reader
    type(error_t), allocatable :: error
    integer :: first, last

    call reader%open(scratch("cut.h5"), error)
    call reader%get_number("/analysis/"//analysis, "cut_first", first)
    call reader%get_number("/analysis/"//analysis, "cut_last", last)
    call reader%close()
    call expect(first == merge(1, 0, cut(1)), analysis//": the first")
    call expect(last == merge(1, 0, cut(2)), analysis//": the last")
  end subroutine expect_cut

end module test_mode_clusters
