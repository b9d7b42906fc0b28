#pragma once

#include "texture/atlas.h"

namespace ck::texture {

/// The dense surface as a place on the simplified one sees it.
struct DensePoint {
  Vec3 position, normal;
  /// How far it is above the place, along the place's normal.
  float height = 0;
};

/// A place on the simplified surface.
struct BasePoint {
  Vec3 position, normal;
};

/// The place that the weights of a triangle's corners say.
BasePoint base_point(const ck_atlas& atlas, const ck_bake_source& source, size_t face,
                     Vec3 weights);

/// The dense surface's point nearest along the normal, inwards or outwards, that faces the same
/// way; false where there is none within the source's reach.
bool find_dense(const ck_bake_source& source, const BasePoint& base, DensePoint* point);

}  // namespace ck::texture
