// The scale space of an octave and its extrema, included once for each instruction set after
// gaussian_blur.inl and the definition of `lane_bits`. Only what descriptors need is stored for the
// whole octave: the levels and their differences are ring buffers of rows, each level just far
// enough ahead of the next.

namespace ck::sift {
namespace {

/// Value, gradient and second derivatives along x, y and scale.
///
/// Position and scale are solved for separately. Around a blob the difference of Gaussians is
/// approximately a function of position times one of scale: the extremum has the same position at
/// every scale, whereas a joint solution, which includes the change of the gradient with scale but
/// not that of the curvature, would be wrong by up to a tenth of the offset.
struct Quadratic {
  double value, gx, gy, gs, xx, yy, ss, xy;

  /// Computes the offset of the extremum; false if there is none.
  bool solve(double* offset) const {
    const double determinant = xx * yy - xy * xy;
    if (determinant <= 0 || std::abs(ss) < 1e-9) return false;
    offset[0] = -(yy * gx - xy * gy) / determinant;
    offset[1] = -(xx * gy - xy * gx) / determinant;
    offset[2] = -gs / ss;
    return true;
  }
};

/// The differences around a sample: `p[s][r]` points to the sample's column in layer s and row r.
CK_INLINE Quadratic quadratic(const float* const (&p)[3][3]) {
  Quadratic q;
  const float* m = p[1][1];
  q.value = m[0];
  q.gx = 0.5 * (m[1] - m[-1]);
  q.gy = 0.5 * (p[1][2][0] - p[1][0][0]);
  q.gs = 0.5 * (p[2][1][0] - p[0][1][0]);
  q.xx = m[1] + m[-1] - 2.0 * m[0];
  q.yy = p[1][2][0] + p[1][0][0] - 2.0 * m[0];
  q.ss = p[2][1][0] + p[0][1][0] - 2.0 * m[0];
  q.xy = 0.25 * (p[1][2][1] - p[1][2][-1] - p[1][0][1] + p[1][0][-1]);
  return q;
}

/// Whether the ratio of the principal curvatures exceeds the limit (Lowe, IJCV 2004, section 4.1).
CK_INLINE bool is_edge(const Quadratic& q, double limit) {
  const double trace = q.xx + q.yy, determinant = q.xx * q.yy - q.xy * q.xy;
  return determinant <= 0 || trace * trace * limit >= (limit + 1) * (limit + 1) * determinant;
}

// ---- One octave -----------------------------------------------------------------------------

/// Distance from the border in pixels within which extrema are ignored. Chosen.
constexpr int kBorder = 5;
/// Rows above and below an extremum that its refinement may read. Chosen: few extrema move more.
constexpr int kReach = 3;
/// Fraction of the contrast threshold that a sample must exceed. Chosen: interpolation increases
/// the value, but by a much smaller factor.
constexpr float kCandidateFactor = 0.6f;
/// Largest number of refinement steps of an extremum, and the offset in samples from which a step
/// moves to the neighbor. Chosen: with Lowe's 0.5, steps may alternate between two samples.
constexpr int kMaximumSteps = 5;
constexpr double kStepOffset = 0.6;
/// The blur σ in pixels that a photo is assumed to have; upsampling doubles it. Paper: Lowe 2004,
/// section 3.3.
constexpr double kPhotoBlur = 0.5;
/// The smallest σ in pixels by which a photo is blurred. Chosen.
constexpr double kMinimumBlur = 0.1;

class OctaveSearch {
 public:
  OctaveSearch(const OctaveInput& input, const Search& search, Octave& octave, Rows& next,
               std::vector<Extremum>& found);
  void run();

 private:
  /// A Gaussian level; the first one may be the raw photo.
  struct Level {
    Gaussian from_previous;
    Rows rows;
    int done = 0;
    /// Index within the octave as in Lowe's paper; −1 for the raw photo.
    int index = 0;
  };

  const OctaveInput& input_;
  const Search& search_;
  Octave& octave_;
  Rows& next_;
  std::vector<Extremum>& found_;
  const int width_, height_;
  std::vector<Level> levels_;
  std::vector<Rows> differences_;
  std::unique_ptr<PhotoRows> photo_;
  Rows wide_;

  void make_levels();
  void make_differences();
  void advance(size_t level, int row_count);
  void blur_group(Level& level, Level& previous);
  RowOutputs outputs(Level& level, Level& previous, int y);
  void keep_for_next_octave(const float* row, int y);
  void scan_row(int y);
  void scan_layer(int layer, int y);
  bool refine(int layer, int x, int y);
  bool keep(const Quadratic& q, const double* offset, int layer, int x, int y);
  const float* at(int layer, int y, int x) const { return differences_[layer][y] + x; }
};

OctaveSearch::OctaveSearch(const OctaveInput& input, const Search& search, Octave& octave,
                           Rows& next, std::vector<Extremum>& found)
    : input_(input),
      search_(search),
      octave_(octave),
      next_(next),
      found_(found),
      width_(input.width),
      height_(input.height),
      wide_(input.width + 2 * kMargin, kGroup) {
  octave.width = width_;
  octave.height = height_;
  octave.stride = Rows::row_stride(width_);
  for (int i = 0; i < search.layers; ++i) {
    octave.levels.emplace_back(octave.stride * static_cast<size_t>(height_) * sizeof(uint16_t));
  }
  next = Rows(std::max(1, width_ / 2), std::max(1, height_ / 2));
  make_levels();
  make_differences();
}

void OctaveSearch::make_levels() {
  const double sigma = search_.sigma, step = std::exp2(1.0 / search_.layers);
  if (input_.photo) {
    photo_ = std::make_unique<PhotoRows>(*input_.photo, input_.is_doubled);
    const double blur = input_.is_doubled ? 2 * kPhotoBlur : kPhotoBlur;
    levels_.emplace_back();
    levels_.back().index = -1;
    levels_.emplace_back();
    levels_.back().from_previous =
        Gaussian(std::sqrt(std::max(kMinimumBlur * kMinimumBlur, sigma * sigma - blur * blur)));
  } else {
    levels_.emplace_back();
    levels_.back().rows = std::move(*input_.rows);
    levels_.back().done = height_;
  }
  for (int i = 1; i < search_.layers + 3; ++i) {
    levels_.emplace_back();
    levels_.back().index = i;
    levels_.back().from_previous =
        Gaussian(sigma * std::pow(step, i - 1) * std::sqrt(step * step - 1));
  }
  for (size_t i = 0; i < levels_.size(); ++i) {
    if (levels_[i].done > 0) continue;
    const int radius = i + 1 < levels_.size() ? levels_[i + 1].from_previous.radius : 0;
    levels_[i].rows = Rows(width_, 2 * radius + 2 * kGroup);
  }
}

void OctaveSearch::make_differences() {
  int lag = 2 * kReach + 2 * kGroup;
  std::vector<int> heights;
  for (size_t i = levels_.size(); heights.size() < static_cast<size_t>(search_.layers) + 2;) {
    heights.push_back(lag);
    lag += levels_[--i].from_previous.radius + kGroup;
  }
  for (size_t i = heights.size(); i-- > 0;) differences_.emplace_back(width_, heights[i]);
}

RowOutputs OctaveSearch::outputs(Level& level, Level& previous, int y) {
  RowOutputs out{level.rows[y]};
  if (level.index > 0) {
    out.previous = previous.rows[y];
    out.difference = differences_[level.index - 1][y];
  }
  if (level.index >= 1 && level.index <= search_.layers) {
    out.kept =
        octave_.levels[level.index - 1].as<uint16_t>() + static_cast<size_t>(y) * octave_.stride;
  }
  return out;
}

void OctaveSearch::keep_for_next_octave(const float* row, int y) {
  if (y % 2 != 0 || y / 2 >= height_ / 2) return;
  float* out = next_[y / 2];
  for (int x = 0; x < width_ / 2; ++x) out[x] = row[2 * x];
}

void OctaveSearch::blur_group(Level& level, Level& previous) {
  const Gaussian& gaussian = level.from_previous;
  const int y = level.done, radius = gaussian.radius;
  const float* rows[2 * kMargin];
  for (int i = 0; i < 2 * radius + kGroup; ++i) {
    rows[i] = previous.rows[mirrored(y - radius + i, height_)];
  }
  float* wide[kGroup];
  for (int i = 0; i < kGroup; ++i) wide[i] = wide_[i] + kMargin;
  const Blur blur = blur_of_radius(radius);
  blur.columns(rows, gaussian, width_, wide);
  level.done = std::min(height_, y + kGroup);
  for (int i = y; i < level.done; ++i) {
    mirror_ends(wide[i - y], width_, radius);
    const RowOutputs out = outputs(level, previous, i);
    blur.row(wide[i - y], gaussian, width_, out);
    if (level.index == search_.layers) keep_for_next_octave(out.level, i);
  }
}

/// Computes the first rows of a level, and those of previous levels that it needs.
void OctaveSearch::advance(size_t index, int row_count) {
  Level& level = levels_[index];
  while (level.done < std::min(row_count, height_)) {
    if (level.index < 0) {
      photo_->write(level.done, level.rows[level.done]);
      ++level.done;
      continue;
    }
    advance(index - 1, level.done + kGroup + level.from_previous.radius);
    blur_group(level, levels_[index - 1]);
  }
}

void OctaveSearch::run() {
  for (int y = kBorder; y < height_ - kBorder; ++y) {
    advance(levels_.size() - 1, y + kReach + 1);
    scan_row(y);
  }
  advance(levels_.size() - 1, height_);
}

void OctaveSearch::scan_row(int y) {
  for (int layer = 1; layer <= search_.layers; ++layer) scan_layer(layer, y);
}

/// Sixteen values with their signs flipped by `sign`.
CK_INLINE F16 signed_value(const float* p, const I16& sign) {
  I16 bits;
  __builtin_memcpy(&bits, p, sizeof bits);
  bits ^= sign;
  F16 v;
  __builtin_memcpy(&v, &bits, sizeof v);
  return v;
}

CK_INLINE F16 larger(const F16& a, const F16& b) { return __builtin_elementwise_max(a, b); }

/// The maximum of each value and its left and right neighbors.
CK_INLINE F16 largest_of_row(const float* p, const I16& sign) {
  return larger(larger(signed_value(p - 1, sign), signed_value(p, sign)),
                signed_value(p + 1, sign));
}

CK_INLINE F16 largest_of_plane(const Rows& rows, int x, int y, const I16& sign) {
  return larger(larger(largest_of_row(rows[y - 1] + x, sign), largest_of_row(rows[y] + x, sign)),
                largest_of_row(rows[y + 1] + x, sign));
}

/// Finds extrema among their 26 neighbors. Of equal neighbors the first counts as the extremum, in
/// the order of rows, columns and layers, so that a symmetric blob is found once.
void OctaveSearch::scan_layer(int layer, int y) {
  const Rows& plane = differences_[layer];
  const float *above = plane[y - 1], *row = plane[y], *below = plane[y + 1];
  const float threshold = kCandidateFactor * search_.threshold;
  const int end = width_ - kBorder;
  for (int x = kBorder; x < end; x += 16) {
    const F16 value = load(row + x);
    const F16 size = __builtin_elementwise_abs(value);
    I16 candidates = size > threshold;
    if (lane_bits(candidates) == 0) continue;
    I16 sign;
    __builtin_memcpy(&sign, &value, sizeof sign);
    sign &= static_cast<int32_t>(0x80000000u);
    const F16 before = larger(signed_value(row + x - 1, sign), largest_of_row(above + x, sign));
    const F16 after = larger(signed_value(row + x + 1, sign), largest_of_row(below + x, sign));
    candidates &= (size > before) & (size >= after);
    if (lane_bits(candidates) == 0) continue;
    candidates &= size > largest_of_plane(differences_[layer - 1], x, y, sign);
    candidates &= size >= largest_of_plane(differences_[layer + 1], x, y, sign);
    uint32_t bits = lane_bits(candidates);
    for (; bits != 0; bits &= bits - 1) {
      const int column = x + __builtin_ctz(bits);
      if (column < end) refine(layer, column, y);
    }
  }
}

/// −1, 0 or 1: step to a neighbor that is clearly nearer to the extremum.
CK_INLINE int step_towards(double offset) {
  return offset > kStepOffset ? 1 : offset < -kStepOffset ? -1 : 0;
}

/// Fits a quadratic, moves to its extremum, and keeps it if it is strong and not on an edge.
bool OctaveSearch::refine(int layer, int x, int y) {
  const int first_row = y;
  for (int iteration = 0; iteration < kMaximumSteps; ++iteration) {
    const float* p[3][3];
    for (int s = 0; s < 3; ++s) {
      for (int r = 0; r < 3; ++r) p[s][r] = at(layer + s - 1, y + r - 1, x);
    }
    const Quadratic q = quadratic(p);
    double o[3];
    if (!q.solve(o)) return false;
    const int dx = step_towards(o[0]), dy = step_towards(o[1]);
    // Clamped, because the adjacent octaves may miss extrema beyond the first and last layer.
    const int next_layer = std::clamp(layer + step_towards(o[2]), 1, search_.layers);
    if ((dx == 0 && dy == 0 && next_layer == layer) || iteration == kMaximumSteps - 1) {
      return keep(q, o, layer, x, y);
    }
    x += dx;
    y += dy;
    layer = next_layer;
    if (x < kBorder || x >= width_ - kBorder || y < kBorder || y >= height_ - kBorder ||
        std::abs(y - first_row) >= kReach) {
      return false;
    }
  }
  return false;
}

/// Appends an extremum unless it is too far from its sample, too weak or on an edge.
bool OctaveSearch::keep(const Quadratic& q, const double* o, int layer, int x, int y) {
  if (std::abs(o[0]) > 1 || std::abs(o[1]) > 1 || std::abs(o[2]) > 1) return false;
  const double contrast = std::abs(q.value + 0.5 * (q.gx * o[0] + q.gy * o[1] + q.gs * o[2]));
  if (contrast < search_.threshold || is_edge(q, search_.edge_threshold)) return false;
  const double sigma = search_.sigma * std::exp2((layer + o[2]) / search_.layers);
  found_.push_back({static_cast<float>(x + o[0]), static_cast<float>(y + o[1]),
                    static_cast<float>(sigma), static_cast<float>(contrast), layer - 1,
                    input_.index});
  return true;
}

void search_octave(const OctaveInput& input, const Search& search, Octave& octave, Rows& next,
                   std::vector<Extremum>& found) {
  OctaveSearch(input, search, octave, next, found).run();
}

}  // namespace
}  // namespace ck::sift
