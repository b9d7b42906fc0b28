#include "features/selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ck {
namespace {

/// Indices by descending response, ties by index.
std::vector<size_t> by_response(const std::vector<Candidate>& candidates) {
  std::vector<size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if (candidates[a].response != candidates[b].response) {
      return candidates[a].response > candidates[b].response;
    }
    return a < b;
  });
  return order;
}

/// Removes features below the threshold, which is lowered until enough are left.
void apply_threshold(std::vector<size_t>& order, const std::vector<Candidate>& candidates,
                     const Selection& selection) {
  size_t count = selection.sufficient;
  while (count < order.size() && candidates[order[count]].response >= selection.high_threshold) {
    ++count;
  }
  order.resize(std::min(order.size(), count));
}

/// The rank of each element of `order` within its cell.
std::vector<size_t> ranks_in_cells(const std::vector<size_t>& order,
                                   const std::vector<Candidate>& candidates, int width, int height,
                                   int cells) {
  const float side = std::max(1.0f, static_cast<float>(std::max(width, height)) / cells);
  const int columns = static_cast<int>(std::ceil(width / side));
  const int rows = static_cast<int>(std::ceil(height / side));
  std::vector<size_t> population(static_cast<size_t>(columns) * rows, 0);
  std::vector<size_t> ranks;
  ranks.reserve(order.size());
  for (size_t index : order) {
    const int column = std::clamp(static_cast<int>(candidates[index].x / side), 0, columns - 1);
    const int row = std::clamp(static_cast<int>(candidates[index].y / side), 0, rows - 1);
    ranks.push_back(population[static_cast<size_t>(row) * columns + column]++);
  }
  return ranks;
}

}  // namespace

std::vector<size_t> select_features(const std::vector<Candidate>& candidates, int width, int height,
                                    const Selection& selection) {
  std::vector<size_t> order = by_response(candidates);
  apply_threshold(order, candidates, selection);
  if (order.size() > selection.maximum) {
    const auto ranks = ranks_in_cells(order, candidates, width, height, selection.cells);
    std::vector<size_t> places(order.size());
    std::iota(places.begin(), places.end(), size_t{0});
    // Within a rank the order by response is kept.
    std::sort(places.begin(), places.end(), [&](size_t a, size_t b) {
      return ranks[a] != ranks[b] ? ranks[a] < ranks[b] : a < b;
    });
    std::vector<size_t> kept;
    for (size_t i = 0; i < selection.maximum; ++i) kept.push_back(order[places[i]]);
    order = std::move(kept);
  }
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace ck
