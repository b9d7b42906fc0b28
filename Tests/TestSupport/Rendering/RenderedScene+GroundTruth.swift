import Foundation
import SceneModel

/// What is exactly known about the photos of a scene.
extension RenderedScene {
  /// The depth (z in the camera frame) at each pixel center; 0 where there is no surface.
  package func depth(_ index: Int) -> [Float] {
    (0..<camera.height).flatMap { row in
      (0..<camera.width).map { column in
        let ray = ray(through: SIMD2(Double(column) + 0.5, Double(row) + 0.5), of: index)
        return caster.hit(from: ray.origin, along: ray.direction)?.distance ?? 0
      }
    }
  }

  /// The mask of photo `index`: gray, 255 on the points of the object for which `isMarked` is true,
  /// 0 elsewhere.
  package func mask(
    _ index: Int, isMarked: (SIMD3<Float>) -> Bool = { _ in true }
  ) -> RasterImage {
    var mask = RasterImage(width: camera.width, height: camera.height, channels: 1)
    let frame = frame(ofObjectIn: index)
    for row in frame.rows {
      for column in frame.columns {
        let ray = ray(through: SIMD2(Double(column), Double(row)) + 0.5, of: index)
        guard let hit = caster.hit(from: ray.origin, along: ray.direction) else { continue }
        let point = ray.origin + ray.direction * hit.distance
        if parts[hit.triangle].surface == 0, isMarked(point) {
          mask.pixels[row * camera.width + column] = 255
        }
      }
    }
    return mask
  }

  /// The pixels of photo `index` that may show the object.
  private func frame(ofObjectIn index: Int) -> (rows: Range<Int>, columns: Range<Int>) {
    let (rows, columns) = (0..<camera.height, 0..<camera.width)
    guard let bounds = object.bounds else { return (0..<0, 0..<0) }
    let ends = [bounds.min, bounds.max].map { SIMD3<Double>($0) }
    let corners = (0..<8).map { corner in
      let (x, y, z) = (ends[corner & 1].x, ends[corner >> 1 & 1].y, ends[corner >> 2].z)
      return poses[index] * SIMD3(x, y, z)
    }
    // The projection of a box is inside of that of its corners if it is before the camera.
    guard corners.allSatisfy({ $0.z > 1e-3 }), camera.distortion == .zero else {
      return (rows, columns)
    }
    let pixels = corners.map { camera.project($0) }
    func span(_ values: [Double], in range: Range<Int>) -> Range<Int> {
      let limits = [(values.min() ?? 0) - 1, (values.max() ?? 0) + 2].map {
        Int(min(max($0, 0), Double(range.count)))
      }
      return limits[0]..<limits[1]
    }
    return (span(pixels.map(\.y), in: rows), span(pixels.map(\.x), in: columns))
  }

  /// Whether a surface point is visible in photo `index`.
  package func isVisible(_ point: SIMD3<Double>, in index: Int) -> Bool {
    let inCamera = poses[index] * point
    guard inCamera.z > 0 else { return false }
    let pixel = camera.project(inCamera)
    guard pixel.x > 0, pixel.y > 0, pixel.x < Double(camera.width),
      pixel.y < Double(camera.height)
    else { return false }
    let origin = SIMD3<Float>(poses[index].center)
    return !caster.isBlocked(
      from: origin, along: SIMD3<Float>(point) - origin, farthest: 0.999)
  }

  /// The exact cameras with about `pointCount` exact points of the object, each observed by at
  /// least two photos: the result of a perfect alignment.
  package func reconstruction(pointCount: Int = 500) -> Reconstruction {
    let photos = poses.indices.map { index in
      Photo(
        id: ID(index), sampleID: index, name: Self.name(index),
        url: URL(fileURLWithPath: "/" + Self.name(index)), width: camera.width,
        height: camera.height, orientation: 1, camera: ID(0))
    }
    let step = max(1, object.positions.count / max(1, pointCount))
    let points = stride(from: 0, to: object.positions.count, by: step).compactMap { vertex in
      let position = SIMD3<Double>(object.positions[vertex])
      let track = poses.indices.filter { isVisible(position, in: $0) }.map {
        Observation(
          photo: ID($0), feature: Int32(vertex), pixel: camera.project(poses[$0] * position))
      }
      return track.count < 2 ? nil : ScenePoint(position: position, track: track)
    }
    return Reconstruction(cameras: [camera], photos: photos, poses: poses, points: points)
  }
}
