#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/parallel.h"
#include "core/uninitialized.h"

namespace ck {

/// Sorts elements on the control's threads (sample sort). Equal elements are in any order, which
/// does not depend on the number of threads.
template <typename Element, typename Less>
void parallel_sort(Uninitialized<Element>& elements, const Less& less, const ck_control* control) {
  // Chosen: fewer elements are sorted in a few milliseconds. A unit of work of each pass is one
  // block or one bucket; the samples are so many that buckets differ little in size.
  constexpr size_t kFew = 1 << 15, kBuckets = 64, kSamplesPerBucket = 32, kBlocks = 64;
  if (elements.size() < kFew) return std::sort(elements.begin(), elements.end(), less);
  const ck_control quiet{nullptr, nullptr, thread_count(control)};

  std::vector<Element> splitters;
  const size_t stride = elements.size() / (kBuckets * kSamplesPerBucket);
  for (size_t i = stride / 2; i < elements.size(); i += stride) splitters.push_back(elements[i]);
  std::sort(splitters.begin(), splitters.end(), less);
  for (size_t k = 1; k < kBuckets; ++k) {
    splitters[k - 1] = splitters[k * splitters.size() / kBuckets];
  }
  splitters.resize(kBuckets - 1);
  const auto bucket = [&](const Element& e) {
    return size_t(std::upper_bound(splitters.begin(), splitters.end(), e, less) -
                  splitters.begin());
  };

  std::vector<std::vector<size_t>> places(kBlocks, std::vector<size_t>(kBuckets, 0));
  const auto start = [&](size_t block) { return block * elements.size() / kBlocks; };
  parallel_for(&quiet, kBlocks, [&](size_t block) {
    for (size_t i = start(block); i < start(block + 1); ++i) ++places[block][bucket(elements[i])];
  });
  std::vector<size_t> starts;
  size_t total = 0;
  for (size_t k = 0; k < kBuckets; ++k) {
    starts.push_back(total);
    for (auto& counts : places) {
      const size_t count = counts[k];
      counts[k] = total;
      total += count;
    }
  }
  starts.push_back(total);
  Uninitialized<Element> grouped(elements.size());
  parallel_for(&quiet, kBlocks, [&](size_t block) {
    for (size_t i = start(block); i < start(block + 1); ++i) {
      grouped[places[block][bucket(elements[i])]++] = elements[i];
    }
  });
  parallel_for(&quiet, kBuckets, [&](size_t k) {
    std::sort(grouped.begin() + std::ptrdiff_t(starts[k]),
              grouped.begin() + std::ptrdiff_t(starts[k + 1]), less);
  });
  elements = std::move(grouped);
}

}  // namespace ck
