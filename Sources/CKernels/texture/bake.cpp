#include <algorithm>
#include <cmath>
#include <cstring>

#include "texture/bake.h"

namespace ck::texture {
namespace {

/// Smallest component of a baked normal along the normal of the textured surface; texels with
/// steeper ones stay flat. Chosen: by trial.
constexpr float kSteepestNormal = 0.05f;
/// Cosine between the normals of the two surfaces above which they face the same way. Chosen: by
/// trial.
constexpr float kFacingCosine = 0.1f;

/// Fraction of the search distance by which the rays outwards and inwards overlap, so that a
/// surface at distance 0 is not missed by both. Chosen: above the rounding of single precision.
constexpr float kRayOverlap = 1e-3f;

/// Encodes a unit vector as three bytes; the flat normal (0, 0, 1) is 128, 128, 255.
void encode(Vec3 n, uint8_t* pixel) {
  const auto byte = [](float v) {
    return static_cast<uint8_t>(std::clamp(std::lround(127.5f * v + 127.5f), 0L, 255L));
  };
  pixel[0] = byte(n.x + 1e-6f);
  pixel[1] = byte(n.y + 1e-6f);
  pixel[2] = byte(n.z);
}

/// The vector at `p`.
Vec3 at(const float* p) { return {p[0], p[1], p[2]}; }

/// The interpolated normal of the dense surface at a hit.
Vec3 dense_normal(const ck_bake_source& source, const Hit& hit) {
  const auto& t = source.dense->triangles[hit.triangle];
  const auto n = [&](size_t i) { return vec_at(source.dense_normals, t[i]); };
  return normalized(n(0) * (1 - hit.u - hit.v) + n(1) * hit.u + n(2) * hit.v);
}

/// Bakes the texels of one triangle.
class FaceBaker {
 public:
  FaceBaker(const ck_atlas& atlas, const ck_bake_source& source, size_t face)
      : atlas_(atlas), source_(source), face_(face), map_(atlas.corners.data() + 6 * face) {}

  void run(uint8_t* rgb, uint8_t* displacement) const {
    if (!map_.is_valid) return;
    atlas_.for_each_texel(face_, [&](int x, int y, size_t texel) {
      const Vec3 w = TexelMap::clamped(
          map_.weights(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      const BasePoint base = base_point(atlas_, source_, face_, w);
      DensePoint dense;
      Vec3 local = {0, 0, 1};
      if (find_dense(source_, base, &dense)) {
        local = in_tangent_frame(dense.normal, base.normal, w);
      }
      encode(local, rgb + 3 * texel);
      if (displacement) {
        const float share = dense.height / source_.maximum_distance;
        displacement[texel] =
            static_cast<uint8_t>(std::clamp(std::lround(127.5f + 127.5f * share), 0L, 255L));
      }
    });
  }

 private:
  Vec3 in_tangent_frame(Vec3 dense, Vec3 normal, Vec3 w) const {
    const float* t = source_.corner_tangents + 12 * face_;
    Vec3 tangent = at(t) * w.x + at(t + 4) * w.y + at(t + 8) * w.z;
    tangent = normalized(tangent - normal * dot(normal, tangent));
    const Vec3 bitangent = cross(normal, tangent) * t[3];
    const Vec3 local = {dot(dense, tangent), dot(dense, bitangent), dot(dense, normal)};
    return local.z > kSteepestNormal ? normalized(local) : Vec3{0, 0, 1};
  }

  const ck_atlas& atlas_;
  const ck_bake_source& source_;
  size_t face_;
  TexelMap map_;
};

}  // namespace

BasePoint base_point(const ck_atlas& atlas, const ck_bake_source& source, size_t face, Vec3 w) {
  const float* n = source.corner_normals + 9 * face;
  return {atlas.scene.corner(face, 0) * w.x + atlas.scene.corner(face, 1) * w.y +
              atlas.scene.corner(face, 2) * w.z,
          normalized(at(n) * w.x + at(n + 3) * w.y + at(n + 6) * w.z)};
}

bool find_dense(const ck_bake_source& source, const BasePoint& base, DensePoint* point) {
  bool found = false;
  const float reach = source.maximum_distance;
  // One ray outwards and one inwards along the normal; the nearer hit wins.
  for (const float sign : {1.0f, -1.0f}) {
    Hit hit;
    const Vec3 origin = base.position - base.normal * (sign * reach * kRayOverlap);
    if (!intersect(*source.dense, origin, base.normal * sign, 0, reach, &hit)) continue;
    if (dot(source.dense->face_normals[hit.triangle], base.normal) <= kFacingCosine) continue;
    const float height = sign * (hit.distance - reach * kRayOverlap);
    if (found && std::fabs(height) >= std::fabs(point->height)) continue;
    *point = {base.position + base.normal * height, dense_normal(source, hit), height};
    found = true;
  }
  return found;
}

}  // namespace ck::texture

ck_status ck_atlas_bake(const ck_atlas* atlas, const ck_bake_source* source,
                        const ck_control* control, uint8_t* rgb, uint8_t* displacement) {
  return ck::guarded([&] {
    ck::require(atlas && source && source->dense && rgb, "an argument is missing");
    const size_t texels = atlas->faces.size();
    for (size_t i = 0; i < texels; ++i) ck::texture::encode({0, 0, 1}, rgb + 3 * i);
    if (displacement) std::memset(displacement, 128, texels);
    ck::texture::for_each_face(*atlas, control, [&](size_t face) {
      ck::texture::FaceBaker(*atlas, *source, face).run(rgb, displacement);
    });
    ck::texture::fill_uncovered(atlas->faces, atlas->side, 3, control, rgb);
    if (displacement)
      ck::texture::fill_uncovered(atlas->faces, atlas->side, 1, control, displacement);
  });
}
