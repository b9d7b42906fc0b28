// The inner loops of patch stereo, included once for each instruction set. The including file
// defines CK_PATCH_KERNELS (the name of the table) and `gather`, and sets the target.

namespace ck::patches {
namespace {

typedef float F8 __attribute__((ext_vector_type(8)));
typedef float F4 __attribute__((ext_vector_type(4)));

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

/// Where a patch lies in a source: its centre and the affine map of the offsets.
struct Footprint {
  float u, v, inverse_z;
  float ax, ay, bx, by;
};

/// False where the patch leaves the source, is turned over or changes its size too much.
CK_INLINE bool locate(const Warp& t, int x, int y, const Plane& p, Footprint& f) {
  const float fx = static_cast<float>(x), fy = static_cast<float>(y);
  const float qx = t.base[0] + fx * t.column0[0] + fy * t.column1[0] + p.w * t.epipole[0];
  const float qy = t.base[1] + fx * t.column0[1] + fy * t.column1[1] + p.w * t.epipole[1];
  const float qz = t.base[2] + fx * t.column0[2] + fy * t.column1[2] + p.w * t.epipole[2];
  if (!(qz > 1e-6f)) return false;
  f.inverse_z = 1 / qz;
  f.u = qx * f.inverse_z;
  f.v = qy * f.inverse_z;
  const float cz = t.column0[2] + p.gx * t.epipole[2], dz = t.column1[2] + p.gy * t.epipole[2];
  f.ax = (t.column0[0] + p.gx * t.epipole[0] - f.u * cz) * f.inverse_z;
  f.ay = (t.column0[1] + p.gx * t.epipole[1] - f.v * cz) * f.inverse_z;
  f.bx = (t.column1[0] + p.gy * t.epipole[0] - f.u * dz) * f.inverse_z;
  f.by = (t.column1[1] + p.gy * t.epipole[1] - f.v * dz) * f.inverse_z;
  const float area = f.ax * f.by - f.ay * f.bx;
  if (!(area > 0.1f && area < 8)) return false;
  const float eu = 2 * (std::fabs(f.ax) + std::fabs(f.bx));
  const float ev = 2 * (std::fabs(f.ay) + std::fabs(f.by));
  return f.u - eu > 0.5f && f.v - ev > 0.5f && f.u + eu < t.width - 1.5f &&
         f.v + ev < t.height - 1.5f;
}

/// The source's grey values at the 16 texels, bilinearly.
CK_INLINE F16 sample(const Warp& t, const Footprint& f) {
  const F16 u = (f.u - 0.5f) + kDx * f.ax + kDy * f.bx;
  const F16 v = (f.v - 0.5f) + kDx * f.ay + kDy * f.by;
  const I16 iu = __builtin_convertvector(u, I16), iv = __builtin_convertvector(v, I16);
  const F16 ru = u - __builtin_convertvector(iu, F16), rv = v - __builtin_convertvector(iv, F16);
  I16 word;
  gather(word, t.packed, iv * t.width + iu);
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

Score score(const ReferencePatch& patch, const Comparison& c, int x, int y, const Plane& plane,
            uint8_t sources) {
  float costs[kMaxSources];
  const F16 weight = load(patch.weight), weighted = load(patch.weighted);
  const int count = static_cast<int>(c.warps.size());
  float best = 2, second = 2;
  for (int s = 0; s < count; ++s) {
    costs[s] = 2;
    Footprint f;
    if (!(sources >> s & 1) || !locate(c.warps[s], x, y, plane, f)) continue;
    const F16 value = sample(c.warps[s], f);
    const F16 wv = weight * value;
    const float mean = sum(wv);
    const float variance = sum(wv * value) - mean * mean;
    const float covariance = sum(weighted * value);
    const float deviation = std::sqrt(std::max(variance, 0.0f) + c.noise_variance);
    const float cost = 1 - covariance / deviation * patch.confidence;
    costs[s] = cost;
    if (cost < best) {
      second = best;
      best = cost;
    } else if (cost < second) {
      second = cost;
    }
  }
  Score result;
  result.cost = count == 1 ? best : 0.5f * (best + second);
  for (int kept = 0; kept < c.kept_sources; ++kept) {
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

bool step(const ReferencePatch& patch, const Comparison& c, int x, int y, const Plane& plane,
          uint8_t sources, Plane& result) {
  const F16 weight = load(patch.weight), reference = load(patch.value);
  const F16 gx = load(patch.gradient_x), gy = load(patch.gradient_y);
  F16 squares = 0, products = 0;
  for (int s = 0; s < static_cast<int>(c.warps.size()); ++s) {
    Footprint f;
    const Warp& t = c.warps[s];
    if (!(sources >> s & 1) || !locate(t, x, y, plane, f)) continue;
    const F16 value = sample(t, f);
    const F16 wv = weight * value;
    const float mean = sum(wv);
    const float variance = std::max(sum(wv * value) - mean * mean, 0.0f);
    const F16 residual = (value - mean) * (1 / std::sqrt(variance + c.noise_variance)) - reference;
    // The motion of the texel with inverse depth, taken back to the reference's pixels.
    const float du = (t.epipole[0] - f.u * t.epipole[2]) * f.inverse_z;
    const float dv = (t.epipole[1] - f.v * t.epipole[2]) * f.inverse_z;
    const float inverse_area = 1 / (f.ax * f.by - f.ay * f.bx);
    const float mx = (f.by * du - f.bx * dv) * inverse_area;
    const float my = (f.ax * dv - f.ay * du) * inverse_area;
    const F16 slope = gx * mx + gy * my;
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
