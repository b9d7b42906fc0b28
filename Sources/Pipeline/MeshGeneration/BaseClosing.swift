import Foundation
import SceneModel

/// Makes points that close an object where it stood on its support, which no photo sees.
///
/// Without them a Poisson surface closes the underside with a blob. The contact is what the lowest
/// part of the object encloses on the support, less where the support itself is seen.
struct BaseClosing {
  struct Options: Hashable, Codable, Sendable {
    /// What stands lower than this share of the object's height outlines the contact.
    var outlineHeight = 0.15
    /// Gaps of the outline up to this share of the object's width are closed.
    var closing = 0.06

    init() {}
  }

  var options = Options()

  /// Points on `support` with normals down, in the spacing of `cell`.
  ///
  /// `object` is averaged; `seenSupport` are points of the scene that may lie on the support.
  func run(
    object: PointCloud, scene: [SIMD3<Float>], support: StandingPlane, cell: Double
  ) -> [SIMD3<Float>] {
    let heights = object.positions.map { support.height(of: SIMD3<Double>($0)) }
    guard let top = heights.quantile(0.99), top > 4 * support.band else { return [] }
    let limit = max(3 * support.band, options.outlineHeight * top)
    let low = object.positions.indices.filter { heights[$0] < limit }
    guard
      var grid = SupportGrid(
        low.map { object.positions[$0] }, support, cell: max(1.5 * cell, 0.5 * support.band))
    else { return [] }
    for index in low { grid.mark(object.positions[index], .object) }
    let width = Double(grid.width + grid.height) / 2 * options.closing
    grid.close(radius: max(2, min(40, Int(width.rounded(.up)))))
    for position in scene where abs(support.height(of: SIMD3<Double>(position))) < support.band {
      grid.mark(position, .support)
    }
    return grid.contact(spacing: cell)
  }
}

/// A grid on the support plane.
private struct SupportGrid {
  enum Content { case object, support }

  let width: Int
  let height: Int
  private let plane: StandingPlane
  private let (u, v): (SIMD3<Double>, SIMD3<Double>)
  private let origin: SIMD2<Double>
  private let cell: Double
  private var isObject: [Bool]
  private var supportCounts: [UInt16]

  /// Nil where the points don't span an area or span too large a one.
  init?(_ points: [SIMD3<Float>], _ plane: StandingPlane, cell: Double) {
    (u, v) = plane.normal.orthonormalPair
    self.plane = plane
    let (u, v) = (u, v)
    let flat = points.map { p in
      SIMD2(SIMD3<Double>(p).dot(u), SIMD3<Double>(p).dot(v))
    }
    guard let first = flat.first else { return nil }
    let low = flat.reduce(first, pointwiseMin)
    let high = flat.reduce(first, pointwiseMax)
    let extent = max(high.x - low.x, high.y - low.y)
    guard extent.isFinite, extent > 4 * cell else { return nil }
    self.cell = max(cell, extent / 1500)
    let margin = 44.0
    origin = low - margin * self.cell
    width = Int((high.x - low.x) / self.cell + 2 * margin) + 1
    height = Int((high.y - low.y) / self.cell + 2 * margin) + 1
    isObject = Array(repeating: false, count: width * height)
    supportCounts = Array(repeating: 0, count: width * height)
  }

  private func index(of position: SIMD3<Float>) -> Int? {
    let p = SIMD3<Double>(position)
    let x = ((p.dot(u) - origin.x) / cell).rounded(.down)
    let y = ((p.dot(v) - origin.y) / cell).rounded(.down)
    guard x >= 0, y >= 0, x < Double(width), y < Double(height) else { return nil }
    return Int(y) * width + Int(x)
  }

  mutating func mark(_ position: SIMD3<Float>, _ content: Content) {
    guard let index = index(of: position) else { return }
    switch content {
    case .object: isObject[index] = true
    case .support: supportCounts[index] = min(1000, supportCounts[index]) + 1
    }
  }

  /// Closes gaps of the outline and fills what it encloses.
  mutating func close(radius: Int) {
    isObject = Self.dilated(isObject, width, height, radius)
    fillHoles()
    isObject = Self.dilated(isObject.map { !$0 }, width, height, radius).map { !$0 }
  }

  private mutating func fillHoles() {
    var isOutside = [Bool](repeating: false, count: isObject.count)
    var stack = [0]
    isOutside[0] = true
    while let index = stack.popLast() {
      let (x, y) = (index % width, index / width)
      for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
        let (nx, ny) = (x + dx, y + dy)
        guard nx >= 0, ny >= 0, nx < width, ny < height else { continue }
        let next = ny * width + nx
        if !isOutside[next], !isObject[next] {
          isOutside[next] = true
          stack.append(next)
        }
      }
    }
    isObject = isOutside.map { !$0 }
  }

  /// Dilates by a square of side `2 · radius + 1`, by rows and columns.
  private static func dilated(_ mask: [Bool], _ width: Int, _ height: Int, _ radius: Int) -> [Bool]
  {
    func pass(_ source: [Bool], length: Int, lines: Int, step: Int, line: Int) -> [Bool] {
      var result = source
      for l in 0..<lines {
        var last = -radius - 1
        for i in 0..<length {
          if source[l * line + i * step] { last = i }
          if i - last <= radius { result[l * line + i * step] = true }
        }
        last = length + radius
        for i in (0..<length).reversed() {
          if source[l * line + i * step] { last = i }
          if last - i <= radius { result[l * line + i * step] = true }
        }
      }
      return result
    }
    let rows = pass(mask, length: width, lines: height, step: 1, line: width)
    return pass(rows, length: height, lines: width, step: width, line: 1)
  }

  /// Points on the plane, `spacing` apart, in the cells of the object where no support is seen.
  func contact(spacing: Double) -> [SIMD3<Float>] {
    var points: [SIMD3<Float>] = []
    let foot = plane.offset * plane.normal
    let per = max(1, Int((cell / spacing).rounded()))
    for y in 0..<height {
      for x in 0..<width where isObject[y * width + x] && supportCounts[y * width + x] < 1 {
        for k in 0..<per * per {
          let a = origin.x + cell * (Double(x) + (Double(k % per) + 0.5) / Double(per))
          let b = origin.y + cell * (Double(y) + (Double(k / per) + 0.5) / Double(per))
          points.append(SIMD3<Float>(foot + a * u + b * v))
        }
      }
    }
    return points
  }
}
