import CKernels

/// The most similar photos of each photo, by the inner products of their vectors.
package struct SimilarityRanking: Sendable {
  /// Number of neighbors per photo; less than the number of photos.
  package let neighborCount: Int
  /// `neighborCount` entries per photo, most similar first.
  package private(set) var indices: [Int32]
  /// The inner products corresponding to `indices`.
  package private(set) var similarities: [Float]

  /// Compares the vectors of all photos, concatenated in `vectors`, with each other.
  package init(
    vectors: [Float], photoCount: Int, neighborCount: Int, _ control: KernelControl
  ) throws {
    self.neighborCount = max(0, min(neighborCount, photoCount - 1))
    indices = [Int32](repeating: 0, count: photoCount * self.neighborCount)
    similarities = [Float](repeating: 0, count: photoCount * self.neighborCount)
    guard self.neighborCount > 0, !vectors.isEmpty else { return }
    try withKernel(control) { control in
      ck_most_similar(
        vectors, photoCount, vectors.count / photoCount, self.neighborCount, control, &indices,
        &similarities)
    }
  }

  /// The photos most similar to `photo`, most similar first.
  package func neighbors(of photo: Int) -> [Int] {
    indices[photo * neighborCount..<(photo + 1) * neighborCount].map(Int.init)
  }
}
