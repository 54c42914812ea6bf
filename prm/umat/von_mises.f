! Copyright (C) 2026 by the geocone authors
! SPDX-License-Identifier: LGPL-2.1-or-later
!
! A UMAT in Fortran: von Mises' law, without hardening.
!
!   PROPS  = E (Pa), nu, c (Pa), the strength in pure shear
!   STATEV = none
!
!   gfortran -O2 -shared -fPIC -o von_mises.so von_mises.f
      subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl,
     &  ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp,
     &  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props,
     &  nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel,
     &  npt, layer, kspt, jstep, kinc)
      implicit real*8 (a-h, o-z)
      character*80 cmname
      dimension stress(ntens), statev(nstatv), ddsdde(ntens, ntens),
     &  ddsddt(ntens), drplde(ntens), stran(ntens), dstran(ntens),
     &  time(2), predef(1), dpred(1), props(nprops), coords(3),
     &  drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), jstep(4)
      dimension t(6)

      g2 = props(1)/(1.d0 + props(2))
      el = g2*props(2)/(1.d0 - 2.d0*props(2))
      radius = sqrt(2.d0)*props(3)
      ddsdde = 0.d0
      do i = 1, ndi
        do j = 1, ndi
          ddsdde(i, j) = el
        end do
        ddsdde(i, i) = el + g2
      end do
      do i = ndi + 1, ntens
        ddsdde(i, i) = g2/2.d0
      end do
      stress = stress + matmul(ddsdde, dstran)

      pressure = sum(stress(1:ndi))/3.d0
      square = 0.d0
      do i = 1, ntens
        if (i <= ndi) then
          t(i) = stress(i) - pressure
          square = square + t(i)**2
        else
          t(i) = stress(i)
          square = square + 2.d0*t(i)**2
        end if
      end do
      if (square <= radius**2) return

      part = radius/sqrt(square)
      ddsdde = 0.d0
      do i = 1, ntens
        stress(i) = part*t(i)
        do j = 1, ntens
          ddsdde(i, j) = -g2*part*t(i)*t(j)/square
        end do
      end do
      do i = 1, ndi
        stress(i) = stress(i) + pressure
        do j = 1, ndi
          ddsdde(i, j) = ddsdde(i, j) + el + g2*(1.d0 - part)/3.d0
        end do
        ddsdde(i, i) = ddsdde(i, i) + g2*part
      end do
      do i = ndi + 1, ntens
        ddsdde(i, i) = ddsdde(i, i) + part*g2/2.d0
      end do
      end
