/// An acceleration along the device's axes, in units of standard gravity (9.81 m/s²).
public struct CMAcceleration: Hashable, Sendable {
  /// Along the x axis.
  public var x: Double
  /// Along the y axis.
  public var y: Double
  /// Along the z axis.
  public var z: Double

  /// Creates a zero acceleration.
  public init() { self.init(x: 0, y: 0, z: 0) }

  /// Creates an acceleration from its components.
  public init(x: Double, y: Double, z: Double) {
    (self.x, self.y, self.z) = (x, y, z)
  }
}
