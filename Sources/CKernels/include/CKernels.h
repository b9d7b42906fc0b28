/// Umbrella header of the C interface: one header per kernel family.
///
/// Conventions of all functions:
/// - Parameters are in this order: the object that the function works on (a handle, or a scene that
///   it modifies in place), inputs, options, control, outputs.
/// - Vectors are passed as `ck_span`, other arrays as pointer and count without padding. The caller
///   owns all arrays; a comment states the size of an output, or a parameter its capacity.
/// - Upper bounds are named `maximum_…`, lower bounds `minimum_…`; flags are `bool`.
/// - A function has at most eight parameters.
/// - A function that can fail returns a `ck_status`; no exception leaves it. Apart from
///   `ck_silence_libraries`, no function prints, changes a setting of the process, or ends it.
#ifndef CKERNELS_H
#define CKERNELS_H

#include "ck_bundle.h"
#include "ck_camera.h"
#include "ck_compression.h"
#include "ck_core.h"
#include "ck_features.h"
#include "ck_global.h"
#include "ck_image.h"
#include "ck_masks.h"
#include "ck_matching.h"
#include "ck_mesh.h"
#include "ck_patches.h"
#include "ck_rays.h"
#include "ck_refinement.h"
#include "ck_resection.h"
#include "ck_retrieval.h"
#include "ck_surface.h"
#include "ck_testing.h"
#include "ck_texture.h"
#include "ck_two_view.h"
#include "ck_video.h"

#endif
