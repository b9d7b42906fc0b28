/// The texture maps of a material.
package enum TextureMap: String, Hashable, CaseIterable, Comparable, Codable, Sendable {
  case diffuseColor, normal, roughness, displacement, ambientOcclusion

  package static func < (lhs: Self, rhs: Self) -> Bool {
    allCases.firstIndex(of: lhs)! < allCases.firstIndex(of: rhs)!
  }
}
