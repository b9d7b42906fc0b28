#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ck_image.h"
#include "core/guard.h"
#include "core/opencv.h"
#include "image/buffers.h"

namespace {

/// A matrix over the memory of an input, which must not be written to.
cv::Mat wrap(const ck_pixels& image) {
  ck::require(image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4,
              "the image has no pixels");
  return cv::Mat(image.height, image.width, CV_8UC(image.channels),
                 const_cast<uint8_t*>(image.data), image.row_stride);
}

/// A matrix over the memory of an output. It has the size that OpenCV writes, so that OpenCV does
/// not allocate another one.
cv::Mat wrap(const ck_mutable_pixels& image) {
  const size_t row_stride = static_cast<size_t>(image.width) * image.channels;
  return wrap({image.data, image.width, image.height, image.channels, row_stride});
}

/// Fills OpenCV's maps of the source pixel of each destination pixel, in rows `first..<last`.
void fill_maps(const ck_camera& from, const ck_camera& to, int first, int last, cv::Mat& map_x,
               cv::Mat& map_y) {
  const double k1 = from.k1, k2 = from.k2, p1 = from.p1, p2 = from.p2;
  for (int row = first; row < last; ++row) {
    float* to_x = map_x.ptr<float>(row - first);
    float* to_y = map_y.ptr<float>(row - first);
    // Pixel centers are at one half here, but at integers in OpenCV.
    const double y = (row + 0.5 - to.cy) / to.fy;
    for (int column = 0; column < to.width; ++column) {
      const double x = (column + 0.5 - to.cx) / to.fx;
      const double r2 = x * x + y * y;
      const double radial = 1 + r2 * (k1 + r2 * k2);
      const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
      const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
      to_x[column] = static_cast<float>(u * from.fx + from.cx - 0.5);
      to_y[column] = static_cast<float>(v * from.fy + from.cy - 0.5);
    }
  }
}

}  // namespace

namespace ck {

void turn_upright(const ck_pixels& source, int32_t orientation,
                  const ck_mutable_pixels& destination) {
  require(orientation >= 1 && orientation <= 8, "EXIF orientations are 1 to 8");
  const cv::Mat from = wrap(source);
  const bool swaps = orientation >= 5;
  require(destination.width == (swaps ? source.height : source.width) &&
              destination.height == (swaps ? source.width : source.height) &&
              destination.channels == source.channels,
          "the destination does not have the size of the rotated image");
  cv::Mat to = wrap(destination);
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
}

}  // namespace ck

ck_status ck_image_resize(const ck_pixels* source, const ck_mutable_pixels* destination) {
  return ck::guarded([&] {
    ck::require(source->channels == destination->channels, "the numbers of channels differ");
    const cv::Mat from = wrap(*source);
    cv::Mat to = wrap(*destination);
    const bool shrinks =
        destination->width <= source->width && destination->height <= source->height;
    ck::on_one_thread([&] {
      cv::resize(from, to, to.size(), 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    });
  });
}

ck_status ck_image_orient(const ck_pixels* source, int32_t orientation,
                          const ck_mutable_pixels* destination) {
  return ck::guarded([&] { ck::turn_upright(*source, orientation, *destination); });
}

ck_status ck_image_undistort(const ck_pixels* source, const ck_camera* source_camera,
                             const ck_camera* destination_camera,
                             const ck_mutable_pixels* destination) {
  return ck::guarded([&] {
    const ck_camera& to = *destination_camera;
    ck::require(to.fx > 0 && to.fy > 0, "the focal length must be positive");
    ck::require(source->width == source_camera->width && source->height == source_camera->height &&
                    destination->width == to.width && destination->height == to.height &&
                    source->channels == destination->channels,
                "an image does not have the size of its camera");
    const cv::Mat from = wrap(*source);
    cv::Mat whole = wrap(*destination);
    // Rows of a band. Chosen: the maps stay small.
    constexpr int kBand = 256;
    for (int first = 0; first < to.height; first += kBand) {
      const int last = std::min(first + kBand, to.height);
      cv::Mat map_x(last - first, to.width, CV_32F), map_y(last - first, to.width, CV_32F);
      fill_maps(*source_camera, to, first, last, map_x, map_y);
      cv::Mat rows = whole.rowRange(first, last);
      ck::on_one_thread(
          [&] { cv::remap(from, rows, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE); });
    }
  });
}

ck_status ck_image_dilate(const ck_pixels* source, int32_t radius,
                          const ck_mutable_pixels* destination) {
  return ck::guarded([&] {
    ck::require(radius >= 0, "the radius is negative");
    ck::require(source->channels == 1 && destination->channels == 1 &&
                    source->width == destination->width && source->height == destination->height,
                "gray images of one size are needed");
    const cv::Mat from = wrap(*source);
    cv::Mat to = wrap(*destination);
    const int side = 2 * radius + 1;
    ck::on_one_thread([&] {
      cv::dilate(from, to, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(side, side)));
    });
  });
}
