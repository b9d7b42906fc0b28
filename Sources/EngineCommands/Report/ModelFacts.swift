import Formats
import Foundation
import SceneModel

/// What the page of a model says about it.
struct ModelFacts {
  /// Pairs of a term and a value.
  let rows: [[String]]

  init(_ model: LoadedModel, file: URL) {
    let mesh = model.mesh
    var rows = [
      ["Triangles", Self.grouped(mesh.triangles.count)],
      ["Vertices", Self.grouped(mesh.positions.count)],
    ]
    let textures = model.parts.count { $0.baseColor != nil }
    if textures > 0 { rows.append(["Textures", "\(textures)"]) }
    if let bounds = mesh.bounds {
      let size = bounds.max - bounds.min
      rows.append(
        [
          "Size",
          [size.x, size.y, size.z].map { String(format: "%.3f", $0) }.joined(separator: " × "),
        ])
    }
    let values = try? file.resourceValues(forKeys: [.fileSizeKey, .isDirectoryKey])
    if values?.isDirectory != true, let bytes = values?.fileSize {
      rows.append(["File", String(format: "%.1f MB", Double(bytes) / 1_000_000)])
    }
    if !model.missingFiles.isEmpty {
      rows.append(["Missing files", model.missingFiles.joined(separator: ", ")])
    }
    self.rows = rows
  }

  /// A number with separators between thousands.
  static func grouped(_ number: Int) -> String {
    var digits = String(number)
    var groups: [Substring] = []
    while digits.count > 3 {
      groups.insert(digits.suffix(3), at: 0)
      digits.removeLast(3)
    }
    return ([Substring(digits)] + groups).joined(separator: ",")
  }
}
