#include <gsl/gsl_errno.h>
#include <sleef.h>

// The elementary functions of the C library, with results that are bitwise the same on every processor. The C
// library selects an implementation by the processor's instruction set, with or without fused multiply-add,
// and these differ in the last digit. Here they are SLEEF's deterministic functions without fused
// multiply-add (Shibata, Petrogalli, IEEE Trans. Parallel Distrib. Syst. 31, 1316 (2020),
// doi:10.1109/TPDS.2019.2960333). A program that defines them uses them itself, and the dynamic linker gives
// them to the shared libraries that it uses, such as GSL. Names end with the largest error in tenths of a
// unit in the last place. Compilers do not evaluate these functions themselves (flags.cmake).
extern "C" {
double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
double exp2(double x) { return Sleef_cinz_exp2d1_u10purec(x); }
double exp10(double x) { return Sleef_cinz_exp10d1_u10purec(x); }
double expm1(double x) { return Sleef_cinz_expm1d1_u10purec(x); }
double log(double x) { return Sleef_cinz_logd1_u35purec(x); }
double log2(double x) { return Sleef_cinz_log2d1_u10purec(x); }
double log10(double x) { return Sleef_cinz_log10d1_u10purec(x); }
double log1p(double x) { return Sleef_cinz_log1pd1_u10purec(x); }
double sin(double x) { return Sleef_cinz_sind1_u35purec(x); }
double cos(double x) { return Sleef_cinz_cosd1_u35purec(x); }
void sincos(double x, double* sine, double* cosine) { *sine = sin(x), *cosine = cos(x); }
double tan(double x) { return Sleef_cinz_tand1_u10purec(x); }
double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
double acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }
double atan(double x) { return Sleef_cinz_atand1_u10purec(x); }
double atan2(double y, double x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
double sinh(double x) { return Sleef_cinz_sinhd1_u10purec(x); }
double cosh(double x) { return Sleef_cinz_coshd1_u10purec(x); }
double tanh(double x) { return Sleef_cinz_tanhd1_u10purec(x); }
double asinh(double x) { return Sleef_cinz_asinhd1_u10purec(x); }
double acosh(double x) { return Sleef_cinz_acoshd1_u10purec(x); }
double atanh(double x) { return Sleef_cinz_atanhd1_u10purec(x); }
double cbrt(double x) { return Sleef_cinz_cbrtd1_u10purec(x); }
double erf(double x) { return Sleef_cinz_erfd1_u10purec(x); }
double erfc(double x) { return Sleef_cinz_erfcd1_u15purec(x); }
double pow(double base, double exponent) { return Sleef_cinz_powd1_u10purec(base, exponent); }
double hypot(double x, double y) { return Sleef_cinz_hypotd1_u05purec(x, y); }
}

// By default GSL aborts the program on an error, which an underflow is as well. Without its handler it
// returns NaN, or 0 on underflow.
[[maybe_unused]] static const auto handler = gsl_set_error_handler_off();
