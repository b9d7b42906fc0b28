import Foundation
import SceneModel

/// A photo with the evidence from the coarse reconstruction.
struct MaskingView: Sendable {
  let photo: ReducedPhoto
  /// The label of the nearest surface point at each pixel, 0 where there is none.
  let labels: RasterImage
  /// Marks the pixels farther inside a label's region than its outline is uncertain.
  let isCore: RasterImage
  /// Marks the pixels within reach of the object.
  let isNear: RasterImage

  /// A photo with the labels of its pixels. `rim` is the width of the uncertain outline in pixels;
  /// `reach` is the distance from the object's points at which its mask ends, as a share of the
  /// diagonal of their bounding box.
  init(_ photo: ReducedPhoto, _ labels: RasterImage, rim: Int, reach: Double) throws {
    (self.photo, self.labels) = (photo, labels)
    let object = labels.marking { $0 == PointLabel.object }
    // The core of a region excludes all pixels near anything else, empty pixels included.
    let notObject = try labels.marking { $0 != PointLabel.object }.dilated(by: rim)
    let notSurroundings = try labels.marking { $0 != PointLabel.surroundings }.dilated(by: rim)
    var core = labels
    for index in core.pixels.indices {
      core.pixels[index] =
        notObject.pixels[index] == 0 || notSurroundings.pixels[index] == 0 ? 255 : 0
    }
    isCore = core
    isNear = try object.dilated(by: Int((reach * object.markedDiagonal).rounded()))
  }
}

extension RasterImage {
  /// The diagonal of the bounding box of the marked pixels of a gray image, in pixels; 0 if there
  /// are none.
  fileprivate var markedDiagonal: Double {
    var (left, right, top, bottom) = (width, -1, height, -1)
    for y in 0..<height {
      for x in 0..<width where pixels[y * width + x] != 0 {
        (left, right) = (min(left, x), max(right, x))
        (top, bottom) = (min(top, y), max(bottom, y))
      }
    }
    return right < 0 ? 0 : hypot(Double(right - left + 1), Double(bottom - top + 1))
  }

  /// A gray image with 255 where `isMarked` holds for the value of a gray pixel.
  func marking(_ isMarked: (UInt8) -> Bool) -> RasterImage {
    var result = self
    for index in pixels.indices { result.pixels[index] = isMarked(pixels[index]) ? 255 : 0 }
    return result
  }
}
