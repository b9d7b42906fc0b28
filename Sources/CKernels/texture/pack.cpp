#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ck_texture.h"
#include "core/guard.h"
#include "texture/vec.h"

namespace ck::texture {
namespace {

constexpr int kWord = 64;
/// The share of the texture that charts may fill at the first try; hardly any set fills more.
constexpr double kHopedUsage = 0.8;

/// A black and white picture, 64 cells a word.
struct Bitmap {
  int width = 0, height = 0, words = 0;
  std::vector<uint64_t> bits;

  Bitmap() = default;
  Bitmap(int w, int h)
      : width(w),
        height(h),
        words((w + kWord - 1) / kWord),
        bits(static_cast<size_t>(words) * static_cast<size_t>(h), 0) {}

  void set(int x, int y) { row(y)[x / kWord] |= uint64_t{1} << (x % kWord); }
  bool get(int x, int y) const { return row(y)[x / kWord] >> (x % kWord) & 1; }
  uint64_t* row(int y) { return bits.data() + static_cast<size_t>(y) * static_cast<size_t>(words); }
  const uint64_t* row(int y) const {
    return bits.data() + static_cast<size_t>(y) * static_cast<size_t>(words);
  }

  /// 64 cells of a row from `x` on.
  uint64_t window(int x, int y) const {
    const uint64_t* r = row(y);
    const int word = x / kWord, shift = x % kWord;
    uint64_t value = word < words ? r[word] >> shift : 0;
    if (shift && word + 1 < words) value |= r[word + 1] << (kWord - shift);
    return value;
  }
};

struct Span {
  Vec2 low, high;
};

/// A chart's triangles in its plane.
struct Shape {
  std::vector<uint32_t> triangles;
  Span span;
};

/// The cells that a chart needs at one scale and turn, the padding included.
struct Stamp {
  Bitmap cells;
  /// Texel coordinates of the stamp's corner before it is moved to its place.
  Vec2 origin;
  /// The row with the longest run of cells, and its length.
  int widest_row = 0, widest = 0;
};

/// The length of the longest run of cells of a row that are set, or that are not.
int longest_run(const Bitmap& bitmap, int y, bool value) {
  int longest = 0, run = 0;
  for (int x = 0; x < bitmap.width; ++x) {
    run = bitmap.get(x, y) == value ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return longest;
}

/// An atlas that fills.
struct Sheet {
  Bitmap taken;
  /// The longest run of free cells of each row.
  std::vector<int> gaps;

  explicit Sheet(int side) : taken(side, side), gaps(static_cast<size_t>(side), side) {}

  void take(const Bitmap& cells, int x0, int y0) {
    for (int y = 0; y < cells.height; ++y) {
      for (int x = 0; x < cells.width; ++x) {
        if (cells.get(x, y)) taken.set(x0 + x, y0 + y);
      }
      gaps[static_cast<size_t>(y0 + y)] = longest_run(taken, y0 + y, false);
    }
  }
};

Vec2 turned(Vec2 p, int quarter_turns) {
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

class Packer {
 public:
  Packer(const float* corners, const int32_t* charts, size_t triangle_count, const float* density,
         size_t chart_count, const ck_pack_options& options)
      : corners_(corners), density_(density), options_(options), shapes_(chart_count) {
    cell_ = std::max(1, options.side / 1024);
    grid_ = options.side / cell_;
    for (uint32_t t = 0; t < triangle_count; ++t) {
      require(charts[t] >= 0 && static_cast<size_t>(charts[t]) < chart_count,
              "a triangle is in no chart");
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

  /// The largest scale, to one percent, at which everything fits.
  std::vector<ck_chart_placement> run(const ck_control* control) {
    const double texels = static_cast<double>(options_.side) * options_.side * options_.atlas_count;
    const auto scale_of = [&](double usage) {
      const double scale = area_ > 0 ? std::sqrt(usage * texels / area_) : 1;
      return options_.maximum_scale > 0 ? std::min<double>(scale, options_.maximum_scale) : scale;
    };
    std::vector<ck_chart_placement> best(shapes_.size()), placements(shapes_.size());
    double scale = scale_of(kHopedUsage), too_large = 0;
    constexpr int kMaximumTries = 200;
    int tries = 0;
    while (!try_scale(static_cast<float>(scale), control, &best)) {
      step(control, static_cast<double>(tries) / (tries + 10.0));
      if (++tries == kMaximumTries) {
        throw Degenerate("the charts don't fit into the texture; ask for a larger one");
      }
      too_large = scale;
      scale *= 0.96;
    }
    while (too_large > 1.01 * scale) {
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

  float bulk(size_t chart) const {
    const Vec2 e = shapes_[chart].span.high - shapes_[chart].span.low;
    return density_[chart] * (std::max(e.x, e.y) + 0.5f * std::min(e.x, e.y));
  }

  bool try_scale(float scale, const ck_control* control,
                 std::vector<ck_chart_placement>* placements) {
    std::vector<Sheet> sheets(static_cast<size_t>(options_.atlas_count), Sheet(grid_));
    for (size_t k = 0; k < order_.size(); ++k) {
      if (k % 16 == 0) step(control, 0.5);
      if (!place(order_[k], scale, &sheets, &(*placements)[order_[k]])) return false;
    }
    return true;
  }

  /// Puts a chart into the first atlas that has room.
  bool place(size_t chart, float scale, std::vector<Sheet>* sheets,
             ck_chart_placement* placement) const {
    const float own = scale * density_[chart];
    const std::vector<Stamp> stamps = make_stamps(chart, own);
    for (size_t s = 0; s < sheets->size(); ++s) {
      Sheet& sheet = (*sheets)[s];
      size_t best = stamps.size();
      int best_x = 0, best_y = grid_;
      for (size_t turn = 0; turn < stamps.size(); ++turn) {
        int x = 0, y = 0;
        if (!find(sheet, stamps[turn], best_y, &x, &y)) continue;
        // The lowest top edge wins.
        if (best < stamps.size() &&
            y + stamps[turn].cells.height >= best_y + stamps[best].cells.height) {
          continue;
        }
        best = turn;
        best_x = x;
        best_y = y;
      }
      if (best == stamps.size()) continue;
      const Stamp& stamp = stamps[best];
      sheet.take(stamp.cells, best_x, best_y);
      placement->scale = own;
      placement->quarter_turns = static_cast<int32_t>(best);
      placement->offset[0] = static_cast<float>(best_x * cell_) - stamp.origin.x;
      placement->offset[1] = static_cast<float>(best_y * cell_) - stamp.origin.y;
      placement->atlas = static_cast<int32_t>(s);
      return true;
    }
    return false;
  }

  /// The turns that are worth trying: those of a small chart would only cost time.
  std::vector<Stamp> make_stamps(size_t chart, float scale) const {
    std::vector<Stamp> stamps;
    stamps.push_back(make_stamp(chart, scale, 0));
    const int cells = stamps[0].cells.width * stamps[0].cells.height;
    const int turns = cells <= 64 ? 1 : cells <= 1024 ? 2 : 4;
    for (int turn = 1; turn < turns; ++turn) stamps.push_back(make_stamp(chart, scale, turn));
    return stamps;
  }

  /// The first place from the top, then from the left, where no cell is taken twice.
  bool find(const Sheet& sheet, const Stamp& stamp, int last_y, int* found_x, int* found_y) const {
    const Bitmap& cells = stamp.cells;
    if (cells.width > grid_ || cells.height > grid_) return false;
    for (int y = 0; y <= std::min(grid_ - cells.height, last_y); ++y) {
      if (sheet.gaps[static_cast<size_t>(y + stamp.widest_row)] < stamp.widest) continue;
      for (int x = 0; x <= grid_ - cells.width;) {
        const int jump = collision(sheet.taken, cells, x, y);
        if (jump == 0) {
          *found_x = x;
          *found_y = y;
          return true;
        }
        x += jump;
      }
    }
    return false;
  }

  /// 0 where the stamp fits, else how far to the right the next place to try is.
  static int collision(const Bitmap& atlas, const Bitmap& cells, int x, int y) {
    for (int k = 0; k < cells.height; ++k) {
      // Rows from the middle outwards: the widest are there.
      const int r = k % 2 ? cells.height / 2 + (k + 1) / 2 : cells.height / 2 - k / 2;
      if (r < 0 || r >= cells.height) continue;
      const uint64_t* row = cells.row(r);
      for (int w = 0; w < cells.words; ++w) {
        const uint64_t taken = row[w] & atlas.window(x + w * kWord, y + r);
        if (taken == 0) continue;
        // The rightmost cell hit must at least come free of this run of the stamp.
        const int last = kWord - 1 - __builtin_clzll(taken);
        const uint64_t below = last == 63 ? ~uint64_t{0} : (uint64_t{1} << (last + 1)) - 1;
        const uint64_t gaps = ~row[w] & below;
        const int start = gaps ? kWord - __builtin_clzll(gaps) : 0;
        return std::max(1, last - start + 1);
      }
    }
    return 0;
  }

  Stamp make_stamp(size_t chart, float scale, int turn) const {
    const Shape& shape = shapes_[chart];
    const Vec2 a = turned(shape.span.low * scale, turn), b = turned(shape.span.high * scale, turn);
    const Vec2 low = {std::min(a.x, b.x), std::min(a.y, b.y)};
    const Vec2 high = {std::max(a.x, b.x), std::max(a.y, b.y)};
    const auto pad = static_cast<float>(options_.padding);
    Stamp stamp;
    stamp.origin = {std::floor(low.x - pad), std::floor(low.y - pad)};
    const Vec2 extent = high - stamp.origin;
    stamp.cells = Bitmap(static_cast<int>((extent.x + pad) / static_cast<float>(cell_)) + 1,
                         static_cast<int>((extent.y + pad) / static_cast<float>(cell_)) + 1);
    if (stamp.cells.width > grid_ || stamp.cells.height > grid_) return stamp;
    for (const uint32_t t : shape.triangles) {
      std::array<Vec2, 3> p;
      for (int i = 0; i < 3; ++i) {
        p[static_cast<size_t>(i)] =
            (turned(corner(t, i) * scale, turn) - stamp.origin) * (1 / static_cast<float>(cell_));
      }
      cover(p, pad / static_cast<float>(cell_), &stamp.cells);
    }
    for (int y = 0; y < stamp.cells.height; ++y) {
      const int run = longest_run(stamp.cells, y, true);
      if (run <= stamp.widest) continue;
      stamp.widest = run;
      stamp.widest_row = y;
    }
    return stamp;
  }

  /// Marks all cells that are within `reach` cells of the triangle, or nearly so.
  static void cover(const std::array<Vec2, 3>& p, float reach, Bitmap* cells) {
    const float y_low = std::min({p[0].y, p[1].y, p[2].y}) - reach;
    const float y_high = std::max({p[0].y, p[1].y, p[2].y}) + reach;
    const int y0 = std::max(0, static_cast<int>(y_low));
    const int y1 = std::min(cells->height - 1, static_cast<int>(y_high));
    for (int y = y0; y <= y1; ++y) {
      float from = 1e30f, to = -1e30f;
      const float top = static_cast<float>(y) - reach, bottom = static_cast<float>(y + 1) + reach;
      for (size_t i = 0; i < 3; ++i) clip(p[i], p[(i + 1) % 3], top, bottom, &from, &to);
      if (from > to) continue;
      const int x0 = std::max(0, static_cast<int>(from - reach));
      const int x1 = std::min(cells->width - 1, static_cast<int>(to + reach));
      for (int x = x0; x <= x1; ++x) cells->set(x, y);
    }
  }

  /// Extends from…to by the part of an edge between two heights.
  static void clip(Vec2 a, Vec2 b, float top, float bottom, float* from, float* to) {
    if (a.y > b.y) std::swap(a, b);
    if (b.y < top || a.y > bottom) return;
    const float rise = b.y - a.y;
    const auto x_at = [&](float y) {
      return rise > 0 ? a.x + (b.x - a.x) * (y - a.y) / rise : a.x;
    };
    const float first = a.y < top ? x_at(top) : a.x;
    const float second = b.y > bottom ? x_at(bottom) : b.x;
    *from = std::min({*from, first, second});
    *to = std::max({*to, first, second});
  }

  const float* corners_;
  const float* density_;
  ck_pack_options options_;
  std::vector<Shape> shapes_;
  std::vector<size_t> order_;
  double area_ = 0;
  int cell_ = 1;
  int grid_ = 0;
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
