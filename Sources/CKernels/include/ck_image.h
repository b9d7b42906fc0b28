#ifndef CK_IMAGE_H
#define CK_IMAGE_H

#include "ck_camera.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A decoded image, top row first: RGB with three bytes per pixel, an alpha channel with one byte
/// per pixel, or floating-point values with four bytes per pixel. Free with `ck_image_free`.
typedef struct ck_image ck_image;

/// A byte buffer allocated by a kernel. Free with `ck_bytes_free`.
typedef struct ck_bytes ck_bytes;

/// Decoder and encoder of an image file.
typedef enum {
  ck_codec_jpeg = 0,
  ck_codec_png = 1,
  /// HEIC and AVIF.
  ck_codec_heif = 2,
  ck_codec_tiff = 3,
  ck_codec_webp = 4,
  /// Windows bitmaps without compression.
  ck_codec_bmp = 5,
  /// Camera raw files.
  ck_codec_raw = 6,
  ck_codec_exr = 7,
} ck_codec;

/// Size limits, checked before a decoder allocates pixels.
typedef struct {
  /// Largest width and largest height in pixels.
  int32_t maximum_side;
  /// Largest product of width and height.
  int64_t maximum_pixels;
} ck_decode_limits;

/// Decodes an image file in memory to 8-bit RGB as stored: EXIF orientation is not applied (but
/// TIFF, HEIF and camera raw files are rotated as their container specifies), alpha is dropped,
/// 16-bit samples become 8-bit, gray, palette and CMYK images become RGB.
///
/// `reduction` is 1, 2, 4 or 8: the sides of a JPEG are divided by it and rounded up, which takes
/// less time; other formats are decoded at full size.
///
/// A JPEG whose pixel data is damaged or truncated fails; the error message contains the first
/// affected row.
ck_status ck_image_decode(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                          int32_t reduction, const ck_decode_limits* limits, ck_image** image);

/// Decodes the alpha channel of an image file in memory: one byte per pixel, 0 where transparent,
/// oriented as by `ck_image_decode`. Returns an image without pixels if the file has no alpha
/// channel.
ck_status ck_image_decode_alpha(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                                const ck_decode_limits* limits, ck_image** image);

/// Decodes a TIFF or OpenEXR file with one floating-point number per pixel, for example a depth
/// map, upright: 32 bits each, in OpenEXR also 16. Returns an image without pixels if the file has
/// another pixel format.
ck_status ck_image_decode_float(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                                const ck_decode_limits* limits, ck_image** image);

/// Width in pixels.
int32_t ck_image_width(const ck_image* image);
/// Height in pixels.
int32_t ck_image_height(const ck_image* image);
/// Copies all bytes: `width × height × 3` of an RGB image.
void ck_image_copy(const ck_image* image, uint8_t* destination);
/// Frees the image; null does nothing.
void ck_image_free(ck_image* image);

/// Properties of the primary image of a HEIF file, in upright orientation.
typedef struct {
  /// Size in pixels.
  int32_t width, height;
  bool has_alpha;
} ck_heif_info;

/// Metadata blocks of a HEIF file: EXIF data starting at its TIFF header, or an ICC profile.
typedef enum { ck_heif_exif = 0, ck_heif_color_profile = 1 } ck_heif_block;

/// Reads the header of a HEIF file (ISO/IEC 23008-12: HEIC, AVIF).
ck_status ck_heif_inspect(const uint8_t* bytes, size_t byte_count, ck_heif_info* info);

/// Reads a metadata block; returns no bytes if the file has none.
ck_status ck_heif_read(const uint8_t* bytes, size_t byte_count, ck_heif_block which,
                       ck_bytes** block);

/// Decodes the depth or disparity map that a HEIF file has for its primary image, upright. `map`
/// receives the samples as 32-bit floating-point numbers from 0 to 1, without pixels if there is no
/// map; `description` receives the XMP packet about the map, without bytes if there is none.
ck_status ck_heif_decode_depth(const uint8_t* bytes, size_t byte_count,
                               const ck_decode_limits* limits, ck_image** map,
                               ck_bytes** description);

/// Properties of a camera raw file. Texts end with a zero and are empty if unknown; numbers are 0
/// if unknown.
typedef struct {
  /// Size in pixels, upright.
  int32_t width, height;
  /// The EXIF orientation, 1…8, that rotates the pixels of the sensor upright.
  int32_t orientation;
  char make[64], model[64], lens[128], body_serial_number[64], lens_serial_number[64];
  /// In millimeters.
  double focal_length, focal_length_in_35mm_film;
  double iso, exposure_seconds;
  /// As in EXIF: "2024:05:17 12:34:56".
  char capture_time[20];
  bool has_position;
  /// Degrees north and east.
  double latitude, longitude;
  /// Meters above sea level.
  double altitude;
} ck_raw_info;

/// Reads the properties of a camera raw file.
ck_status ck_raw_inspect(const uint8_t* bytes, size_t byte_count, ck_raw_info* info);

/// Properties of an OpenEXR file.
typedef struct {
  /// Size in pixels of the display window.
  int32_t width, height;
  /// Independent images; only files with one can be decoded.
  int32_t parts;
  /// Whether pixels have several samples at different depths, which can't be decoded.
  bool is_deep;
  bool has_alpha;
} ck_exr_info;

/// Reads the header of an OpenEXR file.
ck_status ck_exr_inspect(const uint8_t* bytes, size_t byte_count, ck_exr_info* info);

/// Options of HEIC encoding.
typedef struct {
  /// Lossy quality, 0…100.
  int32_t quality;
  /// EXIF orientation to store, 1…8.
  int32_t orientation;
  /// EXIF data starting at its TIFF header, or null.
  const uint8_t* exif;
  size_t exif_count;
  /// An ICC profile, or null.
  const uint8_t* color_profile;
  size_t color_profile_count;
  /// An XMP packet, or null.
  const uint8_t* xmp;
  size_t xmp_count;
} ck_heif_options;

/// Encodes RGB or RGBA as HEIC. Fails with `ck_invalid_argument` if libheif has no HEVC encoder.
ck_status ck_heif_encode(const ck_pixels* pixels, const ck_heif_options* options,
                         ck_bytes** encoded);

/// The source color space of a conversion.
typedef enum {
  /// The color space of an ICC profile.
  ck_color_space_icc = 0,
  /// Adobe RGB (1998).
  ck_color_space_adobe_rgb = 1,
} ck_color_space;

/// Converts RGB pixels in place to sRGB (IEC 61966-2-1) with relative colorimetric intent; values
/// outside the sRGB gamut are clipped. Does nothing if the color space equals sRGB within two 8-bit
/// steps, or if the profile is damaged or not an RGB profile. `profile` is null for a color space
/// without one.
ck_status ck_image_convert_to_srgb(uint8_t* pixels, size_t pixel_count, ck_color_space color_space,
                                   const uint8_t* profile, size_t profile_count);

/// Inflates a zlib stream (RFC 1950); fails if it is damaged or has more than `maximum_count`
/// bytes.
ck_status ck_inflate(const uint8_t* bytes, size_t byte_count, size_t maximum_count,
                     ck_bytes** inflated);

/// Encodes gray, RGB or RGBA as PNG, or gray or RGB as JPEG, without padding between rows.
/// `quality` is 0…100 and used by JPEG only. The same pixels give the same bytes.
ck_status ck_image_encode(const ck_pixels* pixels, ck_codec codec, int32_t quality,
                          ck_bytes** encoded);

/// Options of WebP encoding.
typedef struct {
  /// Keeps all pixels; `quality` is then the effort.
  bool is_lossless;
  /// 0…100.
  int32_t quality;
  /// Computes the colors at half the resolution with less loss, which takes longer.
  bool is_sharp;
} ck_webp_options;

/// Encodes gray or RGB as WebP, without padding between rows and with at most 16383 pixels per
/// side. The same pixels give the same bytes.
ck_status ck_webp_encode(const ck_pixels* pixels, const ck_webp_options* options,
                         ck_bytes** encoded);

/// Number of bytes.
size_t ck_bytes_count(const ck_bytes* bytes);
/// Copies all bytes.
void ck_bytes_copy(const ck_bytes* bytes, uint8_t* destination);
/// Frees the bytes; null does nothing.
void ck_bytes_free(ck_bytes* bytes);

/// Resizes an image to the size of `destination`: area averaging when shrinking, bilinear
/// interpolation when enlarging.
ck_status ck_image_resize(const ck_pixels* source, const ck_mutable_pixels* destination);

/// Rotates stored pixels upright according to EXIF orientation 1…8. Orientations 5…8 swap width and
/// height.
ck_status ck_image_orient(const ck_pixels* source, int32_t orientation,
                          const ck_mutable_pixels* destination);

/// Resamples (bicubic) an image of `source_camera` as seen by `destination_camera`, which has no
/// distortion.
///
/// Pixels outside the source repeat its border. Both images have the size of their camera.
ck_status ck_image_undistort(const ck_pixels* source, const ck_camera* source_camera,
                             const ck_camera* destination_camera,
                             const ck_mutable_pixels* destination);

/// Dilates a gray image: each pixel becomes the maximum of the square that extends `radius` pixels
/// to each side of it.
ck_status ck_image_dilate(const ck_pixels* source, int32_t radius,
                          const ck_mutable_pixels* destination);

/// Sharpness of a gray image: the relative loss of gradient energy of its textured parts under a
/// slight blur, in the direction that loses least (after Crete et al., "The blur effect", SPIE
/// 2007); about 0.2 for a blurred photo, 1.5 and more for a sharp one.
///
/// Returns `ck_degenerate` for an image without texture.
ck_status ck_image_sharpness(const ck_pixels* gray, double* sharpness);

#ifdef __cplusplus
}
#endif
#endif
