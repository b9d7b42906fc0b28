#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>
#include <vector>

#include "ck_masks.h"
#include "core/guard.h"

namespace {

/// Weights are integers in units of the inverse: the flow is then exact, in any order. Chosen: fine
/// enough for log-odds.
constexpr double kUnit = 4096;

/// Number of pixels below which the numbers of nodes and edges are in range. Limit: they are 32-bit
/// integers, and a pixel has up to eight edges.
constexpr int64_t kMaximumPixels = int64_t{1} << 26;

/// Offsets of half of the eight neighbors, so that each edge is visited once.
constexpr std::array<std::array<int, 2>, 4> kNeighbors = {{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

/// Divides an image by a minimum cut. Only uncertain pixels are nodes of the graph; certain ones
/// contribute their edges as weights of the terminals.
class ImageCut {
 public:
  ImageCut(const ck_pixels& image, const float* log_odds, const ck_cut_options& options)
      : image_(image), log_odds_(log_odds), options_(options) {
    contrast_ = mean_contrast();
  }

  void run(const ck_control* control, const ck_mutable_pixels& mask) {
    add_nodes();
    ck::step(control, 0.1);
    add_edges();
    ck::step(control, 0.3);
    graph_.maxFlow();
    ck::step(control, 0.9);
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const bool is_object = nodes_[i] < 0 ? log_odds_[i] > 0 : graph_.inSourceSegment(nodes_[i]);
      mask.data[i] = is_object ? 255 : 0;
    }
  }

 private:
  bool is_certain(size_t index) const {
    return !(std::fabs(log_odds_[index]) < options_.certainty);
  }

  void add_nodes() {
    const size_t count = static_cast<size_t>(image_.width) * image_.height;
    nodes_.assign(count, -1);
    size_t uncertain = 0;
    for (size_t i = 0; i < count; ++i) uncertain += !is_certain(i);
    graph_.create(static_cast<unsigned>(uncertain + 2), static_cast<unsigned>(8 * uncertain + 2));
    for (size_t i = 0; i < count; ++i) {
      if (is_certain(i)) continue;
      nodes_[i] = graph_.addVtx();
      add_terminal(nodes_[i], log_odds_[i] > 0, std::fabs(log_odds_[i]));
    }
    // The solver requires an edge.
    const int first = graph_.addVtx();
    graph_.addEdges(first, graph_.addVtx(), 0, 0);
  }

  void add_terminal(int node, bool is_object, double weight) {
    const int64_t value = std::lround(kUnit * weight);
    graph_.addTermWeights(node, is_object ? value : 0, is_object ? 0 : value);
  }

  void add_edges() {
    for_each_edge([&](size_t a, size_t b, double squared, double length) {
      if (nodes_[a] < 0 && nodes_[b] < 0) return;
      const double weight =
          options_.smoothness / length * std::exp(-squared / (2 * contrast_ + 1e-6));
      if (nodes_[a] >= 0 && nodes_[b] >= 0) {
        const int64_t value = std::lround(kUnit * weight);
        graph_.addEdges(nodes_[a], nodes_[b], value, value);
      } else {
        const size_t certain = nodes_[a] < 0 ? a : b;
        add_terminal(nodes_[certain == a ? b : a], log_odds_[certain] > 0, weight);
      }
    });
  }

  /// The mean squared difference of adjacent pixels.
  double mean_contrast() const {
    double sum = 0;
    size_t count = 0;
    for_each_edge([&](size_t, size_t, double squared, double) {
      sum += squared;
      ++count;
    });
    return sum / std::max<size_t>(1, count);
  }

  /// Calls `body(a, b, squared difference of color, distance)` for every two adjacent pixels.
  template <typename Body>
  void for_each_edge(Body&& body) const {
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        for (const auto& [dx, dy] : kNeighbors) {
          const int u = x + dx, v = y + dy;
          if (u < 0 || u >= image_.width || v >= image_.height) continue;
          body(static_cast<size_t>(y) * image_.width + x, static_cast<size_t>(v) * image_.width + u,
               squared_difference(x, y, u, v), dx != 0 && dy != 0 ? M_SQRT2 : 1);
        }
      }
    }
  }

  double squared_difference(int x, int y, int u, int v) const {
    const uint8_t* a = image_.data + static_cast<size_t>(y) * image_.row_stride + 3 * x;
    const uint8_t* b = image_.data + static_cast<size_t>(v) * image_.row_stride + 3 * u;
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
  }

  const ck_pixels& image_;
  const float* log_odds_;
  const ck_cut_options& options_;
  double contrast_ = 0;
  /// The node of each pixel, −1 if it is certain.
  std::vector<int> nodes_;
  /// With 64 bits: the flow is the sum of the weights of all cut edges, which exceeds 32 bits for
  /// large images.
  cv::detail::GCGraph<int64_t> graph_;
};

}  // namespace

ck_status ck_cut_image(const ck_pixels* image, const float* log_odds, const ck_cut_options* options,
                       const ck_control* control, const ck_mutable_pixels* mask) {
  return ck::guarded([&] {
    ck::require(image && image->data && log_odds && options && mask && mask->data, "null pointer");
    ck::require(image->channels == 3 && mask->channels == 1 && image->width == mask->width &&
                    image->height == mask->height && image->width > 0 && image->height > 0,
                "an RGB image and a gray mask of the same size are needed");
    ck::require(static_cast<int64_t>(image->width) * image->height < kMaximumPixels,
                "the image is too large");
    ck::require(options->smoothness >= 0 && options->smoothness < 1000 && options->certainty > 0 &&
                    options->certainty < 1000,
                "an option is out of range");
    ImageCut(*image, log_odds, *options).run(control, *mask);
  });
}
