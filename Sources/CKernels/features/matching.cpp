#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_matching.h"
#include "core/guard.h"
#include "features/nearest.h"

namespace ck {
namespace {

constexpr size_t kMaximumCount = 65536;

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

ck_status ck_match_descriptors(const uint8_t* first, size_t first_count, const uint8_t* second,
                               size_t second_count, const ck_match_options* options,
                               const ck_control* control, int32_t* pairs, size_t* pair_count) {
  return ck::guarded([&] {
    ck::require(options && pair_count, "options and pair_count are needed");
    *pair_count = 0;
    ck::require(first_count <= ck::kMaximumCount && second_count <= ck::kMaximumCount,
                "there are more than 65,536 descriptors");
    const ck::NearestTable table =
        ck::nearest_two(first, first_count, second, second_count, options->instructions, control);
    for (const ck::Match& match : ck::mutual_matches(table.by_row, table.by_column, *options)) {
      pairs[2 * *pair_count] = match.first;
      pairs[2 * *pair_count + 1] = match.second;
      ++*pair_count;
    }
  });
}
