import SceneModel

/// Creates images with detail at all scales.
package enum TexturePattern {
  /// A pseudorandom image, smooth at pixel scale and high in contrast at large scale: the sum of
  /// four octaves of value noise. `shift` moves the pattern in pixels.
  package static func image(
    width: Int, height: Int, seed: UInt32, shift: SIMD2<Double> = .zero
  ) -> RasterImage {
    var image = RasterImage(width: width, height: height, channels: 3)
    for y in 0..<height {
      for x in 0..<width {
        let p = SIMD2(Double(x), Double(y)) + shift
        for channel in 0..<3 {
          var (value, scale, amplitude) = (0.0, 0.02, 0.5)
          for octave in 0..<4 {
            let layer = seed &+ UInt32(channel) &* 977 &+ UInt32(octave) &* 131
            value += amplitude * noise(p * scale, layer)
            (scale, amplitude) = (scale * 2.7, amplitude * 0.7)
          }
          let gray = 128 + 150 * (value / 1.27 - 0.5)
          image.pixels[(y * width + x) * 3 + channel] = UInt8(min(max(gray, 0), 255))
        }
      }
    }
    return image
  }

  /// Value noise, 0…1.
  private static func noise(_ p: SIMD2<Double>, _ seed: UInt32) -> Double {
    let cell = p.rounded(.down)
    let f = p - cell
    let s = f * f * (3 - 2 * f)
    func corner(_ dx: Double, _ dy: Double) -> Double {
      var h = UInt32(truncatingIfNeeded: Int(cell.x + dx)) &* 0x9E37_79B1
      h ^= UInt32(truncatingIfNeeded: Int(cell.y + dy)) &* 0x85EB_CA77
      h ^= seed &* 0xC2B2_AE3D
      h ^= h >> 15
      h = h &* 0x2C1B_3C6D
      h ^= h >> 12
      return Double(h % 65536) / 65535
    }
    let top = corner(0, 0) * (1 - s.x) + corner(1, 0) * s.x
    let bottom = corner(0, 1) * (1 - s.x) + corner(1, 1) * s.x
    return top * (1 - s.y) + bottom * s.y
  }
}
