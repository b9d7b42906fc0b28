/// The umbrella of the C boundary: one header a kernel family.
#ifndef CKERNELS_H
#define CKERNELS_H

#include "ck_core.h"
#include "ck_features.h"
#include "ck_image.h"
#include "ck_matching.h"

#endif
