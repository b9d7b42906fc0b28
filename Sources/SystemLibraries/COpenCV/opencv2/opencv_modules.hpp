#include <opencv4/opencv2/opencv_modules.hpp>
