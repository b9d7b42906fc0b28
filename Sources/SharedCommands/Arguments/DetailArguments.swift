import ArgumentParser

/// The detail of a model: one of the levels, or custom limits.
package struct DetailArguments: ParsableArguments {
  /// The levels and their limits, as a section of help.
  package static let help = """
    DETAIL LEVELS (upper bounds; poor photos give less)
      level     triangles    texture           maps
      preview      25,000    1024 x 1024       color, normal, occlusion
      reduced      50,000    2048 x 2048       color, normal, occlusion
      medium      100,000    4096 x 4096       color, normal, occlusion
      full        250,000    8192 x 8192       and roughness, displacement
      raw      30,000,000    8192 x 8192, 16   color
      custom   set by --max-polygons, --texture-side, --maps and
               --texture-format; defaults as for medium

    """

  @Option(name: .shortAndLong, help: "Detail level of the model; see the table above.")
  package var detail = DetailChoice.level(.reduced)

  @Option(
    name: .long,
    help: ArgumentHelp("With -d custom: maximum number of triangles.", valueName: "count"))
  package var maxPolygons: UInt?

  @Option(name: .long, help: "With -d custom: maximum texture side in texels.")
  package var textureSide: TextureSideArgument?

  @Option(
    name: .long,
    help: ArgumentHelp(
      """
      With -d custom: comma-separated list of color, normal, roughness, displacement, occlusion \
      or all.
      """,
      valueName: "maps"))
  package var maps: TextureMapsArgument?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "With -d custom: png, jpeg or jpeg:<quality>, quality from 0 to 1 (default 0.8).",
      valueName: "format"))
  package var textureFormat: TextureFormatArgument?

  @Flag(
    name: .long,
    help: """
      Also write the model at all lower levels, from the same run: with -d medium, model.usdz and \
      model-preview.usdz, model-reduced.usdz.
      """)
  package var lod = false

  package init() {}

  package func validate() throws {
    if lod { try validateLevels() }
    let options: [(name: String, isGiven: Bool)] = [
      ("--max-polygons", maxPolygons != nil), ("--texture-side", textureSide != nil),
      ("--maps", maps != nil), ("--texture-format", textureFormat != nil),
    ]
    if detail != .custom, let option = options.first(where: \.isGiven) {
      throw ValidationError("\(option.name) is for --detail custom; add -d custom.")
    }
    if maxPolygons == 0 { throw ValidationError("--max-polygons must be 1 or more.") }
  }

  private func validateLevels() throws {
    switch detail {
    case .custom:
      throw ValidationError(
        "--lod is for detail levels, and custom limits have no lower ones. Choose a level with -d, "
          + "or omit --lod.")
    case .level(.preview):
      throw ValidationError(
        "--lod adds the levels below that of the model, and preview is the lowest. Choose a higher "
          + "level with -d, or omit --lod.")
    case .level: return
    }
  }

  /// The levels of the models besides that of `detail`, coarse to fine.
  package var coarserLevels: [DetailArgument] {
    guard lod, case .level(let level) = detail else { return [] }
    return Array(DetailArgument.allCases.prefix { $0 != level })
  }

  /// The limits of `custom`.
  package var specification: CustomDetail {
    var result = CustomDetail()
    if let maxPolygons { result.maximumPolygonCount = maxPolygons }
    if let textureSide { result.maximumTextureDimension = textureSide.dimension }
    if let maps { result.outputTextureMaps = maps.outputs }
    if let textureFormat { result.textureFormat = textureFormat.format }
    return result
  }
}
