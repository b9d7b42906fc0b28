#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "ck_surface.h"
#include "geometry/pinhole.h"
#include "geometry/vec.h"

namespace ck::surface {

using texture::Vec3;

/// A mesh with what the steps of the refinement ask of it.
struct RefinedMesh {
  std::vector<Vec3> positions;
  /// Unit normals at the vertices.
  std::vector<Vec3> normals;
  std::vector<std::array<uint32_t, 3>> triangles;
  /// The vertices beside vertex v are `neighbours[offsets[v]..<offsets[v + 1]]`, in ascending
  /// order.
  std::vector<uint32_t> offsets, neighbours;
  /// Whether a vertex lies at an edge that doesn't have two triangles.
  std::vector<uint8_t> is_border;
  double mean_edge = 0;

  void find_neighbours();
  void find_normals();
  Vec3 doubled_area(const std::array<uint32_t, 3>& t) const {
    const Vec3 a = positions[t[0]];
    return texture::cross(positions[t[1]] - a, positions[t[2]] - a);
  }
};

/// A photo, and how near the surface is.
struct RefinementView {
  /// Pixels a side that share a depth.
  static constexpr int kShrink = 2;

  ck_pinhole pinhole;
  texture::Projection projection;
  std::vector<uint8_t> luminance;
  /// The least depth of the surface around each square of pixels; 0 outside the mask, infinity
  /// where there is no surface.
  std::vector<float> nearest;
  /// The views it is compared with.
  std::vector<uint32_t> partners;

  RefinementView(const ck_pinhole& view, const uint8_t* rgb, const uint8_t* mask);

  /// Draws the surface and keeps the least depths.
  void find_depths(const RefinedMesh& mesh);
  /// x, y in pixels and depth.
  Vec3 project(Vec3 p) const;
  /// Whether nothing lies before a point with this projection, `margin` pixels from the rim.
  bool sees(Vec3 projected, float margin) const;
  /// The length at a depth that a pixel shows.
  float footprint(float depth) const { return depth / static_cast<float>(pinhole.focal[0]); }

 private:
  size_t shrunk_width() const { return static_cast<size_t>(pinhole.width / kShrink + 1); }
};

/// The part of an image that shows the surface, with the triangle at each pixel.
struct SurfaceImage {
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<uint32_t> triangles;
  std::vector<float> depths;

  /// Draws the mesh into an image of the view, each side divided by `shrink`.
  SurfaceImage(const RefinedMesh& mesh, const RefinementView& view, int shrink);
};

/// What a view and its partners say about one of its pixels: the sum of squared slopes of their
/// differences, and of the slopes times the differences, along the normal.
struct PixelEvidence {
  uint32_t triangle;
  std::array<float, 3> weights;
  float slope2;
  float pull;
};

/// The same for each vertex, and the length that pixels show in the mean.
struct VertexEvidence {
  std::vector<double> slope2, pull;
  double footprint = 0;
};

/// Chooses for each view those that see the same at a good angle.
void choose_partners(const RefinedMesh& mesh, int count, std::vector<RefinementView>* views);

/// Compares a view with its partners by way of the surface.
std::vector<PixelEvidence> compare(const RefinedMesh& mesh,
                                   const std::vector<RefinementView>& views, size_t index,
                                   const ck_photo_refinement_options& options);

/// Moves the vertices to the least sum of the photos' differences and of bending; returns which of
/// them the photos determine.
std::vector<uint8_t> move_vertices(const VertexEvidence& evidence, float smoothness,
                                   const ck_control* control, RefinedMesh* mesh);

}  // namespace ck::surface
