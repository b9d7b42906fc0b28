import ImageFiles
import SceneModel

/// Writes HEIC photos with a depth map, as Apple's phones do.
///
/// libheif writes no auxiliary images but alpha channels. So the map is written as one, with an XMP
/// packet about the photo; then the channel becomes a depth map, and the packet one about it.
package enum DepthHEICWriter {
  /// What the XMP packet says about the map.
  package struct Description: Sendable {
    /// `disparity` or `depth`.
    package var kind = "disparity"
    /// `absolute` or `relative`.
    package var accuracy = "absolute"
    /// The values of the samples 0 and 255.
    package var range: (low: Double, high: Double) = (0, 2)
    /// Whether properties are attributes instead of elements.
    package var usesAttributes = false

    package init() {}

    var xmp: [UInt8] {
      let properties = [
        ("apdi:AuxiliaryImageType", kind), ("apdi:FloatMinValue", "\(range.low)"),
        ("apdi:FloatMaxValue", "\(range.high)"), ("depthData:Accuracy", accuracy),
      ]
      let attributes = properties.map { " \($0)=\"\($1)\"" }.joined()
      let elements = properties.map { "<\($0)>\($1)</\($0)>\n" }.joined()
      let xmp = """
        <x:xmpmeta xmlns:x="adobe:ns:meta/">
        <rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
        <rdf:Description rdf:about="" xmlns:apdi="http://ns.apple.com/pixeldatainfo/1.0/"
        xmlns:depthData="http://ns.apple.com/depthData/1.0/"\(usesAttributes ? attributes : "")>
        \(usesAttributes ? "" : elements)</rdf:Description></rdf:RDF></x:xmpmeta>
        """
      return Array(xmp.utf8)
    }
  }

  /// The photo with a map of the same size, one sample per pixel.
  package static func file(
    _ photo: RasterImage, samples: [UInt8], _ description: Description,
    _ content: ImageCodec.HEICContent = ImageCodec.HEICContent()
  ) throws -> [UInt8] {
    var both = RasterImage(width: photo.width, height: photo.height, channels: 4)
    for index in samples.indices {
      for channel in 0..<3 { both.pixels[4 * index + channel] = photo.pixels[3 * index + channel] }
      both.pixels[4 * index + 3] = samples[index]
    }
    var content = content
    content.xmp = description.xmp
    var file = try ImageCodec.encodeHEIC(both, content)
    let type = Array("urn:mpeg:hevc:2015:auxid:1".utf8)
    if let start = file.firstRange(of: type)?.lowerBound {
      file[start + type.count - 1] = UInt8(ascii: "2")
    }
    // References: length, type, from, count, to.
    let auxiliary = file.firstRange(of: Array("auxl".utf8))?.upperBound ?? 0
    if let packet = file.ranges(of: Array("cdsc".utf8)).last?.upperBound {
      file.replaceSubrange(packet + 4..<packet + 6, with: file[auxiliary..<auxiliary + 2])
    }
    return file
  }
}
