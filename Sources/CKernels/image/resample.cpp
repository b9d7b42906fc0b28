#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ck_image.h"
#include "core/guard.h"

namespace {

cv::Mat wrap(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels) {
  ck::require(width > 0 && height > 0 && channels >= 1 && channels <= 4, "the image has no pixels");
  return cv::Mat(height, width, CV_8UC(channels), const_cast<uint8_t*>(pixels));
}

/// Fills OpenCV's maps of the source pixel of each destination pixel, in rows `first..<last`.
void fill_maps(const ck_camera& from, const ck_camera& to, int first, int last, cv::Mat& map_x,
               cv::Mat& map_y) {
  const double k1 = from.distortion[0], k2 = from.distortion[1];
  const double p1 = from.distortion[2], p2 = from.distortion[3];
  for (int row = first; row < last; ++row) {
    float* to_x = map_x.ptr<float>(row - first);
    float* to_y = map_y.ptr<float>(row - first);
    // Pixel centers are at one half here, but at integers in OpenCV.
    const double y = (row + 0.5 - to.principal_point[1]) / to.focal_length[1];
    for (int column = 0; column < to.width; ++column) {
      const double x = (column + 0.5 - to.principal_point[0]) / to.focal_length[0];
      const double r2 = x * x + y * y;
      const double radial = 1 + r2 * (k1 + r2 * k2);
      const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
      const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
      to_x[column] = static_cast<float>(u * from.focal_length[0] + from.principal_point[0] - 0.5);
      to_y[column] = static_cast<float>(v * from.focal_length[1] + from.principal_point[1] - 0.5);
    }
  }
}

}  // namespace

ck_status ck_image_resize(const uint8_t* source, int32_t width, int32_t height, int32_t channels,
                          uint8_t* destination, int32_t destination_width,
                          int32_t destination_height) {
  return ck::guarded([&] {
    const cv::Mat from = wrap(source, width, height, channels);
    cv::Mat to = wrap(destination, destination_width, destination_height, channels);
    const bool shrinks = destination_width <= width && destination_height <= height;
    cv::resize(from, to, to.size(), 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
  });
}

ck_status ck_image_orient(const uint8_t* source, int32_t width, int32_t height, int32_t channels,
                          int32_t orientation, uint8_t* destination) {
  return ck::guarded([&] {
    ck::require(orientation >= 1 && orientation <= 8, "EXIF orientations are 1 to 8");
    const cv::Mat from = wrap(source, width, height, channels);
    const bool swaps = orientation >= 5;
    cv::Mat to = wrap(destination, swaps ? height : width, swaps ? width : height, channels);
    cv::Mat transposed;
    if (swaps) {
      cv::transpose(from, transposed);
    } else {
      transposed = from;
    }
    // After transposing, orientations 5…8 need these flips: 5 none, 6 columns, 7 both, 8 rows.
    switch (orientation) {
      case 2:
      case 6:
        cv::flip(transposed, to, 1);
        break;
      case 3:
      case 7:
        cv::flip(transposed, to, -1);
        break;
      case 4:
      case 8:
        cv::flip(transposed, to, 0);
        break;
      default:
        transposed.copyTo(to);
    }
  });
}

ck_status ck_image_undistort(const uint8_t* source, const ck_camera* source_camera,
                             int32_t channels, uint8_t* destination,
                             const ck_camera* destination_camera) {
  return ck::guarded([&] {
    const ck_camera& to = *destination_camera;
    ck::require(to.focal_length[0] > 0 && to.focal_length[1] > 0,
                "the focal length must be positive");
    const cv::Mat from = wrap(source, source_camera->width, source_camera->height, channels);
    cv::Mat whole = wrap(destination, to.width, to.height, channels);
    // In bands, so that the maps stay small.
    constexpr int band = 256;
    for (int first = 0; first < to.height; first += band) {
      const int last = std::min(first + band, to.height);
      cv::Mat map_x(last - first, to.width, CV_32F), map_y(last - first, to.width, CV_32F);
      fill_maps(*source_camera, to, first, last, map_x, map_y);
      cv::Mat rows = whole.rowRange(first, last);
      cv::remap(from, rows, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    }
  });
}

ck_status ck_image_dilate(const uint8_t* source, int32_t width, int32_t height, int32_t radius,
                          uint8_t* destination) {
  return ck::guarded([&] {
    ck::require(radius >= 0, "the radius is negative");
    const cv::Mat from = wrap(source, width, height, 1);
    cv::Mat to = wrap(destination, width, height, 1);
    const int side = 2 * radius + 1;
    cv::dilate(from, to, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(side, side)));
  });
}
