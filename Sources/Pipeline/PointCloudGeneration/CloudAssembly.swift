import Kernels
import SceneModel

/// Clouds that are appended to one, on two threads: with millions of points, new memory takes the
/// time.
final class CloudAssembly: Sendable {
  /// Positions and normals, which are about half of a cloud's bytes, and the other half.
  private let (surface, rest) = (Locked(PointCloud()), Locked(PointCloud()))

  /// Appends clouds, which have all that a point can have.
  func append(_ clouds: [PointCloud], _ control: KernelControl) throws {
    try beside(
      { [surface] in
        surface.withLock { all in
          for cloud in clouds {
            all.positions += cloud.positions
            all.normals += cloud.normals
          }
        }
      }, control
    ) {
      rest.withLock { all in
        for var cloud in clouds {
          (cloud.positions, cloud.normals) = ([], [])
          all.append(cloud)
        }
      }
    }
  }

  /// Reserves space for `factor` times as many points, but not for more than the maximum.
  func reserveCapacity(times factor: Double, atMost maximum: Int) {
    let count = surface.withLock(\.count)
    let points = min(Double(maximum), factor * Double(count))
    rest.withLock { rest in
      let photos = points * Double(rest.photoIndices.count) / Double(max(1, count))
      rest.reserveCapacity(points: Int(points), photos: Int(photos))
      (rest.positions, rest.normals) = ([], [])
    }
    surface.withLock {
      $0.positions.reserveCapacity(Int(points))
      $0.normals.reserveCapacity(Int(points))
    }
  }

  /// Removes and returns what was appended.
  func take() -> PointCloud {
    var cloud = rest.withLock { rest in
      defer { rest = PointCloud() }
      return rest
    }
    surface.withLock {
      (cloud.positions, cloud.normals) = ($0.positions, $0.normals)
      $0 = PointCloud()
    }
    return cloud
  }
}
