#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <vector>

#include "ck_bundle.h"
#include "core/guard.h"
#include "core/parallel.h"
#include "core/span.h"
#include "geometry/camera_model.h"

namespace ck {
namespace {

/// Tracks per unit of parallel work. Chosen.
constexpr size_t kTracks = 512;
/// Largest number of pairs of rays that are tried as hypotheses. Chosen.
constexpr size_t kMaximumHypotheses = 60;
/// Largest number of rounds of refining a point and selecting its inliers again. Chosen.
constexpr int kRounds = 3;
/// Largest number of Gauss–Newton steps, and the relative decrease of the cost below which they
/// stop. Chosen: Gauss–Newton hardly needs more.
constexpr int kSteps = 8;
constexpr double kTolerance = 1e-6;
/// Smallest determinant of the normal equations of rays that determine a point. Limit: rounding;
/// that of two rays is twice the squared sine of their angle.
constexpr double kMinimumDeterminant = 1e-12;

/// The photos' cameras, and their poses with rotations as matrices.
struct Views {
  std::vector<Pose> poses;
  std::vector<Vector3> centers;
  const ck_posed_photos& raw;

  explicit Views(const ck_posed_photos& views) : raw(views) {
    for (size_t i = 0; i < views.photo_count; ++i) {
      poses.push_back(pose_from(views.poses[i]));
      centers.push_back(poses.back().center());
    }
  }

  const ck_camera& camera(int photo) const { return raw.cameras[raw.photo_cameras[photo]]; }

  /// The reprojection error of a point in pixels; infinite behind the camera.
  double error(const ck_observation& observation, const Vector3& point) const {
    const Vector3 p = poses[observation.photo] * point;
    if (!(p.z() > kMinimumDepth)) return std::numeric_limits<double>::infinity();
    return (project(camera(observation.photo), p) - Vector2(observation.x, observation.y)).norm();
  }
};

/// One track with its viewing rays.
struct Track {
  const Views& views;
  const ck_observation* observations;
  size_t count;
  /// Unit vectors in the world frame.
  std::vector<Vector3> directions;

  Track(const Views& views, const ck_observation* observations, size_t count)
      : views(views), observations(observations), count(count) {
    for (size_t i = 0; i < count; ++i) {
      const int photo = observations[i].photo;
      const Vector2 ray = unproject(views.camera(photo), observations[i].x, observations[i].y);
      const Vector3 direction = Vector3(ray.x(), ray.y(), 1).normalized();
      directions.push_back(views.poses[photo].rotation.transpose() * direction);
    }
  }

  double error(const Vector3& point, size_t i) const { return views.error(observations[i], point); }

  /// The point with the smallest sum of squared distances to the chosen rays.
  bool intersect(const std::vector<size_t>& chosen, Vector3& point) const {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Vector3 b = Vector3::Zero();
    for (const size_t i : chosen) {
      const Vector3& d = directions[i];
      const Eigen::Matrix3d m = Eigen::Matrix3d::Identity() - d * d.transpose();
      a += m;
      b += m * views.centers[observations[i].photo];
    }
    if (!(a.determinant() > kMinimumDeterminant)) return false;
    point = a.inverse() * b;
    return point.allFinite();
  }

  /// Gauss–Newton on the reprojection errors of the chosen observations.
  void refine(const std::vector<size_t>& chosen, Vector3& point) const {
    double cost = squares(chosen, point);
    for (int iteration = 0; iteration < kSteps; ++iteration) {
      Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
      Vector3 g = Vector3::Zero();
      for (const size_t i : chosen) {
        const int photo = observations[i].photo;
        const Vector3 p = views.poses[photo] * point;
        const Vector2 r =
            project(views.camera(photo), p) - Vector2(observations[i].x, observations[i].y);
        const Eigen::Matrix<double, 2, 3> j =
            project_jacobian(views.camera(photo), p) * views.poses[photo].rotation;
        h.noalias() += j.transpose() * j;
        g.noalias() += j.transpose() * r;
      }
      const Vector3 next = point - h.ldlt().solve(g);
      if (!next.allFinite()) return;
      const double next_cost = squares(chosen, next);
      if (!(next_cost < cost)) return;
      const bool converged = cost - next_cost < kTolerance * cost;
      point = next;
      cost = next_cost;
      if (converged) return;
    }
  }

  /// The sum of the squared reprojection errors of the chosen observations.
  double squares(const std::vector<size_t>& chosen, const Vector3& point) const {
    double sum = 0;
    for (const size_t i : chosen) {
      const double e = error(point, i);
      sum += e * e;
    }
    return sum;
  }

  /// The angle between two viewing rays in radians.
  double angle(size_t i, size_t j) const {
    return std::atan2(directions[i].cross(directions[j]).norm(), directions[i].dot(directions[j]));
  }

  /// The largest angle at `point` between the rays to two of the chosen camera centers.
  double largest_angle(const std::vector<size_t>& chosen, const Vector3& point) const {
    std::vector<Vector3> rays;
    for (const size_t i : chosen) {
      rays.push_back((point - views.centers[observations[i].photo]).normalized());
    }
    double cosine = 1;
    for (size_t i = 0; i < rays.size(); ++i) {
      for (size_t j = i + 1; j < rays.size(); ++j) cosine = std::min(cosine, rays[i].dot(rays[j]));
    }
    return std::acos(std::clamp(cosine, -1.0, 1.0));
  }

  std::vector<size_t> inliers(const Vector3& point, double maximum_error) const {
    std::vector<size_t> chosen;
    for (size_t i = 0; i < count; ++i) {
      if (error(point, i) <= maximum_error) chosen.push_back(i);
    }
    return chosen;
  }

  /// The sum of the squared reprojection errors, each truncated.
  double score(const Vector3& point, double maximum_square) const {
    double sum = 0;
    for (size_t i = 0; i < count; ++i) {
      const double e = error(point, i);
      sum += std::min(e * e, maximum_square);
    }
    return sum;
  }

  /// The inliers of the best hypothesis from two rays.
  std::vector<size_t> robust_inliers(double maximum_error, double minimum_angle) const {
    const double maximum_square = maximum_error * maximum_error;
    double best_score = std::numeric_limits<double>::infinity();
    Vector3 best = Vector3::Zero();
    // Pairs in order of descending distance within the track.
    size_t tried = 0;
    for (size_t separation = count - 1; separation >= 1 && tried < kMaximumHypotheses;
         --separation) {
      for (size_t i = 0; i + separation < count && tried < kMaximumHypotheses; ++i) {
        if (angle(i, i + separation) < minimum_angle) continue;
        ++tried;
        Vector3 point;
        if (!intersect({i, i + separation}, point)) continue;
        const double s = score(point, maximum_square);
        if (s < best_score) {
          best_score = s;
          best = point;
        }
      }
    }
    return std::isfinite(best_score) ? inliers(best, maximum_error) : std::vector<size_t>{};
  }

  /// True if a point was found that at least two observations agree on.
  bool triangulate(const ck_triangulation_options& options, Vector3& point,
                   std::vector<size_t>& chosen) const {
    if (count < 2) return false;
    chosen.resize(count);
    for (size_t i = 0; i < count; ++i) chosen[i] = i;
    if (intersect(chosen, point)) {
      refine(chosen, point);
      if (inliers(point, options.maximum_error).size() == count) {
        return largest_angle(chosen, point) >= options.minimum_angle;
      }
    }
    if (count < 3) return false;
    chosen = robust_inliers(options.maximum_error, options.minimum_angle);
    for (int round = 0; round < kRounds; ++round) {
      if (chosen.size() < 2 || !intersect(chosen, point)) return false;
      refine(chosen, point);
      const std::vector<size_t> next = inliers(point, options.maximum_error);
      if (next == chosen) break;
      chosen = next;
    }
    return chosen.size() >= 2 && largest_angle(chosen, point) >= options.minimum_angle;
  }
};

void check(const ck_tracks& tracks, const ck_posed_photos* photos) {
  const auto [offsets, count, observations] = tracks;
  require(offsets && observations && photos && photos->cameras && photos->poses, "missing tracks");
  for (size_t t = 0; t < count; ++t)
    require(offsets[t] <= offsets[t + 1], "the offsets of the tracks are not ascending");
  for (int32_t i = 0; i < offsets[count]; ++i) {
    require(observations[i].photo >= 0 &&
                static_cast<size_t>(observations[i].photo) < photos->photo_count,
            "an observation refers to a photo that does not exist");
  }
}

}  // namespace
}  // namespace ck

ck_status ck_triangulate(const ck_tracks* tracks, const ck_posed_photos* photos,
                         const ck_triangulation_options* options, const ck_control* control,
                         ck_mutable_span positions, uint8_t* found, uint8_t* inliers) {
  return ck::guarded([&] {
    using namespace ck;
    if (tracks->count == 0) return;
    require(positions.count == tracks->count && found && inliers && options, "missing output");
    check(*tracks, photos);
    const Views prepared(*photos);
    const MutableStrided<double> points(positions);
    parallel_for_blocks(control, tracks->count, kTracks, [&](size_t t) {
      const int32_t begin = tracks->offsets[t], end = tracks->offsets[t + 1];
      std::fill(inliers + begin, inliers + end, uint8_t(0));
      const Track track(prepared, tracks->observations + begin, static_cast<size_t>(end - begin));
      Vector3 point = Vector3::Zero();
      std::vector<size_t> chosen;
      found[t] = track.triangulate(*options, point, chosen);
      if (!found[t]) return;
      for (const size_t i : chosen) inliers[begin + static_cast<int32_t>(i)] = 1;
      for (int k = 0; k < 3; ++k) points[t][k] = point[k];
    });
  });
}

ck_status ck_measure_tracks(const ck_tracks* tracks, ck_span positions,
                            const ck_posed_photos* photos, double maximum_error,
                            const ck_control* control, double* errors, double* angles) {
  return ck::guarded([&] {
    using namespace ck;
    if (tracks->count == 0) return;
    require(errors && angles && positions.count == tracks->count, "missing output");
    check(*tracks, photos);
    const auto [offsets, count, observations] = *tracks;
    const Views prepared(*photos);
    const Strided<double> points(positions);
    const auto measure = [&, offsets = offsets, observations = observations](size_t t) {
      const double* p = points[t];
      const Vector3 point(p[0], p[1], p[2]);
      std::vector<Vector3> rays;
      double cosine = 1;
      for (int32_t i = offsets[t]; i < offsets[t + 1]; ++i) {
        errors[i] = prepared.error(observations[i], point);
        if (!(errors[i] <= maximum_error)) continue;
        const Vector3 ray = (point - prepared.centers[observations[i].photo]).normalized();
        for (const Vector3& other : rays) cosine = std::min(cosine, ray.dot(other));
        rays.push_back(ray);
      }
      angles[t] = rays.size() < 2 ? 0 : std::acos(std::clamp(cosine, -1.0, 1.0));
    };
    parallel_for_blocks(control, count, kTracks, measure);
  });
}
