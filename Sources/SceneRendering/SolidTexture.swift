import SceneModel

/// A solid texture, which assigns a color to every point of space: smooth multi-octave noise mapped
/// to a palette.
///
/// Fixed in space, so that photos from all sides agree, and without seams.
package struct SolidTexture: SurfaceTexture {
  /// Symmetry that causes repeated structure.
  package enum Repetition: Sendable {
    case none
    /// Symmetric under a half turn about the y axis.
    case halfTurn
    /// Periodic along x with this period.
    case period(Float)
  }

  /// Linear RGB, 0…1, from the lowest noise value to the highest.
  package var palette: [SIMD3<Float>]
  /// Wavelength of the coarsest octave in world units; it decreases by a factor of 2.1 per octave.
  package var wavelength: Float
  package var octaves: Int
  package var seed: UInt32
  /// Amplification of the noise; higher values produce flat patches with sharp borders.
  package var contrast: Float
  /// Modulation of the brightness by the fine octaves.
  private var shading: Float = 1.6
  /// Wavelength of the regions with hardly any texture; 0 disables them.
  package var plainWavelength: Float = 0
  package var repetition: Repetition
  /// Factors by which the pattern is longer than `wavelength` along each axis, as grain or fur.
  package var stretch: SIMD3<Float> = [1, 1, 1]

  package init(
    palette: [SIMD3<Float>], wavelength: Float, octaves: Int, seed: UInt32, contrast: Float = 2.2,
    repetition: Repetition = .none
  ) {
    self.repetition = repetition
    self.palette = palette
    self.wavelength = wavelength
    self.octaves = octaves
    self.seed = seed
    self.contrast = contrast
  }

  /// The same texture with reduced contrast: 1 leaves the colors unchanged, 0 is uniform.
  package func withContrast(_ factor: Float) -> SolidTexture {
    guard factor != 1, !palette.isEmpty else { return self }
    var result = self
    let mean = palette.reduce(SIMD3<Float>.zero, +) / Float(palette.count)
    result.palette = palette.map { mean + ($0 - mean) * factor }
    result.shading *= factor
    return result
  }

  /// Linear RGB of a point. Octaves that a pixel of width `footprint` can't resolve are omitted.
  package func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    var (sum, fine, total, amplitude, length) = (Float(0), Float(0), Float(0), Float(1), wavelength)
    var p = repeated(point) / stretch
    for octave in 0..<octaves {
      let visible = min(max(length / max(footprint, 1e-12) - 1.5, 0), 1)
      if visible > 0 {
        let value = Self.noise(p / length, seed &+ UInt32(octave) &* 0x9E37_79B9)
        sum += amplitude * visible * (value - 0.5)
        if octave >= 2 { fine += amplitude * visible * (value - 0.5) }
      }
      total += amplitude
      amplitude *= 0.8
      length /= 2.1
      // Rotated, so that the lattices of the octaves don't align.
      p = SIMD3(
        0.36 * p.x + 0.48 * p.y - 0.8 * p.z, -0.8 * p.x + 0.6 * p.y,
        0.48 * p.x + 0.64 * p.y + 0.6 * p.z)
    }
    let spread = contrast * sum / total * Float(octaves).squareRoot()
    let position = 0.5 + 0.5 * spread / (0.5 + abs(spread))
    // The fine octaves also modulate the brightness, so that no patch is flat.
    let shade = min(max(1 + shading * fine / total * Float(octaves).squareRoot(), 0.35), 1.5)
    let textured = palette(at: position) * shade
    guard plainWavelength > 0 else { return textured }
    let mean = palette.reduce(SIMD3<Float>.zero, +) / Float(max(1, palette.count))
    return mean + (textured - mean) * strength(at: point)
  }

  /// The fraction of the texture that remains, from a sixth to one.
  private func strength(at point: SIMD3<Float>) -> Float {
    let value = Self.noise(point / plainWavelength, seed &+ 0x5bd1)
    let t = min(max((value - 0.2) / 0.25, 0), 1)
    return 0.17 + 0.83 * t * t * (3 - 2 * t)
  }

  private func repeated(_ p: SIMD3<Float>) -> SIMD3<Float> {
    switch repetition {
    case .none: p
    case .halfTurn: p.z < 0 ? SIMD3(-p.x, p.y, -p.z) : p
    case .period(let length): SIMD3(p.x - length * (p.x / length).rounded(.down), p.y, p.z)
    }
  }

  private func palette(at value: Float) -> SIMD3<Float> {
    guard palette.count > 1 else { return palette.first ?? SIMD3(repeating: 0.5) }
    let position = value * Float(palette.count - 1)
    let index = min(Int(position), palette.count - 2)
    let t = position - Float(index)
    return palette[index] * (1 - t) + palette[index + 1] * t
  }

  /// Value noise on the integer lattice, 0…1, with continuous gradient.
  package static func noise(_ p: SIMD3<Float>, _ seed: UInt32) -> Float {
    let cell = p.rounded(.down)
    let f = p - cell
    let s = f * f * (3 - 2 * f)
    let i = SIMD3(Int32(cell.x), Int32(cell.y), Int32(cell.z))
    let x = SIMD2(UInt32(bitPattern: i.x), UInt32(bitPattern: i.x &+ 1)) &* 0x9E37_79B1
    let y = SIMD2(UInt32(bitPattern: i.y), UInt32(bitPattern: i.y &+ 1)) &* 0x85EB_CA77
    let z = SIMD2(UInt32(bitPattern: i.z), UInt32(bitPattern: i.z &+ 1)) &* 0xC2B2_AE3D
    var corners = SIMD8(
      x[0] ^ y[0] ^ z[0], x[1] ^ y[0] ^ z[0], x[0] ^ y[1] ^ z[0], x[1] ^ y[1] ^ z[0],
      x[0] ^ y[0] ^ z[1], x[1] ^ y[0] ^ z[1], x[0] ^ y[1] ^ z[1], x[1] ^ y[1] ^ z[1])
    corners ^= SIMD8(repeating: seed)
    corners ^= corners &>> 15
    corners = corners &* 0x2C1B_3C6D
    corners ^= corners &>> 12
    corners = corners &* 0x297A_2D39
    corners ^= corners &>> 15
    let values = SIMD8<Float>(corners &>> 8) / Float(1 << 24)
    let front = values.lowHalf
    let back = values.highHalf
    let inZ = front + (back - front) * s.z
    let inY = inZ.lowHalf + (inZ.highHalf - inZ.lowHalf) * s.y
    return inY.x + (inY.y - inY.x) * s.x
  }
}
