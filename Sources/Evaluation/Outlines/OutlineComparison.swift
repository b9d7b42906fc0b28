import Kernels
import SceneModel

/// Compares the outlines of a model in photos, or masks, with other masks.
package struct OutlineComparison: Sendable {
  package struct Options: Codable, Hashable, Sendable {
    /// Outlines are compared at this width, in pixels, or that of the photo if it is less. Chosen:
    /// masks that were drawn by hand are exact to a pixel at about this width.
    package var maximumWidth = 1000

    package init() {}
  }

  package var options: Options
  private let control: KernelControl

  package init(_ options: Options = Options(), _ control: KernelControl) {
    (self.options, self.control) = (options, control)
  }

  /// Draws the model into the photos of `cameras` that have a mask. `model` is in their frame.
  ///
  /// Nil if no photo has a mask. Throws an `ImageError` for a mask that can't be decoded.
  package func run(
    _ model: ShadedModel, _ cameras: [NamedCamera], _ masks: MaskFolder
  ) throws -> OutlineScores? {
    var entries: [OutlineScores.Entry] = []
    for camera in cameras {
      let (width, height) = size(camera.camera.width, camera.camera.height)
      guard let mask = try masks.mask(of: camera.name, width: width, height: height) else {
        continue
      }
      var small = camera
      small.camera = camera.camera.resized(width: width, height: height)
      let view = small
      let rows = try control.parallelMap(height) { row in
        (0..<width).map { column in
          let (origin, direction) = view.ray(throughColumn: column, row: row)
          return model.isHit(from: origin, along: direction)
        }
      }
      entries += Self.entry(camera.name, rows.flatMap { $0 }, mask)
    }
    return OutlineScores(entries)
  }

  /// Compares masks with those of `truth`.
  package func run(_ masks: MaskFolder, _ truth: MaskFolder) throws -> OutlineScores? {
    let entries = try masks.names.flatMap { name -> [OutlineScores.Entry] in
      guard let full = try masks.size(of: name) else { return [] }
      let (width, height) = size(full.width, full.height)
      guard let found = try masks.mask(of: name, width: width, height: height),
        let mask = try truth.mask(of: name, width: width, height: height)
      else { return [] }
      return Self.entry(name, found, mask)
    }
    return OutlineScores(entries)
  }

  private func size(_ width: Int, _ height: Int) -> (width: Int, height: Int) {
    let target = min(options.maximumWidth, width)
    let ratio = Double(target) / Double(max(1, width))
    return (target, max(1, Int((Double(height) * ratio).rounded(.toNearestOrEven))))
  }

  /// None for an empty mask.
  private static func entry(
    _ name: String, _ found: [Bool], _ mask: [Bool]
  ) -> [OutlineScores.Entry] {
    var (both, outside, missing) = (0, 0, 0)
    for (found, wanted) in zip(found, mask) {
      both += found && wanted ? 1 : 0
      outside += found && !wanted ? 1 : 0
      missing += wanted && !found ? 1 : 0
    }
    guard both + missing > 0 else { return [] }
    let area = Double(both + missing)
    return [
      OutlineScores.Entry(
        name: name, intersectionOverUnion: Double(both) / (area + Double(outside)),
        outside: Double(outside) / area, missing: Double(missing) / area)
    ]
  }
}
