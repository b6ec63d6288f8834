!> The datasets of /VTKHDF as VTK's readers want them: a mesh, sets of points, and fields of all
!> steps one behind the other, with where a step's part of each begins.
module output_fields
  use hdf5, only: h5lcreate_hard_f
  use kinds, only: wp, sp, i8
  use output_hdf5, only: hdf5_file_t, about_t
  use output_arrays, only: write_longs, write_bytes, set_longs, set_ascii
  use output_tables, only: table_t
  use beam_mesh, only: mesh_t
  implicit none
  private

  public :: field_writer_t

  character(len=*), parameter :: root = "VTKHDF", steps_group = root//"/Steps"

  !> Tables of long whole numbers, a row for each step.
  integer, parameter :: part_offsets = 1, parts = 2, point_offsets = 3, cell_offsets = 4, &
                        field_offsets = 5, cell_field_offsets = 6, longs = 6

  !> Points gathered before they are written: files of small models would rather wait for the disk.
  integer, parameter :: gathered_points = 16384

  type :: field_writer_t
    private
    logical :: stressed = .false.               !< there are stresses
    integer :: points = 0, cells = 0            !< of the mesh
    integer :: steps = 0                        !< written
    integer :: pending = 0, most_pending = 1    !< gathered
    integer(i8), public :: point_sets = 1       !< written: undeformed, then about which modes are
    real(sp), allocatable :: motion(:, :), turn(:, :)   !< (3, points gathered)
    real(sp), allocatable :: stress(:), force(:, :)     !< (points), (7, cells gathered)
    integer(i8), allocatable :: entry(:, :), origin(:, :)   !< (steps gathered, longs), (2, steps)
    type(table_t) :: point_table, values, origin_table, long(longs), &
                     motion_table, turn_table, stress_table, force_table
  contains
    procedure :: start
    procedure :: add_points
    procedure :: add_step
    procedure :: write_pending
  end type field_writer_t

contains

  !> Write the mesh and make the tables of about `steps` steps.
  subroutine start(self, file, mesh, steps, stressed, moved)
    class(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(mesh_t), intent(in) :: mesh
    integer(i8), intent(in) :: steps
    logical, intent(in) :: stressed           !< a section has an outline
    logical, intent(in) :: moved              !< there may be more than one set of points

    self%stressed = stressed
    self%points = size(mesh%position, 2)
    self%cells = size(mesh%kind)
    self%most_pending = int(max(1_i8, min(steps, int(gathered_points/self%points, i8))))
    associate (points => self%points*self%most_pending, cells => self%cells*self%most_pending)
      allocate (self%motion(3, points), self%turn(3, points), self%stress(points), &
                self%force(7, cells))
    end associate
    allocate (self%entry(self%most_pending, longs), self%origin(2, self%most_pending))
    call write_head(file)
    call write_mesh(self, file, mesh)
    call start_fields(self, file, steps)
    call start_steps(self, file, steps, moved)
  end subroutine start

  !> The group and its attributes: the type is plain ASCII, the version long whole numbers.
  subroutine write_head(file)
    type(hdf5_file_t), intent(inout) :: file

    call file%group(root)
    call file%group(steps_group)
    call file%group(root//"/PointData")
    call file%group(root//"/CellData")
    call file%group(steps_group//"/PointDataOffsets")
    call file%group(steps_group//"/CellDataOffsets")
    call file%set_number(steps_group, "NSteps", 0)
    call set_longs(file, root, "Version", [2, 0])
    call set_ascii(file, root, "Type", "UnstructuredGrid")
  end subroutine write_head

  subroutine write_mesh(self, file, mesh)
    type(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    type(mesh_t), intent(in) :: mesh

    call write_longs(file, root//"/NumberOfPoints", [self%points])
    call write_longs(file, root//"/NumberOfCells", [self%cells])
    call write_longs(file, root//"/NumberOfConnectivityIds", [size(mesh%corners)])
    call write_longs(file, root//"/Connectivity", mesh%corners)
    call write_longs(file, root//"/Offsets", mesh%offset)
    call write_bytes(file, root//"/Types", mesh%kind)
    call self%point_table%start_reals(file, root//"/Points", int(self%points, i8), &
      about_t("L", "point; X Y Z", "positions of the undeformed model"), 3)
    call self%point_table%append(file, mesh%position)
  end subroutine write_mesh

  !> Fields in single precision, for eyes; what is gathered is a piece of them.
  subroutine start_fields(self, file, steps)
    type(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(in) :: steps

    associate (points => steps*self%points, cells => steps*self%cells, &
               point_piece => size(self%motion, 2), cell_piece => size(self%force, 2))
      call self%motion_table%start_singles(file, root//"/PointData/displacement", points, &
        about_t("L", "step*point; X Y Z", "from Points; of modes as in /analysis"), 3, point_piece)
      call self%turn_table%start_singles(file, root//"/PointData/rotation", points, &
        about_t("1", "step*point; X Y Z", "rotation vector of the section in radians"), 3, &
        point_piece)
      if (self%stressed) call self%stress_table%start_singles(file, &
        root//"/PointData/axial_stress", points, about_t("FL-2", "step*point", &
        "from section forces linear along the beam; of modes too"), piece=point_piece)
      call self%force_table%start_singles(file, root//"/CellData/section_force", cells, &
        about_t("F F F FL FL FL FL2", "step*cell; N Vy Vz T My Mz B", &
                "linear along the beam; of modes to first order, of critical points 0"), 7, &
        cell_piece)
    end associate
  end subroutine start_fields

  !> Tables with a row for each step. VTK wants to know where in the tables a step's rows begin.
  subroutine start_steps(self, file, steps, moved)
    type(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(in) :: steps
    logical, intent(in) :: moved

    call self%values%start_reals(file, steps_group//"/Values", steps, &
      about_t("1", "step", "number of the step, from 1"))
    call self%origin_table%start_longs(file, steps_group//"/Origin", steps, &
      about_t("1", "step; analysis row", "number of the group in /analysis; of the state or"// &
              " mode in it, from 0; -1, -2, ... for critical/0001, ..."), 2)
    call start_long(self, file, part_offsets, "PartOffsets", steps)
    call start_long(self, file, parts, "NumberOfParts", steps)
    if (moved) then
      call start_long(self, file, point_offsets, "PointOffsets", steps)
    else
      call link(file, "PartOffsets", "PointOffsets")
    end if
    call start_long(self, file, cell_offsets, "CellOffsets", steps, 1)
    call start_long(self, file, field_offsets, "PointDataOffsets/displacement", steps)
    call start_long(self, file, cell_field_offsets, "CellDataOffsets/section_force", steps)
    call link(file, "CellOffsets", "ConnectivityIdOffsets")
    call link(file, "PointDataOffsets/displacement", "PointDataOffsets/rotation")
    if (self%stressed) call link(file, "PointDataOffsets/displacement", &
                                 "PointDataOffsets/axial_stress")
  end subroutine start_steps

  subroutine start_long(self, file, which, name, steps, columns)
    type(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: which
    character(len=*), intent(in) :: name
    integer(i8), intent(in) :: steps
    integer, intent(in), optional :: columns

    call self%long(which)%start_longs(file, steps_group//"/"//name, steps, columns=columns)
  end subroutine start_long

  !> A second name of a dataset.
  subroutine link(file, old, new)
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: old, new
    integer :: status

    if (allocated(file%failure)) return
    call h5lcreate_hard_f(file%id, steps_group//"/"//old, file%id, steps_group//"/"//new, status)
    call file%check(status, "h5lcreate_hard_f")
  end subroutine link

  !> Points of a deformed state, for steps about it; `set`: their number.
  subroutine add_points(self, file, points, set)
    class(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    real(wp), intent(in), contiguous :: points(:, :)
    integer(i8), intent(out) :: set

    call self%point_table%append(file, points)
    set = self%point_sets
    self%point_sets = set + 1
  end subroutine add_points

  !> A step: its fields, and where its rows begin in the tables.
  subroutine add_step(self, file, origin, set, motion, turn, stress, force)
    class(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: origin(2)              !< number of the analysis, row in it from 0
    integer(i8), intent(in) :: set                !< of points
    real(wp), intent(in), contiguous :: motion(:, :), turn(:, :)   !< (3, points)
    real(sp), intent(in), contiguous :: stress(:), force(:, :)     !< (points), (7, cells)
    integer(i8) :: before

    associate (points => self%points, cells => self%cells, k => self%pending)
      call to_single(3*points, motion, self%motion(:, k*points + 1:))
      call to_single(3*points, turn, self%turn(:, k*points + 1:))
      self%stress(k*points + 1:(k + 1)*points) = stress
      self%force(:, k*cells + 1:(k + 1)*cells) = force
    end associate
    before = self%steps + self%pending
    self%pending = self%pending + 1
    self%entry(self%pending, :) = [0_i8, 1_i8, set*self%points, 0_i8, before*self%points, &
                                   before*self%cells]
    self%origin(:, self%pending) = origin
    if (self%pending == self%most_pending) call write_pending(self, file)
  end subroutine add_step

  !> The same numbers, as they lie in memory.
  pure subroutine to_single(n, numbers, single)
    integer, intent(in) :: n
    real(wp), intent(in) :: numbers(n)
    real(sp), intent(out) :: single(n)

    single = real(numbers, sp)
  end subroutine to_single

  !> Write what was gathered; the count of steps comes last, when all they need is there.
  subroutine write_pending(self, file)
    class(field_writer_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer :: i

    if (self%pending == 0) return
    associate (points => self%pending*self%points, cells => self%pending*self%cells)
      call self%motion_table%append(file, self%motion(:, :points))
      call self%turn_table%append(file, self%turn(:, :points))
      call self%stress_table%append(file, self%stress(:points))
      call self%force_table%append(file, self%force(:, :cells))
    end associate
    do i = 1, longs
      call self%long(i)%append(file, self%entry(:self%pending, i))
    end do
    call self%origin_table%append(file, self%origin(:, :self%pending))
    call self%values%append(file, [(real(self%steps + i, wp), i=1, self%pending)])
    self%steps = self%steps + self%pending
    self%pending = 0
    call file%set_number(steps_group, "NSteps", self%steps)
  end subroutine write_pending

end module output_fields
