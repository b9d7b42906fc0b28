#include "bundle/reduced_system.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/parallel.h"

namespace ck {
namespace {

/// Conjugate gradients stop when an iteration adds less than this share to the decrease of the
/// quadratic form per iteration so far. Paper: Nash and Sofer 1990, "Assessing a search direction
/// within a truncated-Newton method". The share is Ceres' default.
constexpr double kForcingSequence = 0.1;
/// Conjugate gradients stop at this number of iterations. Chosen: Ceres' default is 500.
constexpr int kMaximumConjugateSteps = 100;

/// Number of columns with duplicates that a list has room for in any case. Chosen.
constexpr size_t kRoom = 256;

/// Sorts `columns` and removes duplicates.
void make_unique(std::vector<int32_t>& columns) {
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
}

/// Removes duplicates once a list has doubled, so that it stays near its final length.
void append(int32_t column, size_t& limit, std::vector<int32_t>& columns) {
  if (!columns.empty() && columns.back() == column) return;
  columns.push_back(column);
  if (columns.size() < limit) return;
  make_unique(columns);
  limit = 2 * columns.size() + kRoom;
}

/// The poses and cameras with which a pose shares a block.
void find_neighbors(const BundleLayout& layout, size_t pose, std::vector<int32_t>& poses,
                    std::vector<int32_t>& cameras) {
  poses.push_back(int32_t(pose));
  size_t pose_limit = kRoom, camera_limit = kRoom;
  const Lists& own = layout.observations_of_pose;
  for (size_t i = own.starts[pose]; i < own.starts[pose + 1]; ++i) {
    const auto& observation = layout.observations[size_t(own.values[i])];
    const auto point = size_t(observation.point);
    if (observation.camera_block >= 0) append(observation.camera_block, camera_limit, cameras);
    if (!layout.is_point_free[point]) continue;
    for (size_t k = layout.point_starts[point]; k < layout.point_starts[point + 1]; ++k) {
      const auto& other = layout.observations[k];
      if (other.pose_block > int32_t(pose)) append(other.pose_block, pose_limit, poses);
      if (other.camera_block >= 0) append(other.camera_block, camera_limit, cameras);
    }
  }
  make_unique(poses);
  make_unique(cameras);
}

/// The cameras with which a camera shares a block.
void find_neighbors(const BundleLayout& layout, size_t camera, std::vector<int32_t>& cameras) {
  cameras.push_back(int32_t(camera));
  size_t limit = kRoom;
  const Lists& links = layout.links_of_camera;
  const Lists& all = layout.cameras_of_point;
  for (size_t i = links.starts[camera]; i < links.starts[camera + 1]; ++i) {
    const auto point = size_t(layout.link_points[size_t(links.values[i])]);
    for (size_t k = all.starts[point]; k < all.starts[point + 1]; ++k) {
      if (all.values[k] > int32_t(camera)) append(all.values[k], limit, cameras);
    }
  }
  make_unique(cameras);
}

}  // namespace

template <typename Block>
Block& ReducedSystem::Row<Block>::at(int32_t column) {
  return blocks[size_t(std::lower_bound(columns.begin(), columns.end(), column) - columns.begin())];
}

template <typename Block>
void ReducedSystem::Row<Block>::clear() {
  blocks.assign(columns.size(), Block::Zero());
}

template struct ReducedSystem::Row<ReducedSystem::PosePose>;
template struct ReducedSystem::Row<ReducedSystem::PoseCamera>;
template struct ReducedSystem::Row<ReducedSystem::CameraCamera>;

ReducedSystem::ReducedSystem(const BundleLayout& layout, const ck_control* control)
    : poses(layout.pose_count()),
      pose_cameras(layout.pose_count()),
      cameras(layout.camera_count()) {
  const ck_control quiet{nullptr, nullptr, thread_count(control)};
  parallel_for(&quiet, poses.size() + cameras.size(), [&](size_t row) {
    if (row < poses.size()) {
      find_neighbors(layout, row, poses[row].columns, pose_cameras[row].columns);
    } else {
      find_neighbors(layout, row - poses.size(), cameras[row - poses.size()].columns);
    }
  });
  right = Eigen::VectorXd::Zero(size());
}

Eigen::VectorXd ReducedSolver::solve() {
  if (system_.size() == 0) return system_.right;
  const auto photos = int32_t(system_.poses.size());
  Eigen::VectorXd found = photos <= options_.dense_photo_limit    ? solve_dense()
                          : photos <= options_.direct_photo_limit ? solve_sparse()
                                                                  : solve_iteratively();
  return found.allFinite() ? found : Eigen::VectorXd();
}

Eigen::VectorXd ReducedSolver::solve_dense() const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(system_.size(), system_.size());
  system_.for_each_block([&](Eigen::Index row, Eigen::Index column, const auto& block) {
    matrix.block(column, row, block.cols(), block.rows()) = block.transpose();
  });
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factorization(matrix);
  if (factorization.info() != Eigen::Success) return {};
  return factorization.solve(system_.right);
}

Eigen::VectorXd ReducedSolver::solve_sparse() {
  std::vector<Eigen::Triplet<double>> entries;
  system_.for_each_block([&](Eigen::Index row, Eigen::Index column, const auto& block) {
    for (Eigen::Index c = 0; c < block.cols(); ++c) {
      const Eigen::Index end = row == column ? c + 1 : block.rows();
      for (Eigen::Index r = 0; r < end; ++r) {
        entries.emplace_back(int(row + r), int(column + c), block(r, c));
      }
    }
  });
  Eigen::SparseMatrix<double> matrix(system_.size(), system_.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!is_analyzed_) sparse_.analyzePattern(matrix);
  is_analyzed_ = true;
  sparse_.factorize(matrix);
  if (sparse_.info() != Eigen::Success || sparse_.vectorD().minCoeff() <= 0) return {};
  return sparse_.solve(system_.right);
}

Eigen::VectorXd ReducedSolver::multiply(const Eigen::VectorXd& x) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(system_.size());
  system_.for_each_block([&](Eigen::Index row, Eigen::Index column, const auto& block) {
    product.segment(row, block.rows()) += block * x.segment(column, block.cols());
    if (row == column) return;
    product.segment(column, block.cols()) += block.transpose() * x.segment(row, block.rows());
  });
  return product;
}

/// Conjugate gradients with the diagonal blocks as preconditioner.
Eigen::VectorXd ReducedSolver::solve_iteratively() const {
  std::vector<Eigen::LLT<Eigen::MatrixXd>> diagonal;
  for (const auto& row : system_.poses) diagonal.emplace_back(row.blocks.front());
  for (const auto& row : system_.cameras) diagonal.emplace_back(row.blocks.front());
  for (const auto& block : diagonal) {
    if (block.info() != Eigen::Success) return {};
  }
  const auto precondition = [&](const Eigen::VectorXd& r) {
    Eigen::VectorXd z(r.size());
    Eigen::Index offset = 0;
    for (const auto& block : diagonal) {
      z.segment(offset, block.cols()) = block.solve(r.segment(offset, block.cols()));
      offset += block.cols();
    }
    return z;
  };

  Eigen::VectorXd x = Eigen::VectorXd::Zero(system_.size()), r = system_.right;
  Eigen::VectorXd z = precondition(r), p = z;
  double rho = r.dot(z), decrease = 0;
  for (int i = 1; i <= kMaximumConjugateSteps && rho > 0; ++i) {
    const Eigen::VectorXd q = multiply(p);
    const double curvature = p.dot(q);
    if (!(curvature > 0)) return {};
    const double alpha = rho / curvature;
    x += alpha * p;
    r -= alpha * q;
    const double gain = alpha * rho / 2;
    decrease += gain;
    if (i * gain < kForcingSequence * decrease) break;
    z = precondition(r);
    const double next = r.dot(z);
    p = z + next / rho * p;
    rho = next;
  }
  return x;
}

}  // namespace ck
