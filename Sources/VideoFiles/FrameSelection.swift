import Foundation

/// Selects sharp frames at even distances along the camera's path.
package struct FrameSelection: Sendable {
  package struct Options: Hashable, Sendable {
    /// Distance between frames as a share of the picture's diagonal. Chosen.
    package var step = 0.03
    /// Bounds of the number of frames: the step is changed to keep them, as far as there are
    /// frames. Chosen.
    package var minimumCount = 40
    package var maximumCount = 250
    /// How far a frame may be from its place to be the sharper one, as a share of the step. Chosen:
    /// neighbors are then 0.2 to 1.8 steps apart. See `VideoAnalysis.Options.framesPerSecond`.
    package var tolerance = 0.4

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The selected frames, in order; `readings` are in the order of time. The number of frames is
  /// `count` if it isn't nil, else it follows from the path.
  package func run(_ readings: [FrameReading], count: Int? = nil) -> [FrameReading] {
    guard let first = readings.first, let last = readings.last else { return [] }
    let length = last.position - first.position
    let count = min(count ?? self.count(alongPathOf: length), readings.count)
    guard length > 0 else { return evenlyInTime(readings, count: count) }
    let step = length / Double(count)
    var result: [FrameReading] = []
    var remaining = readings[...]
    for place in 0..<count {
      let center = first.position + (Double(place) + 0.5) * step
      guard let best = best(near: center, within: options.tolerance * step, of: remaining),
        best.position < center + step
      else { continue }
      result.append(remaining[best.place])
      remaining = remaining[(best.place + 1)...]
    }
    return result
  }

  /// The number of frames of a path of this length.
  package func count(alongPathOf length: Double) -> Int {
    let count = (length / options.step).rounded()
    return Int(min(max(count, Double(options.minimumCount)), Double(options.maximumCount)))
  }

  /// The sharpest frame that is close enough to a place, else the nearest; nil if there are none.
  private func best(
    near center: Double, within tolerance: Double, of readings: ArraySlice<FrameReading>
  ) -> (place: Int, position: Double)? {
    let start = readings.partitioningIndex { $0.position >= center - tolerance }
    let end = readings.partitioningIndex { $0.position > center + tolerance }
    let place =
      (start..<end).max { readings[$0].sharpness < readings[$1].sharpness }
      ?? (max(readings.startIndex, start - 1)..<min(readings.endIndex, start + 1)).min {
        abs(readings[$0].position - center) < abs(readings[$1].position - center)
      }
    return place.map { ($0, readings[$0].position) }
  }

  private func evenlyInTime(_ readings: [FrameReading], count: Int) -> [FrameReading] {
    (0..<count).map { readings[(2 * $0 + 1) * readings.count / (2 * count)] }
  }
}

extension ArraySlice<FrameReading> {
  /// The index of the first element that fulfills the condition, which all later ones also do.
  fileprivate func partitioningIndex(_ isInSecondPart: (Element) -> Bool) -> Int {
    var (low, high) = (startIndex, endIndex)
    while low < high {
      let middle = (low + high) / 2
      if isInSecondPart(self[middle]) { high = middle } else { low = middle + 1 }
    }
    return low
  }
}
