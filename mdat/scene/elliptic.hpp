// Elliptic integrals and functions of real arguments. The parameter m = k^2 is given by its complement, m1 = 1 - m in (0, 1], and angles
// by sine and cosine, so that nothing is lost where m is near 1 and the angle near a quarter turn.
#pragma once

#include "fsw/geometry/portable_math.hpp"

namespace lasso::mdat::scene {

// An angle: whole half turns, and a rest within a quarter turn on both sides (its cosine is not negative).
struct Amplitude {
  double half_turns = 0;
  SinCos rest{0, 1};
};
Amplitude to_amplitude(double sine, double cosine);  // within half a turn; of unit length together
SinCos whole_angle(const Amplitude& amplitude);

// Jacobi's am(u | m), any u: sn and cn are its sine and cosine. It grows by half a turn in 2 K(m).
Amplitude jacobi_amplitude(double u, double m1);

// First kind, F(amplitude | m), and third kind with a characteristic n <= 0: the integral of
// 1 / ((1 - n sin^2 a) sqrt(1 - m sin^2 a)) da from 0 to the amplitude. Relative error about 1e-14.
double elliptic_first(const Amplitude& amplitude, double m1);
double elliptic_third(double n, const Amplitude& amplitude, double m1);

}  // namespace lasso::mdat::scene
