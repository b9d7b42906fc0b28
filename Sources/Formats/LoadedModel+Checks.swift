import SceneModel

extension LoadedModel {
  /// The model without empty parts, with finite numbers and valid indices only. Throws a
  /// `FormatFault` if positions aren't finite, or if there is no triangle.
  func checked() throws -> LoadedModel {
    var result = self
    result.parts = try parts.filter { !$0.triangles.isEmpty }.map { try $0.checked() }
    guard !result.parts.isEmpty else { throw FormatFault("it contains no triangles") }
    let vertices = result.parts.reduce(0) { $0 + $1.positions.count }
    guard vertices < UInt32.max else { throw FormatFault("it has too many vertices") }
    return result
  }
}

extension LoadedModel.Part {
  fileprivate func checked() throws -> Self {
    guard positions.allSatisfy(\.isFinite) else { throw FormatFault("a vertex is not finite") }
    let count = positions.count
    guard triangles.allSatisfy({ max($0.a, $0.b, $0.c) < count }) else {
      throw FormatFault("a triangle refers to a vertex that does not exist")
    }
    var result = self
    if normals.count != count || !normals.allSatisfy(\.isFinite) { result.normals = [] }
    if colors.count != count { result.colors = [] }
    if textureCoordinates.count != count || !textureCoordinates.allSatisfy({ $0.sum().isFinite }) {
      result.textureCoordinates = []
    }
    return result
  }
}
