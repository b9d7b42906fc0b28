#pragma once

#include <array>

namespace ck {

/// Highest degree that `real_roots` handles. Limit: that of the five-point problem.
constexpr int kMaximumDegree = 10;

/// The real roots of a polynomial.
struct RealRoots {
  std::array<double, 2 * kMaximumDegree> values;
  int count = 0;
};

/// The real roots of odd multiplicity of Σ coefficients[i] xⁱ, of degree at most `kMaximumDegree`.
///
/// Roots of a derivative bracket those of its antiderivative, starting from the linear one; roots
/// outside −1…1 are found as reciprocals.
RealRoots real_roots(const double* coefficients, int degree);

}  // namespace ck
