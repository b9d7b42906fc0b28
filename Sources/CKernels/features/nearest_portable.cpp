#include <algorithm>

#include "features/nearest.h"

namespace ck {

uint32_t squared_distance(const uint8_t* a, const uint8_t* b) {
  int32_t sum = 0;
  for (size_t k = 0; k < kDescriptorLength; ++k) {
    // 16 bits, so that compilers use the multiply-add instruction for pairs.
    const auto difference = static_cast<int16_t>(int16_t{a[k]} - int16_t{b[k]});
    sum += int32_t{difference} * int32_t{difference};
  }
  return static_cast<uint32_t>(sum);
}

uint32_t squared_norm(const uint8_t* descriptor) {
  uint32_t sum = 0;
  for (size_t k = 0; k < kDescriptorLength; ++k) sum += uint32_t{descriptor[k]} * descriptor[k];
  return sum;
}

void nearest_portable(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column) {
  for (size_t i = block.row_begin; i < block.row_end; ++i) {
    const uint8_t* row = block.rows + i * kDescriptorLength;
    for (size_t j = block.column_begin; j < block.column_end; ++j) {
      const uint32_t distance =
          std::min(squared_distance(row, block.columns + j * kDescriptorLength), kFar - 1);
      by_row[i].offer(distance, static_cast<uint32_t>(j));
      by_column[j].offer(distance, static_cast<uint32_t>(i));
    }
  }
}

}  // namespace ck
