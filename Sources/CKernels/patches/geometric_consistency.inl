// Geometric consistency of a row of patches with a neighbor; included once for each instruction
// set. The including file defines CK_CONSISTENCY_KERNELS (the name of the table) and `gather`, and
// sets the target.

#include "core/vectors.inl"
#include "patches/constants.h"

namespace ck::patches {
namespace {

/// Disparity from which a patch in front of another violates free space, in reprojection
/// thresholds: with little parallax a depth difference is not significant. Chosen.
constexpr float kViolationDistance = 2;

CK_INLINE F16 clamped(const F16& v, float low, float high) {
  return __builtin_elementwise_min(__builtin_elementwise_max(v, F16(low)), F16(high));
}

/// −1 in lanes where the normals of two planes over the reference's pixel grid enclose a small
/// angle; they need not have unit length.
CK_INLINE I16 are_parallel(const ConsistencyThresholds& a, const F16& x, float y, const F16& w,
                           const F16& gx, const F16& gy, const F16& w2, const F16& gx2,
                           const F16& gy2) {
  const F16 dx = a.cx - x;
  const float dy = a.cy - y;
  const F16 nx = gx * a.fx, ny = gy * a.fy, nz = w + gx * dx + gy * dy;
  const F16 mx = gx2 * a.fx, my = gy2 * a.fy, mz = w2 + gx2 * dx + gy2 * dy;
  const F16 dot = nx * mx + ny * my + nz * mz;
  const F16 lengths = (nx * nx + ny * ny + nz * nz) * (mx * mx + my * my + mz * mz);
  return (dot > 0) & (dot * dot >= lengths * a.squared_cosine);
}

/// Projection of a vector of the reference's patches into the neighbor.
struct Projections {
  F16 x, qz, inverse_z, u, v;
  /// The neighbor's cells, clamped to its border.
  I16 iu, iv, cell;
};

CK_INLINE Projections locate(const RelativeProjection& t, const PatchRow& row, int start) {
  const F16 w = load(&row.w[start]);
  const auto y = static_cast<float>(row.y);
  const F16 kLane = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  Projections p;
  p.x = kLane + static_cast<float>(start);
  const F16 qx = t.base[0] + y * t.column1[0] + p.x * t.column0[0] + w * t.epipole[0];
  const F16 qy = t.base[1] + y * t.column1[1] + p.x * t.column0[1] + w * t.epipole[1];
  p.qz = t.base[2] + y * t.column1[2] + p.x * t.column0[2] + w * t.epipole[2];
  p.inverse_z = 1.0f / p.qz;
  p.u = qx * p.inverse_z;
  p.v = qy * p.inverse_z;
  const auto width = static_cast<float>(t.width), height = static_cast<float>(t.height);
  p.iu = __builtin_convertvector(clamped(p.u, 0, width - 1), I16);
  p.iv = __builtin_convertvector(clamped(p.v, 0, height - 1), I16);
  p.cell = p.iv * t.width + p.iu;
  return p;
}

/// Prefetches the patches that `check_vector` will read: a row of patches crosses the neighbor's
/// rows, which the hardware prefetcher does not predict.
CK_INLINE void prefetch(const RelativeProjection& t, const PatchRow& row, int start) {
  const I16 cell = locate(t, row, start).cell;
  constexpr int kPatchesOfLine = 64 / sizeof(ck_patch);  // Limit: cache lines have 64 bytes.
  for (int i = 0; i < 16; i += kPatchesOfLine) __builtin_prefetch(t.patches + cell[i]);
}

/// Tests the patches of a vector.
void check_vector(const RelativeProjection& t, const ConsistencyThresholds& a, const PatchRow& row,
                  ConsistencyRow& results, int start) {
  const F16 w = load(&row.w[start]), gx = load(&row.gx[start]), gy = load(&row.gy[start]);
  const auto y = static_cast<float>(row.y);
  const auto [x, qz, inverse_z, u, v, iu, iv, cell] = locate(t, row, start);
  const auto width = static_cast<float>(t.width), height = static_cast<float>(t.height);
  I16 known =
      (w > 0) & (qz > kMinimumProjection) & (u >= 0) & (v >= 0) & (u < width) & (v < height);
  // The neighbor's plane p: its inverse depth and gradient, evaluated at the projected pixel.
  F16 pw, pu, pv, cost;
  gather(pw, &t.patches->inverse_depth, cell);
  gather(pu, &t.patches->gradient_x, cell);
  gather(pv, &t.patches->gradient_y, cell);
  gather(cost, &t.patches->cost, cell);
  known &= (pw > 0) & (cost < a.cost);
  pw += pu * (u - __builtin_convertvector(iu, F16) - 0.5f) +
        pv * (v - __builtin_convertvector(iv, F16) - 0.5f);
  // A pixel projects to q / q.z with inverse depth w / q.z. On the neighbor's plane that gives p ·
  // q = w, which is linear in the reference's inverse depth and pixel.
  const F16 ex = t.epipole[0] - u * t.epipole[2], ey = t.epipole[1] - v * t.epipole[2];
  const F16 slope = 1.0f - (pu * ex + pv * ey + pw * t.epipole[2]), inverse = 1.0f / slope;
  const F16 plane_w = w + (pw * qz - w) * inverse;
  const F16 plane_x = (pu * (t.column0[0] - u * t.column0[2]) +
                       pv * (t.column0[1] - v * t.column0[2]) + pw * t.column0[2]) *
                      inverse;
  const F16 plane_y = (pu * (t.column1[0] - u * t.column1[2]) +
                       pv * (t.column1[1] - v * t.column1[2]) + pw * t.column1[2]) *
                      inverse;
  const F16 motion = __builtin_elementwise_sqrt(ex * ex + ey * ey) * inverse_z;
  const F16 scale = __builtin_elementwise_max(t.magnification * inverse_z, F16(1));
  const F16 difference = __builtin_elementwise_abs(plane_w - w);
  const F16 distance = motion * difference / scale;
  const F16 ratio = pw * qz;  // times w: this depth over the neighbor's
  const I16 is_consistent = known & (slope > kMinimumRaySlope) & (plane_w > 0) &
                            (difference < a.depth * w) & (distance < a.reprojection) &
                            are_parallel(a, x, y, w, gx, gy, plane_w, plane_x, plane_y);
  const I16 violates_free_space =
      known & (distance > kViolationDistance * a.reprojection) & (ratio < w * (1 - a.free_space));
  const I16 kind =
      (is_consistent & int32_t{kConsistent}) | (violates_free_space & int32_t{kFreeSpaceViolation});
  store(&results.kind[start], __builtin_convertvector(kind, B16));
  store(&results.cell[start], cell);
  store(&results.w[start], plane_w);
  store(&results.gx[start], plane_x);
  store(&results.gy[start], plane_y);
  store(&results.distance[start], distance);
}

/// Tests a row of patches, with the patches of a later vector prefetched.
void check_row(const RelativeProjection& projection, const ConsistencyThresholds& thresholds,
               const PatchRow& row, ConsistencyRow& results) {
  constexpr int kAhead = 64;  // In cells. Chosen.
  for (int start = 0; start < row.width; start += 16) {
    if (start + kAhead < row.width) prefetch(projection, row, start + kAhead);
    const F16 w = load(&row.w[start]);
    if (__builtin_reduce_max(w) > 0) {
      check_vector(projection, thresholds, row, results, start);
    } else {
      store(&results.kind[start], B16(0));
    }
  }
}

}  // namespace

const ConsistencyKernels& CK_CONSISTENCY_KERNELS() {
  static const ConsistencyKernels table = {check_row};
  return table;
}

}  // namespace ck::patches
