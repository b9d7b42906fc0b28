#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ck_refinement.h"
#include "core/guard.h"
#include "core/vectors.h"
#include "refinement/luma_pyramid.h"

namespace ck {
namespace {

/// Samples per side of the comparison window. Limit: the template without its border.
constexpr int kSide = CK_TEMPLATE_SIDE - 2;
/// Number of samples of the comparison window.
constexpr int kCount = kSide * kSide;
/// Standard deviation in samples of the weights of the window. Chosen.
constexpr float kSigma = 0.5f * (kSide / 2 + 1);
/// Largest number of iterations of a search. Chosen.
constexpr int kIterations = 15;
/// Step length in pixels below which a search has converged. Chosen: less than its error.
constexpr double kConvergedStep = 0.003;
/// Stored template samples per gray level. Limit: 16 bits hold four times the range of the luma,
/// which cubic interpolation exceeds at edges.
constexpr float kSampleScale = 64;
/// Smallest standard deviation of the luma, in gray levels, of a template with texture. Chosen.
constexpr float kMinimumDeviation = 2.5f;
/// Smallest ratio of the eigenvalues of its structure tensor. Chosen.
constexpr float kMinimumIsotropy = 0.03f;

/// Templates that are searched for at a time: the sums of one depend on each other, those of
/// several do not. Chosen: two registers of four.
constexpr int kLanes = 8;
/// A value of each of these templates.
using Lanes = F8;
using Weights = std::array<float, kCount>;
using Window = std::array<Lanes, kCount>;
/// The samples of templates, with their borders.
using Samples = std::array<Lanes, CK_TEMPLATE_SAMPLES>;

/// The effective sample size: the number of samples without weights that would determine a position
/// as well (Kish, "Survey sampling", 1965). The noise of neighboring samples is taken as
/// independent.
float effective_count(const Weights& weights) {
  float sum = 0;
  for (const float weight : weights) sum += weight * weight;
  return 1 / sum;
}

/// Gaussian weights of the window, with a sum of one.
Weights window_weights() {
  Weights weights;
  float sum = 0;
  for (int k = 0; k < kCount; ++k) {
    const float x = static_cast<float>(k % kSide - kSide / 2);
    const float y = static_cast<float>(k / kSide - kSide / 2);
    sum += weights[k] = std::exp(-(x * x + y * y) / (2 * kSigma * kSigma));
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

const Weights kWeights = window_weights();
const float kEffectiveCount = effective_count(kWeights);

CK_INLINE Lanes weighted_dot(const Window& a, const Window& b) {
  Lanes sum = 0;
  for (int k = 0; k < kCount; ++k) sum += kWeights[k] * a[k] * b[k];
  return sum;
}

/// The reciprocal of a standard deviation; 0 without any texture.
CK_INLINE Lanes reciprocal(Lanes deviation) { return deviation > 1e-6f ? 1 / deviation : Lanes(0); }

/// Subtracts the mean and scales to unit variance; returns the standard deviation.
CK_INLINE Lanes normalize(Window& values) {
  Lanes mean = 0;
  for (int k = 0; k < kCount; ++k) mean += kWeights[k] * values[k];
  for (Lanes& value : values) value -= mean;
  const Lanes deviation = __builtin_elementwise_sqrt(weighted_dot(values, values));
  const Lanes factor = reciprocal(deviation);
  for (Lanes& value : values) value *= factor;
  return deviation;
}

/// Projects the effect of gain and offset out of a derivative.
CK_INLINE void project_out(Window& derivative, const Window& unit) {
  Lanes mean = 0;
  for (int k = 0; k < kCount; ++k) mean += kWeights[k] * derivative[k];
  for (Lanes& value : derivative) value -= mean;
  const Lanes share = weighted_dot(derivative, unit);
  for (int k = 0; k < kCount; ++k) derivative[k] -= share * unit[k];
}

/// Normalized templates with their derivatives per sample and the matrices of the normal equations.
struct Templates {
  Window unit, dx, dy;
  Lanes deviation, xx, xy, yy;

  explicit Templates(const Samples& samples) {
    for (int k = 0; k < kCount; ++k) {
      const Lanes* p = &samples[(k / kSide + 1) * CK_TEMPLATE_SIDE + k % kSide + 1];
      unit[k] = p[0];
      dx[k] = 0.5f * (p[1] - p[-1]);
      dy[k] = 0.5f * (p[CK_TEMPLATE_SIDE] - p[-CK_TEMPLATE_SIDE]);
    }
    deviation = normalize(unit);
    const Lanes factor = reciprocal(deviation);
    for (int k = 0; k < kCount; ++k) dx[k] *= factor, dy[k] *= factor;
    project_out(dx, unit);
    project_out(dy, unit);
    xx = weighted_dot(dx, dx), xy = weighted_dot(dx, dy), yy = weighted_dot(dy, dy);
  }

  bool has_texture(int lane) const {
    const float mean = (xx[lane] + yy[lane]) / 2;
    const float determinant = xx[lane] * yy[lane] - xy[lane] * xy[lane];
    const float root = std::sqrt(std::max(0.0f, mean * mean - determinant));
    return deviation[lane] >= kMinimumDeviation && mean > 0 &&
           mean - root >= kMinimumIsotropy * (mean + root);
  }
};

/// The search for one template.
class Search {
 public:
  Search(const LumaPyramid& image, const Templates& model, int lane, const ck_template_search& s,
         double maximum_shift)
      : xx_(model.xx[lane]),
        xy_(model.xy[lane]),
        yy_(model.yy[lane]),
        determinant_(double(xx_) * yy_ - double(xy_) * xy_),
        a_(s.step * s.warp[0]),
        b_(s.step * s.warp[1]),
        c_(s.step * s.warp[2]),
        d_(s.step * s.warp[3]),
        x_(s.x),
        y_(s.y),
        start_x_(s.x),
        start_y_(s.y),
        maximum_shift_(maximum_shift),
        match_{s.x, s.y, -1, 0, 0, 0} {
    const double area = std::abs(a_ * d_ - b_ * c_);
    is_running_ = determinant_ > 1e-12 && area > 1e-6;
    if (is_running_) level_ = image.level_for(std::sqrt(area));
  }

  bool is_running() const { return is_running_; }
  /// A ZNCC of −1 means that the search failed.
  const ck_template_match& match() const { return match_; }

  /// Samples the photo where the template is expected; ends outside of it.
  void sample(const LumaPyramid& image, int lane, Window& values) {
    float own[kCount];
    is_running_ = image.sample_grid(level_, x_, y_, a_, c_, b_, d_, kSide, own);
    if (!is_running_) return;
    for (int k = 0; k < kCount; ++k) values[k][lane] = own[k];
  }

  /// Takes a step, from the right side of the normal equations; true if the search has converged.
  bool advance(float bx, float by) {
    const double u = (yy_ * bx - xy_ * by) / determinant_;
    const double v = (xx_ * by - xy_ * bx) / determinant_;
    const double step_x = a_ * u + b_ * v, step_y = c_ * u + d_ * v;
    x_ -= step_x, y_ -= step_y;
    is_running_ = std::hypot(x_ - start_x_, y_ - start_y_) <= maximum_shift_;
    return is_running_ && std::hypot(step_x, step_y) < kConvergedStep;
  }

  /// Ends with a result.
  void finish(double zncc) {
    is_running_ = false;
    // The residuals of two normalized windows have the variance 2 (1 − ZNCC).
    const double noise = 2 * std::max(0.0, 1 - zncc) / (kEffectiveCount * determinant_);
    const double uu = noise * yy_, uv = -noise * xy_, vv = noise * xx_;
    match_ = {x_,
              y_,
              zncc,
              a_ * a_ * uu + 2 * a_ * b_ * uv + b_ * b_ * vv,
              a_ * c_ * uu + (a_ * d_ + b_ * c_) * uv + b_ * d_ * vv,
              c_ * c_ * uu + 2 * c_ * d_ * uv + d_ * d_ * vv};
  }

 private:
  float xx_, xy_, yy_;
  double determinant_;
  /// The photo's pixels per step in the template: (a, c) along a row, (b, d) along a column.
  double a_, b_, c_, d_;
  double x_, y_, start_x_, start_y_, maximum_shift_;
  ck_template_match match_;
  int level_ = 0;
  bool is_running_;
};

/// Locates templates, one in each lane.
void run(std::vector<Search>& searches, const LumaPyramid& image, const Templates& model) {
  Window values{};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    bool is_any_running = false;
    for (size_t lane = 0; lane < searches.size(); ++lane) {
      if (!searches[lane].is_running()) continue;
      searches[lane].sample(image, int(lane), values);
      is_any_running = true;
    }
    if (!is_any_running) return;
    normalize(values);
    Lanes bx = 0, by = 0;
    for (int k = 0; k < kCount; ++k) {
      const Lanes residual = kWeights[k] * (values[k] - model.unit[k]);
      bx += residual * model.dx[k];
      by += residual * model.dy[k];
    }
    const Lanes zncc = weighted_dot(values, model.unit);
    for (size_t lane = 0; lane < searches.size(); ++lane) {
      Search& search = searches[lane];
      if (search.is_running() && search.advance(bx[lane], by[lane])) search.finish(zncc[lane]);
    }
  }
}

LumaPyramid pyramid_of(const ck_pixels& photo, ck_instructions instructions) {
  const auto [pixels, width, height, channels, row_stride] = photo;
  require(pixels && width > 0 && height > 0, "an image is needed");
  require(channels == 1 || channels == 3 || channels == 4, "1, 3 or 4 channels are needed");
  require(row_stride >= static_cast<size_t>(width) * channels, "the row stride is too small");
  return LumaPyramid(pixels, width, height, channels, row_stride, instructions);
}

}  // namespace
}  // namespace ck

ck_status ck_extract_templates(const ck_pixels* photo, const ck_template_location* locations,
                               size_t location_count, ck_instructions instructions,
                               uint16_t* samples, uint8_t* valid) {
  return ck::guarded([&] {
    const ck::LumaPyramid image = ck::pyramid_of(*photo, instructions);
    for (size_t first = 0; first < location_count; first += ck::kLanes) {
      const size_t count = std::min<size_t>(ck::kLanes, location_count - first);
      ck::Samples values{};
      for (size_t lane = 0; lane < count; ++lane) {
        const ck_template_location& p = locations[first + lane];
        float own[CK_TEMPLATE_SAMPLES] = {};
        valid[first + lane] = image.sample_grid(image.level_for(p.step), p.x, p.y, p.step, 0, 0,
                                                p.step, CK_TEMPLATE_SIDE, own);
        for (int k = 0; k < CK_TEMPLATE_SAMPLES; ++k) values[k][lane] = own[k];
      }
      const ck::Templates templates(values);
      for (size_t lane = 0; lane < count; ++lane) {
        valid[first + lane] = valid[first + lane] && templates.has_texture(int(lane));
        uint16_t* out = samples + (first + lane) * CK_TEMPLATE_SAMPLES;
        for (int k = 0; k < CK_TEMPLATE_SAMPLES; ++k) {
          // Cubic interpolation overshoots at edges.
          const float value = std::min(1023.0f, std::max(0.0f, float(values[k][lane])));
          out[k] = valid[first + lane] ? static_cast<uint16_t>(ck::kSampleScale * value + 0.5f) : 0;
        }
      }
    }
  });
}

ck_status ck_match_templates(const ck_pixels* photo, const uint16_t* samples, size_t template_count,
                             const ck_template_search* searches, size_t search_count,
                             double maximum_shift, ck_instructions instructions,
                             ck_template_match* matches) {
  return ck::guarded([&] {
    const ck::LumaPyramid image = ck::pyramid_of(*photo, instructions);
    for (size_t first = 0; first < search_count; first += ck::kLanes) {
      const size_t count = std::min<size_t>(ck::kLanes, search_count - first);
      ck::Samples values{};
      for (size_t lane = 0; lane < count; ++lane) {
        const int32_t index = searches[first + lane].index;
        ck::require(index >= 0 && static_cast<size_t>(index) < template_count,
                    "a search refers to a template that does not exist");
        const uint16_t* stored = samples + static_cast<size_t>(index) * CK_TEMPLATE_SAMPLES;
        for (int k = 0; k < CK_TEMPLATE_SAMPLES; ++k) {
          values[k][lane] = stored[k] / ck::kSampleScale;
        }
      }
      const ck::Templates model(values);
      std::vector<ck::Search> group;
      for (size_t lane = 0; lane < count; ++lane) {
        group.emplace_back(image, model, int(lane), searches[first + lane], maximum_shift);
      }
      ck::run(group, image, model);
      for (size_t lane = 0; lane < count; ++lane) matches[first + lane] = group[lane].match();
    }
  });
}
