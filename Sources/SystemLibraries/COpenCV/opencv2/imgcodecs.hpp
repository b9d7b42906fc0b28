#include <opencv4/opencv2/imgcodecs.hpp>
