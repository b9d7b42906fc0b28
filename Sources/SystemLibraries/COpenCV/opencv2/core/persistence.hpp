#include <opencv4/opencv2/core/persistence.hpp>
