#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "ck_features.h"

namespace ck::sift {

/// The caller's photo: 8-bit with 1, 3 or 4 channels.
struct Photo {
  const uint8_t* pixels;
  int width, height, channels;
  size_t stride;
};

/// Acceptance thresholds of extrema and sampling of the scales.
struct Search {
  /// Number of scale samples per octave.
  int layers;
  /// Blur σ of the first level of an octave, in pixels of the octave.
  float sigma;
  /// Smallest absolute difference of Gaussians at an extremum, in gray levels (0…255).
  float threshold;
  /// Lowe's limit on the ratio of principal curvatures.
  float edge_threshold;
};

/// An extremum of the difference of Gaussians, in pixels of its octave. The origin is the center of
/// the first pixel.
struct Extremum {
  float x, y, sigma;
  /// Absolute difference of Gaussians there, in gray levels.
  float response;
  /// The level for orientation and description, and the octave; both from 0.
  int level, octave;
};

/// Uninitialized memory. Large blocks request huge pages, which are many times cheaper to allocate.
class Block {
 public:
  Block() = default;
  explicit Block(size_t byte_count) {
    constexpr size_t kLargePage = size_t{2} << 20;  // Limit: the huge pages of x86-64 and ARM64.
    const bool is_large = byte_count >= 2 * kLargePage;
    const size_t alignment = is_large ? kLargePage : 64;
    const size_t size = (byte_count + alignment - 1) / alignment * alignment;
    memory_.reset(std::aligned_alloc(alignment, size));
    if (!memory_) throw std::bad_alloc();
#if defined(__linux__)
    if (is_large) madvise(memory_.get(), size, MADV_HUGEPAGE);
#endif
  }

  template <typename Value>
  Value* as() const {
    return static_cast<Value*>(memory_.get());
  }

 private:
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  std::unique_ptr<void, Free> memory_;
};

/// The levels of an octave from which features are described, in gray levels × 256.
struct Octave {
  int width = 0, height = 0;
  size_t stride = 0;
  std::vector<Block> levels;
};

/// A ring buffer of the last `height` rows of floats written, or all rows.
struct Rows {
  std::vector<float> values;
  size_t stride = 0;
  int height = 1;

  Rows() = default;
  Rows(int width, int row_count)
      : values(row_stride(width) * static_cast<size_t>(row_count), 0.0f),
        stride(row_stride(width)),
        height(row_count) {}

  float* operator[](int y) { return values.data() + static_cast<size_t>(y % height) * stride; }
  const float* operator[](int y) const {
    return values.data() + static_cast<size_t>(y % height) * stride;
  }

  /// Whole vectors, one more for reading ahead, and an odd number of cache lines, so that adjacent
  /// rows do not map to the same cache sets.
  static size_t row_stride(int width) {
    return (((static_cast<size_t>(width) + 15) / 16 + 1) | 1) * 16;
  }
};

/// The source of the first level of an octave: a photo, or the previous octave.
struct OctaveInput {
  /// Null except for the first octave.
  const Photo* photo = nullptr;
  bool is_doubled = false;
  /// All rows of the first level, if there is no photo.
  Rows* rows = nullptr;
  int width = 0, height = 0, index = 0;
};

/// The inner loops, compiled for each instruction set.
struct Kernels {
  /// Appends the extrema of an octave. Fills `octave`, and `next` with the first level of the next
  /// octave, which has half the width and height (rounded down).
  void (*search)(const OctaveInput& input, const Search& search, Octave& octave, Rows& next,
                 std::vector<Extremum>& found);
  /// Computes the dominant gradient directions around an extremum, in radians 0…2π from x to y, the
  /// strongest first. Returns their number: at least one, at most `kMaximumOrientations`.
  int (*orient)(const Octave& octave, const Extremum& extremum, float* orientations);
  /// Computes the root-SIFT bytes of an extremum relative to the orientation.
  void (*describe)(const Octave& octave, const Extremum& extremum, float orientation,
                   uint8_t* descriptor);
};

/// Largest number of orientations of an extremum. Chosen: it hardly ever has more.
constexpr int kMaximumOrientations = 4;
/// Smallest width and height of an octave. Chosen: less has hardly any pixel inside its border.
constexpr int kMinimumOctaveSide = 16;

const Kernels& portable_kernels();
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();

/// The kernels of an instruction set. Throws if the processor does not support it.
const Kernels& kernels(ck_instructions instructions);

}  // namespace ck::sift
