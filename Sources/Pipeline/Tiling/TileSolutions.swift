import Formats
import Foundation
import Kernels
import SceneModel

/// The solved tiles of a scene in files of a folder.
struct TileSolutions {
  let tiling: Tiling
  let base: TileBase
  let folder: URL
  /// Whether each tile has a solution.
  private var isSolved: [Bool]

  init(_ tiling: Tiling, _ base: TileBase, in folder: URL) {
    (self.tiling, self.base, self.folder) = (tiling, base, folder)
    isSolved = base.grid.boxes.map { _ in false }
  }

  /// Solves a tile and writes it. Throws `OutputError` if it can't be written.
  mutating func solve(_ tile: Int, _ points: PointCloud, _ context: StageContext) throws {
    guard let (solution, samples) = try tiling.solve(tile, points, of: base, context) else {
      return
    }
    let box = base.grid.boxes[tile].dilated(by: tiling.halo(base))
    try AtomicFile.write(samples.encoded(), to: file(tile, "samples"))
    try AtomicFile.write(try solution.encoded(for: box), to: file(tile, "surface"))
    isSolved[tile] = true
  }

  /// The surface of a tile, with the vertices of its neighbors at the seams, and the photos that
  /// see it; nil if it has none. `scene` is all that the photos observe. Throws `WorkspaceError` if
  /// a file was changed or deleted.
  func surface(
    _ tile: Int, scene: PointCloud, _ context: StageContext
  ) throws -> (mesh: Mesh, photos: Set<UInt16>)? {
    guard isSolved[tile] else { return nil }
    let (boxes, control) = (base.grid.boxes, context.part(from: 0, to: 0).control)
    let reach = boxes[tile].dilated(by: tiling.halo(base))
    let solution = try solution(tile, for: reach, control)
    for other in boxes.indices
    where other != tile && isSolved[other] && boxes[other].overlaps(reach) {
      try solution.adopt(
        try self.solution(other, for: reach, control), below: base.solution.depth,
        in: boxes[other], control)
    }
    var samples = PointCloud()
    guard samples.append(encoded: [UInt8](try data(tile, "samples"))[...]) else {
      throw WorkspaceError.changed(file: file(tile, "samples").path)
    }
    let mesh = try tiling.surface(
      tile, solution, samples: samples, of: base, scene: scene, context)
    return mesh.map { ($0, Set(samples.photoIndices)) }
  }

  private func solution(
    _ tile: Int, for box: CellBox, _ control: KernelControl
  ) throws -> PoissonSolution {
    try data(tile, "surface").withUnsafeBytes {
      try PoissonSolution(encoded: $0, for: box, control)
    }
  }

  /// Mapped: of a neighbor, only what is near the seam is read.
  private func data(_ tile: Int, _ kind: String) throws -> Data {
    guard let data = try? Data(contentsOf: file(tile, kind), options: .alwaysMapped) else {
      throw WorkspaceError.changed(file: file(tile, kind).path)
    }
    return data
  }

  private func file(_ tile: Int, _ kind: String) -> URL {
    folder.appendingPathComponent("\(tile).\(kind)")
  }
}
