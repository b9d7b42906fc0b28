#include <opencv4/opencv2/core/mat.inl.hpp>
