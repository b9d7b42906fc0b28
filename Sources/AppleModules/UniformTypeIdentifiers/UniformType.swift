/// The declaration of a uniform type.
struct UniformType: Sendable {
  var identifier: String
  var parents: [String]
  /// File extensions without the dot, the preferred one first.
  var filenameExtensions: [String] = []
  var mimeType: String?
}

extension UniformType {
  /// All known types.
  static let known: [UniformType] = [
    UniformType(identifier: "public.item", parents: []),
    UniformType(identifier: "public.content", parents: []),
    UniformType(identifier: "public.data", parents: ["public.item"]),
    UniformType(identifier: "public.directory", parents: ["public.item"]),
    UniformType(identifier: "public.folder", parents: ["public.directory"]),
    UniformType(identifier: "com.apple.package", parents: ["public.directory"]),
    UniformType(identifier: "public.image", parents: ["public.data", "public.content"]),
    UniformType(
      identifier: "public.jpeg", parents: ["public.image"],
      filenameExtensions: ["jpeg", "jpg", "jpe"],
      mimeType: "image/jpeg"),
    UniformType(
      identifier: "public.png", parents: ["public.image"], filenameExtensions: ["png"],
      mimeType: "image/png"),
    UniformType(
      identifier: "public.tiff", parents: ["public.image"], filenameExtensions: ["tiff", "tif"],
      mimeType: "image/tiff"),
    UniformType(
      identifier: "public.heic", parents: ["public.heif"], filenameExtensions: ["heic"],
      mimeType: "image/heic"),
    UniformType(
      identifier: "public.heif", parents: ["public.image"], filenameExtensions: ["heif", "hif"],
      mimeType: "image/heif"),
    UniformType(
      identifier: "com.compuserve.gif", parents: ["public.image"], filenameExtensions: ["gif"],
      mimeType: "image/gif"),
    UniformType(
      identifier: "com.microsoft.bmp", parents: ["public.image"], filenameExtensions: ["bmp"],
      mimeType: "image/bmp"),
    UniformType(
      identifier: "org.webmproject.webp", parents: ["public.image"], filenameExtensions: ["webp"],
      mimeType: "image/webp"),
    UniformType(
      identifier: "com.ilm.openexr-image", parents: ["public.image"], filenameExtensions: ["exr"],
      mimeType: "image/x-exr"),
    UniformType(identifier: "public.camera-raw-image", parents: ["public.image"]),
    UniformType(
      identifier: "com.adobe.raw-image", parents: ["public.camera-raw-image"],
      filenameExtensions: ["dng"],
      mimeType: "image/x-adobe-dng"),
    UniformType(identifier: "public.3d-content", parents: ["public.content"]),
    UniformType(
      identifier: "com.pixar.universal-scene-description",
      parents: ["public.3d-content", "public.data"], filenameExtensions: ["usd", "usda", "usdc"],
      mimeType: "model/vnd.usd"),
    UniformType(
      identifier: "com.pixar.universal-scene-description-mobile",
      parents: ["public.3d-content", "public.data"], filenameExtensions: ["usdz"],
      mimeType: "model/vnd.usdz+zip"),
    UniformType(
      identifier: "com.apple.reality", parents: ["public.3d-content", "public.data"],
      filenameExtensions: ["reality"], mimeType: "model/vnd.reality"),
    UniformType(
      identifier: "public.audiovisual-content", parents: ["public.data", "public.content"]),
    UniformType(identifier: "public.movie", parents: ["public.audiovisual-content"]),
    UniformType(identifier: "public.video", parents: ["public.movie"]),
    UniformType(
      identifier: "public.mpeg-4", parents: ["public.movie"], filenameExtensions: ["mp4"],
      mimeType: "video/mp4"),
    UniformType(
      identifier: "com.apple.quicktime-movie", parents: ["public.movie"],
      filenameExtensions: ["mov", "qt"],
      mimeType: "video/quicktime"),
    UniformType(identifier: "public.text", parents: ["public.data", "public.content"]),
    UniformType(
      identifier: "public.plain-text", parents: ["public.text"],
      filenameExtensions: ["txt", "text"],
      mimeType: "text/plain"),
    UniformType(
      identifier: "public.json", parents: ["public.text"], filenameExtensions: ["json"],
      mimeType: "application/json"),
    UniformType(
      identifier: "public.comma-separated-values-text", parents: ["public.text"],
      filenameExtensions: ["csv"],
      mimeType: "text/csv"),
    UniformType(
      identifier: "public.xml", parents: ["public.text"], filenameExtensions: ["xml"],
      mimeType: "application/xml"),
    UniformType(
      identifier: "com.adobe.pdf", parents: ["public.data", "public.content"],
      filenameExtensions: ["pdf"],
      mimeType: "application/pdf"),
    UniformType(identifier: "public.archive", parents: ["public.data"]),
    UniformType(
      identifier: "public.zip-archive", parents: ["public.archive"], filenameExtensions: ["zip"],
      mimeType: "application/zip"),
    UniformType(
      identifier: "public.polygon-file-format", parents: ["public.3d-content", "public.data"],
      filenameExtensions: ["ply"]),
    UniformType(
      identifier: "public.geometry-definition-format",
      parents: ["public.3d-content", "public.data"], filenameExtensions: ["obj"]),
    UniformType(
      identifier: "public.standard-tesselated-geometry-format",
      parents: ["public.3d-content", "public.data"], filenameExtensions: ["stl"]),
  ]
}
