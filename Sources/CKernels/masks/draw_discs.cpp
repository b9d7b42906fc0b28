#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ck_masks.h"
#include "core/guard.h"
#include "core/span.h"
#include "geometry/camera_model.h"

namespace {

/// An image of labels with the depth of each.
class LabelBuffer {
 public:
  explicit LabelBuffer(const ck_mutable_pixels& labels)
      : labels_(labels),
        depths_(static_cast<size_t>(labels.width) * labels.height,
                std::numeric_limits<float>::infinity()) {
    std::fill_n(labels.data, depths_.size(), uint8_t{0});
  }

  /// Draws a disc around a position in pixels.
  void draw(const ck::Vector2& center, double radius, float depth, uint8_t label) {
    const int top = first(center.y() - radius), left = first(center.x() - radius);
    const int bottom = last(center.y() + radius, labels_.height);
    const int right = last(center.x() + radius, labels_.width);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const double dx = x + 0.5 - center.x(), dy = y + 0.5 - center.y();
        const size_t index = static_cast<size_t>(y) * labels_.width + x;
        if (dx * dx + dy * dy > radius * radius || depth >= depths_[index]) continue;
        depths_[index] = depth;
        labels_.data[index] = label;
      }
    }
  }

 private:
  /// The first and the last pixel whose center lies within a bound.
  static int first(double bound) { return std::max(0, static_cast<int>(std::ceil(bound - 0.5))); }
  static int last(double bound, int size) {
    return std::min(size - 1, static_cast<int>(std::floor(bound - 0.5)));
  }

  const ck_mutable_pixels& labels_;
  std::vector<float> depths_;
};

/// Smallest radius of a disc, in pixels. Limit: half the diagonal of a pixel, so that it covers at
/// least one pixel center.
constexpr double kMinimumRadius = 0.7072;
/// Margin around the frame, in frames: distortion is not monotonic far outside of it. Chosen.
constexpr double kMargin = 0.5;

}  // namespace

ck_status ck_draw_discs(const ck_discs* discs, const ck_camera* camera, const ck_pose* pose,
                        const ck_control* control, const ck_mutable_pixels* labels) {
  return ck::guarded([&] {
    ck::require(discs && camera && pose && labels && labels->data, "null pointer");
    ck::require(labels->channels == 1 && labels->width == camera->width &&
                    labels->height == camera->height && labels->width > 0 && labels->height > 0,
                "the labels must be gray and have the size of the camera");
    const ck::Strided<float> points(discs->positions);
    ck::require(points.count == 0 || (discs->radii && discs->labels), "null pointer");
    LabelBuffer buffer(*labels);
    const ck::Pose cameraFromWorld = ck::pose_from(*pose);
    const double focal = std::max(camera->fx, camera->fy);
    const double margin_x = kMargin * camera->width, margin_y = kMargin * camera->height;
    for (size_t i = 0; i < points.count; ++i) {
      if (i % 65536 == 0) ck::step(control, static_cast<double>(i) / points.count);
      if (!points.is_finite(i)) continue;
      const float* p = points[i];
      const ck::Vector3 point = cameraFromWorld * ck::Vector3(p[0], p[1], p[2]);
      if (!(point.z() > ck::kMinimumDepth)) continue;
      const ck::Vector2 ideal(camera->fx * point.x() / point.z() + camera->cx,
                              camera->fy * point.y() / point.z() + camera->cy);
      if (ideal.x() < -margin_x || ideal.y() < -margin_y || ideal.x() > camera->width + margin_x ||
          ideal.y() > camera->height + margin_y) {
        continue;
      }
      const double radius = std::max(kMinimumRadius, focal * discs->radii[i] / point.z());
      // A disc larger than the frame belongs to a point next to the camera: an outlier.
      if (!(radius < std::max(camera->width, camera->height))) continue;
      buffer.draw(ck::project(*camera, point), radius, static_cast<float>(point.z()),
                  discs->labels[i]);
    }
  });
}

ck_status ck_count_mask_hits(ck_span points, const ck_camera* camera, const ck_pose* pose,
                             const ck_pixels* mask, uint16_t* seen, uint16_t* inside) {
  return ck::guarded([&] {
    ck::require(camera && pose && mask && mask->data, "null pointer");
    ck::require(
        mask->channels == 1 && mask->width == camera->width && mask->height == camera->height,
        "the mask must be gray and have the size of the camera");
    const ck::Strided<float> p(points);
    ck::require(p.count == 0 || (seen && inside), "null pointer");
    const ck::Pose cameraFromWorld = ck::pose_from(*pose);
    for (size_t i = 0; i < p.count; ++i) {
      const ck::Vector3 point = cameraFromWorld * ck::Vector3(p[i][0], p[i][1], p[i][2]);
      if (!(point.z() > ck::kMinimumDepth)) continue;
      const ck::Vector2 pixel = ck::project(*camera, point);
      if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < mask->width &&
            pixel.y() < mask->height)) {
        continue;
      }
      ++seen[i];
      const size_t row = static_cast<size_t>(pixel.y()) * mask->row_stride;
      if (mask->data[row + static_cast<size_t>(pixel.x())] >= 128) ++inside[i];
    }
  });
}
