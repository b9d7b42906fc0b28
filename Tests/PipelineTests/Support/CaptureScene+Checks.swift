import SceneModel
import TestSupport

/// What tests of captures check.
extension CaptureScene {
  /// The share of the object's vertices that are more than a pixel outside of its mask.
  func shareOutsideOfMask(ofPhoto index: Int) -> Double {
    let mask = scene(ofPhoto: index).mask(index)
    let pose = views[index].cameraFromObject
    // Within a pixel, because the mask is that of the pixels' centers.
    let outside = mesh.positions.filter { position in
      let pixel = camera.project(pose * SIMD3<Double>(position))
      let (x, y) = (Int(pixel.x), Int(pixel.y))
      let rows = (y - 1...y + 1).clamped(to: 0...mask.height - 1)
      let columns = (x - 1...x + 1).clamped(to: 0...mask.width - 1)
      return !rows.contains { row in
        columns.contains { mask.pixels[row * mask.width + $0] > 0 }
      }
    }
    return Double(outside.count) / Double(max(1, mesh.positions.count))
  }

  /// The smallest distance of the object from the border of a photo, in pixels.
  var smallestMargin: Double {
    let (width, height) = (Double(camera.width), Double(camera.height))
    let margins = views.flatMap { view in
      mesh.positions.map { position in
        let pixel = camera.project(view.cameraFromObject * SIMD3<Double>(position))
        return min(pixel.x, pixel.y, width - pixel.x, height - pixel.y)
      }
    }
    return margins.min() ?? 0
  }
}
