import Foundation
import SceneModel

/// Makes points that close an object where it stood on its support, which no photo sees.
///
/// Without them a Poisson surface closes the underside with a blob. The contact is what the lowest
/// part of the object encloses on the support, less where the support itself is seen.
struct BaseClosing {
  struct Options: Hashable, Codable, Sendable {
    /// What stands lower than one of these shares of the object's height outlines the contact: the
    /// lowest that encloses most of what the highest does, so that overhangs are left out.
    var outlineHeights = [0.03, 0.05, 0.08, 0.11, 0.15]
    /// How much of it, as share of the area.
    var enclosedShare = 0.5
    /// Gaps of the outline up to this share of the object's width are closed.
    var closing = 0.2

    init() {}
  }

  var options = Options()

  struct Result: Sendable {
    /// On the support, in the spacing of the samples; their normals point down.
    var points: [SIMD3<Float>] = []
    /// What is lower than this above the support is of the base.
    var height = 0.0
  }

  /// `object` is averaged with a spacing of `cell`; `scene` are all points, of which some may lie
  /// on the support.
  func run(
    object: PointCloud, scene: [SIMD3<Float>], support: StandingPlane, cell: Double
  ) -> Result {
    let heights = object.positions.map { support.height(of: SIMD3<Double>($0)) }
    guard let top = heights.quantile(0.99), top > 4 * support.band else { return Result() }
    let limits = options.outlineHeights.map { max(3 * support.band, $0 * top) }
    guard let highest = limits.last else { return Result() }
    let low = object.positions.indices.filter { heights[$0] < highest }
    guard
      var grid = SupportGrid(
        low.map { object.positions[$0] }, support, cell: max(1.5 * cell, 0.5 * support.band),
        closing: options.closing)
    else { return Result() }
    for position in scene where abs(support.height(of: SIMD3<Double>(position))) < support.band {
      grid.markSupport(position)
    }
    let contacts = limits.map { limit in
      grid.contact(
        under: low.filter { heights[$0] < limit }.map { object.positions[$0] })
    }
    let areas = contacts.map { $0.reduce(0) { $1 ? $0 + 1 : $0 } }
    let wanted = options.enclosedShare * Double(areas.last ?? 0)
    guard let index = areas.firstIndex(where: { Double($0) >= wanted }) else { return Result() }
    return Result(
      points: grid.points(contacts[index], spacing: cell), height: limits[index] + support.band)
  }
}

/// A grid on the support plane.
private struct SupportGrid {
  private let margin: Double
  private let width: Int
  private let height: Int
  private let plane: StandingPlane
  private let (u, v): (SIMD3<Double>, SIMD3<Double>)
  private let origin: SIMD2<Double>
  private let cell: Double
  private var isSupport: [Bool]

  /// Nil where the points don't span an area or span too large a one.
  init?(
    _ points: [SIMD3<Float>], _ plane: StandingPlane, cell: Double, closing: Double
  ) {
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
    self.cell = max(cell, extent / 800)
    margin = (extent / self.cell * closing + 4).rounded(.up)
    origin = low - margin * self.cell
    width = Int((high.x - low.x) / self.cell + 2 * margin) + 1
    height = Int((high.y - low.y) / self.cell + 2 * margin) + 1
    isSupport = Array(repeating: false, count: width * height)
  }

  private func index(of position: SIMD3<Float>) -> Int? {
    let p = SIMD3<Double>(position)
    let x = ((p.dot(u) - origin.x) / cell).rounded(.down)
    let y = ((p.dot(v) - origin.y) / cell).rounded(.down)
    guard x >= 0, y >= 0, x < Double(width), y < Double(height) else { return nil }
    return Int(y) * width + Int(x)
  }

  mutating func markSupport(_ position: SIMD3<Float>) {
    if let index = index(of: position) { isSupport[index] = true }
  }

  /// The cells that an outline with gaps encloses and where no support is seen.
  func contact(under outline: [SIMD3<Float>]) -> [Bool] {
    var mask = [Bool](repeating: false, count: width * height)
    for position in outline {
      if let index = index(of: position) { mask[index] = true }
    }
    let radius = max(2, Int(margin) - 3)
    mask = filled(Self.dilated(mask, width, height, radius))
    mask = Self.dilated(mask.map { !$0 }, width, height, radius).map { !$0 }
    return zip(mask, isSupport).map { $0 && !$1 }
  }

  /// The mask with the holes that it encloses.
  private func filled(_ mask: [Bool]) -> [Bool] {
    var isOutside = [Bool](repeating: false, count: mask.count)
    var stack = [0]
    isOutside[0] = true
    while let index = stack.popLast() {
      let (x, y) = (index % width, index / width)
      for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
        let (nx, ny) = (x + dx, y + dy)
        guard nx >= 0, ny >= 0, nx < width, ny < height else { continue }
        let next = ny * width + nx
        if !isOutside[next], !mask[next] {
          isOutside[next] = true
          stack.append(next)
        }
      }
    }
    return isOutside.map { !$0 }
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

  /// Points on the plane, `spacing` apart, in the cells of a mask.
  func points(_ mask: [Bool], spacing: Double) -> [SIMD3<Float>] {
    var points: [SIMD3<Float>] = []
    let foot = plane.offset * plane.normal
    let per = max(1, Int((cell / spacing).rounded()))
    for y in 0..<height {
      for x in 0..<width where mask[y * width + x] {
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
