import Kernels
import SceneModel

/// Paints the textures from the photos, one photo at a time.
struct TexturePainting: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum pixels of a view. Chosen.
    var maximumPixels = 8_000_000
  }

  /// Number of photos that are decoded at the same time. Chosen: of 8 MP, they take 100 MB.
  private static let concurrentViews = 4

  var options = Options()
  var weights: CornerWeights
  var leveling: LevelingOffsets
  /// By view number, as are `views`.
  var gains: [ExposureGain]
  var views: [ID<Photo>]
  var source: ViewSource
  /// Linear ratio of texels to photo pixels.
  var magnification: Float

  /// Paints `faces` onto the canvas.
  func run(on canvas: TextureCanvas, faces: [Int], _ context: StageContext) throws {
    var paints = [[FacePaint]](repeating: [], count: views.count + 1)
    for face in faces {
      for paint in Self.paints(of: face, weights, leveling) {
        paints[Int(paint.view) + 1].append(paint.value)
      }
    }
    for (index, gain) in gains.enumerated() { Self.add(gain.offset, to: &paints[index + 1]) }
    try canvas.paint(paints[0], from: nil, context.part(from: 0, to: 0).control)
    let used = views.indices.filter { !paints[$0 + 1].isEmpty }
    let control = context.part(from: 0, to: 0).control
    for start in stride(from: 0, to: used.count, by: Self.concurrentViews) {
      try context.step(start, of: used.count)
      let indices = Array(used[start..<min(used.count, start + Self.concurrentViews)])
      let loaded = try control.parallelMap(indices.count) { unit in
        let photo = views[indices[unit]]
        return try source.view(photo, pixels(of: photo))
      }
      for (index, view) in zip(indices, loaded) {
        try canvas.paint(paints[index + 1], from: view, gain: gains[index].factors, control)
      }
    }
  }

  private static func add(_ offset: SIMD3<Float>, to paints: inout [FacePaint]) {
    for index in paints.indices {
      paints[index].offsets.0 += offset
      paints[index].offsets.1 += offset
      paints[index].offsets.2 += offset
    }
  }

  /// Maximum pixels of a photo's view: for small textures, two pixels per texel (linear) suffice.
  private func pixels(of photo: ID<Photo>) -> Int {
    let camera = source.reconstruction.camera(of: photo)
    let useful = Float(camera.width * camera.height) * 4 * magnification * magnification
    return min(options.maximumPixels, max(100_000, Int(min(useful, 1e9))))
  }

  /// The weights and offsets of one triangle's corners, by view.
  private static func paints(
    of face: Int, _ weights: CornerWeights, _ leveling: LevelingOffsets
  ) -> [(view: Int32, value: FacePaint)] {
    var result: [(view: Int32, value: FacePaint)] = []
    for corner in 0..<3 {
      for index in weights.shares(of: 3 * face + corner).indices {
        let share = weights.shares[index]
        let place =
          result.firstIndex { $0.view == share.view }
          ?? {
            let none = SIMD3<Float>.zero
            result.append(
              (
                share.view,
                FacePaint(face: Int32(face), weights: .zero, offsets: (none, none, none))
              )
            )
            return result.count - 1
          }()
        result[place].value.weights[corner] = share.weight
        result[place].value.setOffset(leveling.offsets[index], at: corner)
      }
    }
    for place in result.indices { result[place].value.fillMissingOffsets() }
    return result
  }
}

extension FacePaint {
  fileprivate mutating func setOffset(_ offset: SIMD3<Float>, at corner: Int) {
    switch corner {
    case 0: offsets.0 = offset
    case 1: offsets.1 = offset
    default: offsets.2 = offset
    }
  }

  /// Sets the offset of corners without weight to the mean of the others.
  fileprivate mutating func fillMissingOffsets() {
    let all = [offsets.0, offsets.1, offsets.2]
    let used = (0..<3).filter { weights[$0] > 0 }
    guard !used.isEmpty else { return }
    let mean = used.reduce(SIMD3<Float>.zero) { $0 + all[$1] } / Float(used.count)
    for corner in 0..<3 where weights[corner] <= 0 { setOffset(mean, at: corner) }
  }
}
