#include <vector>

#include "ck_texture.h"
#include "core/eigen_sparse.h"
#include "core/guard.h"

namespace ck::texture {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Both triangles of the matrix.
Matrix matrix_of(const ck_sparse_matrix& input) {
  const auto [size, entry_count, rows, columns, entries] = input;
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(2 * entry_count);
  for (size_t i = 0; i < entry_count; ++i) {
    require(rows[i] < size && columns[i] < size, "an entry lies outside the matrix");
    const auto r = static_cast<int>(rows[i]), c = static_cast<int>(columns[i]);
    triplets.emplace_back(r, c, entries[i]);
    if (r != c) triplets.emplace_back(c, r, entries[i]);
  }
  const auto n = static_cast<Eigen::Index>(size);
  Matrix matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

}  // namespace
}  // namespace ck::texture

ck_status ck_solve_sparse(const ck_sparse_matrix* input, size_t channels,
                          const ck_conjugate_gradient_options* options, const ck_control* control,
                          double* values) {
  return ck::guarded([&] {
    if (input->size == 0) return;
    const auto n = static_cast<Eigen::Index>(input->size);
    const ck::texture::Matrix matrix = ck::texture::matrix_of(*input);
    Eigen::ConjugateGradient<ck::texture::Matrix, Eigen::Lower | Eigen::Upper,
                             Eigen::DiagonalPreconditioner<double>>
        solver;
    solver.setTolerance(options->tolerance);
    solver.setMaxIterations(static_cast<Eigen::Index>(options->maximum_iterations));
    solver.compute(matrix);
    if (solver.info() != Eigen::Success) throw ck::Degenerate("the system can't be solved");
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> block(
        values, n, static_cast<Eigen::Index>(channels));
    for (Eigen::Index c = 0; c < block.cols(); ++c) {
      ck::step(control, static_cast<double>(c) / static_cast<double>(channels));
      const Eigen::VectorXd right = block.col(c);
      const Eigen::VectorXd solution = solver.solve(right);
      if (!solution.allFinite()) throw ck::Degenerate("the system has no finite solution");
      block.col(c) = solution;
    }
  });
}
