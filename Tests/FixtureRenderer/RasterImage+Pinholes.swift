import SceneModel

extension RasterImage {
  /// A mask without the single pixels whose rays pass between two adjacent triangles.
  var withoutPinholes: RasterImage {
    var result = self
    for pixel in width..<max(width, pixels.count - width) where pixels[pixel] == 0 {
      let neighbors = [pixel - width, pixel - 1, pixel + 1, pixel + width]
      if neighbors.allSatisfy({ pixels[$0] > 0 }) { result.pixels[pixel] = 255 }
    }
    return result
  }
}
