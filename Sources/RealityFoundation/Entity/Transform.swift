/// A scale, then a rotation, then a translation.
@frozen public struct Transform: Hashable, Codable, Sendable {
  /// The factors along the axes.
  public var scale: SIMD3<Float>
  /// The rotation, a unit quaternion.
  public var rotation: simd_quatf
  /// The translation along the axes.
  public var translation: SIMD3<Float>

  /// The identity transform.
  public static let identity = Transform()

  /// Creates the identity transform.
  public init() {
    scale = SIMD3(repeating: 1)
    rotation = simd_quatf(ix: 0, iy: 0, iz: 0, r: 1)
    translation = .zero
  }

  /// Creates a transform from its parts.
  public init(
    scale: SIMD3<Float> = SIMD3<Float>(x: 1, y: 1, z: 1),
    rotation: simd_quatf = simd_quaternion(0, 0, 0, 1),
    translation: SIMD3<Float> = SIMD3<Float>(x: 0, y: 0, z: 0)
  ) {
    self.scale = scale
    self.rotation = rotation
    self.translation = translation
  }

  /// Decomposes a matrix without shear.
  ///
  /// A reflection becomes a negative scale along x; an axis of length zero loses its direction.
  public init(matrix: float4x4) {
    self.init()
    self.matrix = matrix
  }

  /// Creates a rotation from Euler angles in radians: roll about z, then pitch about x, then yaw
  /// about y, all about the fixed axes.
  public init(pitch x: Float = 0, yaw y: Float = 0, roll z: Float = 0) {
    self.init()
    rotation =
      simd_quatf(angle: y, axis: [0, 1, 0]) * simd_quatf(angle: x, axis: [1, 0, 0])
      * simd_quatf(angle: z, axis: [0, 0, 1])
  }

  /// The transform as a matrix for column vectors.
  public var matrix: float4x4 {
    get {
      let axes = float3x3(rotation)
      return float4x4(
        SIMD4(axes.columns.0 * scale.x, 0), SIMD4(axes.columns.1 * scale.y, 0),
        SIMD4(axes.columns.2 * scale.z, 0), SIMD4(translation, 1))
    }
    set {
      let columns = (0..<3).map { SIMD3(newValue[$0].x, newValue[$0].y, newValue[$0].z) }
      var lengths = SIMD3(length(columns[0]), length(columns[1]), length(columns[2]))
      if float3x3(columns).determinant < 0 { lengths.x.negate() }
      let fallback = matrix_identity_float3x3
      let axes = (0..<3).map { lengths[$0] == 0 ? fallback[$0] : columns[$0] / lengths[$0] }
      scale = lengths
      rotation = simd_quatf(float3x3(axes)).normalized
      translation = SIMD3(newValue[3].x, newValue[3].y, newValue[3].z)
    }
  }
}
