#pragma once

#include <opencv2/core/utility.hpp>

namespace ck {

/// Runs `body` with the OpenCV calls in it on the calling thread.
///
/// Kernels distribute work over threads themselves. OpenCV does not parallelize a region that is
/// nested in another one; this opens an outer region of one unit instead of setting the number of
/// threads, which would hold for the whole process.
template <typename Body>
void on_one_thread(Body&& body) {
  cv::parallel_for_(cv::Range(0, 1), [&](const cv::Range&) { body(); });
}

}  // namespace ck
