#include "ck_retrieval.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/guard.h"
#include "core/parallel.h"
#include "core/random.h"
#include "features/nearest.h"

namespace ck {
namespace {

/// Descriptors per unit of work. Chosen: a block of the search.
constexpr size_t kChunk = 4096;
/// Vectors per unit of work that are compared with all others. Chosen.
constexpr size_t kRankedRows = 32;

/// The index of the nearest word of each descriptor.
std::vector<uint32_t> assign(const uint8_t* descriptors, size_t count, const uint8_t* words,
                             size_t word_count, const ck_control* control) {
  std::vector<uint32_t> nearest(count);
  parallel_for(control, (count + kChunk - 1) / kChunk, [&](size_t chunk) {
    const size_t begin = chunk * kChunk, end = std::min(count, begin + kChunk);
    const NearestTable table = nearest_two(descriptors + begin * kDescriptorLength, end - begin,
                                           words, word_count, ck_instructions_automatic, nullptr);
    for (size_t i = begin; i < end; ++i) nearest[i] = table.by_row[i - begin].index;
  });
  return nearest;
}

/// `count` distinct random numbers below `bound`, in ascending order.
std::vector<size_t> sample(size_t count, size_t bound, uint64_t seed) {
  std::vector<size_t> numbers(bound);
  std::iota(numbers.begin(), numbers.end(), size_t{0});
  Random random(seed);
  for (size_t i = 0; i < count; ++i) std::swap(numbers[i], numbers[i + random.below(bound - i)]);
  numbers.resize(count);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Updates each word to the mean of its descriptors; words without descriptors do not change.
void move_words(const uint8_t* descriptors, const std::vector<uint32_t>& nearest, uint8_t* words,
                size_t word_count) {
  std::vector<uint64_t> sums(word_count * kDescriptorLength);
  std::vector<uint64_t> sizes(word_count);
  for (size_t i = 0; i < nearest.size(); ++i) {
    const uint8_t* descriptor = descriptors + i * kDescriptorLength;
    uint64_t* sum = &sums[nearest[i] * kDescriptorLength];
    for (size_t k = 0; k < kDescriptorLength; ++k) sum[k] += descriptor[k];
    ++sizes[nearest[i]];
  }
  for (size_t w = 0; w < word_count; ++w) {
    if (sizes[w] == 0) continue;
    for (size_t k = 0; k < kDescriptorLength; ++k) {
      words[w * kDescriptorLength + k] =
          static_cast<uint8_t>((sums[w * kDescriptorLength + k] + sizes[w] / 2) / sizes[w]);
    }
  }
}

/// Scales a vector to length 1; zeros stay zeros.
void scale_to_unit_length(float* values, size_t count) {
  double squares = 0;
  for (size_t k = 0; k < count; ++k) squares += double{values[k]} * values[k];
  if (squares <= 0) return;
  const auto factor = static_cast<float>(1 / std::sqrt(squares));
  for (size_t k = 0; k < count; ++k) values[k] *= factor;
}

/// Another vector with its similarity; the most similar comes first.
struct Neighbor {
  float similarity;
  int32_t index;

  bool operator<(const Neighbor& other) const {
    return similarity != other.similarity ? similarity > other.similarity : index < other.index;
  }
};

}  // namespace
}  // namespace ck

ck_status ck_learn_words(const uint8_t* descriptors, size_t count, size_t word_count,
                         int32_t iterations, uint64_t seed, const ck_control* control,
                         uint8_t* words) {
  return ck::guarded([&] {
    ck::require(descriptors && words, "an argument is missing");
    ck::require(word_count > 0 && word_count <= count, "there are fewer descriptors than words");
    const std::vector<size_t> first = ck::sample(word_count, count, seed);
    for (size_t w = 0; w < word_count; ++w) {
      std::copy_n(descriptors + first[w] * ck::kDescriptorLength, ck::kDescriptorLength,
                  words + w * ck::kDescriptorLength);
    }
    for (int32_t i = 0; i < iterations; ++i) {
      const auto nearest = ck::assign(descriptors, count, words, word_count, control);
      ck::move_words(descriptors, nearest, words, word_count);
    }
  });
}

ck_status ck_encode_vlad(const uint8_t* descriptors, size_t count, const uint8_t* words,
                         size_t word_count, const ck_control* control, float* vector) {
  return ck::guarded([&] {
    ck::require(words && vector && word_count > 0, "an argument is missing");
    constexpr size_t kLength = ck::kDescriptorLength;
    std::fill_n(vector, word_count * kLength, 0.0f);
    const auto nearest = ck::assign(descriptors, count, words, word_count, control);
    for (size_t i = 0; i < count; ++i) {
      const uint8_t* descriptor = descriptors + i * kLength;
      const uint8_t* word = words + nearest[i] * kLength;
      float* sum = vector + nearest[i] * kLength;
      // Integers that floats represent exactly.
      for (size_t k = 0; k < kLength; ++k) sum[k] += static_cast<float>(descriptor[k] - word[k]);
    }
    for (size_t w = 0; w < word_count; ++w) ck::scale_to_unit_length(vector + w * kLength, kLength);
    ck::scale_to_unit_length(vector, word_count * kLength);
  });
}

ck_status ck_most_similar(const float* vectors, size_t count, size_t length, size_t neighbor_count,
                          const ck_control* control, int32_t* indices, float* similarities) {
  return ck::guarded([&] {
    ck::require(vectors && indices && similarities, "an argument is missing");
    ck::require(length > 0 && neighbor_count < count,
                "neighbor_count must be less than the number of vectors");
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> all(vectors, static_cast<Eigen::Index>(count),
                                     static_cast<Eigen::Index>(length));
    ck::parallel_for(control, (count + ck::kRankedRows - 1) / ck::kRankedRows, [&](size_t chunk) {
      const size_t begin = chunk * ck::kRankedRows;
      const size_t rows = std::min(count - begin, ck::kRankedRows);
      const Eigen::MatrixXf table =
          all * all.middleRows(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(rows))
                    .transpose();
      for (size_t r = 0; r < rows; ++r) {
        std::vector<ck::Neighbor> others;
        for (size_t i = 0; i < count; ++i) {
          if (i == begin + r) continue;
          others.push_back({table(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(r)),
                            static_cast<int32_t>(i)});
        }
        std::partial_sort(others.begin(),
                          others.begin() + static_cast<std::ptrdiff_t>(neighbor_count),
                          others.end());
        for (size_t k = 0; k < neighbor_count; ++k) {
          indices[(begin + r) * neighbor_count + k] = others[k].index;
          similarities[(begin + r) * neighbor_count + k] = others[k].similarity;
        }
      }
    });
  });
}
