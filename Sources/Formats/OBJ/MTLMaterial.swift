import SceneModel

/// What a material of an MTL file means for the base color.
struct MTLMaterial: Equatable {
  /// The path of the texture, as in the file.
  var texture: String?
  /// The diffuse color, as in the file; viewers show it as sRGB.
  var diffuse: SIMD3<Float>?

  /// The materials of an untrusted MTL file, by name.
  static func materials(_ bytes: [UInt8]) -> [String: MTLMaterial] {
    var lines = TextLines(bytes)
    var result: [String: MTLMaterial] = [:]
    var name: String?
    while !lines.isAtEnd {
      switch lines.word()?.lowercased() {
      case "newmtl":
        let new = lines.rest()
        result[new] = MTLMaterial()
        name = new
      case "kd":
        if let name, let r = lines.number(), let g = lines.number(), let b = lines.number() {
          result[name]?.diffuse = [Float(r), Float(g), Float(b)]
        }
      case "map_kd":
        if let name { result[name]?.texture = file(lines.rest()) }
      default: break
      }
      lines.skipLine()
    }
    return result
  }

  /// The path of a texture after its options; it may contain spaces.
  private static func file(_ text: String) -> String? {
    /// The numbers of values of the options; those of some may be fewer.
    let options = [
      "-blendu": 1, "-blendv": 1, "-cc": 1, "-clamp": 1, "-imfchan": 1, "-texres": 1, "-bm": 1,
      "-boost": 1, "-mm": 2, "-o": 3, "-s": 3, "-t": 3, "-type": 1,
    ]
    var rest = Substring(text)
    while let word = rest.split(separator: " ", maxSplits: 1).first,
      let count = options[word.lowercased()]
    {
      rest = rest.dropFirst(word.count).drop { $0 == " " }
      for index in 0..<count {
        guard let value = rest.split(separator: " ", maxSplits: 1).first else { break }
        // Vectors may be shorter.
        if count == 3, index > 0, Double(value) == nil { break }
        rest = rest.dropFirst(value.count).drop { $0 == " " }
      }
    }
    return rest.isEmpty ? nil : String(rest)
  }
}
