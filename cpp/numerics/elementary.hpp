#pragma once

#include <numbers>

// Declared here, because sleef.h includes 55,000 lines of vector intrinsics.
extern "C" {
[[gnu::const]] double Sleef_cinz_expd1_u10purec(double);
[[gnu::const]] double Sleef_cinz_expm1d1_u10purec(double);
[[gnu::const]] double Sleef_cinz_logd1_u35purec(double);
[[gnu::const]] double Sleef_cinz_log1pd1_u10purec(double);
[[gnu::const]] double Sleef_cinz_powd1_u10purec(double, double);
[[gnu::const]] double Sleef_cinz_cosd1_u35purec(double);
[[gnu::const]] double Sleef_cinz_sind1_u35purec(double);
[[gnu::const]] double Sleef_cinz_erfd1_u10purec(double);
[[gnu::const]] double Sleef_cinz_erfcd1_u15purec(double);
}

/// Elementary functions whose results are bitwise the same on every processor. Those of the C library are
/// not: it selects an implementation by the processor's instruction set, with or without fused multiply-add.
/// These are SLEEF's deterministic scalar functions without fused multiply-add (Shibata, Petrogalli, IEEE
/// Trans. Parallel Distrib. Syst. 31, 1316 (2020), doi:10.1109/TPDS.2019.2960333). Errors are at most 1 unit
/// in the last place (ulp) where no other bound is given.
namespace elementary {

inline double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
inline double expm1(double x) { return Sleef_cinz_expm1d1_u10purec(x); }
inline double log(double x) { return Sleef_cinz_logd1_u35purec(x); }  // 3.5 ulp
inline double log1p(double x) { return Sleef_cinz_log1pd1_u10purec(x); }
inline double log10(double x) { return log(x) / std::numbers::ln10; }  // log's 3.5 ulp and two roundings
inline double pow(double base, double exponent) { return Sleef_cinz_powd1_u10purec(base, exponent); }
inline double cos(double x) { return Sleef_cinz_cosd1_u35purec(x); }  // 3.5 ulp
inline double sin(double x) { return Sleef_cinz_sind1_u35purec(x); }  // 3.5 ulp
inline double erf(double x) { return Sleef_cinz_erfd1_u10purec(x); }
inline double erfc(double x) { return Sleef_cinz_erfcd1_u15purec(x); }  // 1.5 ulp

}  // namespace elementary
