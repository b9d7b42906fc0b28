// The rows of a photo and their Gaussian blur, included once for each instruction set.

#include "core/vectors.inl"

namespace ck::sift {
namespace {

/// The index mirrored at the first and last pixel.
CK_INLINE int mirrored(int i, int count) {
  while (i < 0 || i >= count) i = i < 0 ? -i : 2 * (count - 1) - i;
  return i;
}

// ---- Gray rows of the photo -----------------------------------------------------------------

/// A row of the photo as luma (Rec. 601), 0…255.
void gray_row(const Photo& photo, int y, float* out) {
  const uint8_t* p = photo.pixels + static_cast<size_t>(y) * photo.stride;
  if (photo.channels == 1) {
    for (int x = 0; x < photo.width; ++x) out[x] = p[x];
  } else if (photo.channels == 3) {
    for (int x = 0; x < photo.width; ++x) {
      out[x] = 0.299f * p[3 * x] + 0.587f * p[3 * x + 1] + 0.114f * p[3 * x + 2];
    }
  } else {
    for (int x = 0; x < photo.width; ++x) {
      out[x] = 0.299f * p[4 * x] + 0.587f * p[4 * x + 1] + 0.114f * p[4 * x + 2];
    }
  }
}

/// Upsamples a row to twice its width by linear interpolation between pixel centers; `in[-1]` and
/// `in[width]` are overwritten.
void doubled_row(float* in, int width, float* out) {
  in[-1] = in[0];
  in[width] = in[width - 1];
  for (int x = 0; x < width; ++x) {
    out[2 * x] = 0.25f * in[x - 1] + 0.75f * in[x];
    out[2 * x + 1] = 0.75f * in[x] + 0.25f * in[x + 1];
  }
}

/// The rows of a photo from top to bottom, upsampled to twice the size if requested.
struct PhotoRows {
  const Photo& photo;
  bool is_doubled;
  Rows wide;  // the last rows, doubled along x
  std::vector<float> gray;
  int done = 0;

  PhotoRows(const Photo& source, bool doubled)
      : photo(source),
        is_doubled(doubled),
        wide(doubled ? 2 * source.width : 1, 3),
        gray(doubled ? static_cast<size_t>(source.width) + 32 : 0) {}

  void write(int y, float* out) {
    if (!is_doubled) return gray_row(photo, y, out);
    const int upper = (y - 1) >> 1;  // floor; −1 in the first row
    while (done <= std::min(upper + 1, photo.height - 1)) {
      gray_row(photo, done, gray.data() + 16);
      doubled_row(gray.data() + 16, photo.width, wide[done]);
      ++done;
    }
    const float* a = wide[std::max(0, upper)];
    const float* b = wide[std::min(upper + 1, photo.height - 1)];
    const float lower = y & 1 ? 0.25f : 0.75f;
    for (int x = 0; x < 2 * photo.width; ++x) out[x] = (1 - lower) * a[x] + lower * b[x];
  }
};

// ---- Gaussian blur --------------------------------------------------------------------------

/// Rows that are blurred together. Chosen: their sums fit the registers.
constexpr int kGroup = 4;
/// Columns around a row that the blur along x reads. Chosen: room for the largest radius and a
/// vector.
constexpr int kMargin = 64;

/// Number of σ at which a Gaussian is truncated. Chosen: 0.3 % of it are farther away.
constexpr double kTruncation = 3;

/// A truncated Gaussian filter.
struct Gaussian {
  /// Number of taps on each side of the center.
  int radius = 0;
  /// From the center outwards.
  std::vector<float> taps;

  Gaussian() = default;
  explicit Gaussian(double sigma)
      : radius(std::min(kMargin - 16, static_cast<int>(std::ceil(kTruncation * sigma)))) {
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += std::exp(-i * i / (2 * sigma * sigma));
    for (int i = 0; i <= radius; ++i) {
      taps.push_back(static_cast<float>(std::exp(-i * i / (2 * sigma * sigma)) / sum));
    }
  }
};

/// Blurs along y: four rows from the 2 · radius + 4 rows around them. `known` is the radius if it
/// is a compile-time constant, so that the loop is unrolled, or 0.
template <int known>
void blur_columns(const float* const* rows, const Gaussian& gaussian, int width,
                  float* const* out) {
  const int radius = known > 0 ? known : gaussian.radius;
  float taps[2 * kMargin];
  for (int i = -radius; i <= radius; ++i) taps[i + radius] = gaussian.taps[std::abs(i)];
  const int last = 2 * radius;
  for (int x = 0; x < width; x += 16) {
    F16 a = load(rows[0] + x) * taps[0];
    F16 v = load(rows[1] + x);
    a += v * taps[1];
    F16 b = v * taps[0];
    v = load(rows[2] + x);
    a += v * taps[2];
    b += v * taps[1];
    F16 c = v * taps[0], d = 0;
    for (int i = 3; i <= last; ++i) {
      v = load(rows[i] + x);
      a += v * taps[i];
      b += v * taps[i - 1];
      c += v * taps[i - 2];
      d += v * taps[i - 3];
    }
    v = load(rows[last + 1] + x);
    b += v * taps[last];
    c += v * taps[last - 1];
    d += v * taps[last - 2];
    v = load(rows[last + 2] + x);
    c += v * taps[last];
    d += v * taps[last - 1];
    d += load(rows[last + 3] + x) * taps[last];
    store(out[0] + x, a);
    store(out[1] + x, b);
    store(out[2] + x, c);
    store(out[3] + x, d);
  }
}

/// Sixteen values blurred along x. Reads `radius` values on both sides of the row.
CK_INLINE F16 blurred(const float* p, const float* taps, int radius) {
  F16 sum = load(p) * taps[0];
  for (int i = 1; i <= radius; ++i) sum += (load(p - i) + load(p + i)) * taps[i];
  return sum;
}

/// Mirrors `radius` values beyond both ends of a row.
void mirror_ends(float* row, int width, int radius) {
  for (int i = 1; i <= radius; ++i) {
    row[-i] = row[mirrored(-i, width)];
    row[width - 1 + i] = row[mirrored(width - 1 + i, width)];
  }
}

/// Destinations of a blurred row in addition to the level itself.
struct RowOutputs {
  float* level;
  const float* previous = nullptr;
  float* difference = nullptr;
  uint16_t* kept = nullptr;
};

/// Blurs a row along x and writes all destinations; `known` as above.
template <int known>
void blur_row(const float* row, const Gaussian& gaussian, int width, const RowOutputs& out) {
  const int radius = known > 0 ? known : gaussian.radius;
  float taps[kMargin];
  for (int i = 0; i <= radius; ++i) taps[i] = gaussian.taps[i];
  for (int x = 0; x < width; x += 16) {
    const F16 v = blurred(row + x, taps, radius);
    store(out.level + x, v);
    if (out.difference) store(out.difference + x, v - load(out.previous + x));
    if (out.kept) {
      const H16 fixed =
          __builtin_convertvector(__builtin_convertvector(v * 256.0f + 0.5f, I16), H16);
      __builtin_memcpy(out.kept + x, &fixed, sizeof fixed);
    }
  }
}

/// The two passes of a blur.
struct Blur {
  decltype(&blur_columns<0>) columns;
  decltype(&blur_row<0>) row;
};

template <int known>
constexpr Blur blur_of() {
  return {blur_columns<known>, blur_row<known>};
}

/// Unrolled for the radii of three scales per octave with a first blur of σ = 1.6.
Blur blur_of_radius(int radius) {
  switch (radius) {
    case 4:
      return blur_of<4>();
    case 5:
      return blur_of<5>();
    case 6:
      return blur_of<6>();
    case 8:
      return blur_of<8>();
    case 10:
      return blur_of<10>();
    default:
      return blur_of<0>();
  }
}

}  // namespace
}  // namespace ck::sift
