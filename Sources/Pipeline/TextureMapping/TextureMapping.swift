import Foundation
import Kernels
import SceneModel

/// Colors a surface from the photos that it was reconstructed from (Waechter, Moehrle and Goesele,
/// "Let There Be Color!", ECCV 2014), and bakes detail that simplification removed into maps.
package struct TextureMapping: Sendable {
  /// Parameters of texturing.
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum texture side in texels; halved while the photos have less detail. Chosen:
    /// `DetailSpecification` sets that of the detail level.
    package var textureSide = 4096
    /// Maximum number of textures; more than one only if the photos fill it. Chosen: as above.
    package var maximumAtlases = 1
    /// The maps to produce.
    package var maps: Set<TextureMap> {
      get { Set(sortedMaps) }
      set { sortedMaps = newValue.sorted() }
    }
    /// In the order of the cases, so that equal options have equal encodings.
    private var sortedMaps: [TextureMap] = [.diffuseColor, .normal, .ambientOcclusion]

    /// Minimum area of a transient occluder, as a share of a photo. Chosen.
    var minimumRegionShare: Float = 0.001
    /// Maximum triangles of the cropped-away surface that is kept as an occluder. Chosen.
    var occluderTriangles = 100_000
    var observation = ViewObservation.Options()
    var exposure = ExposureCompensation.Options()
    var candidates = ViewCandidates.Options()
    /// Nil if the surface isn't that of an object.
    var presence: ObjectPresence.Options? = ObjectPresence.Options()
    var selection = ViewSelection.Options()
    var blending = ViewBlending.Options()
    var leveling = ColorLeveling.Options()
    var charting = Charting.Options()
    var painting = TexturePainting.Options()
    var baking = MapBaking.Options()

    package init(
      textureSide: Int = 4096, maximumAtlases: Int = 1,
      maps: Set<TextureMap> = [.diffuseColor, .normal, .ambientOcclusion]
    ) {
      self.textureSide = textureSide
      self.maximumAtlases = maximumAtlases
      self.maps = maps
    }
  }

  package var options: Options

  package init(options: Options = Options()) { self.options = options }

  /// Textures `mesh`; its maps are baked from `dense`, the surface before simplification.
  /// `occluders` block the photos' view of the mesh but get no texture. `gains` are those of all
  /// photos, if they are known. `onEvidence` receives how the photos show the surface, before it is
  /// painted.
  ///
  /// Throws `PipelineError.noSurface` for an empty mesh.
  func run(
    _ mesh: Mesh, dense: Mesh, occluders: Mesh = Mesh(), reconstruction: Reconstruction,
    images: ImageStore, gains: [ExposureGain]? = nil, _ context: StageContext,
    onEvidence: EvidenceHandler? = nil
  ) throws -> TexturedMesh {
    let images = images.decodingOnce(forSizesUpTo: options.painting.maximumPixels)
    return try run(
      mesh, dense: dense, occluders: occluders,
      source: ViewSource(reconstruction, images: images), gains: gains, context,
      onEvidence: onEvidence)
  }

  /// Receives how the photos show a surface.
  typealias EvidenceHandler = (ModelEvidence) throws -> Void

  func run(
    _ input: Mesh, dense: Mesh, occluders: Mesh = Mesh(), source: ViewSource,
    gains: [ExposureGain]? = nil, _ context: StageContext, onEvidence: EvidenceHandler? = nil
  ) throws -> TexturedMesh {
    let mesh = try checked(input)
    let notes = context.notes
    let views = source.reconstruction.registered
    let topology = notes.step("topology") { MeshTopology(mesh) }
    let scene = try notes.step("rayScene") {
      try RayScene(mesh, context.part(from: 0, to: 0).control)
    }
    var seen = try notes.step("observation") {
      try ViewObservation(options: options.observation).run(
        try occluded(mesh, by: occluders, context) ?? scene, faceCount: mesh.triangles.count,
        views: views, source: source, context.part(from: 0, to: 0.19))
    }
    let colors = try colors(
      of: mesh, topology, draining: &seen, source, gains: gains,
      isCropped: !occluders.triangles.isEmpty, needsEvidence: onEvidence != nil, context)
    try onEvidence?(evidence(colors, of: mesh, scene, views))
    let layout = try notes.step("layout") {
      try self.layout(of: mesh, dense, topology, colors, context.part(from: 0.26, to: 0.39))
    }
    let baking = notes.step("bakingPreparation") {
      MapBaking(options: options.baking).prepared(
        options.maps, mesh: mesh, scene: scene, dense: layout.dense, layout: layout.atlas,
        charts: layout.charts)
    }
    let painting = TexturePainting(
      options: options.painting, weights: layout.weights, leveling: layout.leveling,
      gains: colors.gains, views: views, source: source, magnification: layout.atlas.magnification)
    let maps = try images(
      of: layout.atlas, scene: scene, baking, painting, context.part(from: 0.39, to: 1))
    return notes.step("assembly") { assembled(mesh, layout.atlas, maps) }
  }

  /// The views that may color the faces, and the one chosen for each.
  private struct FaceColors {
    var gains: [ExposureGain]
    var rated: RatedViews
    var labels: [Int32]
    /// Empty if nobody asks for them.
    var evidence: [ModelEvidence.Face]
  }

  /// Chooses the views of each face. `seen` is left empty.
  private func colors(
    of mesh: Mesh, _ topology: MeshTopology, draining seen: inout FaceViews,
    _ source: ViewSource, gains: [ExposureGain]?, isCropped: Bool, needsEvidence: Bool,
    _ context: StageContext
  ) throws -> FaceColors {
    let notes = context.notes
    let views = source.reconstruction.registered
    let gains = try notes.step("exposure") {
      if let gains { return views.map { gains[$0.index] } }
      return try ExposureCompensation(options: options.exposure)
        .run(seen, viewCount: views.count, context.part(from: 0.19, to: 0.21))
    }
    let evidence = try notes.step("evidence") {
      guard needsEvidence else { return [ModelEvidence.Face]() }
      return try EvidenceSurvey(source.reconstruction, gains: gains)
        .run(mesh, seen: seen, context.part(from: 0, to: 0).control)
    }
    // A user who cropped the model decided what is in it.
    if let presence = options.presence, !isCropped {
      notes.step("presence") {
        ObjectPresence(options: presence)
          .run(mesh, seen: seen, views: views, source.reconstruction, notes)
      }
    }
    var candidates = options.candidates
    candidates.outliers.minimumRegionPixels = max(
      candidates.outliers.minimumRegionPixels, options.minimumRegionShare * source.pixelsPerPhoto)
    var rated = try notes.step("candidates") {
      defer { NativeLibraries.releaseFreeMemory() }
      return try ViewCandidates(options: candidates)
        .run(
          draining: &seen, gains: gains, topology: topology, context.part(from: 0.21, to: 0.22))
    }
    let labels = try notes.step("labels") {
      try ViewSelection(options: options.selection)
        .run(rated, mesh: mesh, topology: topology, context.part(from: 0.22, to: 0.26))
    }
    try notes.step("restriction") {
      defer { NativeLibraries.releaseFreeMemory() }
      try ViewBlending(options: options.blending).restrict(
        &rated, labels: labels, mesh: mesh, topology: topology,
        context.part(from: 0.26, to: 0.26).control)
    }
    return FaceColors(gains: gains, rated: rated, labels: labels, evidence: evidence)
  }

  /// How the photos show the surface.
  private func evidence(
    _ colors: FaceColors, of mesh: Mesh, _ scene: RayScene, _ views: [ID<Photo>]
  ) -> ModelEvidence {
    ModelEvidence(
      mesh: mesh, scene: scene, faces: colors.evidence,
      painters: colors.labels.map { $0 < 0 ? nil : views[Int($0)] },
      gains: Dictionary(uniqueKeysWithValues: zip(views, colors.gains.map(\.light))))
  }

  /// Where the faces lie in the textures, how their photos are blended there, and the surface that
  /// the maps show.
  private struct Layout {
    var charts: [Int32]
    var atlas: AtlasLayout
    var weights: CornerWeights
    var leveling: LevelingOffsets
    var dense: MapBaking.DenseSurface?
  }

  /// Lays out the textures while another thread levels the colors and prepares the dense surface.
  private func layout(
    of mesh: Mesh, _ dense: Mesh, _ topology: MeshTopology, _ colors: FaceColors,
    _ context: StageContext
  ) throws -> Layout {
    let (rated, labels) = (colors.rated, colors.labels)
    let notes = context.notes
    let ((charts, atlas), (weights, leveling), surface) = try context.control.concurrently(
      { control in
        let context = StageContext(control: control, notes: notes)
        let map = try Charting(options: options.charting)
          .run(mesh, rated: rated, labels: labels, context.part(from: 0, to: 0.3))
        let packing = AtlasPacking(
          options: .init(
            maximumSide: options.textureSide, maximumAtlases: options.maximumAtlases))
        return (map.charts, try packing.run(map, context.part(from: 0.3, to: 1)))
      },
      { control in
        let context = StageContext(control: control, notes: notes)
        let weights = try ViewBlending(options: options.blending).run(
          rated, labels: labels, mesh: mesh, topology: topology, context.part(from: 0, to: 0.3))
        let leveling = try ColorLeveling(options: options.leveling).run(
          rated, weights: weights, mesh: mesh, topology: topology, context.part(from: 0.3, to: 1))
        return (weights, leveling)
      },
      { try MapBaking(options: options.baking).denseSurface(dense, for: options.maps, $0) })
    return Layout(
      charts: charts, atlas: atlas, weights: weights, leveling: leveling, dense: surface)
  }

  /// The mesh's scene with the occluders appended after its triangles; nil without occluders.
  private func occluded(
    _ mesh: Mesh, by occluders: Mesh, _ context: StageContext
  ) throws -> RayScene? {
    guard !occluders.triangles.isEmpty else { return nil }
    let control = context.part(from: 0, to: 0).control
    let coarse = try occluders.simplified(
      maximumTriangles: options.occluderTriangles, control)
    guard !coarse.triangles.isEmpty else { return nil }
    let first = UInt32(mesh.positions.count)
    return try RayScene(
      Mesh(
        positions: mesh.positions + coarse.positions,
        triangles: mesh.triangles
          + coarse.triangles.map { Triangle($0.a + first, $0.b + first, $0.c + first) }),
      control)
  }

  /// The maps of each texture, one texture at a time: painting one takes three times the memory of
  /// its image.
  private func images(
    of layout: AtlasLayout, scene: RayScene, _ baking: MapBaking.Prepared,
    _ painting: TexturePainting, _ context: StageContext
  ) throws -> [[TextureMap: RasterImage]] {
    let share = 1 / Double(layout.count)
    var usage = 0.0
    let images = try (0..<layout.count).map { atlas in
      let part = context.part(from: share * Double(atlas), to: share * Double(atlas + 1))
      let canvas = try context.notes.step("canvas") {
        try TextureCanvas(
          scene, corners: layout.corners(in: atlas), side: layout.side,
          part.part(from: 0, to: 0.06).control)
      }
      usage += canvas.usage * share
      var maps = try context.notes.step("baking") {
        try baking.run(on: canvas, atlas: atlas, part.part(from: 0.06, to: 0.73))
      }
      if options.maps.contains(.diffuseColor) {
        maps[.diffuseColor] = try context.notes.step("painting") {
          try painting.run(
            on: canvas, faces: layout.faces(in: atlas), part.part(from: 0.73, to: 0.97))
          return try canvas.colors(part.part(from: 0.97, to: 1).control)
        }
      }
      return maps
    }
    context.notes.record("textureUsage", usage)
    return images
  }

  /// The mesh with normals; throws if it is empty.
  private func checked(_ input: Mesh) throws -> Mesh {
    guard !input.triangles.isEmpty else {
      throw PipelineError.noSurface(reason: "there is nothing to texture")
    }
    var mesh = input
    if mesh.normals.count != mesh.positions.count { mesh.normals = mesh.angleWeightedNormals() }
    return mesh
  }

  /// Orders the triangles by texture. Corners with equal coordinates at one vertex share them
  /// within a texture.
  private func assembled(
    _ mesh: Mesh, _ layout: AtlasLayout, _ maps: [[TextureMap: RasterImage]]
  ) -> TexturedMesh {
    var result = TexturedMesh(
      mesh: mesh, textureCoordinates: [], textureTriangles: [], atlases: [])
    result.mesh.triangles.removeAll(keepingCapacity: true)
    result.textureTriangles.reserveCapacity(mesh.triangles.count)
    for (atlas, maps) in maps.enumerated() {
      let start = result.mesh.triangles.count
      append(layout.faces(in: atlas), of: mesh, layout, to: &result)
      result.atlases.append(
        TextureAtlas(triangles: start..<result.mesh.triangles.count, maps: maps))
    }
    return result
  }

  private func append(
    _ faces: [Int], of mesh: Mesh, _ layout: AtlasLayout, to result: inout TexturedMesh
  ) {
    let side = Float(layout.side)
    var known = [[UInt32]](repeating: [], count: mesh.positions.count)
    for face in faces {
      let triangle = mesh.triangles[face]
      let indices = triangle.vertices.enumerated().map { corner, vertex in
        let texel = layout.corners[3 * face + corner]
        let uv = SIMD2(texel.x / side, 1 - texel.y / side)
          .clamped(lowerBound: .zero, upperBound: .one)
        if let index = known[vertex].first(where: { result.textureCoordinates[Int($0)] == uv }) {
          return index
        }
        result.textureCoordinates.append(uv)
        known[vertex].append(UInt32(result.textureCoordinates.count - 1))
        return UInt32(result.textureCoordinates.count - 1)
      }
      result.mesh.triangles.append(triangle)
      result.textureTriangles.append(Triangle(indices[0], indices[1], indices[2]))
    }
  }
}
