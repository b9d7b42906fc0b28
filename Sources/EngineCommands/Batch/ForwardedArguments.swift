import RealityFoundation
import SharedCommands

// Options as command-line arguments, for the process of a dataset and to determine whether a model
// was made with the same options.

extension DetailArguments {
  var arguments: [String] {
    var arguments = ["--detail", detail.defaultValueDescription]
    if let maxPolygons { arguments += ["--max-polygons", "\(maxPolygons)"] }
    if let textureSide { arguments += ["--texture-side", textureSide.rawValue] }
    if let maps { arguments += ["--maps", maps.text] }
    if let textureFormat { arguments += ["--texture-format", textureFormat.text] }
    return arguments + (lod ? ["--lod"] : [])
  }
}

extension CompressionArguments {
  var arguments: [String] { compress ? ["--compress"] : [] }
}

extension TextureMapsArgument {
  fileprivate var text: String {
    let names: [(CustomDetail.TextureMapOutputs, String)] = [
      (.diffuseColor, "color"), (.normal, "normal"), (.roughness, "roughness"),
      (.displacement, "displacement"), (.ambientOcclusion, "occlusion"),
    ]
    return names.filter { outputs.isSuperset(of: $0.0) }.map(\.1).joined(separator: ",")
  }
}

extension TextureFormatArgument {
  fileprivate var text: String {
    switch format {
    case .png: "png"
    case .jpeg(let quality): "jpeg:\(quality)"
    }
  }
}

extension AlignmentArguments {
  var arguments: [String] {
    [
      "--sample-ordering", sampleOrdering.rawValue,
      "--feature-sensitivity", featureSensitivity.rawValue,
    ]
  }
}

extension SurfaceArguments {
  var arguments: [String] { (keepGaps ? ["--keep-gaps"] : []) + (refine ? ["--refine"] : []) }
}

extension UpArguments {
  // With an equals sign, since axes may start with a minus sign.
  var arguments: [String] { up.map { ["--up=\($0.direction.name)"] } ?? [] }
}

extension ShapeArguments {
  var arguments: [String] {
    let corners = crop.map { [$0.box.min, $0.box.max].flatMap { [$0.x, $0.y, $0.z] } }
    let box = corners.map { ["--crop", $0.map { "\($0)" }.joined(separator: ",")] } ?? []
    return box + (quads ? ["--quads"] : [])
  }
}
