/// The division of a mesh's triangles into blocks.
enum FaceBlocks {
  /// Triangles of each block but the last. Chosen: a few milliseconds of work, and 2 MB of
  /// observations in 15 views.
  static let size = 4096

  /// The number of blocks.
  static func count(faceCount: Int) -> Int { (faceCount + size - 1) / size }

  /// The triangles of a block.
  static func faces(of block: Int, faceCount: Int) -> Range<Int> {
    block * size..<min(faceCount, (block + 1) * size)
  }
}
