#include "bundle/normal_equations.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace ck {
namespace {

/// Units of parallel work. Their size decides how sums are rounded. Chosen: a unit takes about a
/// millisecond, far more than it takes to start a thread.
constexpr size_t kPointsPerChunk = 1024, kLinksPerChunk = 2048;
/// Observations of the poses of a unit of work. Chosen: about a millisecond; results do not depend
/// on it, because the row of a pose is one sum.
constexpr size_t kObservationsPerUnit = 1000;
/// Observations of a pose between asking for what one reads and reading it. Chosen: reading from
/// memory takes as long as adding a few; results do not depend on it.
constexpr size_t kReadAhead = 8;
/// Bounds of the diagonal elements that damping is proportional to. Chosen: Ceres' defaults.
constexpr double kMinimumDiagonal = 1e-6, kMaximumDiagonal = 1e32;

/// Adds the damping to a diagonal. Parameters that nothing depends on get 1, so that they keep
/// their values.
template <typename Matrix>
void damp(Matrix& matrix, double damping) {
  for (int i = 0; i < matrix.rows(); ++i) {
    double& value = matrix(i, i);
    value += value == 0 ? 1 : damping * std::clamp(value, kMinimumDiagonal, kMaximumDiagonal);
  }
}

/// The two rows of a derivative by a pose as columns.
using PoseColumns = Eigen::Matrix<double, kPoseSize, 2>;

/// Adds the product of `pose` and `other` to a block, a column at a time: Eigen would compute so
/// small a product one element after the other.
template <int Columns>
void add_product(const PoseColumns& pose, const Eigen::Matrix<double, 2, Columns>& other,
                 Eigen::Matrix<double, kPoseSize, Columns>& block) {
  for (int i = 0; i < Columns; ++i) {
    block.col(i) += pose.col(0) * other(0, i) + pose.col(1) * other(1, i);
  }
}

}  // namespace

/// A part of the row of a camera in the reduced system.
struct NormalEquations::CameraSum {
  ReducedSystem::CameraCamera diagonal = ReducedSystem::CameraCamera::Zero();
  std::vector<ReducedSystem::CameraCamera> eliminated;
  Prior gradient = Prior::Zero(), right = Prior::Zero();
};

NormalEquations::NormalEquations(const ck_bundle& bundle, const BundleLayout& layout,
                                 double huber_width, const ck_control* control)
    : layout_(layout),
      huber_width_(huber_width),
      quiet_{nullptr, nullptr, thread_count(control)},
      terms_(new Term[layout.observations.size()]),
      by_camera_(new ByCamera[layout.observations.size()]),
      links_(layout.link_points.size()),
      prior_residuals_(layout.cameras.size()),
      inverses_(layout.is_point_free.size()),
      gradients_(layout.is_point_free.size()) {
  for (size_t i = 0; i < layout.cameras.size(); ++i) {
    const ck_camera_prior& prior = bundle.camera_priors[layout.cameras[i]];
    Prior mean = Prior::Zero(), deviation = Prior::Zero();
    mean.head<3>() << prior.focal_length, prior.cx, prior.cy;
    deviation.head<5>() << prior.focal_length * prior.focal_deviation,
        prior.principal_point_deviation, prior.principal_point_deviation, prior.radial_deviation,
        prior.radial_deviation;
    for (int k = 0; k < kCameraSize; ++k) {
      deviation[k] = deviation[k] > 0 ? 1 / deviation[k] : 0;
    }
    prior_means_.push_back(mean);
    prior_weights_.push_back(deviation);
  }
}

/// Calls `sum(point)` for all points and adds the values.
template <typename Sum>
double NormalEquations::sum_over_points(Sum&& sum) const {
  const size_t count = layout_.is_point_free.size();
  std::vector<double> sums((count + kPointsPerChunk - 1) / kPointsPerChunk, 0.0);
  parallel_for(&quiet_, sums.size(), [&](size_t chunk) {
    const size_t end = std::min(count, (chunk + 1) * kPointsPerChunk);
    for (size_t point = chunk * kPointsPerChunk; point < end; ++point) sums[chunk] += sum(point);
  });
  double total = 0;
  for (const double value : sums) total += value;
  return total;
}

NormalEquations::Prior NormalEquations::deviations(const ck_camera& camera, size_t block) const {
  Prior values;
  values << camera.fx, camera.cx, camera.cy, camera.k1, camera.k2, camera.p1, camera.p2;
  return prior_weights_[block].cwiseProduct(values - prior_means_[block]);
}

double NormalEquations::cost(const BundleParameters& parameters) const {
  std::vector<Pose> poses;
  for (size_t i = 0; i < parameters.rotations.size(); ++i) poses.push_back(parameters.pose(i));
  double total = sum_over_points([&](size_t point) {
    double sum = 0;
    for (size_t k = layout_.point_starts[point]; k < layout_.point_starts[point + 1]; ++k) {
      const auto& o = layout_.observations[k];
      const double r = (o.whitening * reprojection_error(parameters.cameras[size_t(o.camera)],
                                                         poses[size_t(o.photo)],
                                                         parameters.points[point], o.pixel))
                           .norm();
      sum += r <= huber_width_ ? r * r : huber_width_ * (2 * r - huber_width_);
    }
    return sum;
  });
  for (size_t i = 0; i < layout_.cameras.size(); ++i) {
    total += deviations(parameters.cameras[layout_.cameras[i]], i).squaredNorm();
  }
  return total / 2;
}

void NormalEquations::linearize(const BundleParameters& parameters) {
  std::vector<Pose> poses;
  for (size_t i = 0; i < parameters.rotations.size(); ++i) poses.push_back(parameters.pose(i));
  parallel_for_blocks(&quiet_, layout_.is_point_free.size(), kPointsPerChunk, [&](size_t point) {
    for (size_t k = layout_.point_starts[point]; k < layout_.point_starts[point + 1]; ++k) {
      const auto& o = layout_.observations[k];
      const Reprojection found =
          reproject(parameters.cameras[size_t(o.camera)], poses[size_t(o.photo)],
                    parameters.points[point], o.pixel);
      // Iteratively reweighted least squares: the weight is the derivative of the loss by the
      // squared error.
      const double r = (o.whitening * found.residual).norm();
      const Eigen::Matrix2d weight =
          (r <= huber_width_ ? 1 : std::sqrt(huber_width_ / r)) * o.whitening;
      Term& term = terms_[k];
      term.residual = weight * found.residual;
      term.by_pose = weight * found.by_pose;
      term.by_point = weight * found.by_point;
      by_camera_[k] = weight * found.by_camera;
      if (o.pose_block >= 0 && layout_.fixed_axes[size_t(o.pose_block)] >= 0) {
        term.by_pose.col(3 + layout_.fixed_axes[size_t(o.pose_block)]).setZero();
      }
      for (int i = 0; o.camera_block >= 0 && i < kCameraSize; ++i) {
        if (!layout_.free_parameters[size_t(o.camera_block)][size_t(i)]) {
          by_camera_[k].col(i).setZero();
        }
      }
    }
    link(point);
  });
  for (size_t i = 0; i < layout_.cameras.size(); ++i) {
    prior_residuals_[i] = deviations(parameters.cameras[layout_.cameras[i]], i);
  }
}

/// Sums the products of the derivatives by a point and by its cameras.
void NormalEquations::link(size_t point) {
  const Lists& all = layout_.cameras_of_point;
  for (size_t m = all.starts[point]; m < all.starts[point + 1]; ++m) {
    links_[m].setZero();
    for (size_t k = layout_.point_starts[point]; k < layout_.point_starts[point + 1]; ++k) {
      if (layout_.observations[k].camera_block != all.values[m]) continue;
      links_[m].noalias() += terms_[k].by_point.transpose() * by_camera_[k];
    }
  }
}

void NormalEquations::reduce(double damping, ReducedSystem& system) {
  gradient_norm_ = eliminate_points(damping);
  const std::vector<PoseUnit> units = pose_units();
  std::vector<double> norms(layout_.pose_count(), 0.0);
  parallel_for(&quiet_, units.size(), [&](size_t i) {
    for (size_t pose = units[i].begin; pose < units[i].end; ++pose) {
      norms[pose] = add_pose(pose, damping, system);
    }
  });
  for (const double norm : norms) gradient_norm_ = std::max(gradient_norm_, norm);
  gradient_norm_ = std::max(gradient_norm_, add_cameras(damping, system));
}

/// Poses in units of about the same number of observations. Consecutive ones often see the same
/// points, whose terms are then still in the cache.
std::vector<NormalEquations::PoseUnit> NormalEquations::pose_units() const {
  std::vector<PoseUnit> units;
  const Lists& own = layout_.observations_of_pose;
  const auto size = [&](const PoseUnit& unit) {
    return own.starts[unit.end] - own.starts[unit.begin];
  };
  for (size_t pose = 0; pose < layout_.pose_count(); ++pose) {
    if (units.empty() || size(units.back()) >= kObservationsPerUnit) units.push_back({pose, pose});
    units.back().end = pose + 1;
  }
  return units;
}

/// Computes the blocks of the points; returns the largest component of their gradients.
double NormalEquations::eliminate_points(double damping) {
  std::vector<double> norms(layout_.is_point_free.size(), 0.0);
  parallel_for_blocks(&quiet_, norms.size(), kPointsPerChunk, [&](size_t point) {
    if (!layout_.is_point_free[point]) return;
    Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
    Vector3 gradient = Vector3::Zero();
    for (size_t k = layout_.point_starts[point]; k < layout_.point_starts[point + 1]; ++k) {
      block.noalias() += terms_[k].by_point.transpose() * terms_[k].by_point;
      gradient.noalias() += terms_[k].by_point.transpose() * terms_[k].residual;
    }
    damp(block, damping);
    inverses_[point] = block.inverse();
    gradients_[point] = gradient;
    norms[point] = gradient.cwiseAbs().maxCoeff();
  });
  return norms.empty() ? 0 : *std::max_element(norms.begin(), norms.end());
}

/// Computes the row of a pose; returns the largest component of its gradient.
double NormalEquations::add_pose(size_t pose, double damping, ReducedSystem& system) const {
  system.poses[pose].clear();
  system.pose_cameras[pose].clear();
  ReducedSystem::PosePose diagonal = ReducedSystem::PosePose::Zero();
  Eigen::Matrix<double, kPoseSize, 1> gradient, eliminated;
  gradient.setZero();
  eliminated.setZero();
  const Lists& own = layout_.observations_of_pose;
  for (size_t i = own.starts[pose]; i < own.starts[pose + 1]; ++i) {
    read_ahead(i, own.starts[pose + 1]);
    const auto k = size_t(own.values[i]);
    const auto& o = layout_.observations[k];
    const Term& term = terms_[k];
    const PoseColumns by_pose = term.by_pose.transpose();
    add_product(by_pose, term.by_pose, diagonal);
    gradient.noalias() += by_pose * term.residual;
    if (o.camera_block >= 0) {
      add_product(by_pose, by_camera_[k], system.pose_cameras[pose].at(o.camera_block));
    }
    if (!layout_.is_point_free[size_t(o.point)]) continue;
    const Eigen::Matrix<double, 2, 3> by_point = term.by_point * inverses_[size_t(o.point)];
    const Vector2 pulled = by_point * gradients_[size_t(o.point)];
    eliminated.noalias() += by_pose * pulled;
    add_observation(k, by_point, pose, system);
  }
  damp(diagonal, damping);
  system.poses[pose].blocks.front() += diagonal;
  system.right.segment<kPoseSize>(system.pose_offset(pose)) = eliminated - gradient;
  return gradient.cwiseAbs().maxCoeff();
}

/// Asks the memory for what `add_pose` reads of later observations than number i of all poses,
/// before `end`: those of a pose are far apart.
void NormalEquations::read_ahead(size_t i, size_t end) const {
  const auto& own = layout_.observations_of_pose.values;
  if (i + 2 * kReadAhead < end) {
    const auto k = size_t(own[i + 2 * kReadAhead]);
    __builtin_prefetch(&layout_.observations[k].point);
    __builtin_prefetch(&terms_[k].by_pose);
    __builtin_prefetch(&terms_[k].by_point);
    __builtin_prefetch(&by_camera_[k]);
  }
  if (i + kReadAhead < end) {
    const auto point = size_t(layout_.observations[size_t(own[i + kReadAhead])].point);
    __builtin_prefetch(&inverses_[point]);
    __builtin_prefetch(&gradients_[point]);
    __builtin_prefetch(&terms_[layout_.point_starts[point]]);
  }
}

/// Subtracts what the elimination of the point of observation k contributes to the row of its pose.
/// `by_point` is the derivative by the point times the point's inverted block.
void NormalEquations::add_observation(size_t k, const Eigen::Matrix<double, 2, 3>& by_point,
                                      size_t pose, ReducedSystem& system) const {
  const PoseColumns columns = terms_[k].by_pose.transpose();
  const auto point = size_t(layout_.observations[k].point);
  for (size_t other = layout_.point_starts[point]; other < layout_.point_starts[point + 1];
       ++other) {
    const int32_t block = layout_.observations[other].pose_block;
    if (block < int32_t(pose)) continue;
    const Eigen::Matrix2d product = -(by_point * terms_[other].by_point.transpose());
    const Eigen::Matrix<double, 2, kPoseSize> by_pose = product * terms_[other].by_pose;
    add_product(columns, by_pose, system.poses[pose].at(block));
  }
  const Lists& all = layout_.cameras_of_point;
  for (size_t m = all.starts[point]; m < all.starts[point + 1]; ++m) {
    const Eigen::Matrix<double, 2, kCameraSize> by_camera = -(by_point * links_[m]);
    add_product(columns, by_camera, system.pose_cameras[pose].at(all.values[m]));
  }
}

/// Computes the rows of the cameras; returns the largest component of their gradients.
double NormalEquations::add_cameras(double damping, ReducedSystem& system) const {
  struct Unit {
    size_t camera, chunk;
  };
  std::vector<Unit> units;
  for (size_t camera = 0; camera < layout_.camera_count(); ++camera) {
    const Lists& own = layout_.observations_of_camera;
    const size_t count = own.starts[camera + 1] - own.starts[camera];
    for (size_t chunk = 0; chunk * kLinksPerChunk < count; ++chunk)
      units.push_back({camera, chunk});
  }
  std::vector<CameraSum> sums(units.size());
  parallel_for(&quiet_, units.size(),
               [&](size_t i) { sums[i] = camera_sum(units[i].camera, units[i].chunk, system); });
  double norm = 0;
  for (size_t camera = 0, i = 0; camera < layout_.camera_count(); ++camera) {
    auto& row = system.cameras[camera];
    row.clear();
    CameraSum total;
    for (; i < units.size() && units[i].camera == camera; ++i) {
      total.diagonal += sums[i].diagonal;
      total.gradient += sums[i].gradient;
      total.right += sums[i].right;
      for (size_t k = 0; k < row.blocks.size(); ++k) row.blocks[k] -= sums[i].eliminated[k];
    }
    const Prior& weight = prior_weights_[camera];
    for (int k = 0; k < kCameraSize; ++k) {
      if (!layout_.free_parameters[camera][size_t(k)]) continue;
      total.diagonal(k, k) += weight[k] * weight[k];
      total.gradient[k] += weight[k] * prior_residuals_[camera][k];
    }
    damp(total.diagonal, damping);
    row.blocks.front() += total.diagonal;
    system.right.segment<kCameraSize>(system.camera_offset(camera)) = total.right - total.gradient;
    norm = std::max(norm, total.gradient.cwiseAbs().maxCoeff());
  }
  return norm;
}

/// The sums over a chunk of a camera's observations and links.
NormalEquations::CameraSum NormalEquations::camera_sum(size_t camera, size_t chunk,
                                                       const ReducedSystem& system) const {
  CameraSum sum;
  const auto& columns = system.cameras[camera].columns;
  sum.eliminated.assign(columns.size(), ReducedSystem::CameraCamera::Zero());
  const auto range = [&](const Lists& lists) {
    const size_t begin = lists.starts[camera] + chunk * kLinksPerChunk,
                 end = lists.starts[camera + 1];
    return std::pair(std::min(begin, end), std::min(begin + kLinksPerChunk, end));
  };
  const auto [first, last] = range(layout_.observations_of_camera);
  for (size_t i = first; i < last; ++i) {
    const auto k = size_t(layout_.observations_of_camera.values[i]);
    sum.diagonal.noalias() += by_camera_[k].transpose() * by_camera_[k];
    sum.gradient.noalias() += by_camera_[k].transpose() * terms_[k].residual;
  }
  const auto [first_link, last_link] = range(layout_.links_of_camera);
  const Lists& all = layout_.cameras_of_point;
  for (size_t i = first_link; i < last_link; ++i) {
    const auto link = size_t(layout_.links_of_camera.values[i]);
    const auto point = size_t(layout_.link_points[link]);
    const Eigen::Matrix<double, kCameraSize, 3> product =
        links_[link].transpose() * inverses_[point];
    sum.right.noalias() += product * gradients_[point];
    size_t column = 0;
    for (size_t m = link; m < all.starts[point + 1]; ++m) {
      while (columns[column] != all.values[m]) ++column;
      sum.eliminated[column].noalias() += product * links_[m];
    }
  }
  return sum;
}

BundleStep NormalEquations::complete(const ReducedSystem& system,
                                     const Eigen::VectorXd& cameras) const {
  BundleStep step{cameras, std::vector<Vector3>(layout_.is_point_free.size(), Vector3::Zero())};
  parallel_for_blocks(&quiet_, step.points.size(), kPointsPerChunk, [&](size_t point) {
    if (!layout_.is_point_free[point]) return;
    Vector3 sum = gradients_[point];
    for (size_t k = layout_.point_starts[point]; k < layout_.point_starts[point + 1]; ++k) {
      const int32_t pose = layout_.observations[k].pose_block;
      if (pose < 0) continue;
      const Vector2 moved =
          terms_[k].by_pose * cameras.segment<kPoseSize>(system.pose_offset(size_t(pose)));
      sum.noalias() += terms_[k].by_point.transpose() * moved;
    }
    const Lists& all = layout_.cameras_of_point;
    for (size_t m = all.starts[point]; m < all.starts[point + 1]; ++m) {
      sum.noalias() +=
          links_[m] * cameras.segment<kCameraSize>(system.camera_offset(size_t(all.values[m])));
    }
    step.points[point] = -(inverses_[point] * sum);
  });
  return step;
}

double NormalEquations::predicted_decrease(const ReducedSystem& system,
                                           const BundleStep& step) const {
  double total = sum_over_points([&](size_t point) {
    double sum = 0;
    for (size_t k = layout_.point_starts[point]; k < layout_.point_starts[point + 1]; ++k) {
      const auto& o = layout_.observations[k];
      const Term& term = terms_[k];
      Vector2 moved = term.by_point * step.points[point];
      if (o.pose_block >= 0) {
        moved += term.by_pose *
                 step.cameras.segment<kPoseSize>(system.pose_offset(size_t(o.pose_block)));
      }
      if (o.camera_block >= 0) {
        moved += by_camera_[k] *
                 step.cameras.segment<kCameraSize>(system.camera_offset(size_t(o.camera_block)));
      }
      sum -= moved.dot(2 * term.residual + moved);
    }
    return sum;
  });
  for (size_t camera = 0; camera < layout_.camera_count(); ++camera) {
    const Prior moved = prior_weights_[camera].cwiseProduct(
        step.cameras.segment<kCameraSize>(system.camera_offset(camera)));
    total -= moved.dot(2 * prior_residuals_[camera] + moved);
  }
  return total / 2;
}

}  // namespace ck
