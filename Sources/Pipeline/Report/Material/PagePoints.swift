import Formats
import Foundation
import SceneModel

/// Points in 16 bits per coordinate, as the page shows them.
package struct PagePoints: Encodable, Sendable {
  /// The position is `origin` + `size` · coordinates / 65535.
  package var origin: SIMD3<Float>
  package var size: Float
  /// 16 bits each, little-endian.
  package var positions: Data
  /// RGB.
  package var colors: Data

  /// Chosen: 270 KB, and an even cover of the picture.
  static let maximumCount = 30_000

  /// Of more than `maximumCount` points, every nth; nil without points.
  init?(_ positions: [SIMD3<Float>], _ colors: [SIMD3<UInt8>]) {
    guard !positions.isEmpty else { return nil }
    let step = max(1, (positions.count + Self.maximumCount - 1) / Self.maximumCount)
    let chosen = stride(from: 0, to: positions.count, by: step).map { $0 }
    let points = chosen.map { positions[$0] }
    let grid = PositionGrid(points)
    (origin, size) = (grid.origin, grid.extent)
    self.positions = grid.data(points)
    self.colors = colors.count == positions.count ? Data(rgb: chosen.map { colors[$0] }) : Data()
  }
}

extension PositionGrid {
  /// The coordinates of positions, 16 bits each.
  func data(_ positions: [SIMD3<Float>]) -> Data {
    var numbers: [UInt16] = []
    numbers.reserveCapacity(3 * positions.count)
    for position in positions {
      let coordinates = coordinates(of: position)
      for axis in 0..<3 { numbers.append(coordinates[axis]) }
    }
    return Data(littleEndian: numbers)
  }
}

extension Data {
  /// Colors, one after the other.
  init(rgb colors: [SIMD3<UInt8>]) {
    var bytes: [UInt8] = []
    bytes.reserveCapacity(3 * colors.count)
    for color in colors { for channel in 0..<3 { bytes.append(color[channel]) } }
    self.init(bytes)
  }
}
