#include "core/guard.h"

namespace ck {
namespace {
thread_local std::string last_error;
}

void set_last_error(const std::string& message) { last_error = message; }

}  // namespace ck

const char* ck_last_error(void) { return ck::last_error.c_str(); }
