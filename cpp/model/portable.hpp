#pragma once

#include <sleef.h>

#include <numbers>

/// Elementary functions that are the same, to the last digit, whatever instructions the processor has. The C
/// library chooses its own by whether it can multiply and add at once. These are SLEEF's deterministic ones
/// without that instruction (Shibata, Petrogalli, IEEE Trans. Parallel Distrib. Syst. 31, 1316 (2020),
/// doi:10.1109/TPDS.2019.2960333), within 1 unit in the last place, or 3.5 where it says so.
namespace portable {

inline double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
inline double expm1(double x) { return Sleef_cinz_expm1d1_u10purec(x); }
inline double log(double x) { return Sleef_cinz_logd1_u35purec(x); }  // 3.5
inline double log1p(double x) { return Sleef_cinz_log1pd1_u10purec(x); }
inline double log10(double x) { return log(x) / std::numbers::ln10; }
inline double pow(double base, double exponent) { return Sleef_cinz_powd1_u10purec(base, exponent); }
inline double cos(double x) { return Sleef_cinz_cosd1_u35purec(x); }  // 3.5
inline double sin(double x) { return Sleef_cinz_sind1_u35purec(x); }  // 3.5
inline double erf(double x) { return Sleef_cinz_erfd1_u10purec(x); }
inline double erfc(double x) { return Sleef_cinz_erfcd1_u15purec(x); }

}  // namespace portable
