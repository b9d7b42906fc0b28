#include "core/guard.h"

#include <new>
#include <opencv2/core.hpp>
#include <system_error>

namespace ck {
namespace {
thread_local std::string last_error;
}

void set_last_error(const std::string& message) { last_error = message; }

bool is_out_of_memory(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return true;
  // The stack of a thread could not be allocated.
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again) return true;
  const auto* exception = dynamic_cast<const cv::Exception*>(&error);
  return exception && exception->code == cv::Error::StsNoMem;
}

}  // namespace ck

const char* ck_last_error(void) { return ck::last_error.c_str(); }
