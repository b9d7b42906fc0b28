#include <algorithm>
#include <vector>

#include "features/nearest.h"

#if defined(__x86_64__)
#include <immintrin.h>

namespace ck {
namespace {

constexpr size_t kLanes = 16;  // Columns per tile. Limit: lanes of a register.
constexpr size_t kGroup = 8;   // Rows processed together. Limit: 32 registers hold the sums.
constexpr size_t kChunk = 64;  // Rows. Chosen: their state fits into the first-level cache.
constexpr size_t kSteps = kDescriptorLength / 4;  // Limit: four bytes per step.

/// Rows as signed bytes; four bytes of eight rows are interleaved. With a signed row a − 128 the
/// dot product instruction yields a·b − 128 Σb; the column's term corrects for it.
struct Rows {
  std::vector<int32_t> words;
  std::vector<uint32_t> term, term_with_index;
};

struct Columns {
  std::vector<uint8_t> bytes;  // four bytes of sixteen columns, interleaved
  std::vector<uint32_t> term, term_with_index;
};

Rows pack_rows(const DistanceBlock& block) {
  const size_t padded = rounded_up(block.row_count(), kGroup);
  // Padding rows are zero (−128 signed) and farther away than any norm.
  const uint32_t far = (kFar - 1 - block.column_norm) << kIndexBits;
  Rows rows{std::vector<int32_t>(padded * kSteps, static_cast<int32_t>(0x80808080)),
            std::vector<uint32_t>(padded, far), std::vector<uint32_t>(padded, far)};
  for (size_t i = 0; i < block.row_count(); ++i) {
    const uint8_t* row = block.rows + (block.row_begin + i) * kDescriptorLength;
    const uint32_t norm = squared_norm(row) << kIndexBits;
    rows.term[i] = norm;
    rows.term_with_index[i] = norm + static_cast<uint32_t>(i);
    for (size_t k = 0; k < kSteps; ++k) {
      uint32_t word = 0;
      for (size_t b = 0; b < 4; ++b) word |= uint32_t{uint8_t(row[4 * k + b] ^ 0x80)} << (8 * b);
      rows.words[(i / kGroup * kSteps + k) * kGroup + i % kGroup] = static_cast<int32_t>(word);
    }
  }
  return rows;
}

Columns pack_columns(const DistanceBlock& block) {
  const size_t padded = rounded_up(block.column_count(), 2 * kLanes);
  const uint32_t far = (kFar - 1 - block.row_norm) << kIndexBits;
  Columns columns{std::vector<uint8_t>(padded * kDescriptorLength),
                  std::vector<uint32_t>(padded, far), std::vector<uint32_t>(padded, far)};
  for (size_t j = 0; j < block.column_count(); ++j) {
    const uint8_t* column = block.columns + (block.column_begin + j) * kDescriptorLength;
    uint32_t sum = 0;
    for (size_t k = 0; k < kDescriptorLength; ++k) {
      sum += column[k];
      columns.bytes[((j / kLanes * kSteps + k / 4) * kLanes + j % kLanes) * 4 + k % 4] = column[k];
    }
    const uint32_t term = (squared_norm(column) - 256 * sum) << kIndexBits;
    columns.term[j] = term;
    columns.term_with_index[j] = term + static_cast<uint32_t>(j / kLanes);
  }
  return columns;
}

using Lanes = LaneState<kLanes>;

#define CK_AVX512 __attribute__((target("avx512f,avx512bw,avx512vl,avx512vnni")))

CK_AVX512 inline void keep(__m512i& best, __m512i& second, __m512i key) {
  second = _mm512_min_epu32(second, _mm512_max_epu32(best, key));
  best = _mm512_min_epu32(best, key);
}

/// Eight rows against two tiles of columns.
CK_AVX512 inline void group_against_tiles(const Rows& rows, size_t row, const Columns& columns,
                                          size_t tile, Lanes* row_states, __m512i state[4]) {
  const int32_t* a = rows.words.data() + row * kSteps;
  const uint8_t* b = columns.bytes.data() + tile * kLanes * kDescriptorLength;
  __m512i sums[kGroup][2];
#pragma clang loop unroll(full)
  for (size_t r = 0; r < kGroup; ++r) sums[r][0] = sums[r][1] = _mm512_setzero_si512();
  for (size_t k = 0; k < kSteps; ++k) {
    const __m512i b0 = _mm512_loadu_si512(b + k * 64);
    const __m512i b1 = _mm512_loadu_si512(b + (kSteps + k) * 64);
#pragma clang loop unroll(full)
    for (size_t r = 0; r < kGroup; ++r) {
      const __m512i word = _mm512_set1_epi32(a[k * kGroup + r]);
      sums[r][0] = _mm512_dpbusd_epi32(sums[r][0], b0, word);
      sums[r][1] = _mm512_dpbusd_epi32(sums[r][1], b1, word);
    }
  }
#pragma clang loop unroll(full)
  for (size_t t = 0; t < 2; ++t) {
    const size_t column = (tile + t) * kLanes;
    const __m512i term = _mm512_loadu_si512(&columns.term[column]);
    const __m512i indexed = _mm512_loadu_si512(&columns.term_with_index[column]);
#pragma clang loop unroll(full)
    for (size_t r = 0; r < kGroup; ++r) {
      const __m512i doubled = _mm512_slli_epi32(sums[r][t], kIndexBits + 1);
      Lanes& lanes = row_states[row + r];
      __m512i best = _mm512_load_si512(lanes.best), second = _mm512_load_si512(lanes.second);
      keep(best, second,
           _mm512_add_epi32(_mm512_sub_epi32(indexed, doubled),
                            _mm512_set1_epi32(static_cast<int>(rows.term[row + r]))));
      _mm512_store_si512(lanes.best, best);
      _mm512_store_si512(lanes.second, second);
      keep(state[2 * t], state[2 * t + 1],
           _mm512_add_epi32(_mm512_sub_epi32(term, doubled),
                            _mm512_set1_epi32(static_cast<int>(rows.term_with_index[row + r]))));
    }
  }
}

CK_AVX512 void scan(const Rows& rows, const Columns& columns, std::vector<Lanes>& row_states,
                    std::vector<Lanes>& column_states) {
  const size_t row_count = rows.term.size(), tile_count = columns.term.size() / kLanes;
  for (size_t chunk = 0; chunk < row_count; chunk += kChunk) {
    const size_t end = std::min(row_count, chunk + kChunk);
    for (size_t tile = 0; tile < tile_count; tile += 2) {
      Lanes* lanes = &column_states[tile];
      __m512i state[4] = {_mm512_load_si512(lanes[0].best), _mm512_load_si512(lanes[0].second),
                          _mm512_load_si512(lanes[1].best), _mm512_load_si512(lanes[1].second)};
      for (size_t row = chunk; row < end; row += kGroup) {
        group_against_tiles(rows, row, columns, tile, row_states.data(), state);
      }
      _mm512_store_si512(lanes[0].best, state[0]);
      _mm512_store_si512(lanes[0].second, state[1]);
      _mm512_store_si512(lanes[1].best, state[2]);
      _mm512_store_si512(lanes[1].second, state[3]);
    }
  }
}

}  // namespace

void nearest_avx512_vnni(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column) {
  const Rows rows = pack_rows(block);
  const Columns columns = pack_columns(block);
  auto row_states = empty_states<kLanes>(rows.term.size());
  auto column_states = empty_states<kLanes>(columns.term.size() / kLanes);
  scan(rows, columns, row_states, column_states);
  offer_states(block, row_states, column_states, by_row, by_column);
}

}  // namespace ck

#else

namespace ck {
void nearest_avx512_vnni(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column) {
  nearest_portable(block, by_row, by_column);
}
}  // namespace ck

#endif
