import SceneModel

extension Triangle {
  /// The indices of the three vertices.
  var vertices: Triple<Int> { Triple(Int(a), Int(b), Int(c)) }

  /// The directed edges, each from its first to its second vertex.
  var edges: Triple<SIMD2<UInt32>> { Triple([a, b], [b, c], [c, a]) }
}
