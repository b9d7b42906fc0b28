/// Umbrella header of the C interface: one header per kernel family.
#ifndef CKERNELS_H
#define CKERNELS_H

#include "ck_bundle.h"
#include "ck_camera.h"
#include "ck_core.h"
#include "ck_features.h"
#include "ck_global.h"
#include "ck_image.h"
#include "ck_matching.h"
#include "ck_patches.h"
#include "ck_refinement.h"
#include "ck_resection.h"
#include "ck_retrieval.h"
#include "ck_surface.h"
#include "ck_texture.h"
#include "ck_two_view.h"

#endif
