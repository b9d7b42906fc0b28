#include <cstring>
#include <vector>

#include "core/guard.h"
#include "image/buffers.h"
#include "image/heif.h"

namespace ck {
namespace {

using namespace heif;
using Encoder = std::unique_ptr<heif_encoder, Free<heif_encoder_release>>;
using EncodingOptions = std::unique_ptr<heif_encoding_options, Free<heif_encoding_options_free>>;

Image make_image(const ck_pixels& pixels) {
  const auto [data, width, height, channels, row_stride] = pixels;
  heif_image* made = nullptr;
  check(heif_image_create(
      width, height, heif_colorspace_RGB,
      channels == 4 ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB, &made));
  Image image(made);
  check(heif_image_add_plane(made, heif_channel_interleaved, width, height, 8));
  int stride = 0;
  uint8_t* rows = heif_image_get_plane(made, heif_channel_interleaved, &stride);
  if (!rows) throw std::bad_alloc();
  const size_t row = static_cast<size_t>(width) * static_cast<size_t>(channels);
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    std::memcpy(rows + y * static_cast<size_t>(stride), data + y * row_stride, row);
  }
  return image;
}

heif_error append(heif_context*, const void* data, size_t size, void* user) {
  const auto* bytes = static_cast<const uint8_t*>(data);
  auto* target = static_cast<std::vector<uint8_t>*>(user);
  target->insert(target->end(), bytes, bytes + size);
  return {heif_error_Ok, heif_suberror_Unspecified, nullptr};
}

}  // namespace
}  // namespace ck

ck_status ck_heif_encode(const ck_pixels* pixels, const ck_heif_options* options,
                         ck_bytes** encoded) {
  return ck::guarded([&] {
    using namespace ck;
    require(pixels->width > 0 && pixels->height > 0, "an image without pixels can't be encoded");
    require(pixels->channels == 3 || pixels->channels == 4,
            "this number of channels can't be encoded");
    const Context context = make_context();
    const Image image = make_image(*pixels);
    if (options->color_profile) {
      check(heif_image_set_raw_color_profile(image.get(), "prof", options->color_profile,
                                             options->color_profile_count));
    }
    heif_encoder* found = nullptr;
    check(heif_context_get_encoder_for_format(context.get(), heif_compression_HEVC, &found));
    const Encoder encoder(found);
    check(heif_encoder_set_lossy_quality(found, options->quality));
    EncodingOptions how(heif_encoding_options_alloc());
    if (!how) throw std::bad_alloc();
    how->image_orientation = static_cast<heif_orientation>(options->orientation);
    heif_image_handle* made = nullptr;
    check(heif_context_encode_image(context.get(), image.get(), found, how.get(), &made));
    const Handle handle(made);
    if (options->exif) {
      check(heif_context_add_exif_metadata(context.get(), made, options->exif,
                                           static_cast<int>(options->exif_count)));
    }
    if (options->xmp) {
      check(heif_context_add_XMP_metadata(context.get(), made, options->xmp,
                                          static_cast<int>(options->xmp_count)));
    }
    auto result = std::make_unique<ck_bytes>();
    heif_writer writer{1, append};
    check(heif_context_write(context.get(), &writer, &result->data));
    *encoded = result.release();
  });
}
