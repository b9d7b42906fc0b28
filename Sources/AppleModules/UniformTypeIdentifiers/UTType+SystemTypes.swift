extension UTType {
  /// Anything in a file system.
  public static let item = UTType(known: "public.item")
  /// Content that users view.
  public static let content = UTType(known: "public.content")
  /// Any data.
  public static let data = UTType(known: "public.data")
  /// A container of files.
  public static let directory = UTType(known: "public.directory")
  /// A folder.
  public static let folder = UTType(known: "public.folder")
  /// A folder presented as a file.
  public static let package = UTType(known: "com.apple.package")
  /// Any image.
  public static let image = UTType(known: "public.image")
  /// JPEG.
  public static let jpeg = UTType(known: "public.jpeg")
  /// PNG.
  public static let png = UTType(known: "public.png")
  /// TIFF.
  public static let tiff = UTType(known: "public.tiff")
  /// HEIC, as phones write it.
  public static let heic = UTType(known: "public.heic")
  /// HEIF.
  public static let heif = UTType(known: "public.heif")
  /// GIF.
  public static let gif = UTType(known: "com.compuserve.gif")
  /// BMP.
  public static let bmp = UTType(known: "com.microsoft.bmp")
  /// WebP.
  public static let webP = UTType(known: "org.webmproject.webp")
  /// OpenEXR.
  public static let exr = UTType(known: "com.ilm.openexr-image")
  /// A raw camera image.
  public static let rawImage = UTType(known: "public.camera-raw-image")
  /// DNG.
  public static let dng = UTType(known: "com.adobe.raw-image")
  /// Any 3-D content.
  public static let threeDContent = UTType(known: "public.3d-content")
  /// A USD scene.
  public static let usd = UTType(known: "com.pixar.universal-scene-description")
  /// A USD scene packaged with its textures.
  public static let usdz = UTType(known: "com.pixar.universal-scene-description-mobile")
  /// A Reality Composer scene.
  public static let realityFile = UTType(known: "com.apple.reality")
  /// Audiovisual content.
  public static let audiovisualContent = UTType(known: "public.audiovisual-content")
  /// A video with or without sound.
  public static let movie = UTType(known: "public.movie")
  /// A video without sound.
  public static let video = UTType(known: "public.video")
  /// MPEG-4.
  public static let mpeg4Movie = UTType(known: "public.mpeg-4")
  /// QuickTime.
  public static let quickTimeMovie = UTType(known: "com.apple.quicktime-movie")
  /// Any text.
  public static let text = UTType(known: "public.text")
  /// Text without markup.
  public static let plainText = UTType(known: "public.plain-text")
  /// JSON.
  public static let json = UTType(known: "public.json")
  /// Comma-separated values.
  public static let commaSeparatedText = UTType(known: "public.comma-separated-values-text")
  /// XML.
  public static let xml = UTType(known: "public.xml")
  /// PDF.
  public static let pdf = UTType(known: "com.adobe.pdf")
  /// An archive of files.
  public static let archive = UTType(known: "public.archive")
  /// ZIP.
  public static let zip = UTType(known: "public.zip-archive")
}
