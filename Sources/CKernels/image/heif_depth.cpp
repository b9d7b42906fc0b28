#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "core/guard.h"
#include "image/buffers.h"
#include "image/heif.h"

namespace ck {
namespace {

using namespace heif;

/// The depth image that belongs to an image; null without one.
Handle depth_image(const Primary& primary) {
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_depth_image_IDs(primary.handle.get(), &id, 1) != 1) return {};
  heif_image_handle* depth = nullptr;
  check(heif_image_handle_get_depth_image_handle(primary.handle.get(), id, &depth));
  return Handle(depth);
}

/// The largest XMP packet in bytes that is read. Chosen: those of phones have a few kilobytes.
constexpr size_t kMaximumPacket = 1 << 20;

/// The XMP packet about an image; empty without one.
std::vector<uint8_t> xmp(const Handle& handle) {
  heif_item_id id = 0;
  if (heif_image_handle_get_list_of_metadata_block_IDs(handle.get(), "mime", &id, 1) != 1) {
    return {};
  }
  const size_t size = heif_image_handle_get_metadata_size(handle.get(), id);
  std::vector<uint8_t> packet(std::min(size, kMaximumPacket));
  if (packet.empty() || packet.size() != size) return {};
  check(heif_image_handle_get_metadata(handle.get(), id, packet.data()));
  return packet;
}

/// Decodes the samples to 0…1.
void decode(const Handle& handle, const ck_decode_limits& limits, ck_image& map) {
  require_within(limits, heif_image_handle_get_width(handle.get()),
                 heif_image_handle_get_height(handle.get()));
  const DecodingOptions options = make_decoding_options();
  heif_image* decoded = nullptr;
  check(heif_decode_image(handle.get(), &decoded, heif_colorspace_monochrome,
                          heif_chroma_monochrome, options.get()));
  const Image owner(decoded);
  map.width = heif_image_get_width(decoded, heif_channel_Y);
  map.height = heif_image_get_height(decoded, heif_channel_Y);
  require_within(limits, map.width, map.height);
  int stride = 0;
  const uint8_t* rows = heif_image_get_plane_readonly(decoded, heif_channel_Y, &stride);
  if (!rows || heif_image_get_bits_per_pixel_range(decoded, heif_channel_Y) != 8) {
    throw std::runtime_error("its depth can't be decoded");
  }
  std::vector<float> row(static_cast<size_t>(map.width));
  map.pixels.resize(row.size() * static_cast<size_t>(map.height) * sizeof(float));
  for (size_t y = 0; y < static_cast<size_t>(map.height); ++y) {
    const uint8_t* samples = rows + y * static_cast<size_t>(stride);
    std::transform(samples, samples + row.size(), row.begin(),
                   [](uint8_t sample) { return static_cast<float>(sample) / 255; });
    std::memcpy(&map.pixels[y * row.size() * sizeof(float)], row.data(),
                row.size() * sizeof(float));
  }
}

}  // namespace
}  // namespace ck

ck_status ck_heif_decode_depth(const uint8_t* bytes, size_t byte_count,
                               const ck_decode_limits* limits, ck_image** map,
                               ck_bytes** description) {
  return ck::guarded([&] {
    const ck::heif::Primary primary(bytes, byte_count);
    auto decoded = std::make_unique<ck_image>();
    auto packet = std::make_unique<ck_bytes>();
    if (const ck::heif::Handle depth = ck::depth_image(primary)) {
      packet->data = ck::xmp(depth);
      ck::decode(depth, *limits, *decoded);
    }
    *map = decoded.release();
    *description = packet.release();
  });
}
