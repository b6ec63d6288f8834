!> Datasets that grow by rows while an analysis runs.
!>
!> A table keeps what is appended until its block is full, by default one append: many small writes
!> cost more than a large one. What is appended to a table that was not started is ignored.
module output_tables
  use, intrinsic :: iso_fortran_env, only: i1 => int8
  use, intrinsic :: iso_c_binding, only: c_ptr, c_loc, c_size_t
  use hdf5, only: hid_t, hsize_t, size_t, h5pset_chunk_f, h5pset_chunk_cache_f, &
                  h5screate_simple_f, h5sclose_f, h5dcreate_f, &
                  h5dset_extent_f, h5dget_space_f, h5dwrite_f, h5dclose_f, &
                  h5sselect_hyperslab_f, h5s_select_set_f, h5s_unlimited_f, h5t_native_double, &
                  h5t_native_integer, h5t_ieee_f64le, h5t_ieee_f32le, h5t_std_i32le, &
                  h5t_std_i64le, h5t_native_real, h5kind_to_type, h5_integer_kind, &
                  h5tget_size_f
  use kinds, only: wp, sp, i8
  use errors, only: fail, exit_io
  use output_interfaces, only: c_memcpy
  use output_hdf5, only: hdf5_file_t, about_t
  use output_slab, only: read_slab
  implicit none
  private

  public :: table_t

  integer, parameter :: bytes_of_real = 8
  integer(hsize_t), parameter :: growth = 32768  !< bytes by which a dataset grows, at most

  !> Pieces kept in memory, of which only the last is needed: little memory for many datasets.
  integer(size_t), parameter :: slots = 31, kept = 4*growth

  integer(i8), parameter :: copied_bytes = 2_i8**21   !< at once, about

  type :: table_t
    private
    character(len=:), allocatable, public :: path
    integer(hid_t) :: dataset = 0           !< 0: not started
    integer(hid_t) :: given = 0             !< type in memory
    integer :: width = 0                    !< bytes of a row in memory
    integer :: rank = 1
    integer(hsize_t) :: columns = 1
    integer(hsize_t) :: rows = 0            !< in the file
    integer :: block = 1, appends = 0       !< written together, and of them in `buffer`
    integer :: kept_rows = 0                !< in `buffer`
    integer(i8) :: expected = 0             !< rows, when it was started
    integer(i1), allocatable :: buffer(:)
  contains
    procedure :: gather
    procedure :: copy
    procedure :: write => write_kept
    procedure :: start_integers
    procedure :: start_reals
    procedure :: start_singles
    procedure :: start_longs
    procedure, private :: append_integer, append_longs, append_long_table, append_real, &
      append_reals, append_real_table, append_singles, append_single_table
    generic :: append => append_integer, append_longs, append_long_table, append_real, &
      append_reals, append_real_table, append_singles, append_single_table
    procedure :: finish
  end type table_t

contains

  !> A list of whole numbers; about `rows` are expected.
  subroutine start_integers(self, file, path, rows, about)
    class(table_t), intent(out) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(i8), intent(in) :: rows
    type(about_t), intent(in) :: about

    call start(self, file, path, h5t_std_i32le, h5t_native_integer, rows, about)
  end subroutine start_integers

  !> A list of reals or, with `columns`, a table; about `rows` rows are expected.
  subroutine start_reals(self, file, path, rows, about, columns)
    class(table_t), intent(out) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(i8), intent(in) :: rows
    type(about_t), intent(in) :: about
    integer, intent(in), optional :: columns

    if (present(columns)) then
      self%rank = 2
      self%columns = columns
    end if
    call start(self, file, path, h5t_ieee_f64le, h5t_native_double, rows, about)
  end subroutine start_reals

  !> The same in single precision; with `piece`, appends come in pieces of about so many rows and
  !> are written straight to the file.
  subroutine start_singles(self, file, path, rows, about, columns, piece)
    class(table_t), intent(out) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(i8), intent(in) :: rows
    type(about_t), intent(in) :: about
    integer, intent(in), optional :: columns, piece

    if (present(columns)) then
      self%rank = 2
      self%columns = columns
    end if
    call start(self, file, path, h5t_ieee_f32le, h5t_native_real, rows, about, piece)
  end subroutine start_singles

  !> A list of long whole numbers or, with `columns`, a table.
  subroutine start_longs(self, file, path, rows, about, columns)
    class(table_t), intent(out) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(i8), intent(in) :: rows
    type(about_t), intent(in), optional :: about
    integer, intent(in), optional :: columns

    if (present(columns)) then
      self%rank = 2
      self%columns = columns
    end if
    call start(self, file, path, h5t_std_i64le, h5kind_to_type(i8, h5_integer_kind), rows, &
               about)
  end subroutine start_longs

  subroutine start(self, file, path, type, given, rows, about, piece)
    type(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    character(len=*), intent(in) :: path
    integer(hid_t), intent(in) :: type, given   !< in the file and in memory
    integer(i8), intent(in) :: rows
    type(about_t), intent(in), optional :: about
    integer, intent(in), optional :: piece
    integer(hsize_t) :: largest(2)
    integer(size_t) :: bytes
    integer(hid_t) :: list, space
    integer :: status

    if (allocated(file%failure)) return
    call h5tget_size_f(given, bytes, status)
    self%given = given
    self%width = int(self%columns*bytes)
    self%expected = rows
    self%path = path
    list = file%table_list
    if (present(piece)) list = file%piece_list
    call set_storage(self, file, list, piece)
    largest = [self%columns, h5s_unlimited_f]
    associate (extents => [self%columns, 0_hsize_t])
      call h5screate_simple_f(self%rank, extents(3 - self%rank:), space, status, &
                              largest(3 - self%rank:))
    end associate
    call file%check(status, "h5screate_simple_f")
    call h5dcreate_f(file%id, path, type, space, self%dataset, status, &
                     dcpl_id=list, dapl_id=file%table_access)
    call file%check(status, "h5dcreate_f")
    if (status < 0) self%dataset = 0
    call h5sclose_f(space, status)
    if (present(about) .and. .not. allocated(file%failure)) then
      call file%describe(self%dataset, about)
    end if
  end subroutine start

  !> Datasets grow by chunks. Those of a `piece` need no memory: what is written at once fills them.
  subroutine set_storage(self, file, list, piece)
    type(table_t), intent(in) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(hid_t), intent(in) :: list       !< how the dataset is created
    integer, intent(in), optional :: piece   !< rows
    integer(hsize_t) :: chunk(2)
    integer :: status

    chunk = [self%columns, growth/(bytes_of_real*self%columns)]
    if (present(piece)) chunk(2) = piece
    chunk(2) = max(1_hsize_t, min(int(self%expected, hsize_t), chunk(2)))
    call h5pset_chunk_f(list, self%rank, chunk(3 - self%rank:), status)
    call file%check(status, "h5pset_chunk_f")
    call h5pset_chunk_cache_f(file%table_access, slots, merge(0_size_t, kept, present(piece)), &
                              1.0, status)
    call file%check(status, "h5pset_chunk_cache_f")
  end subroutine set_storage

  subroutine append_integer(self, file, value)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: value
    integer, target :: buffer

    buffer = value
    call append_rows(self, file, 1, c_loc(buffer))
  end subroutine append_integer

  !> Rows of a list or, with one column, of a table.
  subroutine append_longs(self, file, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(in), contiguous, target :: values(:)

    if (size(values) > 0) call append_rows(self, file, size(values), c_loc(values))
  end subroutine append_longs

  !> Rows of a table.
  subroutine append_long_table(self, file, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(i8), intent(in), contiguous, target :: values(:, :)   !< (columns, rows)

    if (size(values) > 0) call append_rows(self, file, size(values, 2), c_loc(values))
  end subroutine append_long_table

  subroutine append_real(self, file, value)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    real(wp), intent(in) :: value
    real(wp), target :: buffer

    buffer = value
    call append_rows(self, file, 1, c_loc(buffer))
  end subroutine append_real

  !> Rows of a list.
  subroutine append_reals(self, file, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    real(wp), intent(in), contiguous, target :: values(:)

    if (size(values) > 0) call append_rows(self, file, size(values), c_loc(values))
  end subroutine append_reals

  !> Rows of a table.
  subroutine append_real_table(self, file, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    real(wp), intent(in), contiguous, target :: values(:, :)   !< (columns, rows)

    if (size(values) > 0) call append_rows(self, file, size(values, 2), c_loc(values))
  end subroutine append_real_table

  !> Rows of a list.
  subroutine append_singles(self, file, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    real(sp), intent(in), contiguous, target :: values(:)

    if (size(values) > 0) call append_rows(self, file, size(values), c_loc(values))
  end subroutine append_singles

  !> Rows of a table.
  subroutine append_single_table(self, file, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    real(sp), intent(in), contiguous, target :: values(:, :)   !< (columns, rows)

    if (size(values) > 0) call append_rows(self, file, size(values, 2), c_loc(values))
  end subroutine append_single_table

  !> Write together what `block` appends bring; other tables of the same block stay in step.
  subroutine gather(self, block)
    class(table_t), intent(inout) :: self
    integer, intent(in) :: block

    self%block = block
  end subroutine gather

  subroutine append_rows(self, file, rows, values)
    type(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: rows
    type(c_ptr), intent(in) :: values

    if (self%dataset == 0 .or. allocated(file%failure)) return
    if (self%block == 1) then
      call write_rows(self, file, rows, values)
    else
      call keep_rows(self, rows, values)
      if (self%appends == self%block) call write_kept(self, file)
    end if
  end subroutine append_rows

  !> Put rows behind those in memory; the room is for the rest of the block, if they are all alike.
  subroutine keep_rows(self, rows, values)
    type(table_t), intent(inout), target :: self
    integer, intent(in) :: rows
    type(c_ptr), intent(in) :: values
    integer(i1), allocatable :: more(:)
    integer(i8) :: from, last
    type(c_ptr) :: ignored

    from = int(self%kept_rows, i8)*self%width
    last = from + int(rows, i8)*self%width
    if (.not. allocated(self%buffer)) allocate (self%buffer(0))
    if (last > size(self%buffer, kind=i8)) then
      allocate (more(from + (self%block - self%appends)*(last - from)))
      more(:from) = self%buffer(:from)
      call move_alloc(more, self%buffer)
    end if
    ignored = c_memcpy(c_loc(self%buffer(from + 1)), values, int(last - from, c_size_t))
    self%appends = self%appends + 1
    self%kept_rows = self%kept_rows + rows
  end subroutine keep_rows

  !> Write what is kept, block full or not.
  subroutine write_kept(self, file)
    class(table_t), intent(inout), target :: self
    type(hdf5_file_t), intent(inout) :: file

    if (self%kept_rows > 0) call write_rows(self, file, self%kept_rows, c_loc(self%buffer))
    self%appends = 0
    self%kept_rows = 0
  end subroutine write_kept

  subroutine write_rows(self, file, rows, values)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer, intent(in) :: rows
    type(c_ptr), intent(in) :: values
    integer(hsize_t) :: first(2), added(2)
    integer(hid_t) :: in_memory, in_file
    integer :: status, k

    if (allocated(file%failure)) return
    k = 3 - self%rank
    first = [0_hsize_t, self%rows]
    added = [self%columns, int(rows, hsize_t)]
    self%rows = self%rows + rows
    associate (extents => first + added)
      call h5dset_extent_f(self%dataset, extents(k:), status)
    end associate
    call file%check(status, "h5dset_extent_f")
    call h5dget_space_f(self%dataset, in_file, status)
    call file%check(status, "h5dget_space_f")
    call h5sselect_hyperslab_f(in_file, h5s_select_set_f, first(k:), added(k:), status)
    call file%check(status, "h5sselect_hyperslab_f")
    call h5screate_simple_f(self%rank, added(k:), in_memory, status)
    call file%check(status, "h5screate_simple_f")
    if (.not. allocated(file%failure)) call h5dwrite_f(self%dataset, self%given, values, &
                                                       status, in_memory, in_file)
    call file%check(status, "h5dwrite_f")
    call h5sclose_f(in_memory, status)
    call h5sclose_f(in_file, status)
  end subroutine write_rows

  !> Begin with what the same table of another file begins with: of `appends` appends, of which
  !> as many were `expected` as rows when it was started.
  subroutine copy(self, file, source, path, appends, expected)
    class(table_t), intent(inout), target :: self
    type(hdf5_file_t), intent(inout) :: file
    integer(hid_t), intent(in) :: source        !< the other file
    character(len=*), intent(in) :: path        !< of the dataset in it
    integer, intent(in) :: appends
    integer(i8), intent(in) :: expected
    integer(i8) :: rows, done, part
    integer :: status

    if (self%dataset == 0 .or. allocated(file%failure)) return
    rows = appends*(self%expected/expected)
    done = 0
    do while (done < rows)
      part = min(rows - done, max(1_i8, copied_bytes/self%width))
      allocate (self%buffer(part*self%width))
      call read_slab(source, path, self%given, int(self%columns), done, part, c_loc(self%buffer), &
                     status)
      if (status < 0) call fail(file%failure, exit_io, "cannot go on with '"//path// &
                                "': it does not fit the deck, or is not whole")
      call write_rows(self, file, int(part), c_loc(self%buffer))
      deallocate (self%buffer)
      done = done + part
    end do
    self%appends = modulo(appends, self%block)
  end subroutine copy

  !> Write what is kept and close the dataset.
  subroutine finish(self, file)
    class(table_t), intent(inout) :: self
    type(hdf5_file_t), intent(inout) :: file
    integer :: status

    if (self%dataset == 0 .or. allocated(file%failure)) return
    call self%write(file)
    call h5dclose_f(self%dataset, status)
    self%dataset = 0
    call file%check(status, "h5dclose_f")
  end subroutine finish

end module output_tables
