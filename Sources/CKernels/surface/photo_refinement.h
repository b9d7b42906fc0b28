#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "ck_surface.h"
#include "geometry/pinhole.h"
#include "geometry/vec.h"

namespace ck::surface {

/// A mesh with the connectivity and normals that the refinement uses.
struct RefinedMesh {
  std::vector<Vec3> positions;
  /// Unit normals at the vertices.
  std::vector<Vec3> normals;
  std::vector<std::array<uint32_t, 3>> triangles;
  /// The neighbors of vertex v are `neighbors[offsets[v]..<offsets[v + 1]]`, in ascending order.
  std::vector<uint32_t> offsets, neighbors;
  /// Whether a vertex has an edge that is not shared by exactly two triangles.
  std::vector<uint8_t> is_border;
  /// Mean edge length in world units.
  double mean_edge = 0;

  /// Fills `offsets`, `neighbors`, `is_border` and `mean_edge`.
  void find_neighbors();
  /// Computes the area-weighted vertex normals.
  void find_normals();
  /// The normal of a triangle, with twice its area as length.
  Vec3 doubled_area(const std::array<uint32_t, 3>& t) const {
    const Vec3 a = positions[t[0]];
    return cross(positions[t[1]] - a, positions[t[2]] - a);
  }
};

/// A photo with the depth of the surface in it.
struct RefinementView {
  /// Side in pixels of the squares that share a depth. Chosen.
  static constexpr int kShrink = 2;

  ck_view view;
  Projection projection;
  std::vector<uint8_t> luminance;
  /// The smallest depth of the surface around each square of pixels; 0 outside the mask, infinity
  /// where there is no surface.
  std::vector<float> nearest;
  /// Indices of the views to compare with.
  std::vector<uint32_t> partners;

  RefinementView(const ck_view& view, const uint8_t* rgb, const uint8_t* mask);

  /// Renders the surface and stores the smallest depths.
  void find_depths(const RefinedMesh& mesh);
  /// x and y in pixels, and depth.
  Vec3 project(Vec3 p) const;
  /// Whether a point with this projection is at least `margin` pixels from the image border and not
  /// occluded.
  bool sees(Vec3 projected, float margin) const;
  /// The side of a pixel at a depth, in world units.
  float footprint(float depth) const { return depth / static_cast<float>(view.camera.fx); }

 private:
  size_t shrunk_width() const { return static_cast<size_t>(view.camera.width / kShrink + 1); }
};

/// The rendered surface within its bounding rectangle: triangle index and depth per pixel.
struct SurfaceImage {
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<uint32_t> triangles;
  std::vector<float> depths;

  /// Renders the mesh into an image of the view with each side divided by `shrink`.
  SurfaceImage(const RefinedMesh& mesh, const RefinementView& view, int shrink);
};

/// Photometric evidence at a pixel of a view: the sum of squared slopes of its differences to the
/// partners (with respect to a displacement along the normal), and the sum of slopes times
/// differences, negated: the terms of a Gauss–Newton step.
struct PixelEvidence {
  uint32_t triangle;
  std::array<float, 3> weights;
  float slope2;
  float pull;
};

/// The same per vertex, and the mean side of a pixel on the surface in world units.
struct VertexEvidence {
  std::vector<double> slope2, pull;
  double footprint = 0;
};

/// Selects for each view at most `count` partners that see the same surface at a suitable angle.
void choose_partners(const RefinedMesh& mesh, int count, std::vector<RefinementView>* views);

/// Compares a view with its partners, which are warped into it by the surface.
std::vector<PixelEvidence> compare(const RefinedMesh& mesh,
                                   const std::vector<RefinementView>& views, size_t index,
                                   const ck_photo_refinement_options& options);

/// Moves the vertices to minimize the photometric differences plus the bending energy; returns
/// which vertices the photos constrain.
std::vector<uint8_t> move_vertices(const VertexEvidence& evidence, float smoothness,
                                   const ck_control* control, RefinedMesh* mesh);

}  // namespace ck::surface
