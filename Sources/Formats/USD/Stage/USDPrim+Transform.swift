import SceneModel

extension USDPrim {
  /// The transform by its `xformOp` attributes, in the order of `xformOpOrder`: `parentFromPrim`,
  /// and whether it ignores the transforms of the parents.
  var transform: (map: NodeTransform, isReset: Bool) {
    var (map, isReset) = (NodeTransform.identity, false)
    guard case .tokenArray(let order) = value("xformOpOrder") else { return (map, isReset) }
    for entry in order {
      if entry == "!resetXformStack!" {
        (map, isReset) = (.identity, true)
        continue
      }
      let isInverse = entry.hasPrefix("!invert!")
      let name = isInverse ? String(entry.dropFirst("!invert!".count)) : entry
      let parts = name.split(separator: ":")
      guard parts.count >= 2, parts[0] == "xformOp", let value = value(name),
        let step = Self.operation(parts[1], value)
      else { continue }
      map = map * (isInverse ? step.inverse ?? .identity : step)
    }
    return (map, isReset)
  }

  private static func operation(_ kind: Substring, _ value: USDValue) -> NodeTransform? {
    if case .matrix4(let elements) = value, kind == "transform" {
      return NodeTransform(elements: elements)
    }
    if let number = value.number, let axis = kind.last.flatMap({ unitVector($0) }) {
      switch kind.dropLast() {
      case "rotate": return rotation(number, axis)
      case "translate": return .translation(number * axis)
      case "scale": return .scale(SIMD3(1, 1, 1) + (number - 1) * axis)
      default: return nil
      }
    }
    guard let v = value.vector, v.count >= 3 else { return nil }
    switch kind {
    case "translate": return .translation([v[0], v[1], v[2]])
    case "scale": return .scale([v[0], v[1], v[2]])
    case "orient" where v.count == 4:
      return .rotation(Quaternion(x: v[0], y: v[1], z: v[2], w: v[3]))
    case _ where kind.hasPrefix("rotate") && kind.count == 9:
      // The first axis of the name is applied first.
      return kind.dropFirst(6).reduce(NodeTransform.identity) { result, axis in
        guard let unit = unitVector(axis) else { return result }
        return rotation(v[0] * unit.x + v[1] * unit.y + v[2] * unit.z, unit) * result
      }
    default: return nil
    }
  }

  private static func unitVector(_ axis: Character) -> SIMD3<Double>? {
    switch axis {
    case "X": [1, 0, 0]
    case "Y": [0, 1, 0]
    case "Z": [0, 0, 1]
    default: nil
    }
  }

  private static func rotation(_ degrees: Double, _ axis: SIMD3<Double>) -> NodeTransform {
    .rotation(Quaternion(angle: degrees * .pi / 180, axis: axis))
  }
}
