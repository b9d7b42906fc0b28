#include "ck_testing.h"

#include <sys/resource.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <opencv2/core/utils/logger.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/parallel.h"

namespace {

/// An exception that owns no memory.
struct Failure : std::exception {
  explicit Failure(const char* message) : message(message) {}
  const char* what() const noexcept override { return message; }
  const char* message;
};

/// All memory that the process can still allocate.
class RemainingMemory {
 public:
  RemainingMemory() {
    const rlimit none = {1, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &none);
    for (size_t size = size_t{1} << 24; size >= sizeof(Block); size /= 2) {
      while (void* memory = std::malloc(size)) last_ = new (memory) Block{last_};
    }
  }
  RemainingMemory(const RemainingMemory&) = delete;
  RemainingMemory& operator=(const RemainingMemory&) = delete;
  ~RemainingMemory() {
    while (last_) std::free(std::exchange(last_, last_->previous));
  }

 private:
  struct Block {
    Block* previous;
  };
  Block* last_ = nullptr;
};

}  // namespace

ck_status ck_test_failure_without_memory(const char* message) {
  const RemainingMemory taken;
  return ck::guarded([&] { throw Failure(message); });
}

ck_status ck_test_parallel_for(size_t count, size_t available_threads, size_t failing,
                               const ck_control* control, int32_t* visits,
                               size_t* created_threads) {
  return ck::guarded([&] {
    *created_threads = 0;
    const auto create = [&](auto& work) {
      if (*created_threads >= available_threads) {
        throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
      }
      ++*created_threads;
      return std::thread(std::ref(work));
    };
    const auto body = [&](size_t i) {
      if (i == failing) throw std::runtime_error("the body failed");
      ++visits[i];
    };
    ck::parallel_for(control, count, body, create);
  });
}

bool ck_test_is_logging(void) {
  using namespace cv::utils::logging;
  return std::cerr.rdbuf() && getLogLevel() != LOG_LEVEL_SILENT;
}
