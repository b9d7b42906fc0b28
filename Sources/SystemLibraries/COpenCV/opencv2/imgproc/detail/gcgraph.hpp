#include <opencv4/opencv2/imgproc/detail/gcgraph.hpp>
