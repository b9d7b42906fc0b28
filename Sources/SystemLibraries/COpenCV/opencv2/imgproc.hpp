#include <opencv4/opencv2/imgproc.hpp>
