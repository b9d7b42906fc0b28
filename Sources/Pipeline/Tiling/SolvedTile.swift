import Foundation
import SceneModel

/// The function of a tile and its halo, before seams are adjusted, and the points that it comes
/// from; both are empty if there are too few.
struct SolvedTile: LargeUnitValue {
  var samples = PointCloud()
  /// An encoded `PoissonSolution`.
  var solution = Data()
}
