// The inner loops of patch-based multi-view stereo, included once for each instruction set. The
// including file defines CK_PATCH_KERNELS (the name of the table) and `gather`, and sets the
// target.

#include "core/vectors.inl"

namespace ck::patches {
namespace {

// Limit: a vector of 16 lanes holds one row of four texels for each of four sources.
constexpr int kSlots = 4;
constexpr int kRows = 4;
const F16 kDx = {-2, -1, 1, 2, -2, -1, 1, 2, -2, -1, 1, 2, -2, -1, 1, 2};

/// Spatial weights: a Gaussian with a standard deviation of two pixels. Measured: raises the share
/// of pixels within 0.5 mm from 0.944 to 0.946 on four views of boot (BENCHMARKS.md of `a00f5c5`).
const F16 kProximity = {0.368f, 0.535f, 0.535f, 0.368f, 0.535f, 0.779f, 0.779f, 0.535f,
                        0.535f, 0.779f, 0.779f, 0.535f, 0.368f, 0.535f, 0.535f, 0.368f};

/// Levenberg damping relative to the trace of the normal equations, so that poorly determined
/// directions do not change. Chosen.
constexpr float kDamping = 1e-3f;

CK_INLINE F8 absolute(const F8& v) { return __builtin_elementwise_abs(v); }

/// Projection of a patch into each source: its center and the affine map of the texel offsets.
struct Footprints {
  F8 u, v, ax, ay, bx, by;
  /// Derivative of the patch's position with respect to inverse depth, in pixels of the reference.
  F8 motion_x, motion_y;
  /// −1 where the patch lies within the source, is not mirrored, and the area of a pixel is within
  /// `kMinimumFootprint`…`kMaximumFootprint`.
  I8 is_valid;
};

CK_INLINE void locate(const Warps& t, int x, int y, const Plane& p, Footprints& f) {
  const float fx = static_cast<float>(x), fy = static_cast<float>(y);
  const F8 ex = load8(t.epipole[0]), ey = load8(t.epipole[1]), ez = load8(t.epipole[2]);
  const F8 cx = load8(t.column0[0]), cy = load8(t.column0[1]), cz = load8(t.column0[2]);
  const F8 dx = load8(t.column1[0]), dy = load8(t.column1[1]), dz = load8(t.column1[2]);
  const F8 qx = load8(t.base[0]) + fx * cx + fy * dx + p.w * ex;
  const F8 qy = load8(t.base[1]) + fx * cy + fy * dy + p.w * ey;
  const F8 qz = load8(t.base[2]) + fx * cz + fy * dz + p.w * ez;
  const F8 inverse_z = 1.0f / qz;
  f.u = qx * inverse_z;
  f.v = qy * inverse_z;
  const F8 scale_x = cz + p.gx * ez, scale_y = dz + p.gy * ez;
  f.ax = (cx + p.gx * ex - f.u * scale_x) * inverse_z;
  f.ay = (cy + p.gx * ey - f.v * scale_x) * inverse_z;
  f.bx = (dx + p.gy * ex - f.u * scale_y) * inverse_z;
  f.by = (dy + p.gy * ey - f.v * scale_y) * inverse_z;
  const F8 area = f.ax * f.by - f.ay * f.bx;
  const F8 eu = 2.0f * (absolute(f.ax) + absolute(f.bx));
  const F8 ev = 2.0f * (absolute(f.ay) + absolute(f.by));
  f.is_valid = (qz > kMinimumProjection) & (area > kMinimumFootprint) & (area < kMaximumFootprint) &
               (f.u - eu > 0.5f) & (f.v - ev > 0.5f) & (f.u + eu < load8(t.limit_u)) &
               (f.v + ev < load8(t.limit_v));
  const F8 du = (ex - f.u * ez) * inverse_z, dv = (ey - f.v * ez) * inverse_z;
  const F8 inverse_area = 1.0f / area;
  f.motion_x = (f.by * du - f.bx * dv) * inverse_area;
  f.motion_y = (f.ax * dv - f.ay * du) * inverse_area;
}

/// A row of four values, repeated for each source.
CK_INLINE F16 row(const float* values, int j) {
  F4 v;
  __builtin_memcpy(&v, values + 4 * j, sizeof v);
  return __builtin_shufflevector(v, v, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
}

/// The sum of the four lanes of each source.
CK_INLINE F4 sum_by_source(const F16& v) {
  const F8 pairs = v.even + v.odd;
  return pairs.even + pairs.odd;
}

/// The value of each of four sources in all of its lanes.
CK_INLINE F16 by_source(const float* values) {
  F4 v;
  __builtin_memcpy(&v, values, sizeof v);
  return __builtin_shufflevector(v, v, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
}

/// By bit mask: the sources in the slots of two groups, as lane indices; free slots repeat the
/// first source.
///
/// Evaluated at compile time: code of this file must not run before the processor is known.
struct Slots {
  uint8_t sources[256][kMaximumSources] = {};
  constexpr Slots() {
    for (int mask = 1; mask < 256; ++mask) {
      int slot = 0;
      for (int s = 0; s < kMaximumSources; ++s) {
        if (mask >> s & 1) sources[mask][slot++] = static_cast<uint8_t>(s);
      }
      for (; slot < kMaximumSources; ++slot) sources[mask][slot] = sources[mask][0];
    }
  }
};
constexpr Slots kSourcesOf;

/// The sources that see a patch, by slot.
struct Sources {
  const uint8_t* of_slot;
  int count;
};

/// The projection of a patch into four sources.
struct Quad {
  F16 u, v, bx, by;
  I16 offset, stride;
};

CK_INLINE Quad quad(const Warps& t, const Footprints& f, const uint8_t* sources) {
  const Lanes lanes = lanes_of(sources);
  Quad q;
  q.u = spread(f.u, lanes) - 0.5f + kDx * spread(f.ax, lanes);
  q.v = spread(f.v, lanes) - 0.5f + kDx * spread(f.ay, lanes);
  q.bx = spread(f.bx, lanes);
  q.by = spread(f.by, lanes);
  F8 offset, stride;
  __builtin_memcpy(&offset, t.offset, sizeof offset);
  __builtin_memcpy(&stride, t.stride, sizeof stride);
  q.offset = __builtin_bit_cast(I16, spread(offset, lanes));
  q.stride = __builtin_bit_cast(I16, spread(stride, lanes));
  return q;
}

/// Packed source pixels at the texels of a patch, and the subpixel position of each texel.
struct Texels {
  I16 words[kRows];
  F16 ru[kRows], rv[kRows];
};

CK_INLINE void fetch(const Warps& t, const Quad& q, Texels& texels) {
  for (int j = 0; j < kRows; ++j) {
    const auto dy = static_cast<float>(kTexelOffsets[j]);
    const F16 u = q.u + dy * q.bx, v = q.v + dy * q.by;
    const I16 iu = __builtin_convertvector(u, I16), iv = __builtin_convertvector(v, I16);
    texels.ru[j] = u - __builtin_convertvector(iu, F16);
    texels.rv[j] = v - __builtin_convertvector(iv, F16);
    gather(texels.words[j], t.texels.data(), iv * q.stride + (iu + q.offset));
  }
}

/// Bilinear gray values of four sources at a row of texels.
CK_INLINE F16 sample(const Texels& texels, int j) {
  const I16 word = texels.words[j];
  const F16 p00 = __builtin_convertvector(word & 255, F16);
  const F16 p10 = __builtin_convertvector((word >> 8) & 255, F16);
  const F16 p01 = __builtin_convertvector((word >> 16) & 255, F16);
  const F16 p11 = __builtin_convertvector((word >> 24) & 255, F16);
  const F16 upper = p00 + texels.ru[j] * (p10 - p00), lower = p01 + texels.ru[j] * (p11 - p01);
  return upper + texels.rv[j] * (lower - upper);
}

/// Four rows of eight bytes: the three pixels before a pixel, the pixel itself twice, and three
/// after it.
typedef uint8_t B32 __attribute__((ext_vector_type(32)));

CK_INLINE B32 rows_around(const uint8_t* pixel, ptrdiff_t width, const int (&rows)[kRows]) {
  typedef uint32_t U8 __attribute__((ext_vector_type(8)));
  U8 halves;
  for (int j = 0; j < kRows; ++j) {
    const uint8_t* p = pixel + rows[j] * width;
    uint32_t left, right;
    __builtin_memcpy(&left, p - 3, sizeof left);
    __builtin_memcpy(&right, p, sizeof right);
    halves[2 * j] = left;
    halves[2 * j + 1] = right;
  }
  return __builtin_bit_cast(B32, halves);
}

/// The texels −2, −1, 1 and 2 of four rows.
CK_INLINE F16 texels_of(const B32& v) {
  return __builtin_convertvector(
      __builtin_shufflevector(v, v, 1, 2, 5, 6, 9, 10, 13, 14, 17, 18, 21, 22, 25, 26, 29, 30),
      F16);
}

/// The texels one pixel to the left.
CK_INLINE F16 texels_before(const B32& v) {
  return __builtin_convertvector(
      __builtin_shufflevector(v, v, 0, 1, 4, 5, 8, 9, 12, 13, 16, 17, 20, 21, 24, 25, 28, 29), F16);
}

CK_INLINE F16 texels_after(const B32& v) {
  return __builtin_convertvector(
      __builtin_shufflevector(v, v, 2, 3, 6, 7, 10, 11, 14, 15, 18, 19, 22, 23, 26, 27, 30, 31),
      F16);
}

void prepare(ReferencePatch& patch, const Comparison& c, const Cell& cell, const float* support) {
  const uint8_t* center = c.luma + static_cast<ptrdiff_t>(cell.y) * c.width + cell.x;
  const B32 rows = rows_around(center, c.width, {-2, -1, 1, 2});
  const B32 above = rows_around(center, c.width, {-3, -2, 0, 1});
  const B32 below = rows_around(center, c.width, {-1, 0, 2, 3});
  const F16 value = texels_of(rows);
  const F16 contrast = (value - static_cast<float>(*center)) * (1 / c.bilateral_contrast);
  F16 weight = 1.0f / (1.0f + contrast * contrast);
  weight = weight * kProximity;
  if (support) weight = weight * load(support);
  weight = weight * (1 / sum(weight));
  const F16 centered = value - sum(weight * value);
  const float variance = sum(weight * centered * centered);
  patch.confidence = std::sqrt(variance / (variance + c.noise_variance));
  const float scale = 1 / std::sqrt(variance + 1e-6f);
  store(patch.weight, weight);
  store(patch.value, centered * scale);
  store(patch.weighted, weight * centered * scale);
  store(patch.gradient_x, 0.5f * (texels_after(rows) - texels_before(rows)) * scale);
  store(patch.gradient_y, 0.5f * (texels_of(below) - texels_of(above)) * scale);
}

/// The two lowest costs.
struct Lowest {
  float first = kNoPatch, second = kNoPatch;
};

CK_INLINE Lowest lowest(const F4& c) {
  const float low = std::min(c.x, c.y), high = std::max(c.x, c.y);
  const float low2 = std::min(c.z, c.w), high2 = std::max(c.z, c.w);
  return {std::min(low, low2), std::min(std::max(low, low2), std::min(high, high2))};
}

/// Up to four sources of a trial that are sampled together.
struct Group {
  int trial, index;
};

/// Weighted moments of the patch in each slot.
struct Moments {
  F4 mean[2], square[2], covariance[2];
};

CK_INLINE F8 join(const F4 (&groups)[2]) {
  return __builtin_shufflevector(groups[0], groups[1], 0, 1, 2, 3, 4, 5, 6, 7);
}

CK_INLINE void measure(const ReferencePatch& patch, const Texels& texels, int g, Samples& samples,
                       Moments& moments) {
  F16 mean = 0, square = 0, covariance = 0;
  for (int j = 0; j < kRows; ++j) {
    const F16 value = sample(texels, j);
    const F16 weighted_value = row(patch.weight, j) * value;
    mean += weighted_value;
    square += weighted_value * value;
    covariance += row(patch.weighted, j) * value;
    store(samples.values[g][j], value);
  }
  moments.mean[g] = sum_by_source(mean);
  moments.square[g] = sum_by_source(square);
  moments.covariance[g] = sum_by_source(covariance);
}

/// Computes the trial's cost and the visible slots.
CK_INLINE void conclude(const Comparison& c, Trial& trial, int count, const Moments& moments) {
  const F8 mean = join(moments.mean), square = join(moments.square);
  const F8 variance = __builtin_elementwise_max(square - mean * mean, F8(0)) + c.noise_variance;
  const F8 inverse_deviation = 1.0f / __builtin_elementwise_sqrt(variance);
  const F8 cost = 1.0f - join(moments.covariance) * inverse_deviation * trial.patch->confidence;
  // A free slot has the cost of no patch; the slots of an unused group have infinite cost.
  F8 free = kNoPatch;
  free.hi = count > kSlots ? kNoPatch : std::numeric_limits<float>::infinity();
  const I8 slot = {0, 1, 2, 3, 4, 5, 6, 7};
  const F8 costs = slot < count ? cost : free;
  const Lowest one = lowest(costs.lo), more = lowest(costs.hi);
  const float first = std::min(one.first, more.first);
  const float second = std::min(std::max(one.first, more.first), std::min(one.second, more.second));
  trial.cost = c.warps.count == 1 ? first : 0.5f * (first + second);
  Samples& samples = *trial.samples;
  store(samples.mean, mean);
  store(samples.inverse_deviation, inverse_deviation);
  // Sources with a much higher cost than the best one are occluded and do not contribute to the
  // step.
  samples.visible_slots =
      mask(costs < std::min(1.0f, kVisibleCostFactor * first + kVisibleCostOffset));
  samples.group_count = (count + kSlots - 1) / kSlots;
}

/// Processes all planes phase by phase, so that the processor has independent work while texel
/// loads and divisions are pending.
void score(const Comparison& c, Trial* trials, int count) {
  Footprints footprints[kWaveSize];
  Sources sources[kWaveSize];
  Group groups[2 * kWaveSize];
  Texels texels[2 * kWaveSize];
  Moments moments[kWaveSize];
  int group_count = 0;
  for (int i = 0; i < count; ++i) {
    const Trial& trial = trials[i];
    locate(c.warps, trial.cell.x, trial.cell.y, trial.plane, footprints[i]);
    const unsigned valid = mask(footprints[i].is_valid) & trial.sources;
    sources[i] = {kSourcesOf.sources[valid], __builtin_popcount(valid)};
    store(trial.samples->motion_x, permute(footprints[i].motion_x, sources[i].of_slot));
    store(trial.samples->motion_y, permute(footprints[i].motion_y, sources[i].of_slot));
    for (int g = 0; g < 2; ++g) {
      groups[group_count] = {i, g};
      group_count += sources[i].count > kSlots * g;
    }
    moments[i] = {};
  }
  for (int k = 0; k < group_count; ++k) {
    const auto [i, g] = groups[k];
    fetch(c.warps, quad(c.warps, footprints[i], sources[i].of_slot + kSlots * g), texels[k]);
  }
  for (int k = 0; k < group_count; ++k) {
    const auto [i, g] = groups[k];
    measure(*trials[i].patch, texels[k], g, *trials[i].samples, moments[i]);
  }
  for (int i = 0; i < count; ++i) conclude(c, trials[i], sources[i].count, moments[i]);
}

bool step(const ReferencePatch& patch, const Samples& samples, const Plane& plane, Plane& result) {
  F16 squares = 0, squares_y = 0, squares_yy = 0, products = 0, products_y = 0;
  const I16 bit = {1, 1, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4, 8, 8, 8, 8};
  for (int g = 0; g < samples.group_count; ++g) {
    const I16 is_used = (bit & static_cast<int>(samples.visible_slots >> kSlots * g)) != 0;
    const F16 share = is_used ? F16(1) : F16(0);
    const F16 mean = by_source(samples.mean + kSlots * g);
    const F16 inverse_deviation = by_source(samples.inverse_deviation + kSlots * g);
    const F16 motion_x = by_source(samples.motion_x + kSlots * g);
    const F16 motion_y = by_source(samples.motion_y + kSlots * g);
    for (int j = 0; j < kRows; ++j) {
      const F16 residual =
          (load(samples.values[g][j]) - mean) * inverse_deviation - row(patch.value, j);
      const F16 slope = row(patch.gradient_x, j) * motion_x + row(patch.gradient_y, j) * motion_y;
      const F16 weighted = share * row(patch.weight, j) * slope;
      const F16 square = weighted * slope, product = weighted * residual;
      const auto dy = static_cast<float>(kTexelOffsets[j]);
      squares += square;
      squares_y += dy * square;
      squares_yy += dy * dy * square;
      products += product;
      products_y += dy * product;
    }
  }
  const F4 dx = {-2, -1, 1, 2};
  // A quarter of a vector holds the texels of one source: these are sums over the sources.
  const F4 h = quarter_sums(squares), hy = quarter_sums(squares_y), b = quarter_sums(products);
  const float h00 = sum(h), h01 = sum(h * dx), h11 = sum(h * dx * dx);
  const float h02 = sum(hy), h12 = sum(hy * dx), h22 = sum(quarter_sums(squares_yy));
  const float b0 = -sum(b), b1 = -sum(b * dx), b2 = -sum(quarter_sums(products_y));
  const float damping = kDamping * (h00 + h11 + h22) + 1e-20f;
  const float a00 = h00 + damping, a11 = h11 + damping, a22 = h22 + damping;
  const float c00 = a11 * a22 - h12 * h12, c01 = h02 * h12 - h01 * a22, c02 = h01 * h12 - h02 * a11;
  const float determinant = a00 * c00 + h01 * c01 + h02 * c02;
  if (!(determinant > 0)) return false;
  const float c11 = a00 * a22 - h02 * h02, c12 = h01 * h02 - a00 * h12, c22 = a00 * a11 - h01 * h01;
  const float inverse = 1 / determinant;
  result.w = plane.w + (c00 * b0 + c01 * b1 + c02 * b2) * inverse;
  result.gx = plane.gx + (c01 * b0 + c11 * b1 + c12 * b2) * inverse;
  result.gy = plane.gy + (c02 * b0 + c12 * b1 + c22 * b2) * inverse;
  return std::isfinite(result.w + result.gx + result.gy);
}

}  // namespace

const Kernels& CK_PATCH_KERNELS() {
  static const Kernels table = {prepare, score, step};
  return table;
}

}  // namespace ck::patches
