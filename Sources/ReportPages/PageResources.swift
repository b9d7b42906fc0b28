/// The page's own HTML, CSS and JavaScript.
enum PageResources {
  static let template = PackageResources.report_html
  static let index = PackageResources.index_html
  static let style = PackageResources.report_css

  /// All scripts in one module element, in the order in which they use each other.
  static let script: [UInt8] = scripts.reduce(into: []) { text, script in
    text += script
    text.append(UInt8(ascii: "\n"))
  }

  private static let scripts = [
    PackageResources.elements_js, PackageResources.formatting_js, PackageResources.decoding_js,
    PackageResources.records_js, PackageResources.selection_js, PackageResources.colormaps_js,
    PackageResources.theme_js, PackageResources.shaders_js, PackageResources.surface_js,
    PackageResources.frusta_js, PackageResources.orbit_js, PackageResources.painter_js,
    PackageResources.scene_js, PackageResources.view_js, PackageResources.charts_js,
    PackageResources.summary_js, PackageResources.photos_js, PackageResources.projection_js,
    PackageResources.picture_js, PackageResources.matches_js, PackageResources.groups_js,
    PackageResources.directions_js, PackageResources.coverage_js, PackageResources.cameras_js,
    PackageResources.stages_js, PackageResources.notes_js, PackageResources.page_js,
  ]
}
