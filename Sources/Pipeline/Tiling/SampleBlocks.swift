import Kernels
import SceneModel

/// The samples of a scene in blocks of consecutive ones, which are near each other, so that those
/// near a tile are found without looking at all.
struct SampleBlocks: Sendable {
  /// What samples are near enough to.
  typealias Corners = (low: SIMD3<Double>, high: SIMD3<Double>)

  /// Samples of a block. Chosen: a block is small beside a tile, and blocks are few beside samples.
  private static let size = 256

  private let samples: SurfaceSamples
  private let reach: Float
  /// The box within reach of each block's samples.
  private let boxes: [Corners]

  /// A point is near enough to a sample within `reach` voxels.
  init(_ samples: SurfaceSamples, reach: Double, _ control: KernelControl) throws {
    let (positions, count, size) = (samples.cloud.positions, samples.cloud.count, Self.size)
    self.samples = samples
    self.reach = Float(reach)
    @Sendable func box(_ block: Int) -> Corners {
      let first = block * size
      var corners: Corners = (.init(repeating: .infinity), .init(repeating: -.infinity))
      for sample in first..<min(count, first + size) {
        let reach = Self.reach(of: sample, in: samples, Float(reach))
        corners.low = pointwiseMin(corners.low, SIMD3<Double>(positions[sample] - reach))
        corners.high = pointwiseMax(corners.high, SIMD3<Double>(positions[sample] + reach))
      }
      return corners
    }
    boxes = try control.parallelMap((count + size - 1) / size, inUnitsOf: 64) { $0.map(box) }
  }

  /// Calls `body` with each sample that points between the corners of a box may be near enough to,
  /// and with its reach in world units.
  func forEach(near box: Corners, _ body: (SIMD3<Float>, Float) -> Void) {
    for (block, corners) in boxes.enumerated() where Self.overlap(corners, box) {
      let first = block * Self.size
      for sample in first..<min(samples.cloud.count, first + Self.size) {
        let position = samples.cloud.positions[sample]
        let reach = Self.reach(of: sample, in: samples, reach)
        let own = (SIMD3<Double>(position - reach), SIMD3<Double>(position + reach))
        if Self.overlap(own, box) { body(position, reach) }
      }
    }
  }

  private static func reach(of sample: Int, in samples: SurfaceSamples, _ reach: Float) -> Float {
    reach * max(Float(samples.voxelSize), samples.cloud.footprints[sample])
  }

  private static func overlap(_ one: Corners, _ other: Corners) -> Bool {
    (0..<3).allSatisfy { one.high[$0] >= other.low[$0] && one.low[$0] <= other.high[$0] }
  }
}
