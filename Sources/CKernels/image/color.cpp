#include <lcms2.h>

#include <cstdlib>
#include <memory>
#include <new>

#include "ck_image.h"
#include "core/guard.h"

namespace {

/// Deleter of a profile.
struct Close {
  using pointer = cmsHPROFILE;
  void operator()(cmsHPROFILE profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, Close>;

/// Deleter of a transform.
struct Delete {
  using pointer = cmsHTRANSFORM;
  void operator()(cmsHTRANSFORM transform) const { cmsDeleteTransform(transform); }
};
using Transform = std::unique_ptr<void, Delete>;

/// The Adobe RGB (1998) Color Image Encoding, section 4.3.
Profile adobe_rgb() {
  const cmsCIExyY white{0.3127, 0.3290, 1};
  const cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.21, 0.71, 1}, {0.15, 0.06, 1}};
  const std::unique_ptr<cmsToneCurve, decltype(&cmsFreeToneCurve)> curve(
      cmsBuildGamma(nullptr, 563.0 / 256), cmsFreeToneCurve);
  if (!curve) throw std::bad_alloc();
  cmsToneCurve* curves[] = {curve.get(), curve.get(), curve.get()};
  return Profile(cmsCreateRGBProfile(&white, &primaries, curves));
}

/// Largest change of a channel, in 8-bit steps, at which two color spaces count as equal. Chosen:
/// profiles of sRGB differ by rounding.
constexpr int kTolerance = 2;

/// Whether no color of a lattice changes by more than the tolerance.
bool is_identity(cmsHTRANSFORM transform) {
  constexpr int kSteps = 9;  // Per axis of the lattice. Chosen.
  for (int i = 0; i < kSteps * kSteps * kSteps; ++i) {
    const int levels[] = {i % kSteps, i / kSteps % kSteps, i / (kSteps * kSteps)};
    uint8_t before[3], after[3];
    for (int c = 0; c < 3; ++c) before[c] = static_cast<uint8_t>(levels[c] * 255 / (kSteps - 1));
    cmsDoTransform(transform, before, after, 1);
    for (int c = 0; c < 3; ++c) {
      if (std::abs(before[c] - after[c]) > kTolerance) return false;
    }
  }
  return true;
}

}  // namespace

ck_status ck_image_convert_to_srgb(uint8_t* pixels, size_t pixel_count, ck_color_space color_space,
                                   const uint8_t* profile, size_t profile_count) {
  return ck::guarded([&] {
    ck::require(pixel_count <= UINT32_MAX && profile_count <= UINT32_MAX,
                "the image or its color profile is too large");
    const Profile source =
        color_space == ck_color_space_adobe_rgb
            ? adobe_rgb()
            : Profile(cmsOpenProfileFromMem(profile, static_cast<cmsUInt32Number>(profile_count)));
    if (!source || cmsGetColorSpace(source.get()) != cmsSigRgbData) return;
    const Profile srgb(cmsCreate_sRGBProfile());
    if (!srgb) throw std::bad_alloc();
    const Transform transform(cmsCreateTransform(source.get(), TYPE_RGB_8, srgb.get(), TYPE_RGB_8,
                                                 INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE));
    if (!transform || is_identity(transform.get())) return;
    cmsDoTransform(transform.get(), pixels, pixels, static_cast<cmsUInt32Number>(pixel_count));
  });
}
