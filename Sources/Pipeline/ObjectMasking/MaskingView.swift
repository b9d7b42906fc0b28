import Foundation
import Kernels
import SceneModel

/// What a coarse reconstruction shows at a pixel of a photo.
enum PointLabel {
  /// A surface point of the object.
  static let object: UInt8 = 1
  /// A surface point of the surroundings.
  static let surroundings: UInt8 = 2
}

/// A registered photo at the size of its mask.
struct ReducedPhoto: Sendable {
  let id: ID<Photo>
  /// The photo's camera, with distortion, at this size.
  let camera: Camera
  let cameraFromWorld: RigidTransform
  /// RGB.
  let image: RasterImage
  /// Marks the backdrop; nil if the photos show none.
  var backdrop: RasterImage?

  var pixelCount: Int { image.width * image.height }

  init(_ id: ID<Photo>, _ reconstruction: Reconstruction, _ image: RasterImage) throws {
    (self.id, self.image) = (id, image)
    camera = reconstruction.camera(of: id).resized(width: image.width, height: image.height)
    cameraFromWorld = reconstruction.poses[id.index] ?? .identity
  }

  /// The pixel that shows a point; nil if it is outside the frame.
  func pixel(of point: SIMD3<Float>) -> Int? {
    let seen = cameraFromWorld * SIMD3<Double>(point)
    guard seen.z > 0 else { return nil }
    let pixel = camera.project(seen)
    guard camera.contains(pixel) else { return nil }
    return Int(pixel.y) * image.width + Int(pixel.x)
  }

  /// Whether the photo shows the backdrop at a pixel.
  func showsBackdrop(at pixel: Int) -> Bool { (backdrop?.pixels[pixel] ?? 0) != 0 }

  /// The RGB color of a pixel, 0…255.
  func color(at pixel: Int) -> SIMD3<Float> {
    SIMD3((0..<3).map { Float(image.pixels[3 * pixel + $0]) })
  }
}

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
