import Foundation
import Kernels
import SceneModel

/// Masks the sky in photos of a scene: it has no surface, but patches at roofs and trees would
/// extend into it.
///
/// Sky is a smooth and bright or blue region, mostly above the horizon, that reaches the top of a
/// photo and in which nothing was triangulated. A minimum cut between its colors and the others
/// finds its outline.
struct SkyDetection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum number of pixels of a mask. Chosen.
    var maximumPixels = 300_000
    /// Maximum range of the luma in a window of three by three pixels, 0…255. Measured: found on
    /// sceaux, saharov32 and lund (docs/experiments/2026-11-masks.md, Blur, concerns and sky).
    var maximumRange: UInt8 = 8
    /// Minimum sine of the elevation of a pixel; not 0, as the up direction is inaccurate. Chosen.
    var minimumElevation = -0.2
    /// Minimum area of a region, as a share of the photo. Chosen.
    var minimumArea = 0.005
    /// Maximum density of observations in a region, relative to that of the photo. Measured: that
    /// of sky is 0.025 at most in sceaux, saharov32 and lund.
    var maximumDensity = 0.05
    /// A region is bright if its mean luma is above this quantile of the photo's. Measured: found
    /// on sceaux, saharov32 and lund (docs/experiments/2026-11-masks.md, Blur, concerns and sky).
    var brightQuantile = 0.75
    /// A region is blue if blue exceeds red by this factor, and its luma the median. Measured: as
    /// above.
    var blueRatio: Float = 1.15
    /// Width of the band around a region in which the cut finds the outline, in pixels. Chosen.
    var band = 6
    /// Weight of the log-likelihood ratio of the colors. Chosen: as in `MaskEstimation`.
    var colorWeight: Float = 0.6
    var cut = ImageCut()
  }

  var options = Options()

  /// The masks of all that isn't sky; nil if no photo shows any, or if up isn't known.
  func run(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> ObjectMasking.Result? {
    guard reconstruction.worldFrame.up != .unknown else { return nil }
    let observations = reconstruction.observedPixels
    let photos = reconstruction.registered
    let masks = try context.control.parallelMap(photos.count) { index -> RasterImage? in
      let photo = try ReducedPhoto(
        photos[index], reconstruction,
        images.image(
          photos[index], maximumPixels: options.maximumPixels, isKept: false))
      let full = reconstruction.photos[photos[index].index]
      let scale = SIMD2(
        Double(photo.image.width) / Double(full.width),
        Double(photo.image.height) / Double(full.height))
      let seen = observations[photos[index].index].map { $0 * scale }
      guard
        let sky = try sky(
          in: photo, vertical: reconstruction.worldFrame.vertical, observations: seen)
      else { return nil }
      return try mask(of: photo.image, sky: sky)
    }
    context.notes.record("skyPhotos", Double(masks.count { $0 != nil }))
    guard masks.contains(where: { $0 != nil }) else { return nil }
    var result = ObjectMasking.Result(photoCount: reconstruction.photos.count)
    for (photo, mask) in zip(photos, masks) { result.masks[photo.index] = mask }
    return result
  }

  /// Marks the regions of sky, without their outline; nil without any.
  private func sky(
    in photo: ReducedPhoto, vertical: SIMD3<Double>, observations: [SIMD2<Double>]
  ) throws -> RasterImage? {
    let (width, height) = (photo.image.width, photo.image.height)
    let gray = photo.image.gray
    let up = photo.cameraFromWorld.rotation * vertical
    let isSmooth = try gray.smoothPixels(maximumRange: options.maximumRange)
    var isCandidate = [Bool](repeating: false, count: width * height)
    var isAboveHorizon = isCandidate
    for pixel in isSmooth.indices where isSmooth[pixel] {
      let center = SIMD2(Double(pixel % width) + 0.5, Double(pixel / width) + 0.5)
      let ray = photo.camera.unproject(center)
      let elevation = SIMD3(ray.x, ray.y, 1).normalized.dot(up)
      isCandidate[pixel] = elevation > options.minimumElevation
      isAboveHorizon[pixel] = elevation > 0
    }
    var counts = [Int32](repeating: 0, count: width * height)
    for seen in observations {
      let (x, y) = (min(width - 1, max(0, Int(seen.x))), min(height - 1, max(0, Int(seen.y))))
      counts[y * width + x] += 1
    }
    let density = Double(observations.count) / Double(width * height)
    var result = RasterImage(width: width, height: height, channels: 1)
    var isFound = false
    for region in regions(isCandidate, width: width, height: height, up: [up.x, up.y]) {
      let observed = region.reduce(0) { $0 + Int(counts[$1]) }
      guard Double(observed) <= options.maximumDensity * density * Double(region.count),
        2 * region.count(where: { isAboveHorizon[$0] }) > region.count,
        hasColorOfSky(region, photo.image, gray)
      else { continue }
      for pixel in region { result.pixels[pixel] = 255 }
      isFound = true
    }
    return isFound ? result : nil
  }

  /// The connected regions of candidates that are large enough and reach the top: the sides of the
  /// photo in the direction `up`.
  private func regions(
    _ isCandidate: [Bool], width: Int, height: Int, up: SIMD2<Double>
  ) -> [[Int]] {
    let isTop = { (x: Double, y: Double) in x * up.x + y * up.y > 0.5 * up.length }
    let sides = (left: isTop(-1, 0), right: isTop(1, 0), upper: isTop(0, -1), lower: isTop(0, 1))
    var isOpen = isCandidate
    var regions: [[Int]] = []
    for seed in isOpen.indices where isOpen[seed] {
      var (region, next, reachesTop) = ([seed], 0, false)
      isOpen[seed] = false
      func visit(_ neighbor: Int, isInside: Bool, orReaches side: Bool) {
        guard isInside else { return reachesTop = reachesTop || side }
        guard isOpen[neighbor] else { return }
        isOpen[neighbor] = false
        region.append(neighbor)
      }
      while next < region.count {
        let pixel = region[next]
        let (x, y) = (pixel % width, pixel / width)
        next += 1
        visit(pixel + 1, isInside: x + 1 < width, orReaches: sides.right)
        visit(pixel - 1, isInside: x > 0, orReaches: sides.left)
        visit(pixel + width, isInside: y + 1 < height, orReaches: sides.lower)
        visit(pixel - width, isInside: y > 0, orReaches: sides.upper)
      }
      if reachesTop, Double(region.count) >= options.minimumArea * Double(isCandidate.count) {
        regions.append(region)
      }
    }
    return regions
  }

  private func hasColorOfSky(_ region: [Int], _ image: RasterImage, _ gray: RasterImage) -> Bool {
    var sum = SIMD4<Float>()
    for pixel in region {
      let at = 3 * pixel
      sum += SIMD4(
        Float(image.pixels[at]), Float(image.pixels[at + 1]), Float(image.pixels[at + 2]),
        Float(gray.pixels[pixel]))
    }
    let mean = sum / Float(region.count)
    guard let median = gray.pixels.quantile(0.5),
      let bright = gray.pixels.quantile(options.brightQuantile)
    else { return false }
    return mean.w >= Float(bright) || mean.z > options.blueRatio * mean.x && mean.w >= Float(median)
  }

  /// The mask of all that isn't sky: 255 there, 0 on the sky.
  private func mask(of image: RasterImage, sky: RasterImage) throws -> RasterImage {
    var (skyColors, others) = (ColorHistogram(), ColorHistogram())
    let near = try sky.dilated(by: options.band)
    skyColors.add(image) { sky.pixels[$0] != 0 }
    others.add(image) { near.pixels[$0] == 0 }
    let ratios = zip(others.probabilities(), skyColors.probabilities()).map { other, sky in
      options.colorWeight * log(other / sky)
    }
    let odds = sky.pixels.indices.map { pixel -> Float in
      if sky.pixels[pixel] != 0 { return -options.cut.certainty }
      return near.pixels[pixel] == 0
        ? options.cut.certainty : ratios[ColorHistogram.bin(image, 3 * pixel)]
    }
    return try options.cut.mask(of: image, logOdds: odds, KernelControl())
  }
}

extension Reconstruction {
  /// The pixels at which each photo observes points, by photo ID.
  fileprivate var observedPixels: [[SIMD2<Double>]] {
    var pixels = [[SIMD2<Double>]](repeating: [], count: photos.count)
    for observation in points.flatMap(\.track) {
      pixels[observation.photo.index].append(observation.pixel)
    }
    return pixels
  }
}
