#if canImport(Pipeline)
  import RealityFoundation

  // Options as the words that give them: for a run in a process of its own, and to tell whether a
  // model was made with the same.

  extension DetailArguments {
    var words: [String] {
      var words = ["--detail", detail.defaultValueDescription]
      if let maxPolygons { words += ["--max-polygons", "\(maxPolygons)"] }
      if let textureSide { words += ["--texture-side", textureSide.rawValue] }
      if let maps { words += ["--maps", maps.text] }
      if let textureFormat { words += ["--texture-format", textureFormat.text] }
      return words
    }
  }

  extension TextureMapsArgument {
    fileprivate var text: String {
      let names: [(DetailArguments.Specification.TextureMapOutputs, String)] = [
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
    var words: [String] {
      [
        "--sample-ordering", sampleOrdering.rawValue,
        "--feature-sensitivity", featureSensitivity.rawValue,
      ]
    }
  }

  extension SurfaceArguments {
    var words: [String] { (keepGaps ? ["--keep-gaps"] : []) + (refine ? ["--refine"] : []) }
  }

  extension ShapeArguments {
    var words: [String] {
      let corners = crop.map { [$0.box.min, $0.box.max].flatMap { [$0.x, $0.y, $0.z] } }
      let box = corners.map { ["--crop", $0.map { "\($0)" }.joined(separator: ",")] } ?? []
      return box + (quads ? ["--quads"] : [])
    }
  }
#endif
