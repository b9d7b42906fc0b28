import Foundation

/// Draws images and shapes into a bitmap with 8 bits per component: gray, alpha only, or RGB with a
/// fourth byte.
///
/// As on macOS the origin is the bottom left corner and y points up; images are drawn upright.
public final class CGContext {
  private struct State {
    var transform = CGAffineTransform.identity
    var fill = CGColor.black.bytes
    var interpolation = CGInterpolationQuality.default
    var opacity: UInt8 = 255
    /// The clipping rectangle in bitmap coordinates.
    var clip = CGRect.infinite
  }

  private let bitmap: Bitmap
  private var state = State()
  private var saved: [State] = []
  /// The color space of the pixels.
  public let colorSpace: CGColorSpace?
  /// How the components are arranged in memory.
  public let bitmapInfo: CGBitmapInfo

  /// Creates a context that draws into a caller's memory, which must outlive it, or into memory of
  /// its own if `data` is nil.
  ///
  /// Fails unless there are 8 bits per component in one of the orders of `CGBitmapInfo` that are
  /// supported here.
  public init?(
    data: UnsafeMutableRawPointer?, width: Int, height: Int, bitsPerComponent: Int,
    bytesPerRow: Int, space: CGColorSpace, bitmapInfo: UInt32
  ) {
    let info = CGBitmapInfo(rawValue: bitmapInfo)
    guard let layout = PixelLayout(space.model, info), bitsPerComponent == 8,
      (1...65536).contains(width), (1...65536).contains(height),
      let bitmap = Bitmap(
        data: data, width: width, height: height, bytesPerRow: bytesPerRow, layout: layout)
    else { return nil }
    self.bitmap = bitmap
    colorSpace = space
    self.bitmapInfo = info
  }

  /// The address of the first pixel of the top row.
  public var data: UnsafeMutableRawPointer? { bitmap.storage.baseAddress }
  /// The width in pixels.
  public var width: Int { bitmap.width }
  /// The height in pixels.
  public var height: Int { bitmap.height }
  /// The number of bits per component.
  public var bitsPerComponent: Int { 8 }
  /// The number of bits per pixel.
  public var bitsPerPixel: Int { 8 * bitmap.layout.size }
  /// The row stride in bytes.
  public var bytesPerRow: Int { bitmap.bytesPerRow }
  /// Where the alpha component is.
  public var alphaInfo: CGImageAlphaInfo { bitmap.layout.alphaInfo }

  /// A copy of the current pixels as an image.
  public func makeImage() -> CGImage? {
    CGImage(bitmap.layout.raster(width: width, height: height, row: bitmap.row))
  }

  /// Draws an image into a rectangle of user space. Tiling is not supported and draws nothing.
  public func draw(_ image: CGImage, in rect: CGRect, byTiling: Bool = false) {
    // Image coordinates start at the top left, like the rows of the bitmap.
    let toUser = CGAffineTransform(
      a: rect.width, b: 0, c: 0, d: -rect.height, tx: rect.minX, ty: rect.maxY)
    let toBitmap = toUser.concatenating(state.transform).concatenating(flip)
    let opacity = state.opacity
    guard !rect.isNull, !byTiling,
      let placed = PlacedImage(image.raster, toBitmap, state.interpolation)
    else { return }
    bitmap.draw(
      placed.columns.clamped(to: clippedColumns), placed.rows.clamped(to: clippedRows)
    ) { x, y in
      guard var value = placed.pixel(x, y) else { return nil }
      if opacity < 255 { value.alpha = UInt8(Int(value.alpha) * Int(opacity) / 255) }
      return value
    }
  }

  /// Fills a rectangle.
  public func fill(_ rect: CGRect) {
    paint(rect, rounded: false, state.fill)
  }

  /// Fills rectangles.
  public func fill(_ rects: [CGRect]) { for rect in rects { fill(rect) } }

  /// Fills the ellipse inscribed in a rectangle.
  public func fillEllipse(in rect: CGRect) { paint(rect, rounded: true, state.fill) }

  /// Sets the pixels in a rectangle to zero.
  public func clear(_ rect: CGRect) {
    let box = rect.applying(state.transform.concatenating(flip))
    bitmap.clear(pixelRange(box.minX, box.maxX, width), pixelRange(box.minY, box.maxY, height))
  }

  /// Sets the fill color.
  public func setFillColor(_ color: CGColor) { state.fill = color.bytes }

  /// Sets the fill color to a gray.
  public func setFillColor(gray: CGFloat, alpha: CGFloat) {
    setFillColor(CGColor(gray: gray, alpha: alpha))
  }

  /// Sets the fill color from RGB components.
  public func setFillColor(red: CGFloat, green: CGFloat, blue: CGFloat, alpha: CGFloat) {
    setFillColor(CGColor(red: red, green: green, blue: blue, alpha: alpha))
  }

  /// Sets the alpha, 0…1, by which everything drawn is multiplied.
  public func setAlpha(_ alpha: CGFloat) {
    state.opacity = UInt8((min(max(alpha, 0), 1) * 255).rounded())
  }

  /// Restricts drawing to a rectangle; a rotated one is replaced by its axis-aligned bounding
  /// rectangle.
  public func clip(to rect: CGRect) {
    let box = rect.applying(state.transform.concatenating(flip))
    state.clip = state.clip.isInfinite ? box : state.clip.intersection(box)
  }

  /// Pushes transform, fill color, alpha, clip and interpolation quality; `restoreGState` pops
  /// them.
  public func saveGState() { saved.append(state) }

  /// Restores the state of the last `saveGState`.
  public func restoreGState() { state = saved.popLast() ?? state }

  /// The current transformation matrix: from user space to the bitmap's space with y up.
  public var ctm: CGAffineTransform { state.transform }

  /// Translates user space.
  public func translateBy(x tx: CGFloat, y ty: CGFloat) {
    state.transform = state.transform.translatedBy(x: tx, y: ty)
  }

  /// Scales user space.
  public func scaleBy(x sx: CGFloat, y sy: CGFloat) {
    state.transform = state.transform.scaledBy(x: sx, y: sy)
  }

  /// Rotates user space by an angle in radians.
  public func rotate(by angle: CGFloat) { state.transform = state.transform.rotated(by: angle) }

  /// Applies a transform to user space.
  public func concatenate(_ transform: CGAffineTransform) {
    state.transform = transform.concatenating(state.transform)
  }

  /// How images are resampled: `none` takes the nearest pixel, all others average.
  public var interpolationQuality: CGInterpolationQuality {
    get { state.interpolation }
    set { state.interpolation = newValue }
  }

  /// Has no effect: drawing is immediate.
  public func flush() {}

  private var clippedColumns: Range<Int> {
    if state.clip.isInfinite { return 0..<width }
    return state.clip.isNull ? 0..<0 : pixelRange(state.clip.minX, state.clip.maxX, width)
  }

  private var clippedRows: Range<Int> {
    if state.clip.isInfinite { return 0..<height }
    return state.clip.isNull ? 0..<0 : pixelRange(state.clip.minY, state.clip.maxY, height)
  }

  private var flip: CGAffineTransform {
    CGAffineTransform(a: 1, b: 0, c: 0, d: -1, tx: 0, ty: CGFloat(height))
  }

  /// Fills the pixels whose centers are inside a shape; edges are not antialiased.
  private func paint(_ rect: CGRect, rounded: Bool, _ color: PixelValue) {
    let toBitmap = state.transform.concatenating(flip)
    let box = rect.applying(toBitmap)
    let userFromBitmap = toBitmap.inverted()
    let center = CGPoint(x: rect.midX, y: rect.midY)
    let half = CGSize(width: rect.width / 2, height: rect.height / 2)
    var color = color
    color.alpha = UInt8(Int(color.alpha) * Int(state.opacity) / 255)
    bitmap.draw(
      pixelRange(box.minX, box.maxX, width).clamped(to: clippedColumns),
      pixelRange(box.minY, box.maxY, height).clamped(to: clippedRows)
    ) { x, y in
      let point = CGPoint(x: CGFloat(x) + 0.5, y: CGFloat(y) + 0.5).applying(userFromBitmap)
      guard rounded else { return rect.contains(point) ? color : nil }
      let (u, v) = ((point.x - center.x) / half.width, (point.y - center.y) / half.height)
      return u * u + v * v <= 1 ? color : nil
    }
  }
}
