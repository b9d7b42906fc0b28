// The inner loops of patch stereo, included once for each instruction set. The including file
// defines CK_PATCH_KERNELS (the name of the table) and `gather`, and sets the target.

namespace ck::patches {
namespace {

#define CK_INLINE inline __attribute__((always_inline))

const F16 kDx = {-2, -1, 1, 2, -2, -1, 1, 2, -2, -1, 1, 2, -2, -1, 1, 2};
const F16 kDy = {-2, -2, -2, -2, -1, -1, -1, -1, 1, 1, 1, 1, 2, 2, 2, 2};

CK_INLINE float sum(const F16& v) {
  const F8 a = v.lo + v.hi;
  const F4 b = a.lo + a.hi;
  return (b.x + b.z) + (b.y + b.w);
}

CK_INLINE F16 load(const float* p) {
  F16 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

CK_INLINE void store(float* p, const F16& v) { __builtin_memcpy(p, &v, sizeof v); }

CK_INLINE F8 load8(const float* p) {
  F8 v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

CK_INLINE void store8(float* p, const F8& v) { __builtin_memcpy(p, &v, sizeof v); }

CK_INLINE F8 absolute(const F8& v) { return __builtin_elementwise_abs(v); }

/// Where a patch lies in each source: its centre and the affine map of the offsets.
struct Footprints {
  F8 u, v, ax, ay, bx, by;
  /// Motion of the patch with inverse depth, in pixels of the reference.
  F8 motion_x, motion_y;
  /// −1 where the patch lies in the source, is not turned over and keeps about its size.
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
  f.is_valid = (qz > 1e-6f) & (area > 0.1f) & (area < 8.0f) & (f.u - eu > 0.5f) &
               (f.v - ev > 0.5f) & (f.u + eu < load8(t.limit_u)) & (f.v + ev < load8(t.limit_v));
  const F8 du = (ex - f.u * ez) * inverse_z, dv = (ey - f.v * ez) * inverse_z;
  const F8 inverse_area = 1.0f / area;
  f.motion_x = (f.by * du - f.bx * dv) * inverse_area;
  f.motion_y = (f.ax * dv - f.ay * du) * inverse_area;
}

/// The grey values of source `s` at the 16 texels, bilinearly.
CK_INLINE F16 sample(const Warps& t, const Footprints& f, int s) {
  const F16 u = (f.u[s] - 0.5f) + kDx * f.ax[s] + kDy * f.bx[s];
  const F16 v = (f.v[s] - 0.5f) + kDx * f.ay[s] + kDy * f.by[s];
  const I16 iu = __builtin_convertvector(u, I16), iv = __builtin_convertvector(v, I16);
  const F16 ru = u - __builtin_convertvector(iu, F16), rv = v - __builtin_convertvector(iv, F16);
  I16 word;
  gather(word, t.packed[s], iv * t.stride[s] + iu);
  const F16 p00 = __builtin_convertvector(word & 255, F16);
  const F16 p10 = __builtin_convertvector((word >> 8) & 255, F16);
  const F16 p01 = __builtin_convertvector((word >> 16) & 255, F16);
  const F16 p11 = __builtin_convertvector((word >> 24) & 255, F16);
  const F16 upper = p00 + ru * (p10 - p00), lower = p01 + ru * (p11 - p01);
  return upper + rv * (lower - upper);
}

void prepare(ReferencePatch& patch, const Comparison& c, int x, int y) {
  const uint8_t* center = c.luma + static_cast<ptrdiff_t>(y) * c.width + x;
  float grey[kTexels], gx[kTexels], gy[kTexels];
  constexpr int kOffset[4] = {-2, -1, 1, 2};
  for (int j = 0; j < 4; ++j) {
    const uint8_t* row = center + static_cast<ptrdiff_t>(kOffset[j]) * c.width;
    for (int i = 0; i < 4; ++i) {
      const uint8_t* p = row + kOffset[i];
      grey[4 * j + i] = p[0];
      gx[4 * j + i] = 0.5f * (p[1] - p[-1]);
      gy[4 * j + i] = 0.5f * (p[c.width] - p[-c.width]);
    }
  }
  const F16 value = load(grey);
  const F16 contrast = (value - static_cast<float>(*center)) * (1 / c.bilateral_contrast);
  F16 weight = 1.0f / (1.0f + contrast * contrast);
  weight = weight * (1 / sum(weight));
  const F16 centered = value - sum(weight * value);
  const float variance = sum(weight * centered * centered);
  patch.deviation = std::sqrt(variance);
  patch.confidence = patch.deviation / std::sqrt(variance + c.noise_variance);
  const float scale = 1 / std::sqrt(variance + 1e-6f);
  store(patch.weight, weight);
  store(patch.value, centered * scale);
  store(patch.weighted, weight * centered * scale);
  store(patch.gradient_x, load(gx) * scale);
  store(patch.gradient_y, load(gy) * scale);
}

/// The mean of the two lowest costs, and the sources of the lowest ones.
CK_INLINE Score summarise(const float* costs, int count, int kept_sources) {
  float best = 2, second = 2;
  for (int s = 0; s < count; ++s) {
    second = std::min(second, std::max(best, costs[s]));
    best = std::min(best, costs[s]);
  }
  Score result;
  result.cost = count == 1 ? best : 0.5f * (best + second);
  for (int kept = 0; kept < kept_sources; ++kept) {
    int argmin = -1;
    for (int s = 0; s < count; ++s) {
      if (costs[s] < 1 && !(result.best >> s & 1) && (argmin < 0 || costs[s] < costs[argmin])) {
        argmin = s;
      }
    }
    if (argmin < 0) break;
    result.best |= static_cast<uint8_t>(1 << argmin);
  }
  return result;
}

Score score(const ReferencePatch& patch, const Comparison& c, int x, int y, const Plane& plane,
            uint8_t sources, Samples& samples) {
  Footprints f;
  locate(c.warps, x, y, plane, f);
  const F16 weight = load(patch.weight), weighted = load(patch.weighted);
  F8 mean = 0, square = 0, covariance = 0;
  for (int s = 0; s < c.warps.count; ++s) {
    if (!(sources >> s & 1) || !f.is_valid[s]) continue;
    const F16 value = sample(c.warps, f, s);
    const F16 weighted_value = weight * value;
    mean[s] = sum(weighted_value);
    square[s] = sum(weighted_value * value);
    covariance[s] = sum(weighted * value);
    store(samples.values[s], value);
  }
  const F8 variance = __builtin_elementwise_max(square - mean * mean, F8(0)) + c.noise_variance;
  const F8 inverse_deviation = 1.0f / __builtin_elementwise_sqrt(variance);
  const F8 similarity = covariance * inverse_deviation * patch.confidence;
  store8(samples.mean, mean);
  store8(samples.inverse_deviation, inverse_deviation);
  store8(samples.motion_x, f.motion_x);
  store8(samples.motion_y, f.motion_y);
  float costs[kMaxSources];
  for (int s = 0; s < c.warps.count; ++s) {
    costs[s] = (sources >> s & 1) && f.is_valid[s] ? 1 - similarity[s] : 2;
  }
  return summarise(costs, c.warps.count, c.kept_sources);
}

bool step(const ReferencePatch& patch, const Samples& samples, const Plane& plane,
          uint8_t sources, Plane& result) {
  const F16 weight = load(patch.weight), reference = load(patch.value);
  const F16 gx = load(patch.gradient_x), gy = load(patch.gradient_y);
  F16 squares = 0, products = 0;
  for (int s = 0; s < kMaxSources; ++s) {
    if (!(sources >> s & 1)) continue;
    const F16 value = load(samples.values[s]);
    const F16 residual = (value - samples.mean[s]) * samples.inverse_deviation[s] - reference;
    const F16 slope = gx * samples.motion_x[s] + gy * samples.motion_y[s];
    squares += weight * slope * slope;
    products += weight * slope * residual;
  }
  const float h00 = sum(squares), h01 = sum(squares * kDx), h02 = sum(squares * kDy);
  const float h11 = sum(squares * kDx * kDx), h12 = sum(squares * kDx * kDy);
  const float h22 = sum(squares * kDy * kDy);
  const float b0 = -sum(products), b1 = -sum(products * kDx), b2 = -sum(products * kDy);
  // Levenberg's damping keeps weak directions where they are.
  const float damping = 1e-3f * (h00 + h11 + h22) + 1e-20f;
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
