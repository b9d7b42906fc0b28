#include "two_view/polynomial.h"

#include <cmath>

namespace ck {
namespace {

using Coefficients = std::array<double, kMaximumDegree + 1>;

/// Largest number of steps to a root, and the change at which they stop. Limit: double precision,
/// which bisection alone reaches after about 50 steps.
constexpr int kRootSteps = 80;
constexpr double kRootTolerance = 1e-15;

double value(const Coefficients& c, int degree, double x) {
  double sum = c[degree];
  for (int i = degree - 1; i >= 0; --i) sum = sum * x + c[i];
  return sum;
}

double slope(const Coefficients& c, int degree, double x) {
  double sum = degree * c[degree];
  for (int i = degree - 1; i >= 1; --i) sum = sum * x + i * c[i];
  return sum;
}

/// The root between `low` and `high`, where the signs differ, by Newton's method with bisection as
/// safeguard.
double bracketed_root(const Coefficients& c, int degree, double low, double high, double at_low) {
  double x = 0.5 * (low + high);
  for (int i = 0; i < kRootSteps; ++i) {
    const double y = value(c, degree, x);
    if (y == 0) return x;
    ((y < 0) == (at_low < 0) ? low : high) = x;
    double next = x - y / slope(c, degree, x);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - x) < kRootTolerance) return next;
    x = next;
  }
  return x;
}

/// Roots within −1…1, ascending.
RealRoots roots_in_unit_interval(const Coefficients& c, int degree) {
  std::array<Coefficients, kMaximumDegree + 1> derivatives;
  derivatives[degree] = c;
  for (int d = degree - 1; d >= 1; --d) {
    for (int i = 0; i <= d; ++i) derivatives[d][i] = (i + 1) * derivatives[d + 1][i + 1];
  }
  RealRoots breaks;
  for (int d = 1; d <= degree; ++d) {
    RealRoots found;
    double low = -1, at_low = value(derivatives[d], d, low);
    for (int k = 0; k <= breaks.count; ++k) {
      const double high = k < breaks.count ? breaks.values[k] : 1;
      const double at_high = value(derivatives[d], d, high);
      if ((at_low < 0) != (at_high < 0)) {
        found.values[found.count++] = bracketed_root(derivatives[d], d, low, high, at_low);
      }
      low = high;
      at_low = at_high;
    }
    breaks = found;
  }
  return breaks;
}

}  // namespace

RealRoots real_roots(const double* coefficients, int degree) {
  Coefficients forward{}, backward{};
  for (int i = 0; i <= degree; ++i) {
    if (!std::isfinite(coefficients[i])) return {};
    forward[i] = coefficients[i];
    backward[degree - i] = coefficients[i];
  }
  RealRoots roots = roots_in_unit_interval(forward, degree);
  const RealRoots reciprocals = roots_in_unit_interval(backward, degree);
  for (int i = 0; i < reciprocals.count; ++i) {
    const double r = reciprocals.values[i];
    if (std::abs(r) < 1 && r != 0) roots.values[roots.count++] = 1 / r;
  }
  return roots;
}

}  // namespace ck
