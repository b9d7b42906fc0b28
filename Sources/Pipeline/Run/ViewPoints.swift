import Foundation
import Kernels
import SceneModel

/// The sparse points that the photos of some consecutive views observe, for a process that works on
/// these.
struct ViewPoints: LargeUnitValue {
  /// Views in a file. Chosen: about as many as of a chunk, which reads one or two files.
  static let viewsPerFile = 32

  private var counts: [Int]
  private var positions: Data

  init(_ points: [[SIMD3<Double>]]) {
    counts = points.map(\.count)
    positions = Data(bytesOf: points.flatMap { $0.flatMap { [$0.x, $0.y, $0.z] } })
  }

  /// Nil if the content is malformed.
  var points: [[SIMD3<Double>]]? {
    let values = positions.values(of: Double.self)
    guard counts.allSatisfy({ $0 >= 0 }), 3 * counts.reduce(0, +) == values.count else {
      return nil
    }
    var next = 0
    return counts.map { count in
      defer { next += 3 * count }
      return (0..<count).map { point in
        let first = next + 3 * point
        return [values[first], values[first + 1], values[first + 2]]
      }
    }
  }

  /// The numbers of the files that have the points of some of `count` views.
  static func files(of views: Range<Int>) -> Range<Int> {
    views.isEmpty
      ? 0..<0 : views.lowerBound / viewsPerFile..<(views.upperBound - 1) / viewsPerFile + 1
  }

  /// The views of a file.
  static func views(of file: Int, count: Int) -> Range<Int> {
    file * viewsPerFile..<min(count, (file + 1) * viewsPerFile)
  }
}
