#include <iostream>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "ck_core.h"

void ck_silence_libraries(void) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  // Kernels manage threads themselves; a second level of threads would break determinism.
  cv::setNumThreads(1);
  // OpenCV's decoders bypass its logger and write to this stream.
  std::cerr.rdbuf(nullptr);
}
