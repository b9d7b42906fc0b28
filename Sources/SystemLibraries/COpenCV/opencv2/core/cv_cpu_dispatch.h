#include <opencv4/opencv2/core/cv_cpu_dispatch.h>
