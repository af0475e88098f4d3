// Student's t distribution and corrections for many tests at once.
#pragma once

namespace drude {

// The regularised incomplete beta function I_x(a, b) for a, b > 0 and x in [0, 1]; NaN elsewhere.
// Relative accuracy about 1e-12 for a, b up to 1e5, in the far tail too. Continued fraction DLMF
// 8.17.22 with the symmetry 8.17.4 (NIST Digital Library of Mathematical Functions), evaluated by
// Lentz's method as modified by Thompson & Barnett (J. Comput. Phys. 64, 490, 1986).
double incomplete_beta(double a, double b, double x);

// P(|T| >= |t|) of Student's t with `degrees` of freedom (> 0; beyond 1e5 the normal
// distribution). Smallest values are exact, not lost against 1. NaN for NaN.
double student_two_sided(double t, double degrees);

// The t >= 0 with student_two_sided(t, degrees) = p for p in (0, 1].
double student_quantile(double p, double degrees);

// Sidak (J. Am. Stat. Assoc. 62, 626, 1967): the probability that the smallest of `tests`
// independent p-values is at most `p`, and the p each test may spend so that all together spend
// `alpha`.
double sidak_family(double p, double tests);
double sidak_each(double alpha, double tests);

}  // namespace drude
