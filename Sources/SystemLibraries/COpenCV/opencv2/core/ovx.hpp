#include <opencv4/opencv2/core/ovx.hpp>
