#include <opencv4/opencv2/core/check.hpp>
