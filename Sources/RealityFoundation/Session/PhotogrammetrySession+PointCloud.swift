import SceneModel

extension PhotogrammetrySession {
  /// Colored points on the surface of the object.
  public struct PointCloud: Sendable {
    /// The points in no particular order.
    public let points: [Point]

    /// A point on the surface.
    public struct Point: Sendable {
      /// The position in the model's frame.
      public let position: SIMD3<Float>
      /// Red, green, blue and alpha.
      public let color: SIMD4<UInt8>
    }
  }
}

extension PhotogrammetrySession.PointCloud {
  init(_ cloud: SceneModel.PointCloud) {
    points = zip(cloud.positions, cloud.colors).map { Point(position: $0, color: SIMD4($1, 255)) }
  }
}
