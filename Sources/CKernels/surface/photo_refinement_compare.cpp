#include <algorithm>
#include <cmath>
#include <numeric>

#include "surface/photo_refinement.h"

namespace ck::surface {
namespace {

/// Surface seen at a smaller cosine is not compared. Chosen.
constexpr float kMinimumCosine = 0.25f;
/// Correlation from which a window has full weight. Chosen.
constexpr float kGoodCorrelation = 0.9f;
/// Smallest fraction of a window that must be visible in both photos. Chosen: by trial.
constexpr float kMinimumCoverage = 0.5f;
/// Threshold of the Huber weights, in standard deviations of the window. Chosen.
constexpr float kLargeDifference = 1;
/// Image border in pixels around a position. Chosen: interpolation reads two pixels on each side.
constexpr float kMargin = 3;
/// Approximate number of vertices that are sampled to select partners. Chosen.
constexpr size_t kSamples = 20000;
/// Triangulation angle in degrees from which the depth is well determined, and the standard
/// deviation in degrees of the decrease of the weight beyond it, where views become too dissimilar.
/// Chosen.
constexpr float kGoodAngle = 15, kAngleSpread = 20;

/// Weight of a pair of views by the cosine of their triangulation angle.
float angle_weight(float cosine) {
  const float degrees = std::acos(std::clamp(cosine, -1.0f, 1.0f)) * 57.29578f;
  if (degrees < kGoodAngle) return degrees / kGoodAngle;
  const float excess = (degrees - kGoodAngle) / kAngleSpread;
  return std::exp(-excess * excess / 2);
}

/// Replaces all values by their sums over the squares that extend `radius` around them.
void sum_squares(int width, int height, int radius, std::vector<float>* values) {
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  const auto r = static_cast<size_t>(radius);
  std::vector<float> rows(values->size());
  for (size_t y = 0; y < h; ++y) {
    const float* from = values->data() + y * w;
    double sum = 0;
    for (size_t x = 0; x < std::min(r, w); ++x) sum += from[x];
    for (size_t x = 0; x < w; ++x) {
      if (x + r < w) sum += from[x + r];
      if (x > r) sum -= from[x - r - 1];
      rows[y * w + x] = static_cast<float>(sum);
    }
  }
  std::vector<double> sums(w, 0);
  for (size_t y = 0; y < std::min(r, h); ++y) {
    for (size_t x = 0; x < w; ++x) sums[x] += rows[y * w + x];
  }
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 0; x < w; ++x) {
      if (y + r < h) sums[x] += rows[(y + r) * w + x];
      if (y > r) sums[x] -= rows[(y - r - 1) * w + x];
      (*values)[y * w + x] = static_cast<float>(sums[x]);
    }
  }
}

/// Interpolation weights of four adjacent values at `t` between the second and the third, and the
/// weights of the derivative (Catmull–Rom).
struct Cubic {
  float weights[4], slopes[4];

  explicit Cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    weights[0] = -0.5f * t + t2 - 0.5f * t3;
    weights[1] = 1 - 2.5f * t2 + 1.5f * t3;
    weights[2] = 0.5f * t + 2 * t2 - 1.5f * t3;
    weights[3] = -0.5f * t2 + 0.5f * t3;
    slopes[0] = -0.5f + 2 * t - 1.5f * t2;
    slopes[1] = -5 * t + 4.5f * t2;
    slopes[2] = 0.5f + 4 * t - 4.5f * t2;
    slopes[3] = -t + 1.5f * t2;
  }
};

/// Luminance at a pixel position (x), and its derivatives along x and y (y, z).
Vec3 sample(const RefinementView& view, float x, float y) {
  x -= 0.5f;
  y -= 0.5f;
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const Cubic across(x - static_cast<float>(left)), down(y - static_cast<float>(top));
  const auto width = static_cast<size_t>(view.view.camera.width);
  const uint8_t* p =
      view.luminance.data() + static_cast<size_t>(top - 1) * width + static_cast<size_t>(left - 1);
  Vec3 result;
  for (size_t k = 0; k < 4; ++k, p += width) {
    float value = 0, slope = 0;
    for (size_t i = 0; i < 4; ++i) {
      value += across.weights[i] * p[i];
      slope += across.slopes[i] * p[i];
    }
    result += {down.weights[k] * value, down.weights[k] * slope, down.slopes[k] * value};
  }
  return result;
}

/// The comparison of one view with its partners.
class Comparison {
 public:
  Comparison(const RefinedMesh& mesh, const RefinementView& view,
             const ck_photo_refinement_options& options)
      : mesh_(mesh), view_(view), options_(options), image_(mesh, view, 1) {
    evidence_.resize(image_.triangles.size());
    points_.resize(evidence_.size());
    moves_.resize(evidence_.size());
    reference_.resize(evidence_.size());
    for (size_t i = 0; i < evidence_.size(); ++i) evidence_[i] = locate(i);
  }

  void add(const RefinementView& partner) {
    warp(partner);
    sums_ = {valid_, reference_, other_, slope_, valid_, valid_, valid_};
    for (size_t i = 0; i < valid_.size(); ++i) {
      sums_[kReference][i] *= valid_[i];
      sums_[kReference2][i] = sums_[kReference][i] * reference_[i];
      sums_[kOther2][i] = other_[i] * other_[i];
      sums_[kBoth][i] = sums_[kReference][i] * other_[i];
    }
    for (auto& sum : sums_) sum_squares(image_.width, image_.height, options_.radius, &sum);
    const auto side = static_cast<float>(2 * options_.radius + 1);
    for (size_t i = 0; i < valid_.size(); ++i) {
      if (valid_[i] > 0 && sums_[kCount][i] > kMinimumCoverage * side * side) add_evidence(i);
    }
  }

  /// The evidence of the pixels that at least one partner constrains.
  std::vector<PixelEvidence> result() const {
    std::vector<PixelEvidence> found;
    for (const PixelEvidence& e : evidence_) {
      if (e.slope2 > 0) found.push_back(e);
    }
    return found;
  }

 private:
  enum { kCount, kReference, kOther, kSlope, kReference2, kOther2, kBoth, kSums };

  /// Computes the surface point of a pixel and its displacement along the viewing ray per unit of
  /// displacement of the surface along its normal.
  PixelEvidence locate(size_t i) {
    PixelEvidence e = {image_.triangles[i], {}, 0, 0};
    if (e.triangle == SurfaceImage::kNone) return e;
    const auto& t = mesh_.triangles[e.triangle];
    const int x = image_.x0 + static_cast<int>(i % static_cast<size_t>(image_.width));
    const int y = image_.y0 + static_cast<int>(i / static_cast<size_t>(image_.width));
    const Vec3 pixel = {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                        image_.depths[i]};
    Vec3 corners[3];
    float sum = 0;
    for (size_t k = 0; k < 3; ++k) corners[k] = view_.project(mesh_.positions[t[k]]);
    for (size_t k = 0; k < 3; ++k) {
      const Vec3 &a = corners[(k + 1) % 3], &b = corners[(k + 2) % 3];
      const float part = (a.x - pixel.x) * (b.y - pixel.y) - (a.y - pixel.y) * (b.x - pixel.x);
      e.weights[k] = part / corners[k].z;
      sum += e.weights[k];
    }
    Vec3 point;
    for (size_t k = 0; k < 3; ++k) {
      e.weights[k] = std::clamp(e.weights[k] / sum, 0.0f, 1.0f);
      point += mesh_.positions[t[k]] * e.weights[k];
    }
    const Vec3 normal = normalized(mesh_.doubled_area(t));
    const Vec3 ray = point - view_.projection.center;
    const float slope = dot(normal, ray);
    const bool is_good = sum != 0 && slope < -kMinimumCosine * length(ray);
    if (!is_good || !view_.sees(pixel, 0)) return {SurfaceImage::kNone, {}, 0, 0};
    points_[i] = point;
    moves_[i] = ray * (1 / slope);
    reference_[i] =
        view_.luminance[static_cast<size_t>(y) * static_cast<size_t>(view_.view.camera.width) +
                        static_cast<size_t>(x)];
    return e;
  }

  /// Warps the partner's photo into this view, with its derivative with respect to the surface
  /// displacement.
  void warp(const RefinementView& partner) {
    valid_.assign(evidence_.size(), 0);
    other_.assign(evidence_.size(), 0);
    slope_.assign(evidence_.size(), 0);
    const float fx = static_cast<float>(partner.view.camera.fx);
    const float fy = static_cast<float>(partner.view.camera.fy);
    const float cx = static_cast<float>(partner.view.camera.cx);
    const float cy = static_cast<float>(partner.view.camera.cy);
    float r[9];
    std::copy(partner.projection.rotation.begin(), partner.projection.rotation.end(), r);
    for (size_t i = 0; i < evidence_.size(); ++i) {
      if (evidence_[i].triangle == SurfaceImage::kNone) continue;
      const Vec3 p = partner.project(points_[i]);
      if (!partner.sees(p, kMargin)) continue;
      const Vec3& m = moves_[i];
      const Vec3 turned = {r[0] * m.x + r[1] * m.y + r[2] * m.z,
                           r[3] * m.x + r[4] * m.y + r[5] * m.z,
                           r[6] * m.x + r[7] * m.y + r[8] * m.z};
      const float dx = (fx * turned.x - (p.x - cx) * turned.z) / p.z;
      const float dy = (fy * turned.y - (p.y - cy) * turned.z) / p.z;
      const Vec3 seen = sample(partner, p.x, p.y);
      valid_[i] = 1;
      other_[i] = seen.x;
      slope_[i] = seen.y * dx + seen.z * dy;
    }
  }

  /// Adds the evidence of a pixel: the difference of the two luminances, each normalized by the
  /// mean and standard deviation of its window, and its derivative.
  void add_evidence(size_t i) {
    const float n = 1 / sums_[kCount][i];
    const float reference_mean = sums_[kReference][i] * n, other_mean = sums_[kOther][i] * n;
    const float noise2 = options_.noise * options_.noise;
    const float reference2 =
        std::max(0.0f, sums_[kReference2][i] * n - reference_mean * reference_mean) + noise2;
    const float other2 = std::max(0.0f, sums_[kOther2][i] * n - other_mean * other_mean) + noise2;
    const float both = sums_[kBoth][i] * n - reference_mean * other_mean;
    const float correlation = both / std::sqrt(reference2 * other2);
    const float least = options_.minimum_correlation;
    if (!(correlation > least)) return;
    const float other_scale = 1 / std::sqrt(other2);
    const float difference = (other_[i] - other_mean) * other_scale -
                             (reference_[i] - reference_mean) / std::sqrt(reference2);
    const float slope = (slope_[i] - sums_[kSlope][i] * n) * other_scale;
    float weight =
        std::min(1.0f, (correlation - least) / std::max(1e-3f, kGoodCorrelation - least));
    weight *= std::min(1.0f, kLargeDifference / std::max(1e-9f, std::fabs(difference)));
    evidence_[i].slope2 += weight * slope * slope;
    evidence_[i].pull -= weight * slope * difference;
  }

  const RefinedMesh& mesh_;
  const RefinementView& view_;
  const ck_photo_refinement_options& options_;
  SurfaceImage image_;
  std::vector<PixelEvidence> evidence_;
  std::vector<Vec3> points_, moves_;
  /// By pixel: this view's luminance, whether the partner sees the point, its luminance there, and
  /// the derivative of the latter.
  std::vector<float> reference_, valid_, other_, slope_;
  std::array<std::vector<float>, kSums> sums_;
};

}  // namespace

void choose_partners(const RefinedMesh& mesh, int count, std::vector<RefinementView>* views) {
  const size_t n = views->size();
  std::vector<double> scores(n * n, 0);
  const size_t stride = std::max<size_t>(1, mesh.positions.size() / kSamples);
  for (size_t v = 0; v < mesh.positions.size(); v += stride) {
    std::vector<std::pair<size_t, Vec3>> seeing;
    for (size_t i = 0; i < n; ++i) {
      const RefinementView& view = (*views)[i];
      const Vec3 ray = normalized(view.projection.center - mesh.positions[v]);
      if (dot(ray, mesh.normals[v]) < kMinimumCosine) continue;
      if (view.sees(view.project(mesh.positions[v]), kMargin)) seeing.push_back({i, ray});
    }
    for (const auto& [i, ray_i] : seeing) {
      for (const auto& [j, ray_j] : seeing) {
        if (i == j) continue;
        const float cosine = std::min(dot(ray_i, mesh.normals[v]), dot(ray_j, mesh.normals[v]));
        scores[i * n + j] += cosine * angle_weight(dot(ray_i, ray_j));
      }
    }
  }
  for (size_t i = 0; i < n; ++i) {
    std::vector<uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0u);
    const double* score = scores.data() + i * n;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return score[a] != score[b] ? score[a] > score[b] : a < b;
    });
    order.resize(std::min(n, static_cast<size_t>(count)));
    order.erase(
        std::remove_if(order.begin(), order.end(), [&](uint32_t j) { return !(score[j] > 0); }),
        order.end());
    (*views)[i].partners = order;
  }
}

std::vector<PixelEvidence> compare(const RefinedMesh& mesh,
                                   const std::vector<RefinementView>& views, size_t index,
                                   const ck_photo_refinement_options& options) {
  if (views[index].partners.empty()) return {};
  Comparison comparison(mesh, views[index], options);
  for (uint32_t partner : views[index].partners) comparison.add(views[partner]);
  return comparison.result();
}

}  // namespace ck::surface
