import Foundation
import Formats
import Kernels
import SceneModel

/// The solved tiles of a scene in files of a folder.
struct TileSolutions {
  let tiling: Tiling
  let base: TileBase
  let folder: URL

  /// Solves a tile and writes it.
  func solve(_ tile: Int, _ points: PointCloud, _ context: StageContext) throws {
    guard let (solution, samples) = try tiling.solve(points, of: base, context) else { return }
    let box = base.grid.boxes[tile].dilated(by: tiling.halo(base))
    try AtomicFile.write(samples.encoded(), to: file(tile, "samples"))
    try AtomicFile.write(try solution.encoded(for: box), to: file(tile, "surface"))
  }

  /// The surface of a tile, with the vertices of its neighbors at the seams; nil if it has none.
  /// `scene` is all that the photos observe. Also the number of samples that each photo sees.
  func surface(
    _ tile: Int, scene: PointCloud, _ context: StageContext
  ) throws -> (mesh: Mesh, views: [UInt16: Int])? {
    let reach = base.grid.boxes[tile].dilated(by: tiling.halo(base))
    guard let solution = try solution(tile, for: reach, context.control.part(from: 0, to: 0.1))
    else { return nil }
    let boxes = base.grid.boxes
    for other in boxes.indices where other != tile && boxes[other].overlaps(reach) {
      guard
        let neighbor = try self.solution(
          other, for: reach, context.part(from: 0.1, to: 0.1).control)
      else { continue }
      try solution.adopt(
        neighbor, below: base.solution.depth, in: boxes[other],
        context.part(from: 0.1, to: 0.1).control)
    }
    var samples = PointCloud()
    guard samples.append(encoded: try bytes(tile, "samples")[...]) else {
      throw WorkspaceError.changed(file: file(tile, "samples").path)
    }
    let mesh = try tiling.surface(
      tile, solution, samples: samples, of: base, scene: scene, context.part(from: 0.1, to: 1))
    guard let mesh else { return nil }
    return (mesh, samples.photoIndices.reduce(into: [:]) { $0[$1, default: 0] += 1 })
  }

  private func solution(
    _ tile: Int, for box: CellBox, _ control: KernelControl
  ) throws -> PoissonSolution? {
    guard FileManager.default.fileExists(atPath: file(tile, "surface").path) else { return nil }
    // Mapped: of a neighbor, only what is near the seam is read.
    let data = try Data(contentsOf: file(tile, "surface"), options: .alwaysMapped)
    return try data.withUnsafeBytes { try PoissonSolution(encoded: $0, for: box, control) }
  }

  private func bytes(_ tile: Int, _ kind: String) throws -> [UInt8] {
    [UInt8](try Data(contentsOf: file(tile, kind)))
  }

  private func file(_ tile: Int, _ kind: String) -> URL {
    folder.appendingPathComponent("\(tile).\(kind)")
  }
}
