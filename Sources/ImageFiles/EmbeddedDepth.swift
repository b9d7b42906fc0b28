import CKernels
import Kernels
import SceneModel

/// The depth map in a HEIC photo, as Apple's phones write it: an auxiliary image of depths or
/// disparities, scaled to 8 bits, and an XMP packet with their range.
package enum EmbeddedDepth: Hashable, Sendable {
  /// In meters, upright.
  case metric(DepthMap)
  /// Disparities from two lenses whose distance varies with temperature and shock: they have no
  /// scale.
  case relative

  /// Larger maps are thinned out: this is half the resolution of disparity maps, and more than that
  /// of a LiDAR scanner. Chosen.
  private static let maximumSide = 384
  /// Maximum relative difference between the aspect ratios of map and photo. If it is larger, the
  /// map shows something else, or isn't upright. Chosen: 4:3 and 3:2 differ by 0.125.
  private static let maximumAspectDifference = 0.05

  /// The map in the content of a file; nil if there is none, or none that can be used.
  package init?(_ bytes: [UInt8], limits: ImageCodec.Limits = ImageCodec.Limits()) {
    guard HEIFFile.Kind(ByteReader(bytes)) != nil,
      let (map, description) = Self.read(bytes, limits),
      let photo = try? ImageHeader(bytes), Self.hasAspect(map, of: photo)
    else { return nil }
    let xmp = XMPPacket(description)
    guard let kind = xmp.text("apdi:AuxiliaryImageType"), ["disparity", "depth"].contains(kind),
      let low = xmp.number("apdi:FloatMinValue"), let high = xmp.number("apdi:FloatMaxValue"),
      high > low
    else { return nil }
    guard xmp.text("depthData:Accuracy") == "absolute" else {
      self = .relative
      return
    }
    let (width, height, samples) = Self.thinned(map)
    let depths = samples.map { sample in
      let value = low + sample * (high - low)
      return kind == "disparity" ? 1 / value : value
    }
    guard let map = DepthMap(width: width, height: height, depths: depths) else { return nil }
    self = .metric(map)
  }

  /// Samples from 0 to 1, row by row.
  private typealias SampleMap = (width: Int, height: Int, samples: [Float])

  /// The depth or disparity map of the primary image, upright, and the XMP packet about it; nil
  /// without a map or if it can't be read.
  private static func read(
    _ bytes: [UInt8], _ limits: ImageCodec.Limits
  ) -> (map: SampleMap, description: [UInt8])? {
    var image: OpaquePointer?
    var packet: OpaquePointer?
    var limits = limits.kernelLimits
    try? withKernel(KernelControl()) { _ in
      ck_heif_decode_depth(bytes, bytes.count, &limits, &image, &packet)
    }
    let description = [UInt8](taking: packet)
    guard let image else { return nil }
    defer { ck_image_free(image) }
    let (width, height) = (Int(ck_image_width(image)), Int(ck_image_height(image)))
    guard width > 0, height > 0 else { return nil }
    var samples = [Float](repeating: 0, count: width * height)
    samples.withUnsafeMutableBytes { buffer in
      if let base = buffer.baseAddress {
        ck_image_copy(image, base.assumingMemoryBound(to: UInt8.self))
      }
    }
    return ((width, height, samples), description)
  }

  private static func hasAspect(_ map: SampleMap, of photo: ImageHeader) -> Bool {
    let ratio =
      Double(map.width) * Double(photo.height) / (Double(map.height) * Double(photo.width))
    return abs(ratio - 1) <= maximumAspectDifference
  }

  /// Every n-th sample of every n-th row.
  private static func thinned(_ map: SampleMap) -> SampleMap {
    let step = (max(map.width, map.height) + maximumSide - 1) / maximumSide
    guard step > 1 else { return map }
    let columns = stride(from: step / 2, to: map.width, by: step)
    let rows = stride(from: step / 2, to: map.height, by: step)
    let samples = rows.flatMap { row in columns.map { map.samples[row * map.width + $0] } }
    return (Array(columns).count, Array(rows).count, samples)
  }
}
