import Foundation
import Kernels
import SceneModel

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
    var generator = SplitMix64(
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
