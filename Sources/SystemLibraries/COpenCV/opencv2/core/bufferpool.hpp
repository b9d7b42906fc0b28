#include <opencv4/opencv2/core/bufferpool.hpp>
