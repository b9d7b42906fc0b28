import Formats
import Foundation
import Kernels
import SceneModel

extension Checkpoint {
  /// Whether a folder is a checkpoint directory rather than a model's.
  package static func isOne(_ folder: URL) -> Bool {
    let checkpoint = Checkpoint(directory: folder)
    let poses = checkpoint.sparse.appendingPathComponent("images.txt")
    return FileManager.default.fileExists(atPath: poses.path)
  }
}

extension SavedRun {
  /// The content of its `report.json`, and the names of the photos in it. Throws `SavedRunError`.
  package func reportData() throws -> (json: Data, names: [String]) {
    guard let json = FileManager.default.contents(atPath: reportFile.path),
      let report = try? JSONDecoder().decode(RunReport.self, from: json)
    else {
      throw SavedRunError.damaged(
        path: reportFile.path, reason: "it is not a report of this program")
    }
    return (json, report.photos.map(\.name))
  }
}

extension ReportMaterial {
  /// What the page of a saved run shows: the surface before simplification, with the colors of the
  /// nearest dense points. Throws `SavedRunError` if photos have changed.
  package init(_ saved: SavedRun, names: [String], _ context: StageContext) throws {
    let ingested = try SavedPhotos().run(saved, context.part(from: 0, to: 0.5))
    let reconstruction = saved.reconstruction(of: ingested)
    let control = context.part(from: 0.5, to: 1).control
    var mesh = saved.surface
    if let cloud = try? PLY.readPointCloud(saved.cloudFile), !cloud.positions.isEmpty {
      points.dense = PagePoints(cloud.positions, cloud.colors)
      mesh.colors = try NearestPoints(of: mesh.positions, in: cloud.positions, control)
        .indices.map { cloud.colors[max(0, Int($0))] }
    }
    points.sparse = PagePoints(
      reconstruction.points.map { SIMD3<Float>($0.position) }, reconstruction.points.map(\.color))
    model = try PageModel(
      TexturedMesh(mesh: mesh, textureCoordinates: [], textureTriangles: [], atlases: []), [],
      context.part(from: 1, to: 1))
    photos = try ReportPictures(
      ingested: ingested, images: ImageStore(photos: ingested.photos),
      reconstruction: reconstruction
    ).run(names: names, control)
  }
}
