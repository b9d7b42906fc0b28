/// What a coarse reconstruction shows at a pixel of a photo.
enum PointLabel {
  /// A surface point of the object.
  static let object: UInt8 = 1
  /// A surface point of the surroundings.
  static let surroundings: UInt8 = 2
}
