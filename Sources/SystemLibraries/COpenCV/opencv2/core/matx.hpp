#include <opencv4/opencv2/core/matx.hpp>
