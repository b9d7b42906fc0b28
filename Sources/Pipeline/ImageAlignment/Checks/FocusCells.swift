import SceneModel

/// A grid of cells around the focus of a photo.
struct FocusCells {
  private let center: SIMD2<Double>
  /// Radius of the focus, and side of a cell, in pixels.
  private let radius: Double
  private let side: Double
  /// Number of cells on each side of the center, and the factor by which the radius of the
  /// surroundings is larger.
  private let reach: Int
  private let factor: Double
  private var isMarked: [Bool]

  init(center: SIMD2<Double>, radius: Double, factor: Double, cellsPerRadius: Int) {
    (self.center, self.radius, self.factor) = (center, radius, factor)
    side = radius / Double(cellsPerRadius)
    reach = Int((factor * Double(cellsPerRadius)).rounded(.up))
    isMarked = Array(repeating: false, count: 4 * reach * reach)
  }

  /// Marks the cell of a pixel, if there is one.
  mutating func mark(_ pixel: SIMD2<Double>) {
    let place = (pixel - center) / side + Double(reach)
    guard place.min() >= 0, place.max() < Double(2 * reach) else { return }
    isMarked[Int(place.y) * 2 * reach + Int(place.x)] = true
  }

  /// Calls `body` with the distance of each cell within a camera's frame from the center, in radii
  /// of the focus, and whether it is marked.
  func forEach(in camera: Camera, _ body: (Double, Bool) -> Void) {
    for (index, isMarked) in isMarked.enumerated() {
      let (row, column) = index.quotientAndRemainder(dividingBy: 2 * reach)
      let offset = side * (SIMD2(Double(column), Double(row)) + 0.5 - Double(reach))
      let distance = offset.length / radius
      if distance < factor, camera.contains(center + offset) { body(distance, isMarked) }
    }
  }
}
