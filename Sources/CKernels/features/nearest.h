#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ck_features.h"
#include "ck_matching.h"
#include "core/guard.h"

namespace ck {

/// Bytes of a descriptor.
constexpr size_t kDescriptorLength = CK_DESCRIPTOR_LENGTH;
/// Upper bound of squared distances; also the distance to a missing neighbor. Limit: that of two
/// vectors of length 512.
constexpr uint32_t kFar = 1u << 20;
/// Bits of a packed key for the index. Limit: the other 20 of 32 hold the squared distance.
constexpr int kIndexBits = 12;

/// The two nearest neighbors of a descriptor by squared distance; ties go to the lower index.
struct NearestTwo {
  uint32_t distance = kFar;
  uint32_t second = kFar;
  uint32_t index = UINT32_MAX;

  void offer(uint32_t candidate, uint32_t candidate_index) {
    if (candidate < distance || (candidate == distance && candidate_index < index)) {
      second = distance;
      distance = candidate;
      index = candidate_index;
    } else if (candidate < second) {
      second = candidate;
    }
  }
};

/// A rectangular block of the distance matrix of two sets of descriptors.
struct DistanceBlock {
  const uint8_t* rows;
  size_t row_begin, row_end;
  const uint8_t* columns;
  size_t column_begin, column_end;
  /// Largest squared norms of the two sets.
  uint32_t row_norm, column_norm;

  size_t row_count() const { return row_end - row_begin; }
  size_t column_count() const { return column_end - column_begin; }
};

// Each offers every distance of the block to its row and to its column. The vector versions need at
// least two and at most 2^12 rows, at least two and at most 2^15 columns, and largest norms with a
// sum below `kFar`. They pad with rows and columns that are farther than all others.
void nearest_portable(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column);
void nearest_avx2(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column);
void nearest_avx512_vnni(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column);

/// The two nearest neighbors of every descriptor of two sets in the other set.
struct NearestTable {
  std::vector<NearestTwo> by_row, by_column;
};

/// Writes the mutually nearest pairs that pass the ratio test in both directions, the most
/// distinctive first; returns their number. `pairs` has room for as many pairs as the smaller set
/// has descriptors.
size_t write_mutual_matches(const NearestTable& table, double ratio, double maximum_distance,
                            int32_t* pairs);

/// Compares all descriptors of two sets. Throws if the processor does not support the instruction
/// set.
NearestTable nearest_two(const uint8_t* rows, size_t row_count, const uint8_t* columns,
                         size_t column_count, ck_instructions requested, const ck_control* control);

/// The smallest multiple of `step` that is at least `count`.
inline size_t rounded_up(size_t count, size_t step) { return (count + step - 1) / step * step; }

/// Squared distance of two descriptors.
uint32_t squared_distance(const uint8_t* a, const uint8_t* b);
/// The same result with AVX2, which the processor must support.
uint32_t squared_distance_avx2(const uint8_t* a, const uint8_t* b);

/// Squared length of a descriptor.
uint32_t squared_norm(const uint8_t* descriptor);

/// The two smallest keys per lane of a vector.
template <size_t Lanes>
struct alignas(4 * Lanes) LaneState {
  uint32_t best[Lanes], second[Lanes];
};

/// States without keys.
template <size_t Lanes>
std::vector<LaneState<Lanes>> empty_states(size_t count) {
  LaneState<Lanes> empty;
  std::fill_n(empty.best, Lanes, UINT32_MAX);
  std::fill_n(empty.second, Lanes, UINT32_MAX);
  return std::vector<LaneState<Lanes>>(count, empty);
}

/// Offers the packed (distance, index) pairs kept by one lane of a vector.
inline void offer_packed(NearestTwo& nearest, uint32_t best, uint32_t second, uint32_t first_index,
                         uint32_t index_step) {
  if (best != UINT32_MAX) {
    const uint32_t place = best & ((1u << kIndexBits) - 1);
    nearest.offer(best >> kIndexBits, first_index + place * index_step);
  }
  // Its index is irrelevant: it cannot be the nearest, or ties with it and comes later.
  if (second != UINT32_MAX) nearest.offer(second >> kIndexBits, UINT32_MAX);
}

/// Offers the pairs kept by all lanes of a block. Lane l of a row's state has processed the columns
/// l, l + Lanes and so on; lane l of column state i all rows of column i · Lanes + l.
template <size_t Lanes>
void offer_states(const DistanceBlock& block, const std::vector<LaneState<Lanes>>& row_states,
                  const std::vector<LaneState<Lanes>>& column_states, NearestTwo* by_row,
                  NearestTwo* by_column) {
  const auto row_begin = static_cast<uint32_t>(block.row_begin);
  const auto column_begin = static_cast<uint32_t>(block.column_begin);
  for (size_t i = 0; i < block.row_count(); ++i) {
    const LaneState<Lanes>& state = row_states[i];
    for (uint32_t lane = 0; lane < Lanes; ++lane) {
      offer_packed(by_row[row_begin + i], state.best[lane], state.second[lane], column_begin + lane,
                   Lanes);
    }
  }
  for (size_t j = 0; j < block.column_count(); ++j) {
    const LaneState<Lanes>& state = column_states[j / Lanes];
    offer_packed(by_column[column_begin + j], state.best[j % Lanes], state.second[j % Lanes],
                 row_begin, 1);
  }
}

}  // namespace ck
