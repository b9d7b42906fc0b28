#include <opencv4/opencv2/core/utility.hpp>
