#include <algorithm>
#include <vector>

#include "features/nearest.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace ck {
namespace {

constexpr size_t kLanes = 8;   // Columns per tile. Limit: lanes of a register.
constexpr size_t kGroup = 4;   // Rows processed together. Limit: 16 registers hold the sums.
constexpr size_t kChunk = 64;  // Rows. Chosen: their state fits into the first-level cache.
constexpr size_t kSteps = kDescriptorLength / 2;  // Limit: two words per step.

/// Descriptors as 16-bit words, because sums of two products of bytes overflow 16 bits; two words
/// of four rows, or of eight columns, are interleaved.
struct Panel {
  std::vector<int32_t> words;
  std::vector<uint32_t> term, term_with_index;
};

/// `padded` is a multiple of `interleave`; the padding has distance `far`.
Panel pack(const uint8_t* descriptors, size_t count, size_t padded, uint32_t far, size_t interleave,
           size_t index_divisor) {
  Panel panel{std::vector<int32_t>(padded * kSteps),
              std::vector<uint32_t>(padded, far << kIndexBits),
              std::vector<uint32_t>(padded, far << kIndexBits)};
  for (size_t i = 0; i < count; ++i) {
    const uint8_t* d = descriptors + i * kDescriptorLength;
    panel.term[i] = squared_norm(d) << kIndexBits;
    panel.term_with_index[i] = panel.term[i] + static_cast<uint32_t>(i / index_divisor);
    for (size_t k = 0; k < kSteps; ++k) {
      panel.words[(i / interleave * kSteps + k) * interleave + i % interleave] =
          int32_t{d[2 * k]} | int32_t{d[2 * k + 1]} << 16;
    }
  }
  return panel;
}

using Lanes = LaneState<kLanes>;

#define CK_AVX2 __attribute__((target("avx2")))

CK_AVX2 inline __m256i load(const void* p) {
  return _mm256_loadu_si256(static_cast<const __m256i*>(p));
}

CK_AVX2 inline void store(void* p, __m256i value) {
  _mm256_storeu_si256(static_cast<__m256i*>(p), value);
}

CK_AVX2 inline void keep(__m256i& best, __m256i& second, __m256i key) {
  second = _mm256_min_epu32(second, _mm256_max_epu32(best, key));
  best = _mm256_min_epu32(best, key);
}

/// Four rows against two tiles of columns.
CK_AVX2 inline void group_against_tiles(const Panel& rows, size_t row, const Panel& columns,
                                        size_t tile, Lanes* row_states, Lanes* column_states) {
  const int32_t* a = rows.words.data() + row * kSteps;
  const int32_t* b = columns.words.data() + tile * kLanes * kSteps;
  __m256i sums[kGroup][2];
#pragma clang loop unroll(full)
  for (size_t r = 0; r < kGroup; ++r) sums[r][0] = sums[r][1] = _mm256_setzero_si256();
  for (size_t k = 0; k < kSteps; ++k) {
    const __m256i b0 = load(b + k * kLanes), b1 = load(b + (kSteps + k) * kLanes);
#pragma clang loop unroll(full)
    for (size_t r = 0; r < kGroup; ++r) {
      const __m256i word = _mm256_set1_epi32(a[k * kGroup + r]);
      sums[r][0] = _mm256_add_epi32(sums[r][0], _mm256_madd_epi16(b0, word));
      sums[r][1] = _mm256_add_epi32(sums[r][1], _mm256_madd_epi16(b1, word));
    }
  }
#pragma clang loop unroll(full)
  for (size_t t = 0; t < 2; ++t) {
    Lanes& own = column_states[tile + t];
    __m256i column_best = load(own.best), column_second = load(own.second);
    const __m256i term = load(&columns.term[(tile + t) * kLanes]);
    const __m256i indexed = load(&columns.term_with_index[(tile + t) * kLanes]);
#pragma clang loop unroll(full)
    for (size_t r = 0; r < kGroup; ++r) {
      const __m256i doubled = _mm256_slli_epi32(sums[r][t], kIndexBits + 1);
      Lanes& lanes = row_states[row + r];
      __m256i best = load(lanes.best), second = load(lanes.second);
      keep(best, second,
           _mm256_add_epi32(_mm256_sub_epi32(indexed, doubled),
                            _mm256_set1_epi32(static_cast<int>(rows.term[row + r]))));
      store(lanes.best, best);
      store(lanes.second, second);
      keep(column_best, column_second,
           _mm256_add_epi32(_mm256_sub_epi32(term, doubled),
                            _mm256_set1_epi32(static_cast<int>(rows.term_with_index[row + r]))));
    }
    store(own.best, column_best);
    store(own.second, column_second);
  }
}

CK_AVX2 void scan(const Panel& rows, const Panel& columns, std::vector<Lanes>& row_states,
                  std::vector<Lanes>& column_states) {
  const size_t row_count = rows.term.size();
  for (size_t chunk = 0; chunk < row_count; chunk += kChunk) {
    const size_t end = std::min(row_count, chunk + kChunk);
    for (size_t tile = 0; tile < column_states.size(); tile += 2) {
      for (size_t row = chunk; row < end; row += kGroup) {
        group_against_tiles(rows, row, columns, tile, row_states.data(), column_states.data());
      }
    }
  }
}

}  // namespace

CK_AVX2 uint32_t squared_distance_avx2(const uint8_t* a, const uint8_t* b) {
  __m256i sum = _mm256_setzero_si256();
#pragma clang loop unroll(full)
  for (size_t k = 0; k < kDescriptorLength; k += 16) {
    const auto widened = [k](const uint8_t* d) __attribute__((target("avx2"))) {
      return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(d + k)));
    };
    const __m256i difference = _mm256_sub_epi16(widened(a), widened(b));
    sum = _mm256_add_epi32(sum, _mm256_madd_epi16(difference, difference));
  }
  const __m128i four = _mm_add_epi32(_mm256_castsi256_si128(sum), _mm256_extracti128_si256(sum, 1));
  const __m128i two = _mm_add_epi32(four, _mm_shuffle_epi32(four, 0x4e));
  return static_cast<uint32_t>(_mm_cvtsi128_si32(_mm_add_epi32(two, _mm_shuffle_epi32(two, 0xb1))));
}

void nearest_avx2(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column) {
  const Panel rows =
      pack(block.rows + block.row_begin * kDescriptorLength, block.row_count(),
           rounded_up(block.row_count(), kGroup), kFar - 1 - block.column_norm, kGroup, 1);
  const Panel columns =
      pack(block.columns + block.column_begin * kDescriptorLength, block.column_count(),
           rounded_up(block.column_count(), 2 * kLanes), kFar - 1 - block.row_norm, kLanes, kLanes);
  auto row_states = empty_states<kLanes>(rows.term.size());
  auto column_states = empty_states<kLanes>(columns.term.size() / kLanes);
  scan(rows, columns, row_states, column_states);
  offer_states(block, row_states, column_states, by_row, by_column);
}

}  // namespace ck

#else

namespace ck {
uint32_t squared_distance_avx2(const uint8_t* a, const uint8_t* b) {
  return squared_distance(a, b);
}
void nearest_avx2(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column) {
  nearest_portable(block, by_row, by_column);
}
}  // namespace ck

#endif
