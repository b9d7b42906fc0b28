import SceneModel

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
