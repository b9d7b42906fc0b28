#include <opencv4/opencv2/core/neon_utils.hpp>
