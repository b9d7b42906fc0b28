import Foundation

/// The structural similarity of two gray images (Wang et al., "Image quality assessment: from error
/// visibility to structural similarity", IEEE TIP 2004), of the weighted pixels only.
///
/// Means, variances and covariance of a window are those of its weighted pixels, so that what
/// surrounds a masked object does not count.
struct StructuralSimilarity {
  /// Radius and standard deviation of the Gaussian window, in pixels, and the constants of the
  /// stabilizing terms for values from 0 to 1. Paper: Wang 2004, section III.C.
  private static let radius = 5
  private static let sigma: Float = 1.5
  private static let c1: Float = 0.01 * 0.01
  private static let c2: Float = 0.03 * 0.03

  let width: Int
  let height: Int
  /// 0 or 1 per pixel.
  let weights: [Float]

  /// The mean over the weighted pixels; 1 for equal images. Values are 0…1.
  func mean(_ a: [Float], _ b: [Float]) -> Double {
    let total = blurred(weights)
    func local(_ values: [Float]) -> [Float] {
      zip(blurred(zip(values, weights).map { $0 * $1 }), total).map { $1 > 0 ? $0 / $1 : 0 }
    }
    let (meanA, meanB) = (local(a), local(b))
    let (squareA, squareB) = (local(a.map { $0 * $0 }), local(b.map { $0 * $0 }))
    let product = local(zip(a, b).map { $0 * $1 })
    var (sum, count) = (0.0, 0.0)
    for index in weights.indices where weights[index] > 0 {
      let (ma, mb) = (meanA[index], meanB[index])
      let (va, vb) = (squareA[index] - ma * ma, squareB[index] - mb * mb)
      let covariance = product[index] - ma * mb
      let numerator = (2 * ma * mb + Self.c1) * (2 * covariance + Self.c2)
      let denominator = (ma * ma + mb * mb + Self.c1) * (va + vb + Self.c2)
      sum += Double(numerator / denominator)
      count += 1
    }
    return count > 0 ? sum / count : 0
  }

  /// The convolution with the window; what is beyond the border counts as zero.
  private func blurred(_ values: [Float]) -> [Float] {
    let window = (-Self.radius...Self.radius).map { offset in
      exp(-Float(offset * offset) / (2 * Self.sigma * Self.sigma))
    }
    var rows = [Float](repeating: 0, count: values.count)
    var result = rows
    for y in 0..<height {
      for (index, weight) in window.enumerated() {
        let shift = index - Self.radius
        for x in max(0, -shift)..<max(max(0, -shift), min(width, width - shift)) {
          rows[y * width + x] += weight * values[y * width + x + shift]
        }
      }
    }
    for y in 0..<height {
      for (index, weight) in window.enumerated() {
        let from = y + index - Self.radius
        guard from >= 0, from < height else { continue }
        for x in 0..<width { result[y * width + x] += weight * rows[from * width + x] }
      }
    }
    return result
  }
}
