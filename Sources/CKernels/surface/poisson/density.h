#pragma once

#include "surface/poisson/samples.h"

namespace ck::poisson {

/// Estimates each sample's area, and its depth up to `depth`, by the density of the samples around
/// it (Kazhdan and Hoppe 2013, after Kazhdan, Bolitho and Hoppe, SGP 2006, section 4.5).
void estimate_density(Samples& samples, int depth, const ck_control* control);

}  // namespace ck::poisson
