#include "features/nearest.h"

#include <algorithm>

namespace ck {
namespace {

constexpr size_t kBlockRows = 1u << kIndexBits;
constexpr size_t kBlockColumns = 1u << (kIndexBits + 3);

uint32_t largest_norm(const uint8_t* descriptors, size_t count) {
  uint32_t largest = 0;
  for (size_t i = 0; i < count; ++i) {
    largest = std::max(largest, squared_norm(descriptors + i * kDescriptorLength));
  }
  return largest;
}

ck_simd_path chosen_path(uint32_t first_norm, uint32_t second_norm, ck_simd_path wish) {
  // Packed keys hold distances of unit-length descriptors; others take the plain road.
  if (first_norm + second_norm >= kFar) return ck_simd_portable;
  if (wish != ck_simd_automatic) return wish;
  if (is_supported(ck_simd_avx512_vnni)) return ck_simd_avx512_vnni;
  return is_supported(ck_simd_avx2) ? ck_simd_avx2 : ck_simd_portable;
}

void scan_block(const DistanceBlock& block, ck_simd_path path, NearestTwo* by_row,
                NearestTwo* by_column) {
  if (path == ck_simd_portable || block.row_count() < 2 || block.column_count() < 2) {
    nearest_portable(block, by_row, by_column);
  } else if (path == ck_simd_avx2) {
    nearest_avx2(block, by_row, by_column);
  } else {
    nearest_avx512_vnni(block, by_row, by_column);
  }
}

}  // namespace

bool is_supported(ck_simd_path path) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  switch (path) {
    case ck_simd_avx2:
      return __builtin_cpu_supports("avx2");
    case ck_simd_avx512_vnni:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vnni");
    default:
      return true;
  }
#else
  return path == ck_simd_automatic || path == ck_simd_portable;
#endif
}

NearestTable nearest_two(const uint8_t* rows, size_t row_count, const uint8_t* columns,
                         size_t column_count, ck_simd_path wish, const ck_control* control) {
  NearestTable table{std::vector<NearestTwo>(row_count), std::vector<NearestTwo>(column_count)};
  const uint32_t row_norm = largest_norm(rows, row_count);
  const uint32_t column_norm = largest_norm(columns, column_count);
  const ck_simd_path path = chosen_path(row_norm, column_norm, wish);
  for (size_t i = 0; i < row_count; i += kBlockRows) {
    step(control, static_cast<double>(i) / static_cast<double>(row_count));
    for (size_t j = 0; j < column_count; j += kBlockColumns) {
      const DistanceBlock block{rows,     i,          std::min(row_count, i + kBlockRows),
                                columns,  j,          std::min(column_count, j + kBlockColumns),
                                row_norm, column_norm};
      scan_block(block, path, table.by_row.data(), table.by_column.data());
    }
  }
  return table;
}

}  // namespace ck
