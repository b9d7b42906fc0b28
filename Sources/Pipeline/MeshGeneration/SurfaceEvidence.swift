import Kernels
import SceneModel

/// What speaks for and against the faces of a reconstructed surface.
struct SurfaceEvidence {
  /// Centroids of the faces.
  let centers: [SIMD3<Float>]
  /// Whether the masks retain each face; nil without masks.
  var isInside: [Bool]?
  /// Whether each face was extrapolated below the support; nil without a support.
  let isBelowSupport: [Bool]?

  private let triangles: [Triangle]
  /// Each vertex's distance to the nearest sample, in units of that sample's spacing.
  private let distances: [Float]
  private let support: SupportPlane?
  private let isPointSeenThrough: (SIMD3<Float>) -> Bool

  /// `nearest` holds the sample nearest to each vertex; `spacing` is the minimum sample spacing, in
  /// world units; `isSeenThrough` indicates whether photos see through a point.
  init(
    _ mesh: Mesh, samples: PointCloud, nearest: NearestPoints, spacing: Double,
    support: SupportPlane?, isSeenThrough: @escaping (SIMD3<Float>) -> Bool
  ) {
    triangles = mesh.triangles
    let centers = mesh.triangles.map { mesh.center(of: $0) }
    self.centers = centers
    distances = zip(nearest.indices, nearest.distances).map { sample, distance in
      sample < 0 ? .infinity : distance / max(Float(spacing), samples.footprints[Int(sample)])
    }
    self.support = support
    isPointSeenThrough = isSeenThrough
    isBelowSupport = support.map { support in
      // Samples below show that the object extends below what was taken for its support.
      let isSampledBelow = nearest.indices.map {
        $0 >= 0
          && support.height(of: SIMD3<Double>(samples.positions[Int($0)])) < -support.band
      }
      return zip(mesh.triangles, support.heights(of: centers)).map { triangle, height in
        height < 0 && !triangle.vertices.contains { isSampledBelow[$0] }
      }
    }
  }

  /// The largest distance of the face's corners from the nearest sample, in spacings.
  func distance(of face: Int) -> Float {
    let triangle = triangles[face]
    return max(
      distances[Int(triangle.a)], distances[Int(triangle.b)], distances[Int(triangle.c)])
  }

  /// Whether photos see through the center of a face.
  func isSeenThrough(_ face: Int) -> Bool { isPointSeenThrough(centers[face]) }

  /// Whether a face is within the thickness of the support, where masks are uncertain.
  func isAtSupport(_ face: Int) -> Bool {
    guard let support else { return false }
    return support.height(of: SIMD3<Double>(centers[face])) < support.band
  }
}
