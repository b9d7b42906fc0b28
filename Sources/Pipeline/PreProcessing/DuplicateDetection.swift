import SceneModel

/// Detects photos that are the same picture: copies of a file, and re-encoded or resized ones.
///
/// Consecutive photos must never count as duplicates. Even a rotation by one degree shifts edges by
/// more than encoding changes them; therefore every part of the picture must agree.
package struct DuplicateDetection: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum root mean square difference, in gray levels, of any block of two thumbnails. Chosen.
    package var maximumBlockDifference = 2.0
    /// Additional tolerance as a fraction of the block's standard deviation: encoders lose more in
    /// strong texture, while consecutive photos differ by more than the standard deviation itself.
    /// Chosen.
    package var maximumShareOfContrast = 0.15
    /// Side of a block in thumbnail pixels. Chosen.
    package var blockSide = 16
    /// Side of the reduced thumbnails that are compared first, in pixels. Chosen.
    package var coarseSide = 16
    /// Maximum relative difference between the aspect ratios of one picture in two sizes. Chosen.
    package var maximumAspectDifference = 0.01

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns for every photo the index of the photo that it duplicates, or nil for the ones to
  /// keep. Of two copies the larger one is kept; of equally large ones, the first.
  package func run(_ photos: [InspectedPhoto], _ context: StageContext) throws -> [Int?] {
    var originals = [Int?](repeating: nil, count: photos.count)
    let order = photos.indices.sorted { a, b in
      let (x, y) = (photos[a].width * photos[a].height, photos[b].width * photos[b].height)
      return x == y ? a < b : x > y
    }
    let coarse = try photos.map {
      try $0.thumbnail.resized(width: options.coarseSide, height: options.coarseSide)
    }
    var kept: [Int] = []
    for (step, index) in order.enumerated() {
      try context.step(step, of: order.count)
      originals[index] = try kept.first { other in
        if photos[other].contentHash == photos[index].contentHash { return true }
        guard difference(coarse[other], coarse[index]) <= options.maximumBlockDifference else {
          return false
        }
        return try isSame(photos[other], photos[index])
      }
      if originals[index] == nil { kept.append(index) }
    }
    return originals
  }

  private func isSame(_ a: InspectedPhoto, _ b: InspectedPhoto) throws -> Bool {
    let (x, y) = (Double(a.width) / Double(a.height), Double(b.width) / Double(b.height))
    guard abs(x - y) <= options.maximumAspectDifference * max(x, y) else { return false }
    let first = a.thumbnail
    let second = try b.thumbnail.resized(width: first.width, height: first.height)
    for top in stride(from: 0, to: first.height, by: options.blockSide) {
      for left in stride(from: 0, to: first.width, by: options.blockSide) {
        let rows = top..<min(top + options.blockSide, first.height)
        let columns = left..<min(left + options.blockSide, first.width)
        let allowed =
          options.maximumBlockDifference
          + options.maximumShareOfContrast * deviation(first, rows, columns)
        guard difference(first, second, rows, columns) <= allowed else { return false }
      }
    }
    return true
  }

  private func difference(_ a: RasterImage, _ b: RasterImage) -> Double {
    difference(a, b, 0..<a.height, 0..<a.width)
  }

  /// Root mean square difference within a rectangle of two images of the same size, in gray levels.
  private func difference(
    _ a: RasterImage, _ b: RasterImage, _ rows: Range<Int>, _ columns: Range<Int>
  ) -> Double {
    var sum = 0
    for y in rows {
      for index in y * a.width + columns.lowerBound..<y * a.width + columns.upperBound {
        let d = Int(a.pixels[index]) - Int(b.pixels[index])
        sum += d * d
      }
    }
    return (Double(sum) / Double(rows.count * columns.count)).squareRoot()
  }

  /// Standard deviation within a rectangle, in gray levels.
  private func deviation(_ a: RasterImage, _ rows: Range<Int>, _ columns: Range<Int>) -> Double {
    var (sum, squares) = (0, 0)
    for y in rows {
      for index in y * a.width + columns.lowerBound..<y * a.width + columns.upperBound {
        let value = Int(a.pixels[index])
        sum += value
        squares += value * value
      }
    }
    let count = Double(rows.count * columns.count)
    let mean = Double(sum) / count
    return max(0, Double(squares) / count - mean * mean).squareRoot()
  }
}
