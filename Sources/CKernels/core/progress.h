#pragma once

#include "core/guard.h"

namespace ck {

/// A part of the progress of a kernel, for a step of it.
class ProgressPart {
 public:
  /// The step takes the fractions `from` to `to` of `whole`, which must outlive it.
  ProgressPart(const ck_control* whole, double from, double to)
      : whole_(whole), from_(from), to_(to), control_{this, should_continue, thread_count(whole)} {}
  ProgressPart(const ProgressPart&) = delete;
  ProgressPart& operator=(const ProgressPart&) = delete;

  /// Reports to the whole, and is canceled with it.
  const ck_control* control() const { return &control_; }

 private:
  static bool should_continue(void* context, double fraction) {
    const auto* part = static_cast<const ProgressPart*>(context);
    const ck_control* whole = part->whole_;
    return !whole || !whole->should_continue ||
           whole->should_continue(whole->context,
                                  part->from_ + fraction * (part->to_ - part->from_));
  }

  const ck_control* whole_;
  double from_, to_;
  ck_control control_;
};

}  // namespace ck
