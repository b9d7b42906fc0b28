#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_matching.h"
#include "core/guard.h"
#include "features/nearest.h"

namespace ck {
namespace {

/// Largest number of descriptors per side. Chosen: far more than photos have.
constexpr size_t kMaximumCount = 65536;

/// A match and its ratio of squared distances, best to second best: the lower, the better.
struct Match {
  double quality;
  int32_t first, second;
};

bool more_distinctive(const Match& a, const Match& b) {
  return a.quality != b.quality ? a.quality < b.quality : a.first < b.first;
}

std::vector<Match> mutual_matches(const NearestTable& table, double ratio,
                                  double maximum_distance) {
  const double squared_ratio = ratio * ratio;
  const double squared_maximum = maximum_distance * maximum_distance;
  std::vector<Match> matches;
  for (size_t i = 0; i < table.by_row.size(); ++i) {
    const NearestTwo& row = table.by_row[i];
    if (row.index >= table.by_column.size() || table.by_column[row.index].index != i) continue;
    const double second = std::min(row.second, table.by_column[row.index].second);
    const double distance = row.distance;
    if (distance > squared_maximum || distance >= squared_ratio * second) continue;
    matches.push_back(
        {distance / second, static_cast<int32_t>(i), static_cast<int32_t>(row.index)});
  }
  std::sort(matches.begin(), matches.end(), more_distinctive);
  return matches;
}

}  // namespace

size_t write_mutual_matches(const NearestTable& table, double ratio, double maximum_distance,
                            int32_t* pairs) {
  const std::vector<Match> matches = mutual_matches(table, ratio, maximum_distance);
  for (const Match& match : matches) {
    *pairs++ = match.first;
    *pairs++ = match.second;
  }
  return matches.size();
}

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
    *pair_count = ck::write_mutual_matches(table, options->ratio, options->maximum_distance, pairs);
  });
}
