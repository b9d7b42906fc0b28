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

/// A photo as the caller stores it: 8-bit, 1, 3 or 4 channels.
struct Photo {
  const uint8_t* pixels;
  int width, height, channels;
  size_t stride;
};

/// What is an extremum worth keeping, and how the scales are sampled.
struct Search {
  /// Scale samples of one octave.
  int layers;
  /// Blur of the first level of an octave, in pixels of the octave.
  float sigma;
  /// Least difference of Gaussians at an extremum, in grey levels (0…255).
  float threshold;
  /// Lowe's limit on the ratio of principal curvatures.
  float edge_threshold;
};

/// An extremum of the difference of Gaussians, in pixels of its octave. The origin is the centre of
/// the first pixel.
struct Extremum {
  float x, y, sigma;
  /// Absolute value there, in grey levels.
  float response;
  /// The level to describe it from, and its octave; both from 0.
  int level, octave;
};

/// Memory that isn't filled. Large blocks ask for large pages, which are many times cheaper to get.
class Block {
 public:
  Block() = default;
  explicit Block(size_t byte_count) {
    constexpr size_t kLargePage = size_t{2} << 20;
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

/// What is kept of an octave: the levels that features are described from, in grey levels × 256.
struct Octave {
  int width = 0, height = 0;
  size_t stride = 0;
  std::vector<Block> levels;
};

/// Rows of floats. Holds the last `height` rows written, or all.
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

  /// Whole vectors, one more to read ahead, and an odd number of cache lines, so that the rows
  /// above each other don't fall on the same cache sets.
  static size_t row_stride(int width) {
    return (((static_cast<size_t>(width) + 15) / 16 + 1) | 1) * 16;
  }
};

/// Where the first level of an octave comes from: a photo, or the octave before.
struct OctaveInput {
  /// Null for all but the first octave.
  const Photo* photo = nullptr;
  bool is_doubled = false;
  /// All rows of the first level, where there is no photo.
  Rows* rows = nullptr;
  int width = 0, height = 0, index = 0;
};

/// The loops that are compiled for each instruction set.
struct Kernels {
  /// Appends the extrema of an octave. Fills `octave`, and `next` with the first level of the next
  /// octave, which has half the width and height (rounded down).
  void (*search)(const OctaveInput& input, const Search& search, Octave& octave, Rows& next,
                 std::vector<Extremum>& found);
  /// The directions of the gradient around an extremum, in radians 0…2π from x to y, the strongest
  /// first. Returns how many: at least one, at most `kMaximumOrientations`.
  int (*orient)(const Octave& octave, const Extremum& extremum, float* orientations);
  /// The root-SIFT bytes of an extremum, seen along the orientation.
  void (*describe)(const Octave& octave, const Extremum& extremum, float orientation,
                   uint8_t* descriptor);
};

constexpr int kMaximumOrientations = 4;
/// Octaves are searched down to this width and height.
constexpr int kSmallestOctave = 16;

const Kernels& portable_kernels();
const Kernels& avx2_kernels();
const Kernels& avx512_kernels();

/// Throws where the processor lacks the instructions.
const Kernels& kernels(ck_instructions instructions);

}  // namespace ck::sift
