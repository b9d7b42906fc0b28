import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Renders an overview of a textured model from several sides, for inspection without a viewer.
package struct ModelPreview: Sendable {
  /// Parameters of the preview.
  package struct Options: Hashable, Codable, Sendable {
    /// Pixels of a picture's longer side. Chosen.
    package var tileSide = 480
    /// Pictures per row. Chosen: two rows of the eight views of `Turntable`.
    package var columns = 4
    var turntable = Turntable.Options()
    var picture = ModelPicture.Options()

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The pictures in rows, ordered counterclockwise around the model as seen from above; RGB.
  ///
  /// All have the same scale. `cameras` are the photos' `cameraFromWorld`: they determine the
  /// photographed side and the elevation.
  package func run(
    _ model: TexturedMesh, cameras: [RigidTransform], _ context: StageContext
  ) throws -> RasterImage {
    let textures = try context.control.part(from: 0, to: 0.3).parallelMap(model.atlases.count) {
      try model.atlases[$0].maps[.diffuseColor].map(MipMap.init)
    }
    var model = model
    if model.mesh.normals.count != model.mesh.positions.count {
      model.mesh.normals = model.mesh.angleWeightedNormals()
    }
    let turntable = Turntable(options: options.turntable)
    let viewpoints = try turntable.viewpoints(
      of: model.mesh.positions, cameras: cameras, side: options.tileSide,
      context.control.part(from: 0.3, to: 0.4))
    let picture = ModelPicture(options: options.picture, model: model, textures: textures)
    let tiles = try context.control.part(from: 0.4, to: 1).parallelMap(viewpoints.poses.count) {
      picture.rendered(by: viewpoints.camera, from: viewpoints.poses[$0])
    }
    return overview(tiles, viewpoints.camera)
  }

  /// Renders the overview and writes it as PNG.
  package func write(
    _ model: TexturedMesh, cameras: [RigidTransform], to file: URL, _ context: StageContext
  ) throws {
    let overview = try run(model, cameras: cameras, context)
    try AtomicFile.write(try ImageCodec.encodePNG(overview), to: file)
  }

  /// Arranges the pictures in rows; missing ones are filled with the background.
  private func overview(_ tiles: [RasterImage], _ camera: Camera) -> RasterImage {
    let columns = max(1, min(options.columns, tiles.count))
    let rows = max(1, (tiles.count + columns - 1) / columns)
    let (width, height) = (camera.width, camera.height)
    let background = options.picture.background
    var pixels: [UInt8] = []
    pixels.reserveCapacity(3 * columns * width * rows * height)
    for row in 0..<rows * height {
      for column in 0..<columns {
        let number = row / height * columns + column
        if tiles.indices.contains(number) {
          let start = 3 * width * (row % height)
          pixels += tiles[number].pixels[start..<start + 3 * width]
        } else {
          for _ in 0..<width { pixels += [background.x, background.y, background.z] }
        }
      }
    }
    return RasterImage(
      width: columns * width, height: rows * height, channels: 3, pixels: pixels)
  }
}
