#include <opencv4/opencv2/core/types.hpp>
