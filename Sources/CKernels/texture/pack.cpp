#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ck_texture.h"
#include "core/guard.h"
#include "geometry/vec.h"
#include "texture/atlas_occupancy.h"

namespace ck::texture {
namespace {

/// Fraction of the texture that charts cover in the first attempt. Measured: charts cover 75 to
/// 84 % (docs/experiments/2026-11-models.md, "Detail levels").
constexpr double kInitialUsage = 0.86;
/// Factor by which the scale falls until all charts fit. Chosen.
constexpr double kScaleStep = 0.97;
/// Ratio of a scale that is too large to one that fits at which the search ends. Chosen.
constexpr double kScaleTolerance = 1.004;
/// Number of scales at which charts that never fit are given up. Chosen: the last one is 1/400.
constexpr int kMaximumTries = 200;
/// Largest numbers of texels of the masks that are tested in one and in two rotations. Chosen: more
/// rotations of small charts would only cost time.
constexpr int kUnrotatedTexels = 64, kHalfRotatedTexels = 4096;

struct Span {
  Vec2 low, high;
};

/// The triangles of a chart and its bounding box in its plane.
struct Shape {
  std::vector<uint32_t> triangles;
  Span span;
};

Vec2 rotated(Vec2 p, int quarter_turns) {
  switch (quarter_turns & 3) {
    case 1:
      return {-p.y, p.x};
    case 2:
      return {-p.x, -p.y};
    case 3:
      return {p.y, -p.x};
    default:
      return p;
  }
}

/// Extends from…to by the part of an edge between two heights.
void clip(Vec2 a, Vec2 b, float top, float bottom, float* from, float* to) {
  if (a.y > b.y) std::swap(a, b);
  if (b.y < top || a.y > bottom) return;
  const float rise = b.y - a.y;
  const auto x_at = [&](float y) { return rise > 0 ? a.x + (b.x - a.x) * (y - a.y) / rise : a.x; };
  const float first = a.y < top ? x_at(top) : a.x;
  const float second = b.y > bottom ? x_at(bottom) : b.x;
  *from = std::min({*from, first, second});
  *to = std::max({*to, first, second});
}

/// Marks all texels that the triangle touches.
void cover(const std::array<Vec2, 3>& p, Bitmap* texels) {
  const int y0 = std::max(0, static_cast<int>(std::min({p[0].y, p[1].y, p[2].y})));
  const int y1 =
      std::min(texels->height() - 1, static_cast<int>(std::max({p[0].y, p[1].y, p[2].y})));
  for (int y = y0; y <= y1; ++y) {
    float from = 1e30f, to = -1e30f;
    const auto top = static_cast<float>(y);
    for (size_t i = 0; i < 3; ++i) clip(p[i], p[(i + 1) % 3], top, top + 1, &from, &to);
    if (from > to) continue;
    const int x0 = std::max(0, static_cast<int>(from));
    const int x1 = std::min(texels->width() - 1, static_cast<int>(to));
    texels->set(x0, std::max(x0, x1), y);
  }
}

/// Packs charts greedily at a given scale, largest first, and searches for the largest scale.
class Packer {
 public:
  Packer(const float* corners, const int32_t* charts, size_t triangle_count, const float* density,
         size_t chart_count, const ck_pack_options& options)
      : corners_(corners), density_(density), options_(options), shapes_(chart_count) {
    margin_ = (options.padding + 1) / 2;
    for (uint32_t t = 0; t < triangle_count; ++t) {
      require(charts[t] >= 0 && static_cast<size_t>(charts[t]) < chart_count,
              "a triangle does not belong to a chart");
      Shape& shape = shapes_[static_cast<size_t>(charts[t])];
      for (int i = 0; i < 3; ++i) {
        const Vec2 p = corner(t, i);
        if (shape.triangles.empty() && i == 0) shape.span = {p, p};
        shape.span.low = {std::min(shape.span.low.x, p.x), std::min(shape.span.low.y, p.y)};
        shape.span.high = {std::max(shape.span.high.x, p.x), std::max(shape.span.high.y, p.y)};
      }
      shape.triangles.push_back(t);
      const float area = std::fabs(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
      const float d = density[charts[t]];
      area_ += 0.5 * static_cast<double>(area) * d * d;
    }
    order_.resize(chart_count);
    std::iota(order_.begin(), order_.end(), size_t{0});
    std::sort(order_.begin(), order_.end(), [&](size_t a, size_t b) {
      const float ba = bulk(a), bb = bulk(b);
      return ba != bb ? ba > bb : a < b;
    });
  }

  /// Packs at the largest scale, to within `kScaleTolerance`, at which everything fits.
  std::vector<ck_chart_placement> run(const ck_control* control) {
    const double texels = static_cast<double>(options_.side) * options_.side * options_.atlas_count;
    const auto scale_of = [&](double usage) {
      const double scale = area_ > 0 ? std::sqrt(usage * texels / area_) : 1;
      return options_.maximum_scale > 0 ? std::min<double>(scale, options_.maximum_scale) : scale;
    };
    std::vector<ck_chart_placement> best(shapes_.size()), placements(shapes_.size());
    double scale = scale_of(kInitialUsage), too_large = 0;
    int tries = 0;
    while (!try_scale(static_cast<float>(scale), control, &best)) {
      step(control, static_cast<double>(tries) / (tries + 10.0));
      if (++tries == kMaximumTries) {
        throw Degenerate("the charts don't fit into the texture; use a larger one");
      }
      too_large = scale;
      scale *= kScaleStep;
    }
    while (too_large > kScaleTolerance * scale) {
      step(control, 0.9);
      const double between = std::sqrt(scale * too_large);
      if (try_scale(static_cast<float>(between), control, &placements)) {
        scale = between;
        best.swap(placements);
      } else {
        too_large = between;
      }
    }
    return best;
  }

 private:
  Vec2 corner(uint32_t t, int i) const {
    return {corners_[6 * t + 2 * static_cast<uint32_t>(i)],
            corners_[6 * t + 2 * static_cast<uint32_t>(i) + 1]};
  }

  /// Sort key by size of the bounding box.
  float bulk(size_t chart) const {
    const Vec2 e = shapes_[chart].span.high - shapes_[chart].span.low;
    return density_[chart] * (std::max(e.x, e.y) + 0.5f * std::min(e.x, e.y));
  }

  /// Packs all charts at a scale; false if one does not fit.
  bool try_scale(float scale, const ck_control* control,
                 std::vector<ck_chart_placement>* placements) {
    std::vector<AtlasOccupancy> atlas_occupancies(static_cast<size_t>(options_.atlas_count),
                                                  AtlasOccupancy(options_.side - 2 * margin_));
    for (size_t k = 0; k < order_.size(); ++k) {
      if (k % 16 == 0) step(control, 0.5);
      if (!place(order_[k], scale, &atlas_occupancies, &(*placements)[order_[k]])) return false;
    }
    return true;
  }

  /// Places a chart on the first page that has room.
  bool place(size_t chart, float scale, std::vector<AtlasOccupancy>* atlas_occupancies,
             ck_chart_placement* placement) const {
    const float own = scale * density_[chart];
    const Span& span = shapes_[chart].span;
    const Vec2 extent = (span.high - span.low) * own;
    const auto side = static_cast<float>(options_.side - 2 * margin_);
    if (!(extent.x < side && extent.y < side)) return false;
    std::vector<ChartMask> masks;
    masks.emplace_back(rasterized(chart, own));
    const int size = masks[0].texels.width() * masks[0].texels.height();
    const int turns = size <= kUnrotatedTexels ? 1 : size <= kHalfRotatedTexels ? 2 : 4;
    while (static_cast<int>(masks.size()) < turns) {
      masks.emplace_back(masks.back().texels.rotated());
    }
    for (size_t s = 0; s < atlas_occupancies->size(); ++s) {
      AtlasOccupancy& atlas_occupancy = (*atlas_occupancies)[s];
      size_t best = masks.size();
      int best_x = 0, best_y = 0, limit = options_.side;
      for (size_t turn = 0; turn < masks.size(); ++turn) {
        // The position with the smallest bottom row wins.
        int x = 0, y = 0;
        if (!atlas_occupancy.find(masks[turn], limit, &x, &y)) continue;
        best = turn;
        best_x = x;
        best_y = y;
        limit = y + masks[turn].texels.height() - 1;
      }
      if (best == masks.size()) continue;
      const ChartMask& mask = masks[best];
      atlas_occupancy.place(mask, options_.padding, best_x, best_y);
      const auto turn = static_cast<int>(best);
      const auto width = static_cast<float>(mask.texels.width());
      const auto height = static_cast<float>(mask.texels.height());
      // The position of the mask's origin corner after the rotation.
      const Vec2 origin{turn == 1 || turn == 2 ? width : 0, turn == 2 || turn == 3 ? height : 0};
      const Vec2 low = rotated(span.low * own, turn);
      placement->scale = own;
      placement->quarter_turns = turn;
      placement->offset[0] = static_cast<float>(best_x + margin_) + origin.x - low.x;
      placement->offset[1] = static_cast<float>(best_y + margin_) + origin.y - low.y;
      placement->atlas = static_cast<int32_t>(s);
      return true;
    }
    return false;
  }

  /// The texels that a chart touches when its bounding box starts at the first one.
  Bitmap rasterized(size_t chart, float scale) const {
    const Shape& shape = shapes_[chart];
    const Vec2 extent = (shape.span.high - shape.span.low) * scale;
    Bitmap result(static_cast<int>(extent.x) + 1, static_cast<int>(extent.y) + 1);
    std::array<Vec2, 3> p;
    for (const uint32_t t : shape.triangles) {
      for (int i = 0; i < 3; ++i) {
        p[static_cast<size_t>(i)] = (corner(t, i) - shape.span.low) * scale;
      }
      cover(p, &result);
    }
    return result;
  }

  const float* corners_;
  const float* density_;
  ck_pack_options options_;
  std::vector<Shape> shapes_;
  std::vector<size_t> order_;
  double area_ = 0;
  /// Free texels along the page border: half the padding, because the texture may repeat.
  int margin_ = 0;
};

}  // namespace
}  // namespace ck::texture

ck_status ck_pack_charts(const float* corners, const int32_t* charts, size_t triangle_count,
                         const float* density, size_t chart_count, const ck_pack_options* options,
                         const ck_control* control, ck_chart_placement* placements) {
  return ck::guarded([&] {
    ck::require(corners && charts && density && options && placements, "an argument is missing");
    ck::require(options->side >= 16 && options->padding >= 0, "the texture is too small");
    ck::require(options->atlas_count > 0 && options->atlas_count <= 1024,
                "the number of textures is out of range");
    ck::texture::Packer packer(corners, charts, triangle_count, density, chart_count, *options);
    const auto result = packer.run(control);
    std::copy(result.begin(), result.end(), placements);
  });
}
