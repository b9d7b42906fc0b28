#pragma once

#include "texture/atlas.h"

namespace ck::texture {

/// The point of the dense surface that corresponds to a point of the simplified one.
struct DensePoint {
  Vec3 position, normal;
  /// Signed distance from the base point along its normal.
  float height = 0;
};

/// A point on the simplified surface.
struct BasePoint {
  Vec3 position, normal;
};

/// The point of a triangle with the given barycentric weights.
BasePoint base_point(const ck_atlas& atlas, const ck_bake_source& source, size_t face,
                     Vec3 weights);

/// The nearest point of the dense surface along the normal, inwards or outwards, that faces the
/// same way; false if there is none within `maximum_distance`.
bool find_dense(const ck_bake_source& source, const BasePoint& base, DensePoint* point);

}  // namespace ck::texture
