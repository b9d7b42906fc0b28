#include <opencv4/opencv2/core/saturate.hpp>
