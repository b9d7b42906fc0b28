import Foundation
import Kernels
import SceneModel

/// The volume that most masks agree on (visual hull; Laurentini, PAMI 1994), on a grid of cubes.
struct VisualHull: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Number of cubes along the longest side of the box. Chosen.
    var resolution = 96
    /// The share of the photos with a cube in their frame whose masks must contain it. Chosen.
    var minimumShare = 0.85
    /// The box is larger than that of the object's points by this share of its diagonal. Chosen.
    var margin = 0.08

    init() {}
  }

  /// The cubes on the surface of the hull, as discs that cover them.
  let discs: Discs

  /// The hull of the masks of `views` around the object's points.
  init(
    of views: [MaskingView], masks: [RasterImage], around points: [SIMD3<Float>],
    options: Options, _ control: KernelControl
  ) throws {
    let grid = Grid(around: points, options)
    let (centers, side) = (grid.centers, grid.side)
    // Masks are dilated by a pixel, so that rounding does not erode thin parts.
    let threads = control.threadCount
    let votes = try control.parallelMap(threads) { part in
      var votes = MaskVotes(centers)
      for index in stride(from: part, to: views.count, by: threads) {
        let photo = views[index].photo
        try votes.add(masks[index].dilated(by: 1), of: photo.camera, at: photo.cameraFromWorld)
      }
      return votes
    }
    var sum = MaskVotes(centers)
    votes.forEach { sum.add($0) }
    let isInside = centers.indices.map {
      sum.seen[$0] > 0 && Double(sum.inside[$0]) >= options.minimumShare * Double(sum.seen[$0])
    }
    let inside = grid.surface(of: isInside)
    discs = Discs(
      positions: inside.map { centers[$0] },
      // Half the diagonal of a cube: the discs leave no gaps.
      radii: [Float](repeating: 0.867 * side, count: inside.count),
      labels: [UInt8](repeating: PointLabel.object, count: inside.count))
  }

  /// The outline of the hull in a photo: 255 inside.
  func silhouette(in view: MaskingView, _ control: KernelControl) throws -> RasterImage {
    try discs.drawn(by: view.photo.camera, at: view.photo.cameraFromWorld, control)
      .marking { $0 != 0 }
  }

  /// The cubes, x fastest.
  private struct Grid {
    var size = [0, 0, 0]
    /// Side of a cube in world units.
    var side: Float = 0
    var centers: [SIMD3<Float>] = []

    init(around points: [SIMD3<Float>], _ options: Options) {
      guard let bounds = Mesh(positions: points).bounds else { return }
      let margin = Float(options.margin) * (bounds.max - bounds.min).length
      let low = bounds.min - SIMD3(repeating: margin)
      let extent = bounds.max + SIMD3(repeating: margin) - low
      side = extent.max() / Float(options.resolution)
      guard side > 0, side.isFinite else { return }
      size = (0..<3).map { Int((extent[$0] / side).rounded(.up)) }
      centers.reserveCapacity(size.reduce(1, *))
      for z in 0..<size[2] {
        for y in 0..<size[1] {
          for x in 0..<size[0] {
            centers.append(low + side * (SIMD3(Float(x), Float(y), Float(z)) + 0.5))
          }
        }
      }
    }

    /// The cubes inside with a face at the border of the grid or at a cube outside.
    func surface(of isInside: [Bool]) -> [Int] {
      let strides = [1, size[0], size[0] * size[1]]
      return isInside.indices.filter { cube in
        guard isInside[cube] else { return false }
        return (0..<3).contains { axis in
          let position = cube / strides[axis] % size[axis]
          return position == 0 || position == size[axis] - 1
            || !isInside[cube - strides[axis]] || !isInside[cube + strides[axis]]
        }
      }
    }
  }
}
