#include <algorithm>
#include <cmath>
#include <vector>

#include "ck_features.h"
#include "core/guard.h"
#include "core/span.h"
#include "features/scale_space.h"
#include "features/selection.h"

namespace ck::sift {
namespace {

/// All octaves of a photo and their extrema.
struct ScaleSpace {
  std::vector<Octave> octaves;
  std::vector<Extremum> extrema;
  /// Side of a pixel of the first octave in pixels of the photo.
  float first_pixel = 1;

  float pixel(int octave) const { return first_pixel * std::exp2(static_cast<float>(octave)); }

  /// Position along one axis in the photo, origin at the corner. Each octave takes every second
  /// pixel of the previous one, so the first pixels of all octaves share their center.
  float position(float along, int octave) const {
    return along * pixel(octave) + 0.5f * first_pixel;
  }
};

/// Searches all octaves, from the largest to the smallest.
ScaleSpace searched(const Photo& photo, const ck_sift_options& options, const Kernels& kernels,
                    const ck_control* control) {
  const bool is_doubled = options.first_octave < 0;
  const Search search{options.octave_layers, static_cast<float>(options.sigma),
                      static_cast<float>(255 * options.low_contrast_threshold) /
                          static_cast<float>(options.octave_layers),
                      static_cast<float>(options.edge_threshold)};
  ScaleSpace space;
  space.first_pixel = is_doubled ? 0.5f : 1.0f;
  OctaveInput input;
  input.photo = &photo;
  input.is_doubled = is_doubled;
  input.width = photo.width * (is_doubled ? 2 : 1);
  input.height = photo.height * (is_doubled ? 2 : 1);
  Rows base;
  while (std::min(input.width, input.height) >= kMinimumOctaveSide) {
    step(control, 0.7 * (1 - std::exp2(-2.0 * input.index)));
    Rows next;
    space.octaves.emplace_back();
    kernels.search(input, search, space.octaves.back(), next, space.extrema);
    base = std::move(next);
    input = {nullptr, false, &base, input.width / 2, input.height / 2, input.index + 1};
  }
  return space;
}

/// The strongest extrema, balanced over the photo.
std::vector<Extremum> selected(const ScaleSpace& space, const Photo& photo,
                               const ck_sift_options& options) {
  std::vector<Candidate> candidates;
  candidates.reserve(space.extrema.size());
  const float contrast = static_cast<float>(options.octave_layers) / 255;
  for (const Extremum& e : space.extrema) {
    candidates.push_back(
        {space.position(e.x, e.octave), space.position(e.y, e.octave), e.response * contrast});
  }
  Selection selection;
  selection.maximum = static_cast<size_t>(options.maximum_features);
  selection.sufficient = static_cast<size_t>(options.sufficient_features);
  selection.high_threshold = static_cast<float>(options.high_contrast_threshold);
  selection.cells = options.grid_cells;
  std::vector<Extremum> kept;
  for (size_t index : select_features(candidates, photo.width, photo.height, selection)) {
    kept.push_back(space.extrema[index]);
  }
  return kept;
}

/// A feature with one of the orientations of its extremum.
struct Feature {
  /// In pixels of the photo, and radians.
  float x, y, sigma, orientation;
  Extremum extremum;
};

/// A total order: largest scale first, so that a prefix is a coarse description of the photo.
bool larger_scale_first(const Feature& a, const Feature& b) {
  if (a.sigma != b.sigma) return a.sigma > b.sigma;
  if (a.y != b.y) return a.y < b.y;
  if (a.x != b.x) return a.x < b.x;
  return a.orientation < b.orientation;
}

/// One feature per orientation. If there are too many, each extremum keeps its strongest one, and
/// those with the highest contrast keep the others.
std::vector<Feature> oriented(const ScaleSpace& space, const std::vector<Extremum>& extrema,
                              size_t maximum, const Kernels& kernels) {
  std::vector<Feature> features, others;
  for (const Extremum& e : extrema) {
    float orientations[kMaximumOrientations];
    const int count = kernels.orient(space.octaves[e.octave], e, orientations);
    for (int i = 0; i < count; ++i) {
      (i == 0 ? features : others)
          .push_back({space.position(e.x, e.octave), space.position(e.y, e.octave),
                      e.sigma * space.pixel(e.octave), orientations[i], e});
    }
  }
  const size_t room = maximum - std::min(maximum, features.size());
  if (others.size() > room) {
    std::sort(others.begin(), others.end(), [](const Feature& a, const Feature& b) {
      const float ra = a.extremum.response, rb = b.extremum.response;
      return ra != rb ? ra > rb : larger_scale_first(a, b);
    });
    others.resize(room);
  }
  features.insert(features.end(), others.begin(), others.end());
  std::sort(features.begin(), features.end(), larger_scale_first);
  return features;
}

void write_color(const Photo& photo, float x, float y, uint8_t* color) {
  const int column = std::clamp(static_cast<int>(x), 0, photo.width - 1);
  const int row = std::clamp(static_cast<int>(y), 0, photo.height - 1);
  const uint8_t* pixel =
      photo.pixels + row * photo.stride + static_cast<size_t>(column) * photo.channels;
  for (int c = 0; c < 3; ++c) color[c] = pixel[photo.channels >= 3 ? c : 0];
}

/// Removes duplicates: two refinements may converge to the same extremum.
void remove_repetitions(std::vector<Extremum>& extrema) {
  const auto before = [](const Extremum& a, const Extremum& b) {
    if (a.octave != b.octave) return a.octave < b.octave;
    if (a.y != b.y) return a.y < b.y;
    if (a.x != b.x) return a.x < b.x;
    return a.sigma < b.sigma;
  };
  const auto same = [](const Extremum& a, const Extremum& b) {
    return a.octave == b.octave && a.y == b.y && a.x == b.x && a.sigma == b.sigma;
  };
  std::sort(extrema.begin(), extrema.end(), before);
  extrema.erase(std::unique(extrema.begin(), extrema.end(), same), extrema.end());
}

/// Removes masked extrema before the selection, so that they do not count toward its limit.
void remove_masked(ScaleSpace& space, const Photo& photo, const uint8_t* mask) {
  const auto is_masked = [&](const Extremum& e) {
    const int column = static_cast<int>(space.position(e.x, e.octave));
    const int row = static_cast<int>(space.position(e.y, e.octave));
    return mask[static_cast<size_t>(std::clamp(row, 0, photo.height - 1)) * photo.width +
                std::clamp(column, 0, photo.width - 1)] == 0;
  };
  auto& extrema = space.extrema;
  extrema.erase(std::remove_if(extrema.begin(), extrema.end(), is_masked), extrema.end());
}

/// Largest number of pixels of a photo. Limit: those of an octave, which has up to four times as
/// many, are indexed by 32 bits.
constexpr int64_t kMaximumPixels = 400'000'000;

void validate(const Photo& photo, const ck_sift_options& options) {
  require(photo.width >= 0 && photo.height >= 0, "the size is negative");
  require(photo.channels == 1 || photo.channels == 3 || photo.channels == 4,
          "1, 3 or 4 channels are needed");
  require(photo.stride >= static_cast<size_t>(photo.width) * photo.channels,
          "the row stride is too small");
  require(options.maximum_features >= 0 && options.octave_layers > 0 &&
              options.octave_layers <= 8 && options.grid_cells > 0 && options.sigma >= 0.6 &&
              options.sigma <= 4 && (options.first_octave == -1 || options.first_octave == 0),
          "an option is out of range");
  require(static_cast<int64_t>(photo.width) * photo.height < kMaximumPixels,
          "the photo is too large");
}

}  // namespace
}  // namespace ck::sift

ck_status ck_sift_detect(const ck_pixels* photo, const uint8_t* mask,
                         const ck_sift_options* options, const ck_control* control,
                         const ck_sift_output* features, size_t* count) {
  return ck::guarded([&] {
    ck::require(photo && options && features && count, "photo, options and outputs are needed");
    *count = 0;
    const ck::sift::Photo image{photo->data, photo->width, photo->height, photo->channels,
                                photo->row_stride};
    ck::sift::validate(image, *options);
    const ck::sift::Kernels& kernels = ck::sift::kernels(options->instructions);
    if (std::min(image.width, image.height) < 8 || options->maximum_features == 0) return;
    ck::sift::ScaleSpace space = ck::sift::searched(image, *options, kernels, control);
    ck::sift::remove_repetitions(space.extrema);
    if (mask) ck::sift::remove_masked(space, image, mask);
    const auto found = ck::sift::oriented(space, ck::sift::selected(space, image, *options),
                                          static_cast<size_t>(options->maximum_features), kernels);
    ck::step(control, 0.8);
    const ck::MutableStrided<uint8_t> colors(features->colors);
    for (const ck::sift::Feature& f : found) {
      const size_t n = (*count)++;
      features->positions[2 * n] = f.x;
      features->positions[2 * n + 1] = f.y;
      features->scales[n] = f.sigma;
      features->orientations[n] = f.orientation;
      kernels.describe(space.octaves[f.extremum.octave], f.extremum, f.orientation,
                       features->descriptors + n * CK_DESCRIPTOR_LENGTH);
      ck::sift::write_color(image, f.x, f.y, colors[n]);
    }
  });
}
