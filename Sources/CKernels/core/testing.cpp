#include "ck_testing.h"

#include <glog/logging.h>

#include <iostream>
#include <opencv2/core/utils/logger.hpp>
#include <stdexcept>
#include <system_error>

#include "core/parallel.h"

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
  return std::cerr.rdbuf() && FLAGS_minloglevel < google::GLOG_FATAL &&
         getLogLevel() != LOG_LEVEL_SILENT;
}
