// Orientations and descriptors, included once for each instruction set after `gather` is defined
// and after scale_space.inl.
//
// Both use a window of 16 × 16 cells, rotated and scaled with the feature, whose corners are
// sampled from the blurred level. The cells are about as large as the blur, so that no detail is
// lost between the corners. The window and its weights are the same for all features, hence tables.

namespace ck::sift {
namespace {

/// Cells per side of the window. Paper: Lowe 2004, section 6.1.
constexpr int kCells = 16;
/// Directions per histogram of a descriptor. Paper: Lowe 2004, section 6.2.
constexpr int kDirections = 8;
/// Histograms per side of a descriptor. Paper: Lowe 2004, section 6.2.
constexpr int kBins = 4;
/// Directions of the histogram from which the orientation is determined. Paper: Lowe 2004,
/// section 5.
constexpr int kPeakBins = 36;
/// Smallest height of a further orientation's peak, relative to the highest. Paper: Lowe 2004,
/// section 5.
constexpr float kPeakRatio = 0.8f;
/// Upper bound of an element of a descriptor, relative to its norm. Paper: Lowe 2004, section 6.1.
constexpr float kMaximumElement = 0.2f;

/// Standard deviation of the orientation's weights in units of the feature's σ. Paper: Lowe 2004,
/// section 5.
constexpr double kOrientationSigma = 1.5;
/// Side of a cell in units of the feature's σ. Chosen: the window extends 4.5 σ from the feature,
/// three standard deviations.
constexpr float kOrientationCell = 9.0f / kCells;
/// Side of a descriptor bin in units of σ. Chosen: that of Lowe's program.
constexpr float kBinSize = 3;
/// Cells per bin. Limit: the window extends half a bin beyond the bins.
constexpr float kCellsOfBin = kCells / 5.0f;

const F16 kLane = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// Weights that are the same for all features.
struct Tables {
  /// Weight of each cell for the orientation: a Gaussian of `kOrientationSigma`.
  float orientation[kCells][kCells];
  /// Weight of a row, or column, of cells for each bin: linear interpolation, averaged over the
  /// cell, under a Gaussian of two bins.
  float bin[kBins][kCells];

  Tables() {
    for (int j = 0; j < kCells; ++j) {
      for (int i = 0; i < kCells; ++i) {
        const double u = (i - 7.5) * kOrientationCell, v = (j - 7.5) * kOrientationCell;
        orientation[j][i] = static_cast<float>(
            std::exp(-(u * u + v * v) / (2 * kOrientationSigma * kOrientationSigma)));
      }
    }
    for (int b = 0; b < kBins; ++b) {
      for (int i = 0; i < kCells; ++i) bin[b][i] = bin_weight(i, b - 1.5);
    }
  }

  static float bin_weight(int cell, double center) {
    constexpr int kParts = 16;  // Chosen: parts of a cell over which the weight is averaged.
    double sum = 0;
    for (int k = 0; k < kParts; ++k) {
      const double u = (cell - 8 + (k + 0.5) / kParts) / kCellsOfBin;
      sum += std::max(0.0, 1 - std::abs(u - center)) * std::exp(-u * u / 8);
    }
    return static_cast<float>(sum / kParts);
  }
};

const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

/// Gray level differences along the window's axes, per row of cells.
struct Gradients {
  F16 x[kCells], y[kCells];
};

/// A window of cells: its position in its level, and the level.
struct Window {
  const uint16_t* level;
  int width, height, stride;
  /// Center in pixels, and the window's x axis with the length of a cell.
  float x, y, ux, uy;

  Window(const Octave& octave, const Extremum& e, float cell, float angle)
      : level(octave.levels[e.level].as<uint16_t>()),
        width(octave.width),
        height(octave.height),
        stride(static_cast<int>(octave.stride)),
        x(e.x),
        y(e.y),
        ux(e.sigma * cell * std::cos(angle)),
        uy(e.sigma * cell * std::sin(angle)) {}

  bool is_inside() const {
    const float reach = 8 * (std::abs(ux) + std::abs(uy));
    return x - reach >= 0 && y - reach >= 0 && x + reach < static_cast<float>(width - 1) &&
           y + reach < static_cast<float>(height - 1);
  }
};

CK_INLINE F16 limited(const F16& v, float limit) {
  return __builtin_elementwise_min(__builtin_elementwise_max(v, F16(0.0f)), F16(limit));
}

/// Bilinear samples of the level at offsets from the center in cells; positions outside are clamped
/// to the border.
CK_INLINE F16 sample(const Window& w, const F16& u, const F16& v) {
  const F16 x = limited(w.x + u * w.ux - v * w.uy, static_cast<float>(w.width) - 1.001f);
  const F16 y = limited(w.y + u * w.uy + v * w.ux, static_cast<float>(w.height) - 1.001f);
  const I16 column = __builtin_convertvector(x, I16), row = __builtin_convertvector(y, I16);
  const F16 fx = x - __builtin_convertvector(column, F16);
  const F16 fy = y - __builtin_convertvector(row, F16);
  const I16 index = row * w.stride + column;
  U16 upper, lower;
  gather(upper, w.level, index);
  gather(lower, w.level + w.stride, index);
  const F16 a = __builtin_convertvector(upper & 65535, F16);
  const F16 b = __builtin_convertvector(upper >> 16, F16);
  const F16 c = __builtin_convertvector(lower & 65535, F16);
  const F16 d = __builtin_convertvector(lower >> 16, F16);
  const F16 top = a + fx * (b - a), bottom = c + fx * (d - c);
  return top + fy * (bottom - top);
}

/// −1 in lanes whose cell center lies within the level.
CK_INLINE I16 cells_inside(const Window& w, int row) {
  const F16 u = kLane - 7.5f;
  const float v = static_cast<float>(row) - 7.5f;
  const F16 x = w.x + u * w.ux - v * w.uy, y = w.y + u * w.uy + v * w.ux;
  return (x >= 0) & (y >= 0) & (x <= static_cast<float>(w.width - 1)) &
         (y <= static_cast<float>(w.height - 1));
}

CK_INLINE void window_gradients(const Window& w, Gradients& g) {
  // The seventeenth corner of each row of corners.
  float last[kCells + 1];
  store(last, sample(w, F16(8.0f), kLane - 8.0f));
  last[kCells] = sample(w, F16(8.0f), F16(8.0f)).x;
  F16 upper = sample(w, kLane - 8.0f, F16(-8.0f));
  for (int r = 0; r < kCells; ++r) {
    const F16 lower = sample(w, kLane - 8.0f, F16(static_cast<float>(r - 7)));
    float shifted[2][kCells + 1];
    store(shifted[0], upper);
    store(shifted[1], lower);
    shifted[0][kCells] = last[r];
    shifted[1][kCells] = last[r + 1];
    const F16 falling = load(shifted[1] + 1) - upper, rising = load(shifted[0] + 1) - lower;
    g.x[r] = falling + rising;
    g.y[r] = falling - rising;
    upper = lower;
  }
  if (w.is_inside()) return;
  for (int r = 0; r < kCells; ++r) {
    const I16 inside = cells_inside(w, r);
    g.x[r] = inside ? g.x[r] : F16(0.0f);
    g.y[r] = inside ? g.y[r] : F16(0.0f);
  }
}

CK_INLINE F16 length(const F16& x, const F16& y) {
  return __builtin_elementwise_sqrt(x * x + y * y);
}

/// The angle of a vector in turns, 0…1. The arctangent polynomial is accurate to 1e-5.
CK_INLINE F16 turns(const F16& x, const F16& y) {
  const F16 ax = __builtin_elementwise_abs(x), ay = __builtin_elementwise_abs(y);
  const F16 big = __builtin_elementwise_max(ax, ay), small = __builtin_elementwise_min(ax, ay);
  const F16 q = small / (big + 1e-20f), s = q * q;
  F16 p = s * -0.01172120f + 0.05265332f;
  p = p * s - 0.11643287f;
  p = p * s + 0.19354346f;
  p = p * s - 0.33262347f;
  p = p * s + 0.99997726f;
  F16 angle = p * q * 0.15915494f;
  angle = ay > ax ? 0.25f - angle : angle;
  angle = x < 0 ? 0.5f - angle : angle;
  return y < 0 ? 1.0f - angle : angle;
}

// ---- Orientation ----------------------------------------------------------------------------

/// Smoothed histogram of gradient directions around a feature, weighted by magnitude and distance.
void direction_histogram(const Window& window, float* histogram) {
  Gradients g;
  window_gradients(window, g);
  // One extra bin receives what wraps around.
  float raw[kPeakBins + 1] = {};
  for (int r = 0; r < kCells; ++r) {
    const F16 place = turns(g.x[r], g.y[r]) * static_cast<float>(kPeakBins);
    const F16 weight = length(g.x[r], g.y[r]) * load(tables().orientation[r]);
    const I16 bin = __builtin_convertvector(place, I16);
    const F16 upper = (place - __builtin_convertvector(bin, F16)) * weight;
    const F16 lower = weight - upper;
    int32_t bins[kCells];
    float parts[2][kCells];
    __builtin_memcpy(bins, &bin, sizeof bin);
    store(parts[0], lower);
    store(parts[1], upper);
    for (int i = 0; i < kCells; ++i) {
      const int b = bins[i] >= kPeakBins ? 0 : bins[i];
      raw[b] += parts[0][i];
      raw[b + 1] += parts[1][i];
    }
  }
  raw[0] += raw[kPeakBins];
  for (int i = 0; i < kPeakBins; ++i) {
    const int a = (i + kPeakBins - 2) % kPeakBins, b = (i + kPeakBins - 1) % kPeakBins;
    const int c = (i + 1) % kPeakBins, d = (i + 2) % kPeakBins;
    histogram[i] = raw[i] * 0.375f + (raw[b] + raw[c]) * 0.25f + (raw[a] + raw[d]) * 0.0625f;
  }
}

/// A peak of the histogram; the angle is in radians.
struct Peak {
  float height, angle;
};

int orient(const Octave& octave, const Extremum& extremum, float* orientations) {
  float h[kPeakBins];
  direction_histogram(Window(octave, extremum, kOrientationCell, 0), h);
  const float least = kPeakRatio * *std::max_element(h, h + kPeakBins);
  Peak peaks[kPeakBins];
  int count = 0;
  for (int i = 0; i < kPeakBins; ++i) {
    const float before = h[(i + kPeakBins - 1) % kPeakBins], after = h[(i + 1) % kPeakBins];
    if (h[i] < least || h[i] <= before || h[i] < after) continue;
    const float offset = 0.5f * (before - after) / (before - 2 * h[i] + after);
    float bin = static_cast<float>(i) + offset;
    if (bin < 0) bin += kPeakBins;
    if (bin >= kPeakBins) bin -= kPeakBins;
    peaks[count++] = {h[i], bin * static_cast<float>(2 * M_PI / kPeakBins)};
  }
  std::sort(peaks, peaks + count, [](const Peak& a, const Peak& b) {
    return a.height != b.height ? a.height > b.height : a.angle < b.angle;
  });
  count = std::min(count, kMaximumOrientations);
  for (int i = 0; i < count; ++i) orientations[i] = peaks[i].angle;
  if (count == 0) orientations[count++] = 0;  // no gradient
  return count;
}

// ---- Descriptor -----------------------------------------------------------------------------

/// Gradient magnitudes of the cells, pooled into four rows of bins for each direction; columns are
/// pooled later.
struct RowBins {
  F16 sum[kBins][kDirections];
};

CK_INLINE void pool_rows(const Gradients& g, RowBins& bins) {
  for (int b = 0; b < kBins; ++b) {
    for (int d = 0; d < kDirections; ++d) bins.sum[b][d] = 0;
  }
  // Limit: every bin covers seven rows of cells.
  constexpr int kFirstRow[kBins] = {0, 3, 6, 9};
  const Tables& t = tables();
  F16 size[kCells], turned[kCells];
  for (int r = 0; r < kCells; ++r) {
    size[r] = length(g.x[r], g.y[r]);
    turned[r] = size[r] * (turns(g.x[r], g.y[r]) * static_cast<float>(kDirections));
  }
#pragma clang loop unroll(full)
  for (int d = 0; d < kDirections; ++d) {
    F16 sum[kBins];
#pragma clang loop unroll(full)
    for (int b = 0; b < kBins; ++b) sum[b] = 0;
#pragma clang loop unroll(full)
    for (int r = 0; r < kCells; ++r) {
      // The part of the magnitude that belongs to the direction, linear in the angle.
      F16 part = __builtin_elementwise_max(
          size[r] - __builtin_elementwise_abs(turned[r] - static_cast<float>(d) * size[r]),
          F16(0.0f));
      if (d == 0) {
        part += __builtin_elementwise_max(turned[r] - (kDirections - 1.0f) * size[r], F16(0.0f));
      }
#pragma clang loop unroll(full)
      for (int b = 0; b < kBins; ++b) {
        if (r >= kFirstRow[b] && r < kFirstRow[b] + 7) sum[b] += part * t.bin[b][r];
      }
    }
#pragma clang loop unroll(full)
    for (int b = 0; b < kBins; ++b) bins.sum[b][d] = sum[b];
  }
}

/// Values in the order bin row, direction, bin column.
CK_INLINE void pool_columns(const RowBins& bins, float* values) {
  const Tables& t = tables();
  F16 weights[kBins];
  for (int c = 0; c < kBins; ++c) weights[c] = load(t.bin[c]);
  for (int b = 0; b < kBins; ++b) {
    for (int d = 0; d < kDirections; ++d) {
      const F16& v = bins.sum[b][d];
      const F4 p = quarter_sums(v * weights[0]), q = quarter_sums(v * weights[1]);
      const F4 r = quarter_sums(v * weights[2]), s = quarter_sums(v * weights[3]);
      const F4 pq =
          __builtin_shufflevector(p, q, 0, 2, 4, 6) + __builtin_shufflevector(p, q, 1, 3, 5, 7);
      const F4 rs =
          __builtin_shufflevector(r, s, 0, 2, 4, 6) + __builtin_shufflevector(r, s, 1, 3, 5, 7);
      const F4 all =
          __builtin_shufflevector(pq, rs, 0, 2, 4, 6) + __builtin_shufflevector(pq, rs, 1, 3, 5, 7);
      __builtin_memcpy(values, &all, sizeof all);
      values += kBins;
    }
  }
}

/// Clamps values to `kMaximumElement` of the norm, then converts to root-SIFT bytes.
CK_INLINE void write_bytes(const float* values, uint8_t* bytes) {
  F16 v[8], square = 0, total = 0;
  for (int i = 0; i < 8; ++i) {
    v[i] = load(values + 16 * i);
    square += v[i] * v[i];
  }
  const F16 limit = kMaximumElement * std::sqrt(sum(square));
  for (int i = 0; i < 8; ++i) {
    v[i] = __builtin_elementwise_min(v[i], limit);
    total += v[i];
  }
  const float total_sum = sum(total);
  const float factor = total_sum > 0 ? 512.0f * 512.0f / total_sum : 0;
  for (int i = 0; i < 8; ++i) {
    const F16 root = __builtin_elementwise_sqrt(v[i] * factor) + 0.5f;
    const I16 whole = __builtin_convertvector(__builtin_elementwise_min(root, F16(255.0f)), I16);
    const B16 narrow = __builtin_convertvector(whole, B16);
    __builtin_memcpy(bytes + 16 * i, &narrow, sizeof narrow);
  }
}

void describe(const Octave& octave, const Extremum& extremum, float orientation,
              uint8_t* descriptor) {
  Gradients gradients;
  window_gradients(Window(octave, extremum, kBinSize / kCellsOfBin, orientation), gradients);
  RowBins bins;
  pool_rows(gradients, bins);
  float values[kBins * kDirections * kBins];
  pool_columns(bins, values);
  write_bytes(values, descriptor);
}

}  // namespace

const Kernels& CK_SIFT_KERNELS() {
  static const Kernels kTable{search_octave, orient, describe};
  return kTable;
}

}  // namespace ck::sift
