#include <opencv4/opencv2/core/hal/interface.h>
