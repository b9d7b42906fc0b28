#include <opencv4/opencv2/core/vsx_utils.hpp>
