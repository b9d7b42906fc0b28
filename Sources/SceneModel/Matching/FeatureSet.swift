/// The keypoints of one photo as parallel arrays.
package struct FeatureSet: Sendable {
  /// Bytes per descriptor (RootSIFT). Paper: Lowe 2004, section 6.1: 4 × 4 × 8.
  package static let descriptorLength = 128

  /// Pixels of the upright photo at full size, origin at the top-left corner.
  package var positions: [SIMD2<Float>]
  /// SIFT scale σ in pixels.
  package var scales: [Float]
  /// Orientations in radians.
  package var orientations: [Float]
  /// `count × 128` bytes.
  package var descriptors: [UInt8]
  /// RGB at the keypoint.
  package var colors: [SIMD3<UInt8>]

  /// The number of features.
  package var count: Int { positions.count }

  package init(
    positions: [SIMD2<Float>] = [], scales: [Float] = [], orientations: [Float] = [],
    descriptors: [UInt8] = [], colors: [SIMD3<UInt8>] = []
  ) {
    self.positions = positions
    self.scales = scales
    self.orientations = orientations
    self.descriptors = descriptors
    self.colors = colors
  }

  /// The features with the given indices.
  package func selecting(_ indices: [Int]) -> FeatureSet {
    FeatureSet(
      positions: indices.map { positions[$0] }, scales: indices.map { scales[$0] },
      orientations: indices.map { orientations[$0] },
      descriptors: indices.flatMap {
        descriptors[$0 * Self.descriptorLength..<($0 + 1) * Self.descriptorLength]
      },
      colors: indices.map { colors[$0] })
  }
}
