#include "image/heif.h"

#include <cstring>
#include <vector>

#include "core/guard.h"
#include "image/buffers.h"

namespace ck {
namespace {

using namespace heif;

/// Decodes to `channels` bytes per pixel, 3 or 4, in upright orientation.
void decode(const uint8_t* bytes, size_t count, size_t channels, const ck_decode_limits& limits,
            ck_image& image) {
  const Primary primary(bytes, count);
  require_within(limits, primary.width(), primary.height());
  const DecodingOptions options = make_decoding_options();
  heif_image* decoded = nullptr;
  check(heif_decode_image(
      primary.handle.get(), &decoded, heif_colorspace_RGB,
      channels == 4 ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB, options.get()));
  const Image owner(decoded);
  image.width = heif_image_get_width(decoded, heif_channel_interleaved);
  image.height = heif_image_get_height(decoded, heif_channel_interleaved);
  require_within(limits, image.width, image.height);
  int stride = 0;
  const uint8_t* rows = heif_image_get_plane_readonly(decoded, heif_channel_interleaved, &stride);
  if (!rows) throw std::runtime_error("it can't be decoded");
  const size_t row = static_cast<size_t>(image.width) * channels;
  image.pixels.resize(row * static_cast<size_t>(image.height));
  for (size_t y = 0; y < static_cast<size_t>(image.height); ++y) {
    std::memcpy(&image.pixels[y * row], rows + y * static_cast<size_t>(stride), row);
  }
}

/// The EXIF data, starting at its TIFF header.
std::vector<uint8_t> exif(const Primary& primary) {
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_metadata_block_IDs(primary.handle.get(), "Exif", &id, 1) != 1) {
    return {};
  }
  std::vector<uint8_t> block(heif_image_handle_get_metadata_size(primary.handle.get(), id));
  if (block.size() < 4) return {};
  check(heif_image_handle_get_metadata(primary.handle.get(), id, block.data()));
  // The block starts with the offset from its fifth byte to that header.
  const size_t start = 4 + (size_t{block[0]} << 24 | size_t{block[1]} << 16 |
                            size_t{block[2]} << 8 | size_t{block[3]});
  if (start >= block.size()) return {};
  block.erase(block.begin(), block.begin() + static_cast<ptrdiff_t>(start));
  return block;
}

std::vector<uint8_t> color_profile(const Primary& primary) {
  const heif_color_profile_type type =
      heif_image_handle_get_color_profile_type(primary.handle.get());
  if (type != heif_color_profile_type_rICC && type != heif_color_profile_type_prof) return {};
  std::vector<uint8_t> profile(heif_image_handle_get_raw_color_profile_size(primary.handle.get()));
  if (!profile.empty()) {
    check(heif_image_handle_get_raw_color_profile(primary.handle.get(), profile.data()));
  }
  return profile;
}

}  // namespace

void decode_heif(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                 ck_image& image) {
  decode(bytes, count, 3, limits, image);
}

void decode_heif_alpha(const uint8_t* bytes, size_t count, const ck_decode_limits& limits,
                       ck_image& image) {
  if (!Primary(bytes, count).has_alpha()) return;
  decode(bytes, count, 4, limits, image);
  for (size_t i = 0; i < image.pixels.size() / 4; ++i) image.pixels[i] = image.pixels[4 * i + 3];
  image.pixels.resize(image.pixels.size() / 4);
}

}  // namespace ck

ck_status ck_heif_inspect(const uint8_t* bytes, size_t byte_count, ck_heif_info* info) {
  return ck::guarded([&] {
    const ck::Primary primary(bytes, byte_count);
    *info = {primary.width(), primary.height(), primary.has_alpha()};
  });
}

ck_status ck_heif_read(const uint8_t* bytes, size_t byte_count, ck_heif_block which,
                       ck_bytes** block) {
  return ck::guarded([&] {
    const ck::Primary primary(bytes, byte_count);
    auto result = std::make_unique<ck_bytes>();
    result->data = which == ck_heif_exif ? ck::exif(primary) : ck::color_profile(primary);
    *block = result.release();
  });
}
