#include <opencv4/opencv2/core/traits.hpp>
