import SceneModel

/// Values that vary over a mesh.
struct USDPrimvar<Value> {
  /// The numbers of elements of a mesh.
  struct Domain {
    var points: Int
    var faces: Int
    var corners: Int
  }

  private enum Interpolation: String { case constant, uniform, varying, vertex, faceVarying }

  private let values: [Value]
  private let indices: [Int32]?
  private let interpolation: Interpolation

  /// Nil unless `property` has a valid value for every element. An interpolation that it lacks is
  /// derived from the number of values.
  init?(
    _ property: USDProperty?, indices: USDProperty?, on domain: Domain,
    values: (USDValue) -> [Value]?
  ) {
    guard let property, let content = property.value.flatMap(values), !content.isEmpty else {
      return nil
    }
    self.values = content
    if case .intArray(let list) = indices?.value, !list.isEmpty {
      guard list.allSatisfy({ content.indices.contains(Int($0)) }) else { return nil }
      self.indices = list
    } else {
      self.indices = nil
    }
    let count = self.indices?.count ?? content.count
    let name = property.metadata("interpolation")?.text
    interpolation =
      name.flatMap(Interpolation.init(rawValue:))
      ?? (count == domain.corners
        ? .faceVarying
        : count == domain.points ? .vertex : count == domain.faces ? .uniform : .constant)
    let needed =
      switch interpolation {
      case .constant: 1
      case .uniform: domain.faces
      case .varying, .vertex: domain.points
      case .faceVarying: domain.corners
      }
    guard count >= needed else { return nil }
  }

  /// The value at a corner of a face.
  func value(face: Int, corner: Int, point: Int) -> Value {
    let index =
      switch interpolation {
      case .constant: 0
      case .uniform: face
      case .varying, .vertex: point
      case .faceVarying: corner
      }
    return values[indices.map { Int($0[index]) } ?? index]
  }
}
