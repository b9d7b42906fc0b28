#include "core/guard.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <opencv2/core.hpp>
#include <system_error>

namespace ck {
namespace {
/// Length of a message in bytes. Chosen: the messages of libraries have a few lines.
constexpr size_t kMaximumLength = 2000;

/// Zero-terminated. It has no constructor that could allocate memory.
thread_local std::array<char, kMaximumLength + 1> last_error = {};
}  // namespace

void set_last_error(const char* message) noexcept {
  const size_t length = std::min(std::strlen(message), kMaximumLength);
  std::memcpy(last_error.data(), message, length);
  last_error[length] = 0;
}

bool is_out_of_memory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return true;
  // The stack of a thread could not be allocated.
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again) return true;
  const auto* exception = dynamic_cast<const cv::Exception*>(&error);
  return exception && exception->code == cv::Error::StsNoMem;
}

}  // namespace ck

const char* ck_last_error(void) { return ck::last_error.data(); }
