#include "features/nearest.h"

#include <algorithm>

#include "core/instructions.h"

namespace ck {
namespace {

// Limit: a packed key has the index of a row, or that of a tile of eight columns.
constexpr size_t kBlockRows = 1u << kIndexBits;
constexpr size_t kBlockColumns = 1u << (kIndexBits + 3);

uint32_t largest_norm(const uint8_t* descriptors, size_t count) {
  uint32_t largest = 0;
  for (size_t i = 0; i < count; ++i) {
    largest = std::max(largest, squared_norm(descriptors + i * kDescriptorLength));
  }
  return largest;
}

using Scan = void (*)(const DistanceBlock& block, NearestTwo* by_row, NearestTwo* by_column);

Scan scan_with(ck_instructions instructions) {
  switch (instructions) {
    case ck_instructions_avx512_vnni:
      return nearest_avx512_vnni;
    case ck_instructions_avx512:
    case ck_instructions_avx2:
      return nearest_avx2;
    default:
      return nearest_portable;
  }
}

}  // namespace

NearestTable nearest_two(const uint8_t* rows, size_t row_count, const uint8_t* columns,
                         size_t column_count, ck_instructions requested,
                         const ck_control* control) {
  NearestTable table{std::vector<NearestTwo>(row_count), std::vector<NearestTwo>(column_count)};
  const uint32_t row_norm = largest_norm(rows, row_count);
  const uint32_t column_norm = largest_norm(columns, column_count);
  const Scan scan = scan_with(chosen_instructions(requested));
  // Packed keys hold distances of unit-length descriptors (norm 512); others use the portable code.
  const bool is_packable = row_norm + column_norm < kFar;
  for (size_t i = 0; i < row_count; i += kBlockRows) {
    step(control, static_cast<double>(i) / static_cast<double>(row_count));
    for (size_t j = 0; j < column_count; j += kBlockColumns) {
      const DistanceBlock block{rows,     i,          std::min(row_count, i + kBlockRows),
                                columns,  j,          std::min(column_count, j + kBlockColumns),
                                row_norm, column_norm};
      const bool is_plain = !is_packable || block.row_count() < 2 || block.column_count() < 2;
      (is_plain ? nearest_portable : scan)(block, table.by_row.data(), table.by_column.data());
    }
  }
  return table;
}

}  // namespace ck
