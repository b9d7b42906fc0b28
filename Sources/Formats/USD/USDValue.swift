import SceneModel

/// A value of a USD attribute or metadata field, limited to the storage types that models
/// use.
///
/// The role of a value (color, point, texture coordinate) is determined by the type name of its
/// attribute.
package indirect enum USDValue: Equatable, Sendable {
  case bool(Bool)
  case int(Int32)
  case float(Float)
  case double(Double)
  case token(String)
  case string(String)
  /// A path relative to the layer.
  case asset(String)
  case float2(SIMD2<Float>)
  case float3(SIMD3<Float>)
  /// Also a quaternion, with its components in the order x, y, z, w.
  case float4(SIMD4<Float>)
  case double3(SIMD3<Double>)
  /// The 16 elements in rows, for row vectors: the last row is the translation.
  case matrix4([Double])
  case tokenArray([String])
  case intArray([Int32])
  case floatArray([Float])
  case float2Array([SIMD2<Float>])
  case float3Array([SIMD3<Float>])
  case float4Array([SIMD4<Float>])
  /// Entries in the order of their keys.
  case dictionary([USDField])
  /// Prims whose content a prim includes.
  case references([USDReference])
}

/// A name-value pair: an entry of a dictionary or of a spec's metadata.
package struct USDField: Equatable, Sendable {
  package var name: String
  package var value: USDValue

  package init(_ name: String, _ value: USDValue) {
    self.name = name
    self.value = value
  }
}
