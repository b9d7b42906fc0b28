#include <opencv4/opencv2/core/cvstd_wrapper.hpp>
