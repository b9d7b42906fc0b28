#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "texture/bake.h"

namespace ck::texture {
namespace {

/// Texels of a square with this many texels per side share a set of rays: each casts a different
/// part of it. Chosen.
constexpr size_t kSquare = 4;
constexpr size_t kParts = kSquare * kSquare;
/// Distance above the surface at which rays start, in diagonals of its bounding box, so that they
/// do not hit the surface itself. Chosen.
constexpr float kLift = 5e-4f;
/// Distance in texel spacings up to which texels share their rays. Chosen: beyond the diagonal of
/// the texels that are averaged.
constexpr float kSharingDistance = 4;
/// Limit: π (3 − √5) radians, between two points of a Fibonacci spiral.
constexpr double kGoldenAngle = 2.399963229728653;

/// Cosine-weighted directions of the upper hemisphere: a Fibonacci spiral on the disk, projected
/// onto the sphere. Each subset of every 16th direction also covers all azimuths.
std::vector<Vec3> cosine_directions(size_t count) {
  std::vector<Vec3> directions(count);
  for (size_t i = 0; i < count; ++i) {
    const double r2 = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double r = std::sqrt(r2), angle = kGoldenAngle * static_cast<double>(i);
    directions[i] = {static_cast<float>(r * std::cos(angle)),
                     static_cast<float>(r * std::sin(angle)),
                     static_cast<float>(std::sqrt(1 - r2))};
  }
  return directions;
}

/// Ambient occlusion by interleaved sampling (Keller and Heidrich, EGWR 2001): a few rays per
/// texel, different ones at its neighbors, and the mean over as many texels as share the whole set.
class AmbientOcclusionBaker {
 public:
  AmbientOcclusionBaker(const ck_atlas& atlas, const ck_bake_source& source, size_t rays_per_texel,
                        float reach)
      : atlas_(atlas),
        source_(source),
        reach_(reach),
        lift_(kLift * atlas.scene.diagonal),
        directions_(cosine_directions(kParts * rays_per_texel)),
        positions_(atlas.faces.size()),
        unoccluded_(atlas.faces.size(), 0),
        spacings_(atlas.corners.size() / 6, 0) {}

  /// Casts the rays of all texels of the charts.
  void cast(const ck_control* control) {
    for_each_face(atlas_, control, [&](size_t face) {
      const float* corners = atlas_.corners.data() + 6 * face;
      const TexelMap map(corners);
      if (!map.is_valid) return;
      spacings_[face] = spacing(face, map);
      atlas_.for_each_texel(face, [&](int x, int y, size_t texel) {
        const Vec3 w = TexelMap::clamped(
            map.weights(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
        const BasePoint base = base_point(atlas_, source_, face, w);
        DensePoint point{base.position, base.normal};
        find_dense(source_, base, &point);
        positions_[texel] = base.position;
        const size_t part =
            static_cast<size_t>(y) % kSquare * kSquare + static_cast<size_t>(x) % kSquare;
        unoccluded_[texel] = unoccluded_share(point, part);
      });
    });
  }

  /// Writes the means over the texels that share rays.
  void gather(const ck_control* control, uint8_t* gray) const {
    const auto side = static_cast<size_t>(atlas_.side);
    parallel_for(control, side, [&](size_t y) {
      for (size_t x = 0; x < side; ++x) {
        const size_t texel = y * side + x;
        if (atlas_.faces[texel] < 0) continue;
        const float mean = mean_around(static_cast<int>(x), static_cast<int>(y));
        gray[texel] = static_cast<uint8_t>(std::lround(255 * std::clamp(mean, 0.0f, 1.0f)));
      }
    });
  }

 private:
  /// Upper bound of the distance in space between adjacent texels of a face.
  float spacing(size_t face, const TexelMap& map) const {
    const Vec3 a = atlas_.scene.corner(face, 0);
    const Vec3 b = atlas_.scene.corner(face, 1) - a, c = atlas_.scene.corner(face, 2) - a;
    return length(b * map.w1.x + c * map.w2.x) + length(b * map.w1.y + c * map.w2.y);
  }

  /// The fraction of a texel's rays that are not occluded.
  float unoccluded_share(const DensePoint& point, size_t part) const {
    Vec3 u, v;
    frame_around(point.normal, &u, &v);
    const Vec3 origin = point.position + point.normal * lift_;
    size_t open = 0, count = 0;
    for (size_t i = part; i < directions_.size(); i += kParts, ++count) {
      const Vec3 d = directions_[i];
      const Vec3 direction = u * d.x + v * d.y + point.normal * d.z;
      open += !is_occluded(*source_.dense, origin, direction, lift_, reach_);
    }
    return static_cast<float>(open) / static_cast<float>(count);
  }

  /// The mean over 5 × 5 texels; only over texels that are also close in space.
  float mean_around(int x, int y) const {
    // Limit: with half weight on the outer rows and columns each part of the rays has the same
    // weight.
    constexpr std::array<float, 5> kWeights = {0.5f, 1, 1, 1, 0.5f};
    const size_t center = atlas_.index(x, y);
    const float near = kSharingDistance * spacings_[static_cast<size_t>(atlas_.faces[center])];
    float sum = 0, weight = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const int nx = x + dx, ny = y + dy;
        if (nx < 0 || ny < 0 || nx >= atlas_.side || ny >= atlas_.side) continue;
        const size_t texel = atlas_.index(nx, ny);
        if (atlas_.faces[texel] < 0) continue;
        if (length(positions_[texel] - positions_[center]) > near) continue;
        const float w =
            kWeights[static_cast<size_t>(dy + 2)] * kWeights[static_cast<size_t>(dx + 2)];
        sum += w * unoccluded_[texel];
        weight += w;
      }
    }
    return weight > 0 ? sum / weight : unoccluded_[center];
  }

  const ck_atlas& atlas_;
  const ck_bake_source& source_;
  float reach_, lift_;
  std::vector<Vec3> directions_;
  /// Position of each texel on the simplified surface.
  std::vector<Vec3> positions_;
  std::vector<float> unoccluded_;
  std::vector<float> spacings_;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_atlas_occlusion(const ck_atlas* atlas, const ck_bake_source* source,
                             size_t rays_per_texel, float maximum_distance,
                             const ck_control* control, uint8_t* gray) {
  return ck::guarded([&] {
    ck::require(atlas && source && source->dense && gray, "an argument is missing");
    ck::require(rays_per_texel > 0 && rays_per_texel <= 256, "too many rays for a texel");
    std::fill(gray, gray + atlas->faces.size(), uint8_t{255});
    ck::texture::AmbientOcclusionBaker baker(*atlas, *source, rays_per_texel, maximum_distance);
    baker.cast(control);
    baker.gather(control, gray);
    ck::texture::fill_uncovered(atlas->faces, atlas->side, 1, control, gray);
  });
}
