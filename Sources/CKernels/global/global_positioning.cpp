#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ck_global.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"
#include "geometry/camera_model.h"
#include "global/block_cholesky.h"

namespace ck {
namespace {

/// Levenberg–Marquardt: the initial damping and its bounds, and the bounds of the diagonal elements
/// that it is proportional to. Chosen: as in Ceres, but the bounds of the damping are narrower. Its
/// update is that of Nielsen ("Damping parameter in Marquardt's method", 1999).
constexpr double kInitialDamping = 1e-4, kMinimumDamping = 1e-12, kMaximumDamping = 1e12;
constexpr double kMinimumDiagonal = 1e-6, kMaximumDiagonal = 1e32;
/// Directions, or points, of a unit of parallel work. Chosen: about a millisecond, far more than it
/// takes to start a thread; results do not depend on it.
constexpr size_t kUnit = 1024;
/// Lower bound of the factor of a direction, which is positive in front of the camera. Chosen.
constexpr double kMinimumFactor = 1e-5;

/// The unknowns: camera centers, points and one factor per direction.
struct Unknowns {
  std::vector<Vector3> centers, points;
  std::vector<double> factors;
};

/// The directions of each point and of each photo, in their order.
struct DirectionLists {
  DirectionLists(const ck_direction* directions, size_t count, size_t photo_count)
      : of_photo(photo_count), point(count) {
    for (size_t k = 0; k < count; ++k) {
      if (k == 0 || directions[k].point != directions[k - 1].point) starts.push_back(k);
      point[k] = starts.size() - 1;
      of_photo[size_t(directions[k].photo)].push_back(k);
    }
    starts.push_back(count);
  }

  size_t point_count() const { return starts.size() - 1; }

  /// The first direction of each point that has any, and the end of the last.
  std::vector<size_t> starts;
  std::vector<std::vector<size_t>> of_photo;
  /// For each direction, the number of its point in `starts`.
  std::vector<size_t> point;
};

/// Levenberg–Marquardt on all unknowns. Factors are eliminated first, each independently, then
/// points (Schur complement); the remaining system contains the cameras only. All sums have an
/// order that does not depend on the number of threads.
class Positioning {
 public:
  Positioning(Unknowns unknowns, const ck_direction* directions, size_t count,
              const ck_positioning_options& options, const ck_control* control)
      : unknowns_(std::move(unknowns)),
        directions_(directions),
        count_(count),
        options_(options),
        control_(control),
        quiet_{nullptr, nullptr, thread_count(control)},
        lists_(directions, count, unknowns_.centers.size()),
        system_(unknowns_.centers.size(), blocks()) {
    for (size_t photo = 0; photo < unknowns_.centers.size(); ++photo) {
      first_slots_.push_back(slots_.size());
      for_each_pair(photo, [&](size_t a, size_t b) {
        slots_.push_back(
            system_.slot(std::max(directions_[a].photo, directions_[b].photo), int32_t(photo)));
      });
    }
    terms_.resize(count);
    weighted_.resize(count);
    residuals_.resize(count);
    offsets_.resize(count);
    weights_.resize(count);
  }

  ck_positioning_summary solve() {
    double cost = this->cost(unknowns_);
    ck_positioning_summary summary = {cost, cost, 0, false};
    double damping = kInitialDamping, growth = 2;
    for (int iteration = 0; iteration < options_.maximum_iterations; ++iteration) {
      step(control_, double(iteration) / options_.maximum_iterations);
      ++summary.iterations;
      linearize();
      Unknowns next;
      double expected = 0;
      const bool is_solved = advance(damping, next, expected);
      const double next_cost = is_solved ? this->cost(next) : cost;
      if (!is_solved || !(next_cost < cost)) {
        damping *= growth;
        growth *= 2;
        if (damping > kMaximumDamping) break;
        continue;
      }
      const double gain = (cost - next_cost) / std::max(expected, 1e-300);
      damping =
          std::max(kMinimumDamping, damping * std::max(1.0 / 3, 1 - std::pow(2 * gain - 1, 3)));
      growth = 2;
      unknowns_ = std::move(next);
      summary.converged = cost - next_cost < options_.function_tolerance * cost;
      cost = next_cost;
      if (summary.converged) break;
    }
    summary.final_cost = cost;
    return summary;
  }

  const Unknowns& unknowns() const { return unknowns_; }

 private:
  /// Contribution of one direction to the normal equations of y = X − c, with its factor
  /// eliminated.
  struct Term {
    Eigen::Matrix3d matrix;
    Vector3 right;
  };

  /// The vector from the camera center to the point of direction k.
  Vector3 offset(const Unknowns& unknowns, size_t k) const {
    return unknowns.points[size_t(directions_[k].point)] -
           unknowns.centers[size_t(directions_[k].photo)];
  }

  Vector3 direction(size_t k) const {
    return {directions_[k].x, directions_[k].y, directions_[k].z};
  }

  /// Calls `body(k)` for all directions.
  template <typename Body>
  void for_each_direction(Body&& body) const {
    parallel_for_blocks(&quiet_, count_, kUnit, body);
  }

  /// Calls `body(begin, end)` for the directions of each point.
  template <typename Body>
  void for_each_point(Body&& body) const {
    parallel_for_blocks(&quiet_, lists_.point_count(), kUnit,
                        [&](size_t i) { body(lists_.starts[i], lists_.starts[i + 1]); });
  }

  /// Calls `body(a, b)` for all pairs a ≤ b of directions of one point of which one belongs to a
  /// photo, and the other to the same or a later one.
  template <typename Body>
  void for_each_pair(size_t photo, Body&& body) const {
    for (const size_t k : lists_.of_photo[photo]) {
      const size_t point = lists_.point[k];
      for (size_t other = lists_.starts[point]; other < lists_.starts[point + 1]; ++other) {
        const auto its_photo = size_t(directions_[other].photo);
        if (its_photo < photo || (its_photo == photo && other < k)) continue;
        body(std::min(k, other), std::max(k, other));
      }
    }
  }

  std::vector<std::pair<int32_t, int32_t>> blocks() const {
    std::vector<std::pair<int32_t, int32_t>> blocks;
    for (size_t photo = 0; photo < unknowns_.centers.size(); ++photo) {
      for_each_pair(photo, [&](size_t a, size_t b) {
        blocks.emplace_back(std::max(directions_[a].photo, directions_[b].photo), int32_t(photo));
      });
    }
    return blocks;
  }

  /// Calls `value(k)` for all directions, and adds the values in their order.
  template <typename Value>
  double sum_over_directions(Value&& value) const {
    std::vector<double> values(count_);
    for_each_direction([&](size_t k) { values[k] = value(k); });
    double sum = 0;
    for (const double each : values) sum += each;
    return sum;
  }

  /// The sum of the Huber losses.
  double cost(const Unknowns& unknowns) const {
    const double h = options_.huber_width;
    return sum_over_directions([&](size_t k) {
             const double r = (direction(k) - unknowns.factors[k] * offset(unknowns, k)).norm();
             return r <= h ? r * r : h * (2 * r - h);
           }) /
           2;
  }

  /// Computes residuals, offsets and robust weights at the current unknowns.
  void linearize() {
    for_each_direction([&](size_t k) {
      offsets_[k] = offset(unknowns_, k);
      residuals_[k] = direction(k) - unknowns_.factors[k] * offsets_[k];
      const double r = residuals_[k].norm();
      weights_[k] = r <= options_.huber_width ? 1 : options_.huber_width / r;
    });
  }

  /// A diagonal element of the normal equations with its damping.
  static double damped(double diagonal, double damping) {
    return diagonal + damping * std::clamp(diagonal, kMinimumDiagonal, kMaximumDiagonal);
  }

  /// One damped Gauss–Newton step. `expected` receives the predicted decrease of the cost.
  bool advance(double damping, Unknowns& next, double& expected) {
    eliminate_factors(damping);
    std::vector<Eigen::Matrix3d> inverses(unknowns_.points.size(), Eigen::Matrix3d::Zero());
    std::vector<Vector3> point_rights(unknowns_.points.size(), Vector3::Zero());
    eliminate_points(damping, inverses, point_rights);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(Eigen::Index(3 * unknowns_.centers.size()));
    system_.clear();
    parallel_for(&quiet_, unknowns_.centers.size(), [&](size_t photo) {
      right.segment<3>(Eigen::Index(3 * photo)) = add_photo(photo, damping, point_rights);
    });
    if (!system_.factorize(control_)) return false;
    const Eigen::VectorXd moves = system_.solve(right);
    if (!moves.allFinite()) return false;

    next = unknowns_;
    for (size_t i = 0; i < next.centers.size(); ++i) {
      next.centers[i] += moves.segment<3>(Eigen::Index(3 * i));
    }
    for_each_point([&](size_t begin, size_t end) {
      const size_t point = size_t(directions_[begin].point);
      Vector3 sum = point_rights[point];
      for (size_t k = begin; k < end; ++k) {
        sum += terms_[k].matrix * moves.segment<3>(3 * directions_[k].photo);
      }
      next.points[point] += inverses[point] * sum;
    });
    expected = sum_over_directions([&](size_t k) { return move_factor(k, damping, next); });
    return true;
  }

  /// Sets the factor for the moved camera and point; returns the predicted decrease.
  double move_factor(size_t k, double damping, Unknowns& next) const {
    const Vector3 move = offset(next, k) - offsets_[k];
    const Vector3& y = offsets_[k];
    const double d = unknowns_.factors[k];
    const double change = y.dot(residuals_[k] - d * move) / damped(y.squaredNorm(), damping);
    next.factors[k] = std::max(kMinimumFactor, d + change);
    const Vector3 predicted = residuals_[k] - d * move - change * y;
    return weights_[k] * (residuals_[k].squaredNorm() - predicted.squaredNorm()) / 2;
  }

  /// Computes the terms of all directions, with their factors eliminated.
  void eliminate_factors(double damping) {
    for_each_direction([&](size_t k) {
      const Vector3& y = offsets_[k];
      const double d = unknowns_.factors[k], w = weights_[k];
      const double pivot = damped(y.squaredNorm(), damping);
      terms_[k].matrix = w * d * d * (Eigen::Matrix3d::Identity() - y * y.transpose() / pivot);
      terms_[k].right = w * d * (residuals_[k] - y * (y.dot(residuals_[k]) / pivot));
    });
  }

  /// The diagonal of the normal equations to which direction k contributes.
  double diagonal(size_t k) const {
    return weights_[k] * unknowns_.factors[k] * unknowns_.factors[k];
  }

  /// Computes the blocks of the points.
  void eliminate_points(double damping, std::vector<Eigen::Matrix3d>& inverses,
                        std::vector<Vector3>& rights) {
    for_each_point([&](size_t begin, size_t end) {
      const size_t point = size_t(directions_[begin].point);
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      Vector3 point_diagonal = Vector3::Zero();
      for (size_t k = begin; k < end; ++k) {
        sum += terms_[k].matrix;
        rights[point] += terms_[k].right;
        point_diagonal.array() += diagonal(k);
      }
      for (int axis = 0; axis < 3; ++axis) {
        sum(axis, axis) += damped(point_diagonal[axis], damping) - point_diagonal[axis];
      }
      inverses[point] = sum.inverse();
      for (size_t k = begin; k < end; ++k) weighted_[k] = terms_[k].matrix * inverses[point];
    });
  }

  /// Computes the column of a photo in the system of the cameras, with the points eliminated;
  /// returns its part of the right side.
  Vector3 add_photo(size_t photo, double damping, const std::vector<Vector3>& point_rights) {
    Vector3 own = Vector3::Zero(), right = Vector3::Zero();
    for (const size_t k : lists_.of_photo[photo]) {
      own.array() += diagonal(k);
      right += weighted_[k] * point_rights[size_t(directions_[k].point)] - terms_[k].right;
    }
    size_t pair = first_slots_[photo];
    for_each_pair(photo, [&](size_t a, size_t b) { add_pair(a, b, slots_[pair++]); });
    const Vector3 extra = own.unaryExpr([&](double x) { return damped(x, damping) - x; });
    system_.add(system_.slot(int32_t(photo), int32_t(photo)), extra.asDiagonal());
    return right;
  }

  /// Adds the contribution of two directions of one point to the system of the cameras.
  void add_pair(size_t a, size_t b, size_t slot) {
    const Eigen::Matrix3d block = -(weighted_[a] * terms_[b].matrix);
    if (a == b) {
      system_.add(slot, terms_[a].matrix + block);
    } else if (directions_[a].photo == directions_[b].photo) {
      system_.add(slot, block + block.transpose());
    } else if (directions_[a].photo > directions_[b].photo) {
      system_.add(slot, block);
    } else {
      system_.add(slot, block.transpose());
    }
  }

  Unknowns unknowns_;
  const ck_direction* directions_;
  size_t count_;
  const ck_positioning_options& options_;
  const ck_control* control_;
  const ck_control quiet_;
  const DirectionLists lists_;
  BlockCholesky system_;
  /// The block of each pair of directions, by photo in the order of `for_each_pair`, and the first
  /// one of each photo.
  std::vector<size_t> slots_, first_slots_;
  std::vector<Term> terms_;
  /// The matrix of each direction times the inverted block of its point.
  std::vector<Eigen::Matrix3d> weighted_;
  std::vector<Vector3> residuals_, offsets_;
  std::vector<double> weights_;
};

std::vector<Vector3> read(const Strided<double>& values) {
  std::vector<Vector3> vectors;
  for (size_t i = 0; i < values.count; ++i) vectors.emplace_back(values[i]);
  return vectors;
}

void write(const std::vector<Vector3>& vectors, const MutableStrided<double>& values) {
  for (size_t i = 0; i < vectors.size(); ++i) {
    for (int k = 0; k < 3; ++k) values[i][k] = vectors[i][k];
  }
}

Unknowns read(const ck_mutable_span& centers, const ck_mutable_span& points,
              const ck_direction* directions, size_t direction_count) {
  Unknowns unknowns;
  unknowns.centers = read(centers);
  unknowns.points = read(points);
  for (size_t k = 0; k < direction_count; ++k) {
    const ck_direction& d = directions[k];
    require(d.photo >= 0 && size_t(d.photo) < centers.count && d.point >= 0 &&
                size_t(d.point) < points.count && (k == 0 || d.point >= directions[k - 1].point),
            "a direction refers to a photo or point that does not exist");
  }
  unknowns.factors.assign(direction_count, 1);
  return unknowns;
}

}  // namespace
}  // namespace ck

ck_status ck_position_globally(const ck_direction* directions, size_t direction_count,
                               const ck_positioning_options* options, const ck_control* control,
                               ck_mutable_span centers, ck_mutable_span points,
                               ck_positioning_summary* summary) {
  return ck::guarded([&] {
    using namespace ck;
    require(centers.data && points.data && directions && summary && options,
            "positioning needs directions");
    require(direction_count > 0 && options->huber_width > 0, "positioning needs directions");
    Positioning positioning(read(centers, points, directions, direction_count), directions,
                            direction_count, *options, control);
    *summary = positioning.solve();
    write(positioning.unknowns().centers, centers);
    write(positioning.unknowns().points, points);
  });
}
