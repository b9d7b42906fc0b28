#include <opencv4/opencv2/core/fast_math.hpp>
