/// The umbrella of the C boundary: one header per kernel family.
///
/// Conventions of all functions:
/// - Arguments come in this order: the object that the function works on (a handle, or a scene that
///   it changes in place), inputs, options, control, outputs.
/// - Vectors come as `ck_span`, other arrays as pointer and count without padding. The caller owns
///   all arrays; a comment gives the size of an output, or an argument its capacity.
/// - A largest value is called `maximum_…`, a smallest `minimum_…`; a flag is a `bool`.
/// - A function has at most eight parameters.
/// - A function that can fail returns a `ck_status` and lets no exception out. None prints, changes
/// a
///   setting of the process, or ends it.
#ifndef CKERNELS_H
#define CKERNELS_H

#include "ck_bundle.h"
#include "ck_camera.h"
#include "ck_core.h"
#include "ck_features.h"
#include "ck_global.h"
#include "ck_image.h"
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

#endif
