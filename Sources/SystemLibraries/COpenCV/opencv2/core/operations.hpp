#include <opencv4/opencv2/core/operations.hpp>
