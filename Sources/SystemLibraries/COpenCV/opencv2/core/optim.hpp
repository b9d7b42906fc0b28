#include <opencv4/opencv2/core/optim.hpp>
