import Kernels
import SceneModel

/// Finds the backdrop of a photo: black velvet, a white sweep, colored paper or a plain wall.
///
/// A backdrop is the smooth region of one color, or of a few as of a table and a wall, that most of
/// the photo's border has, as far as it is connected to the border. A textured support is none: it
/// is reconstructed and separated as a surface.
struct BackdropDetection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Width of the border, as a share of the photo's shorter side. Chosen.
    var borderWidth = 0.02
    /// Colors whose channels differ by at most this from the backdrop's belong to it, 0…255.
    /// Chosen.
    var tolerance = 24
    /// Maximum number of colors, and the share of the smooth border that each must have. Chosen.
    var maximumColors = 3
    var minimumColorShare = 0.1
    /// Maximum range of the luma in a window of three by three pixels, 0…255. Chosen.
    var maximumRange: UInt8 = 6
    /// The share of the border that must be smooth and have a color of the backdrop. Measured: with
    /// these limits, 0.9 for black velvet (dinoRing, templeSparse) and a white board (axe), and 0.7
    /// for a pale, faintly textured table (boot).
    var minimumBorderShare = 0.8
    /// The share of the photos that must show a backdrop. Chosen.
    var minimumPhotoShare = 0.8

    init() {}
  }

  var options = Options()

  struct Result: Sendable {
    /// The backdrop of each photo: 255 where it is visible, 0 elsewhere; empty in a photo without.
    var masks: [RasterImage]
    /// Its mean RGB color, 0…255.
    var color: SIMD3<Float>
  }

  /// Nil if too few photos show a backdrop.
  func run(_ photos: [RasterImage], _ control: KernelControl) throws -> Result? {
    let found = try control.parallelMap(photos.count) { try backdrop(of: photos[$0]) }
    let count = found.count { $0 != nil }
    guard count > 0, Double(count) >= options.minimumPhotoShare * Double(photos.count) else {
      return nil
    }
    let masks = zip(photos, found).map {
      $1 ?? RasterImage(width: $0.width, height: $0.height, channels: 1)
    }
    return Result(masks: masks, color: meanColor(of: photos, where: masks))
  }

  private func meanColor(of photos: [RasterImage], where masks: [RasterImage]) -> SIMD3<Float> {
    var (sum, count) = (SIMD3<Int>(), 0)
    for (photo, mask) in zip(photos, masks) {
      for pixel in mask.pixels.indices where mask.pixels[pixel] != 0 {
        for channel in 0..<3 { sum[channel] += Int(photo.pixels[3 * pixel + channel]) }
        count += 1
      }
    }
    return SIMD3<Float>(sum) / Float(max(1, count))
  }

  /// The backdrop of a photo; nil if it shows none.
  private func backdrop(of photo: RasterImage) throws -> RasterImage? {
    let border = border(of: photo)
    let isSmooth = try photo.gray.smoothPixels(maximumRange: options.maximumRange)
    let colors = colors(of: photo) { border[$0] && isSmooth[$0] }
    let isPlain = (0..<photo.width * photo.height).map { pixel in
      isSmooth[pixel] && colors.contains { isSimilar(photo, pixel, to: $0) }
    }
    let marked = border.indices.filter { border[$0] && isPlain[$0] }
    let borderCount = border.count { $0 }
    guard Double(marked.count) >= options.minimumBorderShare * Double(borderCount) else {
      return nil
    }
    return connected(marked, where: isPlain, width: photo.width, height: photo.height)
  }

  /// The colors that the selected pixels have, the most frequent one first.
  private func colors(of photo: RasterImage, where isSelected: (Int) -> Bool) -> [SIMD3<Int>] {
    let selected = (0..<photo.width * photo.height).filter(isSelected)
    var (rest, result) = (selected, [SIMD3<Int>]())
    while result.count < options.maximumColors {
      let isRest = Set(rest)
      var histogram = ColorHistogram()
      histogram.add(photo) { isRest.contains($0) }
      let smoothed = histogram.probabilities(unseenShare: 0)
      guard let peak = smoothed.indices.max(by: { smoothed[$0] < smoothed[$1] }) else { break }
      let color = ColorHistogram.color(ofBin: peak)
      let others = rest.filter { !isSimilar(photo, $0, to: color) }
      let found = rest.count - others.count
      guard found > 0, Double(found) >= options.minimumColorShare * Double(selected.count) else {
        break
      }
      result.append(color)
      rest = others
    }
    return result
  }

  private func isSimilar(_ photo: RasterImage, _ pixel: Int, to color: SIMD3<Int>) -> Bool {
    (0..<3).allSatisfy {
      abs(Int(photo.pixels[3 * pixel + $0]) - color[$0]) <= options.tolerance
    }
  }

  /// Whether each pixel belongs to the border.
  private func border(of photo: RasterImage) -> [Bool] {
    let width = max(1, Int(options.borderWidth * Double(min(photo.width, photo.height))))
    return (0..<photo.width * photo.height).map { pixel in
      let (x, y) = (pixel % photo.width, pixel / photo.width)
      return min(x, y, photo.width - 1 - x, photo.height - 1 - y) < width
    }
  }

  /// The pixels with the property that are connected to the seeds, which have it (4-neighborhood).
  private func connected(
    _ seeds: [Int], where hasProperty: [Bool], width: Int, height: Int
  ) -> RasterImage {
    var result = RasterImage(width: width, height: height, channels: 1)
    var open = seeds
    for seed in seeds { result.pixels[seed] = 255 }
    while let pixel = open.popLast() {
      let (x, y) = (pixel % width, pixel / width)
      for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
        let (u, v) = (x + dx, y + dy)
        guard u >= 0, v >= 0, u < width, v < height else { continue }
        let next = v * width + u
        if hasProperty[next], result.pixels[next] == 0 {
          result.pixels[next] = 255
          open.append(next)
        }
      }
    }
    return result
  }
}
