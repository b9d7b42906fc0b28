import Foundation
import SceneModel

/// A reconstruction in COLMAP's text format: cameras.txt, images.txt and points3D.txt.
///
/// Ids in the files are indices plus one. An image lists only keypoints that observe a point, in
/// the order of the points; the feature indices that reading returns refer to this list.
package enum COLMAPText {
  /// Writes the three files into `folder`, which is created if missing. Throws `OutputError`.
  package static func write(_ reconstruction: Reconstruction, to folder: URL) throws {
    try AtomicDirectory.write(to: folder) { temporary in
      for (name, text) in encode(reconstruction) {
        try AtomicFile.write(Data(text.utf8), to: temporary.appendingPathComponent(name))
      }
    }
  }

  /// The names and texts of the files that `write` creates.
  package static func encode(
    _ reconstruction: Reconstruction
  ) -> [(name: String, text: String)] {
    let (images, points) = imagesAndPoints(reconstruction)
    return [
      ("cameras.txt", cameras(reconstruction)), ("images.txt", images), ("points3D.txt", points),
    ]
  }

  private static func cameras(_ reconstruction: Reconstruction) -> String {
    var text = """
      # Camera list with one line of data per camera:
      #   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
      # Number of cameras: \(reconstruction.cameras.count)

      """
    for (index, camera) in reconstruction.cameras.enumerated() {
      let d = camera.distortion
      let parameters = [
        camera.focalLength.x, camera.focalLength.y, camera.principalPoint.x,
        camera.principalPoint.y, d.x, d.y, d.z, d.w,
      ]
      text += "\(index + 1) OPENCV \(camera.width) \(camera.height) \(joined(parameters))\n"
    }
    return text
  }

  private static func imagesAndPoints(
    _ reconstruction: Reconstruction
  ) -> (images: String, points: String) {
    let registered = reconstruction.registered
    var keypoints = [String](repeating: "", count: reconstruction.photos.count)
    var counts = [Int](repeating: 0, count: reconstruction.photos.count)
    var points = """
      # 3D point list with one line of data per point:
      #   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
      # Number of points: \(reconstruction.points.count)

      """
    for (index, point) in reconstruction.points.enumerated() {
      let (p, c) = (point.position, point.color)
      points += "\(index + 1) \(joined([p.x, p.y, p.z])) \(c.x) \(c.y) \(c.z) \(point.error)"
      for observation in point.track {
        let photo = observation.photo.index
        guard reconstruction.poses[photo] != nil else { continue }
        points += " \(photo + 1) \(counts[photo])"
        let space = counts[photo] == 0 ? "" : " "
        keypoints[photo] += "\(space)\(observation.pixel.x) \(observation.pixel.y) \(index + 1)"
        counts[photo] += 1
      }
      points += "\n"
    }
    var images = """
      # Image list with two lines of data per image:
      #   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
      #   POINTS2D[] as (X, Y, POINT3D_ID)
      # Number of images: \(registered.count)

      """
    for id in registered {
      guard let pose = reconstruction.poses[id.index] else { continue }
      let photo = reconstruction.photos[id.index]
      let (q, t) = (pose.rotation, pose.translation)
      images += "\(id.index + 1) \(joined([q.w, q.x, q.y, q.z, t.x, t.y, t.z]))"
      images += " \(photo.camera.index + 1) \(singleLine(photo.name))\n"
      images += keypoints[id.index] + "\n"
    }
    return (images, points)
  }

  /// The shortest decimals that parse back to the same numbers.
  private static func joined(_ numbers: [Double]) -> String {
    numbers.map { "\($0)" }.joined(separator: " ")
  }

  private static func singleLine(_ name: String) -> String {
    String(name.map { $0.isNewline ? "_" : $0 })
  }
}
