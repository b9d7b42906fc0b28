/// A box rotated about its center.
public struct OrientedBoundingBox: Hashable, Sendable {
  /// The rotation about the center of the box.
  public var orientation: simd_quatf
  /// The box before the rotation.
  public var boundingBox: BoundingBox

  /// Creates a box from its rotation and its extent.
  public init(
    orientation: simd_quatf = simd_quatf(ix: 0, iy: 0, iz: 0, r: 1),
    boundingBox: BoundingBox = BoundingBox.empty
  ) {
    self.orientation = orientation
    self.boundingBox = boundingBox
  }
}
