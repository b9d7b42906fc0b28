import Foundation
import SceneModel

/// A cube around points, with coordinates of 16 bits.
struct UnitGrid {
  let origin: SIMD3<Float>
  let size: Float

  init(_ positions: [SIMD3<Float>]) {
    let bounds = Mesh(positions: positions).bounds ?? (.zero, .zero)
    let extent = (bounds.max - bounds.min).max()
    origin = bounds.min
    size = extent > 0 && extent.isFinite ? extent : 1
  }

  /// The coordinates of positions, 16 bits each.
  func data(_ positions: [SIMD3<Float>]) -> Data {
    var numbers: [UInt16] = []
    numbers.reserveCapacity(3 * positions.count)
    for position in positions {
      let unit = ((position - origin) / size).clamped(lowerBound: .zero, upperBound: .one)
      let scaled = (unit * 65535).rounded(.toNearestOrAwayFromZero)
      for axis in 0..<3 { numbers.append(UInt16(saturating: scaled[axis])) }
    }
    return Data(littleEndian: numbers)
  }
}
