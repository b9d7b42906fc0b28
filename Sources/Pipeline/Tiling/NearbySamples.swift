import Foundation
import Kernels
import SceneModel

/// The samples of a scene's surface in and around a tile: a point there belongs to the scene if one
/// of them is near enough.
struct NearbySamples: LargeUnitValue {
  private var positionData: Data
  private var reachData: Data

  /// The samples that points between the corners of a box may be near enough to.
  init(of samples: SampleBlocks, between corners: SampleBlocks.Corners) {
    var (positions, reaches): ([SIMD3<Float>], [Float]) = ([], [])
    samples.forEach(near: corners) { position, reach in
      positions.append(position)
      reaches.append(reach)
    }
    (positionData, reachData) = (Data(bytesOf: positions), Data(bytesOf: reaches))
  }

  /// Whether each of some points is near enough to the sample that is nearest to it.
  func reach(_ points: [SIMD3<Float>], _ control: KernelControl) throws -> [Bool] {
    let reaches = reachData.values(of: Float.self)
    let nearest = try NearestPoints(
      of: points, in: positionData.values(of: SIMD3<Float>.self), control)
    return zip(nearest.indices, nearest.distances).map { sample, distance in
      sample >= 0 && distance <= reaches[Int(sample)]
    }
  }
}
