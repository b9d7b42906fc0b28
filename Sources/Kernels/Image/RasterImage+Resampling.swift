import CKernels
import SceneModel

extension RasterImage {
  /// The image resampled to another size: area averaging where it shrinks, bilinear where it grows.
  package func resized(width newWidth: Int, height newHeight: Int) throws -> RasterImage {
    guard newWidth != width || newHeight != height else { return self }
    var result = RasterImage(width: newWidth, height: newHeight, channels: channels)
    try withKernel(KernelControl()) { _ in
      withKernelPixels { source in
        result.withMutableKernelPixels { ck_image_resize(source, $0) }
      }
    }
    return result
  }

  /// The stored image rotated upright according to its EXIF orientation 1…8.
  package func turned(byOrientation orientation: Int) throws -> RasterImage {
    guard orientation != 1 else { return self }
    let swaps = orientation >= 5
    var result = RasterImage(
      width: swaps ? height : width, height: swaps ? width : height, channels: channels)
    try withKernel(KernelControl()) { _ in
      withKernelPixels { source in
        result.withMutableKernelPixels { ck_image_orient(source, Int32(orientation), $0) }
      }
    }
    return result
  }

  /// Resamples this image, taken with `camera`, as seen by `pinhole`, which has no distortion.
  ///
  /// Bicubic; pixels outside the source repeat its border.
  package func undistorted(from camera: Camera, to pinhole: Camera) throws -> RasterImage {
    guard camera.width == width, camera.height == height else {
      throw KernelError.invalidArgument("the camera does not have the image's size")
    }
    guard pinhole.width > 0, pinhole.height > 0 else {
      throw KernelError.invalidArgument("the pinhole camera has no pixels")
    }
    var result = RasterImage(width: pinhole.width, height: pinhole.height, channels: channels)
    var (source, destination) = (ck_camera(camera), ck_camera(pinhole))
    try withKernel(KernelControl()) { _ in
      withKernelPixels { pixels in
        result.withMutableKernelPixels { ck_image_undistort(pixels, &source, &destination, $0) }
      }
    }
    return result
  }

  /// Dilation of a gray image: each pixel becomes the maximum of the square that extends `radius`
  /// pixels to each side.
  package func dilated(by radius: Int) throws -> RasterImage {
    guard channels == 1 else { throw KernelError.invalidArgument("the image is not gray") }
    guard radius > 0 else { return self }
    var result = RasterImage(width: width, height: height, channels: 1)
    try withKernel(KernelControl()) { _ in
      withKernelPixels { source in
        result.withMutableKernelPixels { ck_image_dilate(source, Int32(clamping: radius), $0) }
      }
    }
    return result
  }

  /// Luma with the Rec. 601 weights; a gray image is returned unchanged.
  package var gray: RasterImage {
    guard channels >= 3 else { return self }
    var result = RasterImage(width: width, height: height, channels: 1)
    for index in result.pixels.indices {
      let at = index * channels
      let sum = 299 * Int(pixels[at]) + 587 * Int(pixels[at + 1]) + 114 * Int(pixels[at + 2])
      result.pixels[index] = UInt8((sum + 500) / 1000)
    }
    return result
  }

  /// The sharpness of the textured parts of a gray image, independent of their content.
  ///
  /// The gradient energy that a slight blur (σ 1.5 pixels) removes, relative to what it leaves, in
  /// the direction with the smallest loss, so that motion blur counts: about 0.2 for a blurred
  /// photo, and 1.5 or more for a sharp one of a megapixel. Comparing a photo with a blurred
  /// version of itself follows Crete et al., "The blur effect", SPIE 2007.
  package func sharpness() throws -> Double {
    guard channels == 1 else { throw KernelError.invalidArgument("the image is not gray") }
    var result = 0.0
    try withKernel(KernelControl()) { _ in
      withKernelPixels { ck_image_sharpness($0, &result) }
    }
    return result
  }
}
