#include <opencv4/opencv2/core/utils/logger.hpp>
