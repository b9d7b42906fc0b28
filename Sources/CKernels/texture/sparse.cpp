#include <vector>

#include "ck_texture.h"
#include "core/eigen_sparse.h"
#include "core/guard.h"

ck_status ck_solve_sparse(const ck_sparse_matrix* input, size_t channels,
                          const ck_conjugate_gradient_options* options, const ck_control* control,
                          double* values) {
  return ck::guarded([&] {
    using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    const auto [size, entry_count, rows, columns, entries] = *input;
    if (size == 0) return;
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(2 * entry_count);
    for (size_t i = 0; i < entry_count; ++i) {
      ck::require(rows[i] < size && columns[i] < size, "an entry lies outside the matrix");
      const auto r = static_cast<int>(rows[i]), c = static_cast<int>(columns[i]);
      triplets.emplace_back(r, c, entries[i]);
      if (r != c) triplets.emplace_back(c, r, entries[i]);
    }
    const auto n = static_cast<Eigen::Index>(size);
    Matrix matrix(n, n);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper,
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
