import Foundation

extension CGImage {
  /// Reads a PNG file; nil if the data isn't one.
  public convenience init?(
    pngDataProviderSource source: CGDataProvider, decode: UnsafePointer<CGFloat>?,
    shouldInterpolate: Bool, intent: CGColorRenderingIntent
  ) { self.init(source, "public.png") }

  /// Reads a JPEG file; nil if the data isn't one.
  public convenience init?(
    jpegDataProviderSource source: CGDataProvider, decode: UnsafePointer<CGFloat>?,
    shouldInterpolate: Bool, intent: CGColorRenderingIntent
  ) { self.init(source, "public.jpeg") }

  private convenience init?(_ provider: CGDataProvider, _ type: CFString) {
    guard let source = provider.data.flatMap({ CGImageSourceCreateWithData($0, nil) }),
      CGImageSourceGetType(source) == type, let image = source.image()
    else { return nil }
    self.init(image)
  }
}
