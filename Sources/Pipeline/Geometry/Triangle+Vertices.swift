import SceneModel

extension Triangle {
  /// The indices of the three vertices.
  var vertices: [Int] { [Int(a), Int(b), Int(c)] }

  /// The directed edges, each from its first to its second vertex.
  var edges: [SIMD2<UInt32>] { [[a, b], [b, c], [c, a]] }
}
