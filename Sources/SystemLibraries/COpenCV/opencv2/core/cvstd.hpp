#include <opencv4/opencv2/core/cvstd.hpp>
