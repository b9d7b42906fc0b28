#include <algorithm>
#include <array>
#include <cmath>

#include "ck_refinement.h"
#include "core/guard.h"
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

using Window = std::array<float, kCount>;

/// The effective sample size: the number of samples without weights that would determine a position
/// as well (Kish, "Survey sampling", 1965). The noise of neighboring samples is taken as
/// independent.
float effective_count(const Window& weights) {
  float sum = 0;
  for (const float weight : weights) sum += weight * weight;
  return 1 / sum;
}

/// Gaussian weights of the window, with a sum of one.
Window window_weights() {
  Window weights;
  float sum = 0;
  for (int k = 0; k < kCount; ++k) {
    const float x = static_cast<float>(k % kSide - kSide / 2);
    const float y = static_cast<float>(k / kSide - kSide / 2);
    sum += weights[k] = std::exp(-(x * x + y * y) / (2 * kSigma * kSigma));
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

const Window kWeights = window_weights();
const float kEffectiveCount = effective_count(kWeights);

float weighted_dot(const Window& a, const Window& b) {
  float sum = 0;
  for (int k = 0; k < kCount; ++k) sum += kWeights[k] * a[k] * b[k];
  return sum;
}

/// Subtracts the mean and scales to unit variance; returns the standard deviation.
float normalize(Window& values) {
  float mean = 0;
  for (int k = 0; k < kCount; ++k) mean += kWeights[k] * values[k];
  for (float& value : values) value -= mean;
  const float deviation = std::sqrt(weighted_dot(values, values));
  const float factor = deviation > 1e-6f ? 1 / deviation : 0;
  for (float& value : values) value *= factor;
  return deviation;
}

/// Projects the effect of gain and offset out of a derivative.
void project_out(Window& derivative, const Window& unit) {
  float mean = 0;
  for (int k = 0; k < kCount; ++k) mean += kWeights[k] * derivative[k];
  for (float& value : derivative) value -= mean;
  const float share = weighted_dot(derivative, unit);
  for (int k = 0; k < kCount; ++k) derivative[k] -= share * unit[k];
}

/// A normalized template with its derivatives per sample and the matrix of the normal equations.
struct Template {
  Window unit, dx, dy;
  float deviation = 0, xx = 0, xy = 0, yy = 0;

  explicit Template(const float* samples) {
    for (int k = 0; k < kCount; ++k) {
      const float* p = samples + (k / kSide + 1) * CK_TEMPLATE_SIDE + k % kSide + 1;
      unit[k] = p[0];
      dx[k] = 0.5f * (p[1] - p[-1]);
      dy[k] = 0.5f * (p[CK_TEMPLATE_SIDE] - p[-CK_TEMPLATE_SIDE]);
    }
    deviation = normalize(unit);
    const float factor = deviation > 1e-6f ? 1 / deviation : 0;
    for (int k = 0; k < kCount; ++k) dx[k] *= factor, dy[k] *= factor;
    project_out(dx, unit);
    project_out(dy, unit);
    xx = weighted_dot(dx, dx), xy = weighted_dot(dx, dy), yy = weighted_dot(dy, dy);
  }

  bool has_texture() const {
    const float mean = (xx + yy) / 2;
    const float root = std::sqrt(std::max(0.0f, mean * mean - (xx * yy - xy * xy)));
    return deviation >= kMinimumDeviation && mean > 0 &&
           mean - root >= kMinimumIsotropy * (mean + root);
  }
};

/// Locates one template; a ZNCC of −1 means that the search failed.
ck_template_match search(const LumaPyramid& image, const Template& model,
                         const ck_template_search& s, double maximum_shift) {
  const ck_template_match nothing{s.x, s.y, -1, 0, 0, 0};
  const double a = s.step * s.warp[0], b = s.step * s.warp[1], c = s.step * s.warp[2],
               d = s.step * s.warp[3];
  const double determinant = double(model.xx) * model.yy - double(model.xy) * model.xy;
  const double area = std::abs(a * d - b * c);
  if (!(determinant > 1e-12) || !(area > 1e-6)) return nothing;
  const int level = image.level_for(std::sqrt(area));
  double x = s.x, y = s.y;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Window values;
    if (!image.sample_grid(level, x, y, a, c, b, d, kSide, values.data())) return nothing;
    normalize(values);
    float bx = 0, by = 0;
    for (int k = 0; k < kCount; ++k) {
      const float residual = kWeights[k] * (values[k] - model.unit[k]);
      bx += residual * model.dx[k];
      by += residual * model.dy[k];
    }
    const double u = (model.yy * bx - model.xy * by) / determinant;
    const double v = (model.xx * by - model.xy * bx) / determinant;
    const double step_x = a * u + b * v, step_y = c * u + d * v;
    x -= step_x, y -= step_y;
    if (!(std::hypot(x - s.x, y - s.y) <= maximum_shift)) return nothing;
    if (std::hypot(step_x, step_y) < kConvergedStep) {
      const double zncc = weighted_dot(values, model.unit);
      // The residuals of two normalized windows have the variance 2 (1 − ZNCC).
      const double noise = 2 * std::max(0.0, 1 - zncc) / (kEffectiveCount * determinant);
      const double uu = noise * model.yy, uv = -noise * model.xy, vv = noise * model.xx;
      return {x,
              y,
              zncc,
              a * a * uu + 2 * a * b * uv + b * b * vv,
              a * c * uu + (a * d + b * c) * uv + b * d * vv,
              c * c * uu + 2 * c * d * uv + d * d * vv};
    }
  }
  return nothing;
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
    for (size_t i = 0; i < location_count; ++i) {
      const ck_template_location& p = locations[i];
      float values[CK_TEMPLATE_SAMPLES];
      uint16_t* out = samples + i * CK_TEMPLATE_SAMPLES;
      valid[i] = image.sample_grid(image.level_for(p.step), p.x, p.y, p.step, 0, 0, p.step,
                                   CK_TEMPLATE_SIDE, values) &&
                 ck::Template(values).has_texture();
      for (int k = 0; k < CK_TEMPLATE_SAMPLES; ++k) {
        // Cubic interpolation overshoots at edges.
        const float value = valid[i] ? std::min(1023.0f, std::max(0.0f, values[k])) : 0;
        out[k] = static_cast<uint16_t>(ck::kSampleScale * value + 0.5f);
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
    for (size_t i = 0; i < search_count; ++i) {
      const ck_template_search& s = searches[i];
      ck::require(s.index >= 0 && static_cast<size_t>(s.index) < template_count,
                  "a search refers to a template that does not exist");
      const uint16_t* stored = samples + static_cast<size_t>(s.index) * CK_TEMPLATE_SAMPLES;
      float values[CK_TEMPLATE_SAMPLES];
      for (int k = 0; k < CK_TEMPLATE_SAMPLES; ++k) values[k] = stored[k] / ck::kSampleScale;
      matches[i] = ck::search(image, ck::Template(values), s, maximum_shift);
    }
  });
}
