import Foundation
import SceneModel

/// Models as OBJ files, with their MTL files and textures.
enum OBJFile {
  /// The model in the text of an OBJ file, with the materials and textures in `files`. Throws a
  /// `FormatFault`.
  static func decode(_ bytes: [UInt8], files: RelatedFiles) throws -> LoadedModel {
    let content = try OBJContent(bytes)
    var materials: [String: MTLMaterial] = [:]
    var missingFiles: [String] = []
    var known: Set<String> = []
    for library in content.libraries where known.insert(library).inserted {
      guard let bytes = files.contents(of: library) else {
        missingFiles.append(library)
        continue
      }
      materials.merge(MTLMaterial.materials(bytes)) { first, _ in first }
    }
    var images: [String: EncodedImage?] = [:]
    func image(_ file: String) -> EncodedImage? {
      if let image = images[file] { return image }
      let image = files.contents(of: file).flatMap { EncodedImage(recognizing: $0) }
      images[file] = .some(image)
      if image == nil { missingFiles.append(file) }
      return image
    }
    let budget = MemoryBudget(forFileOf: bytes.count)
    let parts = try content.groups.map { name, group in
      var part = try content.part(group, budget: budget)
      let material = materials[name]
      part.baseColor = material?.texture.flatMap(image)
      if part.baseColor == nil, let color = material?.diffuse, part.colors.isEmpty {
        part.baseColorFactor = LinearColor(sRGB: color).components
      }
      return part
    }
    return LoadedModel(parts: parts, missingFiles: missingFiles)
  }
}
