#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/guard.h"

namespace ck {

/// Calls `body(i)` for every i in 0..<count on the control's threads and reports progress.
///
/// Calls of `body` must not depend on each other's order, so that the result is the same with any
/// number of threads. The first exception stops the rest and is rethrown.
template <typename Body>
void parallel_for(const ck_control* control, size_t count, Body&& body) {
  const size_t threads = std::min<size_t>(static_cast<size_t>(thread_count(control)), count);
  if (threads <= 1) {
    for (size_t i = 0; i < count; ++i) {
      step(control, static_cast<double>(i) / static_cast<double>(count));
      body(i);
    }
    return;
  }
  std::atomic<size_t> next{0};
  std::atomic<bool> stop{false};
  std::exception_ptr error;
  std::mutex mutex;
  auto work = [&] {
    while (!stop.load()) {
      const size_t i = next.fetch_add(1);
      if (i >= count) return;
      try {
        step(control, static_cast<double>(i) / static_cast<double>(count));
        body(i);
      } catch (...) {
        std::lock_guard<std::mutex> lock(mutex);
        if (!error) error = std::current_exception();
        stop.store(true);
      }
    }
  };
  std::vector<std::thread> pool;
  for (size_t t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (auto& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace ck
