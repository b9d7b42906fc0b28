#ifndef CK_IMAGE_H
#define CK_IMAGE_H

#include "ck_core.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A decoded RGB image, three bytes a pixel, an alpha channel, one byte a pixel, or one of numbers
/// of four bytes; top row first. Free with `ck_image_free`.
typedef struct ck_image ck_image;

/// Bytes of unknown size that a kernel made. Free with `ck_bytes_free`.
typedef struct ck_bytes ck_bytes;

/// The kinds of image file.
typedef enum {
  ck_codec_jpeg = 0,
  ck_codec_png = 1,
  /// TIFF, BMP and WebP through OpenCV.
  ck_codec_other = 2,
  /// HEIC and AVIF through libheif.
  ck_codec_heif = 3,
} ck_codec;

/// What a decoder refuses before it allocates pixels.
typedef struct {
  int32_t maximum_side;
  int64_t maximum_pixels;
} ck_decode_limits;

/// Pinhole with OpenCV's distortion; pixel origin at the corner of the top-left pixel.
typedef struct {
  int32_t width;
  int32_t height;
  double focal_length[2];
  double principal_point[2];
  /// k1, k2, p1, p2.
  double distortion[4];
} ck_camera;

/// Decodes an image file in memory to RGB as stored: no EXIF orientation is applied (but TIFF and
/// HEIF files are turned by what they say themselves), alpha is dropped, 16 bits become 8, gray,
/// palette and CMYK become RGB.
///
/// `reduction` is 1, 2, 4 or 8: a JPEG comes with its sides divided by it and rounded up, which
/// takes less time; other formats come whole.
///
/// A JPEG whose pixel data is damaged or cut off fails with a message that says so.
ck_status ck_image_decode(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                          int32_t reduction, const ck_decode_limits* limits, ck_image** image);

/// Decodes the alpha channel of an image file in memory, one byte a pixel, 0 for transparent ones,
/// turned as `ck_image_decode` turns the colours. An image without pixels where the file has none.
ck_status ck_image_decode_alpha(const uint8_t* bytes, size_t byte_count, ck_codec codec,
                                const ck_decode_limits* limits, ck_image** image);

/// Decodes an image of one floating-point number a pixel, four bytes each, as it is stored. An
/// image without pixels where the file holds others.
ck_status ck_image_decode_numbers(const uint8_t* bytes, size_t byte_count,
                                  const ck_decode_limits* limits, ck_image** image);

/// Pixels of a row.
int32_t ck_image_width(const ck_image* image);
/// Rows.
int32_t ck_image_height(const ck_image* image);
/// Copies all bytes: `width × height × 3` of an RGB image.
void ck_image_copy(const ck_image* image, uint8_t* destination);
/// Frees the image; null does nothing.
void ck_image_free(ck_image* image);

/// What a HEIF file says of its primary image, turned upright.
typedef struct {
  int32_t width;
  int32_t height;
  bool has_alpha;
} ck_heif_info;

/// What else a HEIF file holds: EXIF data from its TIFF header on, an ICC profile.
typedef enum { ck_heif_exif = 0, ck_heif_color_profile = 1 } ck_heif_block;

/// Reads the header of a HEIF file (ISO/IEC 23008-12: HEIC, AVIF).
ck_status ck_heif_inspect(const uint8_t* bytes, size_t byte_count, ck_heif_info* info);

/// Reads a block; no bytes where the file has none.
ck_status ck_heif_read(const uint8_t* bytes, size_t byte_count, ck_heif_block which,
                       ck_bytes** block);

/// How a HEIC file is written.
typedef struct {
  /// 0…100.
  int32_t quality;
  /// As in EXIF, 1…8: how the pixels are to be turned.
  int32_t orientation;
  /// EXIF data from its TIFF header on, or null.
  const uint8_t* exif;
  size_t exif_count;
  /// An ICC profile, or null.
  const uint8_t* color_profile;
  size_t color_profile_count;
} ck_heif_options;

/// Encodes RGB or RGBA as HEIC. Fails with `ck_invalid_argument` where libheif has no encoder.
ck_status ck_heif_encode(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels,
                         const ck_heif_options* options, ck_bytes** encoded);

/// The colours that camera and program may have meant.
typedef enum {
  /// Those of an ICC profile.
  ck_colors_icc = 0,
  /// Adobe RGB (1998).
  ck_colors_adobe_rgb = 1,
} ck_colors;

/// Converts RGB pixels in place to sRGB (IEC 61966-2-1), by relative colorimetry; out of its gamut
/// they are clipped. Nothing changes where the colours are sRGB's up to two steps of 255, or the
/// profile is damaged or not one of RGB.
ck_status ck_image_convert_to_srgb(uint8_t* pixels, size_t pixel_count, ck_colors colors,
                                   const uint8_t* profile, size_t profile_count);

/// Inflates a zlib stream of at most `maximum` bytes.
ck_status ck_inflate(const uint8_t* bytes, size_t byte_count, size_t maximum, ck_bytes** inflated);

/// Encodes gray, RGB or RGBA (JPEG: gray or RGB). `quality` is 0…100, JPEG only.
ck_status ck_image_encode(const uint8_t* pixels, int32_t width, int32_t height, int32_t channels,
                          ck_codec codec, int32_t quality, ck_bytes** encoded);

/// How many bytes there are.
size_t ck_bytes_count(const ck_bytes* bytes);
/// Copies all bytes.
void ck_bytes_copy(const ck_bytes* bytes, uint8_t* destination);
/// Frees the bytes; null does nothing.
void ck_bytes_free(ck_bytes* bytes);

/// Resizes: area averages where it shrinks, linear where it grows.
ck_status ck_image_resize(const uint8_t* source, int32_t width, int32_t height, int32_t channels,
                          uint8_t* destination, int32_t destination_width,
                          int32_t destination_height);

/// Turns stored pixels upright by EXIF orientation 1…8. `destination` holds as many bytes as the
/// source; orientations 5…8 swap width and height.
ck_status ck_image_turn(const uint8_t* source, int32_t width, int32_t height, int32_t channels,
                        int32_t orientation, uint8_t* destination);

/// Resamples (bicubic) what `source_camera` saw as `destination_camera`, which has no distortion.
/// Pixels without source repeat the border. Both images have `channels` channels and the size of
/// their camera.
ck_status ck_image_undistort(const uint8_t* source, const ck_camera* source_camera,
                             int32_t channels, uint8_t* destination,
                             const ck_camera* destination_camera);

/// Gives each pixel of a gray image the largest value of the square around it that reaches `radius`
/// pixels to each side.
ck_status ck_image_dilate(const uint8_t* source, int32_t width, int32_t height, int32_t radius,
                          uint8_t* destination);

/// How much of the gradient energy of a gray image's textured parts a slight blur takes away, in
/// the direction that loses least: about 0.2 for a blurred photo, 1.5 and more for a sharp one.
///
/// Degenerate for an image that shows nothing.
ck_status ck_image_sharpness(const uint8_t* gray, int32_t width, int32_t height, double* sharpness);

#ifdef __cplusplus
}
#endif
#endif
