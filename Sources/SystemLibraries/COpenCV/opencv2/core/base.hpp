#include <opencv4/opencv2/core/base.hpp>
