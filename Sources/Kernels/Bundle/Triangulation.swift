import CKernels

/// Triangulates tracks: robustly over pairs of rays, then by least squares of the reprojection
/// error.
package struct Triangulation: Sendable {
  /// Inlier criteria.
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum reprojection error of an inlier in pixels. Chosen: as in `IncrementalMapping`.
    package var maximumError = 4.0
    /// Minimum triangulation angle in radians. Chosen: as in `IncrementalMapping`.
    package var minimumAngle = 1.5 * Double.pi / 180

    package init() {}
  }

  /// The triangulated points.
  package struct Result: Sendable {
    /// The point of each track in the world frame; nil if its observations are inconsistent.
    package var positions: [SIMD3<Double>?]
    /// Whether each observation is consistent with its track's point.
    package var isInlier: [Bool]
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Triangulates all tracks with the given cameras and poses.
  package func run(
    _ tracks: TrackObservations, photos: PosedPhotos, control: KernelControl = KernelControl()
  ) throws -> Result {
    var positions = [SIMD3<Double>](repeating: .zero, count: tracks.count)
    var found = [UInt8](repeating: 0, count: tracks.count)
    var inliers = [UInt8](repeating: 0, count: tracks.observations.count)
    var rawOptions = ck_triangulation_options(
      maximum_error: options.maximumError, minimum_angle: options.minimumAngle)
    try withKernel(control) { control in
      tracks.withKernelValue { tracks in
        photos.withKernelValue { photos in
          positions.withMutableSpan {
            ck_triangulate(tracks, photos, &rawOptions, control, $0, &found, &inliers)
          }
        }
      }
    }
    return Result(
      positions: zip(positions, found).map { $1 != 0 ? $0 : nil },
      isInlier: inliers.map { $0 != 0 })
  }

  /// The reprojection error in pixels of each observation of its track's point (infinite behind the
  /// camera), and for each track the maximum angle in radians between two rays with an error of at
  /// most `maximumError`.
  package static func measure(
    _ tracks: TrackObservations, positions: [SIMD3<Double>], photos: PosedPhotos,
    maximumError: Double, control: KernelControl = KernelControl()
  ) throws -> (errors: [Double], angles: [Double]) {
    guard positions.count == tracks.count else {
      throw KernelError.invalidArgument("measuring tracks needs as many positions as tracks")
    }
    var errors = [Double](repeating: 0, count: tracks.observations.count)
    var angles = [Double](repeating: 0, count: tracks.count)
    try withKernel(control) { control in
      tracks.withKernelValue { tracks in
        photos.withKernelValue { photos in
          positions.withSpan {
            ck_measure_tracks(tracks, $0, photos, maximumError, control, &errors, &angles)
          }
        }
      }
    }
    return (errors, angles)
  }
}
