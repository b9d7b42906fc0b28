#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_matching.h"
#include "core/guard.h"
#include "features/nearest.h"

namespace ck {
namespace {

constexpr size_t kMaximumCount = 65536;
constexpr size_t kBlockRows = 1u << kIndexBits;
constexpr size_t kBlockColumns = 1u << (kIndexBits + 3);

bool supported(ck_simd_path path) {
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
  if (supported(ck_simd_avx512_vnni)) return ck_simd_avx512_vnni;
  return supported(ck_simd_avx2) ? ck_simd_avx2 : ck_simd_portable;
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

struct Match {
  double quality;
  int32_t first, second;
};

bool more_distinctive(const Match& a, const Match& b) {
  return a.quality != b.quality ? a.quality < b.quality : a.first < b.first;
}

std::vector<Match> mutual_matches(const std::vector<NearestTwo>& by_row,
                                  const std::vector<NearestTwo>& by_column,
                                  const ck_match_options& options) {
  const double squared_ratio = options.ratio * options.ratio;
  const double squared_maximum = options.maximum_distance * options.maximum_distance;
  std::vector<Match> matches;
  for (size_t i = 0; i < by_row.size(); ++i) {
    const NearestTwo& row = by_row[i];
    if (row.index >= by_column.size() || by_column[row.index].index != i) continue;
    const double second = std::min(row.second, by_column[row.index].second);
    const double distance = row.distance;
    if (distance > squared_maximum || distance >= squared_ratio * second) continue;
    matches.push_back(
        {distance / second, static_cast<int32_t>(i), static_cast<int32_t>(row.index)});
  }
  std::sort(matches.begin(), matches.end(), more_distinctive);
  return matches;
}

}  // namespace
}  // namespace ck

bool ck_simd_supported(ck_simd_path path) { return ck::supported(path); }

ck_status ck_match_descriptors(const uint8_t* first, size_t first_count, const uint8_t* second,
                               size_t second_count, const ck_match_options* options,
                               const ck_control* control, int32_t* pairs, size_t* pair_count) {
  return ck::guarded([&] {
    ck::require(options && pair_count, "options and pair_count are needed");
    *pair_count = 0;
    ck::require(first_count <= ck::kMaximumCount && second_count <= ck::kMaximumCount,
                "there are more than 65,536 descriptors");
    ck::require(ck::supported(options->path), "this processor lacks the instructions asked for");
    const uint32_t first_norm = ck::largest_norm(first, first_count);
    const uint32_t second_norm = ck::largest_norm(second, second_count);
    const ck_simd_path path = ck::chosen_path(first_norm, second_norm, options->path);
    std::vector<ck::NearestTwo> by_row(first_count), by_column(second_count);
    for (size_t i = 0; i < first_count; i += ck::kBlockRows) {
      ck::step(control, static_cast<double>(i) / static_cast<double>(first_count));
      for (size_t j = 0; j < second_count; j += ck::kBlockColumns) {
        const ck::DistanceBlock block{
            first,      i,          std::min(first_count, i + ck::kBlockRows),
            second,     j,          std::min(second_count, j + ck::kBlockColumns),
            first_norm, second_norm};
        ck::scan_block(block, path, by_row.data(), by_column.data());
      }
    }
    for (const ck::Match& match : ck::mutual_matches(by_row, by_column, *options)) {
      pairs[2 * *pair_count] = match.first;
      pairs[2 * *pair_count + 1] = match.second;
      ++*pair_count;
    }
  });
}
