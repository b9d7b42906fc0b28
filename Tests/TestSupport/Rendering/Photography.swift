import Foundation
import Kernels
import SceneModel

/// Properties of the camera: its lens, and its automatic exposure from photo to photo.
package struct Photography: Sendable {
  /// Fraction of a pixel's light received by each of its four neighbors: the blur of a good lens.
  package var blur: Float = 0.08
  /// Exposures are distributed evenly up to this number of stops in both directions.
  package var exposureStops: Double = 0
  /// Red and blue drift by up to this fraction relative to green.
  package var whiteBalance: Double = 0
  /// Fraction of the light lost in the corners.
  package var vignetting: Double = 0

  package init() {}

  /// Linear channel gains of photo `index`.
  func gains(_ index: Int, seed: UInt64) -> SIMD3<Float> {
    // The golden ratio separates the values of neighboring photos.
    let place = (Double(index) * 0.618_033_988_749_895 + 0.31).truncatingRemainder(dividingBy: 1)
    var generator = SeededGenerator(seed: seed &* 7_368_787 &+ UInt64(index))
    let exposure = pow(2, exposureStops * (2 * place - 1))
    let drift = SIMD2(generator.uniform(), generator.uniform()) * 2 - 1
    let balance = SIMD3(1 + whiteBalance * drift.x, 1, 1 + whiteBalance * drift.y)
    return SIMD3<Float>(balance * exposure)
  }

  /// The fraction of the light that remains at a squared distance from the center, 1 in the
  /// corners.
  func falloff(_ squaredDistance: Double) -> Float { Float(1 - vignetting * squaredDistance) }
}

extension RenderedScene {
  /// A photo through a lens: one ray per pixel, and more at edges.
  func photo(
    _ index: Int, taken photography: Photography, _ control: KernelControl
  ) throws -> RasterImage {
    let width = camera.width
    let sights = try control.parallelMap(camera.height) { row in
      (0..<width).map {
        sight(through: SIMD2(Double($0), Double(row)) + 0.5, of: index)
      }
    }
    let light = try control.parallelMap(camera.height) { row in
      (0..<width).map { column in
        hasEdge(sights, row, column)
          ? average(row, column, index) : sights[row][column].radiance
      }
    }
    let gains = photography.gains(index, seed: seed)
    let rows = try control.parallelMap(camera.height) { row in
      developed(light, row, index, gains, photography)
    }
    return RasterImage(
      width: width, height: camera.height, channels: 3, pixels: rows.flatMap { $0 })
  }

  /// Whether a neighboring pixel shows another surface, another depth or different lighting.
  private func hasEdge(_ sights: [[Sight]], _ row: Int, _ column: Int) -> Bool {
    let center = sights[row][column]
    for y in max(0, row - 1)...min(sights.count - 1, row + 1) {
      for x in max(0, column - 1)...min(camera.width - 1, column + 1) {
        let other = sights[y][x]
        if other.surface != center.surface || other.isLit != center.isLit { return true }
        if center.surface < 0 { continue }
        if abs(other.depth - center.depth) > 0.01 * center.depth { return true }
        if other.normal.dot(center.normal) < 0.8 { return true }
      }
    }
    return false
  }

  private func average(_ row: Int, _ column: Int, _ index: Int) -> SIMD3<Float> {
    let side = max(3, samplesPerSide)
    var sum = SIMD3<Float>.zero
    for sample in 0..<side * side {
      let offset = SIMD2(Double(sample % side), Double(sample / side)) + 0.5
      let pixel = SIMD2(Double(column), Double(row)) + offset / Double(side)
      sum += sight(through: pixel, of: index).radiance
    }
    return sum / Float(side * side)
  }

  /// Applies lens, sensor and encoding to a row of light.
  private func developed(
    _ light: [[SIMD3<Float>]], _ row: Int, _ index: Int, _ gains: SIMD3<Float>,
    _ photography: Photography
  ) -> [UInt8] {
    var generator = SeededGenerator(
      seed: seed &* 1_000_003 &+ UInt64(index) &* 65_537 &+ UInt64(row))
    let (width, height) = (camera.width, camera.height)
    let middle = SIMD2(Double(width), Double(height)) / 2
    var pixels: [UInt8] = []
    pixels.reserveCapacity(width * 3)
    for column in 0..<width {
      let neighbors =
        light[max(0, row - 1)][column] + light[min(height - 1, row + 1)][column]
        + light[row][max(0, column - 1)] + light[row][min(width - 1, column + 1)]
      let sharp = light[row][column]
      let blurred = sharp + (neighbors - 4 * sharp) * photography.blur
      let place = SIMD2(Double(column), Double(row)) + 0.5 - middle
      let falloff = photography.falloff(place.squaredLength / middle.squaredLength)
      let noise = generator.normal3() * self.noise
      let linear = blurred * gains * falloff
      for channel in 0..<3 {
        let encoded = 255 * Self.encode(Double(linear[channel])) + noise[channel]
        pixels.append(UInt8(min(max(encoded.rounded(), 0), 255)))
      }
    }
    return pixels
  }
}
