#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/guard.h"

namespace ck {

/// Threads that are joined at the end of their scope, even if an exception ends it.
class ThreadGroup {
 public:
  ThreadGroup() = default;
  ThreadGroup(const ThreadGroup&) = delete;
  ThreadGroup& operator=(const ThreadGroup&) = delete;
  ~ThreadGroup() {
    for (std::thread& thread : threads_) thread.join();
  }

  /// Starts at most `count` threads, each made by `create()`; fewer if the system refuses more,
  /// which is not an error.
  template <typename Create>
  void start(size_t count, Create&& create) noexcept {
    try {
      threads_.reserve(count);
      for (size_t i = 0; i < count; ++i) threads_.push_back(create());
    } catch (const std::exception&) {
      // std::system_error or std::bad_alloc: the threads that exist do the work.
    }
  }

 private:
  std::vector<std::thread> threads_;
};

/// Creates a thread that runs `work`.
struct StandardThreads {
  template <typename Work>
  std::thread operator()(Work& work) const {
    return std::thread(std::ref(work));
  }
};

/// The number of times that a long loop reports progress and looks for cancellation: both take a
/// lock of the caller, which costs more than a short iteration. Chosen.
constexpr size_t kReports = 128;

/// Calls `body(i)` for every i in 0..<count on the control's threads and reports progress.
///
/// The calling thread takes part; if the system refuses to create more threads, those that exist do
/// the work. Calls of `body` must not depend on each other's order, so that the result is the same
/// with any number of threads. The first exception stops the rest and is rethrown. `create(work)`
/// creates a thread that runs `work`.
template <typename Body, typename Create = StandardThreads>
void parallel_for(const ck_control* control, size_t count, Body&& body,
                  const Create& create = Create()) {
  const size_t threads = std::min<size_t>(static_cast<size_t>(thread_count(control)), count);
  const size_t stride = std::max<size_t>(1, count / kReports);
  const auto run = [&](size_t i) {
    if (i % stride == 0) step(control, static_cast<double>(i) / static_cast<double>(count));
    body(i);
  };
  if (threads <= 1) {
    for (size_t i = 0; i < count; ++i) run(i);
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
        run(i);
      } catch (...) {
        std::lock_guard<std::mutex> lock(mutex);
        if (!error) error = std::current_exception();
        stop.store(true);
      }
    }
  };
  {
    ThreadGroup group;
    group.start(threads - 1, [&] { return create(work); });
    work();
  }
  if (error) std::rethrow_exception(error);
}

/// Calls `body(i)` for every i in 0..<count like `parallel_for`, in units of `block` consecutive
/// numbers, so that the cost of distributing work and reporting progress is negligible.
template <typename Body>
void parallel_for_blocks(const ck_control* control, size_t count, size_t block, Body&& body) {
  parallel_for(control, (count + block - 1) / block, [&](size_t b) {
    const size_t end = std::min(count, (b + 1) * block);
    for (size_t i = b * block; i < end; ++i) body(i);
  });
}

}  // namespace ck
