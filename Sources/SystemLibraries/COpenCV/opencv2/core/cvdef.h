#include <opencv4/opencv2/core/cvdef.h>
