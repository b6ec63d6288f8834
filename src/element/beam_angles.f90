!> f(c) = arccos(c)/sqrt(1 - c**2): from the sine of an angle to the angle (theory 5 a).
module beam_angles
  use kinds, only: wp
  implicit none
  private

  public :: angle_ratio

  !> f = sum a(n) u**n with u = 1 - c, a(0) = 1, a(n+1) = a(n) (n+1)/(2n+3): the terms behind the
  !> last are below round-off for u < 0.05 in f, f' and f''.
  integer, parameter :: terms = 14
  integer :: n_
  real(wp), parameter :: a(0:terms) = [1.0_wp, 1.0_wp/3, 2.0_wp/15, 2.0_wp/35, 8.0_wp/315, &
    8.0_wp/693, 16.0_wp/3003, 16.0_wp/6435, 128.0_wp/109395, 128.0_wp/230945, 256.0_wp/969969, &
    256.0_wp/2028117, 1024.0_wp/16900975, 1024.0_wp/35102025, 2048.0_wp/145422675]
  real(wp), parameter :: a1(terms) = [(-n_*a(n_), n_=1, terms)]
  real(wp), parameter :: a2(2:terms) = [(n_*(n_ - 1)*a(n_), n_=2, terms)]

contains

  !> f and its first two derivatives with respect to c, for -1 < c <= 1.
  pure subroutine angle_ratio(c, f, df, ddf)
    real(wp), intent(in) :: c
    real(wp), intent(out) :: f, df, ddf
    real(wp) :: u, s2
    integer :: i

    u = 1 - c
    if (u < 0.05_wp) then
      f = a(terms)
      df = a1(terms)
      ddf = a2(terms)
      do i = terms - 1, 2, -1
        f = a(i) + u*f
        df = a1(i) + u*df
        ddf = a2(i) + u*ddf
      end do
      f = a(0) + u*(a(1) + u*f)
      df = a1(1) + u*df
    else
      s2 = (1 - c)*(1 + c)
      f = acos(c)/sqrt(s2)
      df = (c*f - 1)/s2
      ddf = (f + 3*c*df)/s2
    end if
  end subroutine angle_ratio

end module beam_angles
