import SceneModel

/// Finds photos that are the same picture: copies of a file, and re-encoded or resized ones.
///
/// Photos taken one after the other must never count as duplicates: even a turn by a degree moves
/// edges by more than what encoding changes, so that every part of the picture has to agree.
package struct DuplicateDetection: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Root mean square difference, in gray levels, that any block of two thumbnails may have.
    package var maximumBlockDifference = 2.0
    /// What is allowed on top, as a share of the block's standard deviation: encoders lose more of
    /// strong texture, and photos taken one after the other differ by more than the whole of it.
    package var maximumShareOfContrast = 0.15
    /// Side of a block in pixels of the thumbnail.
    package var blockSide = 16
    /// Relative difference of the aspects of one picture in two sizes.
    package var maximumAspectDifference = 0.01

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// For every photo the index of the photo that it repeats, nil for those to keep. Of two copies
  /// the larger is kept, of equal ones the first.
  package func run(_ photos: [InspectedPhoto], _ context: StageContext) throws -> [Int?] {
    var originals = [Int?](repeating: nil, count: photos.count)
    let order = photos.indices.sorted { a, b in
      let (x, y) = (photos[a].width * photos[a].height, photos[b].width * photos[b].height)
      return x == y ? a < b : x > y
    }
    let coarse = try photos.map { try $0.thumbnail.resized(width: 16, height: 16) }
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

  /// Root mean square difference inside a rectangle of two images of one size.
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

  /// Standard deviation inside a rectangle.
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
