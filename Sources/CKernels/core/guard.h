#pragma once

#include <exception>
#include <stdexcept>

#include "ck_core.h"

namespace ck {

/// Thrown by `step` when the caller cancels.
struct Canceled {};

/// Thrown when valid input does not determine a result.
struct Degenerate : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown by what needs a library that this program was built without; the message is its name.
struct LeftOut : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Stores the message that `ck_last_error` returns on this thread, up to a fixed length: an error
/// must be reported even if no memory is left.
void set_last_error(const char* message) noexcept;

/// Whether an exception of the standard library or of OpenCV reports a failed allocation.
bool is_out_of_memory(const std::exception& error);

/// Reports progress; throws `Canceled` when the caller cancels.
inline void step(const ck_control* control, double fraction) {
  if (control && control->should_continue &&
      !control->should_continue(control->context, fraction)) {
    throw Canceled{};
  }
}

/// The number of threads of a control, at least 1.
inline int thread_count(const ck_control* control) {
  return control && control->threads > 0 ? control->threads : 1;
}

/// Throws `std::invalid_argument` unless the condition holds.
inline void require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

/// Runs a kernel body and converts exceptions to a status; no exception leaves it.
template <typename Body>
ck_status guarded(Body&& body) noexcept {
  try {
    body();
    return ck_ok;
  } catch (const Canceled&) {
    set_last_error("canceled");
    return ck_canceled;
  } catch (const std::invalid_argument& e) {
    set_last_error(e.what());
    return ck_invalid_argument;
  } catch (const Degenerate& e) {
    set_last_error(e.what());
    return ck_degenerate;
  } catch (const LeftOut& e) {
    set_last_error(e.what());
    return ck_left_out;
  } catch (const std::exception& e) {
    set_last_error(e.what());
    return is_out_of_memory(e) ? ck_out_of_memory : ck_failed;
  } catch (...) {
    set_last_error("unknown exception");
    return ck_failed;
  }
}

}  // namespace ck
