import Pipeline
import SceneModel

extension DetailLevel {
  /// Apple's level; nil for `custom`, which has separate budgets.
  package init?(_ detail: PhotogrammetrySession.Request.Detail) {
    switch detail {
    case .preview: self = .preview
    case .reduced: self = .reduced
    case .medium: self = .medium
    case .full: self = .full
    case .raw: self = .raw
    case .custom: return nil
    }
  }
}

extension DetailSpecification {
  /// The budgets of a detail level; for the level `custom`, those of the specification `custom`.
  package init(
    _ detail: PhotogrammetrySession.Request.Detail,
    custom: PhotogrammetrySession.Configuration.CustomDetailSpecification
  ) {
    if let level = DetailLevel(detail) { self.init(level) } else { self.init(custom) }
  }

  /// The budgets of a custom specification, with the view resolution of the lowest level that
  /// allows as many triangles.
  init(_ custom: PhotogrammetrySession.Configuration.CustomDetailSpecification) {
    let triangles = Int(clamping: custom.maximumPolygonCount)
    let levels = DetailLevel.allCases.map { DetailSpecification($0) }
    let next = levels.first { $0.maximumTriangles >= triangles - 1 } ?? DetailSpecification(.raw)
    let format: TextureFormat =
      switch custom.textureFormat {
      case .png: .png
      case .jpeg(let quality): .jpeg(quality: quality.isFinite ? min(max(quality, 0), 1) : 0.8)
      }
    self.init(
      maximumTriangles: triangles, textureSide: Int(custom.maximumTextureDimension.rawValue),
      maps: Set(custom.outputTextureMaps), textureFormat: format, viewPixels: next.viewPixels)
  }
}

extension Set<TextureMap> {
  fileprivate init(
    _ outputs: PhotogrammetrySession.Configuration.CustomDetailSpecification.TextureMapOutputs
  ) {
    self = []
    if outputs.contains(.diffuseColor) { insert(.diffuseColor) }
    if outputs.contains(.normal) { insert(.normal) }
    if outputs.contains(.roughness) { insert(.roughness) }
    if outputs.contains(.displacement) { insert(.displacement) }
    if outputs.contains(.ambientOcclusion) { insert(.ambientOcclusion) }
  }
}
