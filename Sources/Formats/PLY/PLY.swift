import Foundation
import SceneModel

/// Point clouds and meshes as PLY files, binary little-endian.
///
/// Reading supports ascii and both byte orders, skips unknown properties, and reports damaged files
/// as `FormatError`.
package enum PLY {
  /// The header of a binary file up to the position, normal and color of its vertices.
  static func headerStart(vertices: Int, normals: Bool, colors: Bool) -> String {
    var header = "ply\nformat binary_little_endian 1.0\nelement vertex \(vertices)\n"
    header += "property float x\nproperty float y\nproperty float z\n"
    if normals { header += "property float nx\nproperty float ny\nproperty float nz\n" }
    if colors { header += "property uchar red\nproperty uchar green\nproperty uchar blue\n" }
    return header
  }

  /// Reads `url` with `body`, and adds the path to errors.
  static func read<Result>(
    _ url: URL, _ body: (inout PLYReader) throws -> Result
  ) throws -> Result {
    do {
      var reader = try PLYReader(try contents(of: url))
      return try body(&reader)
    } catch let fault as FormatFault {
      throw FormatError.malformed(path: url.path, reason: fault.reason)
    }
  }

  /// The indices of three properties of an element; nil unless it has all of them.
  static func triple(
    _ element: PLYHeader.Element, _ x: String, _ y: String, _ z: String
  ) -> SIMD3<Int>? {
    guard let x = element.index(of: x), let y = element.index(of: y), let z = element.index(of: z)
    else { return nil }
    return [x, y, z]
  }

  /// The values of three properties of a row.
  static func vector(_ row: PLYRow, _ index: SIMD3<Int>) -> SIMD3<Float> {
    [
      Float(row.scalars[index.x]), Float(row.scalars[index.y]), Float(row.scalars[index.z]),
    ]
  }

  /// An 8-bit color; floating-point colors range from 0 to 1.
  static func color(
    _ row: PLYRow, _ index: SIMD3<Int>, in element: PLYHeader.Element
  ) -> SIMD3<UInt8> {
    let isFloat = [.float32, .float64].contains(element.properties[index.x].type)
    func channel(_ property: Int) -> UInt8 {
      let value = row.scalars[property] * (isFloat ? 255 : 1)
      return value.isFinite ? UInt8(min(255, max(0, value.rounded()))) : 0
    }
    return [channel(index.x), channel(index.y), channel(index.z)]
  }
}
