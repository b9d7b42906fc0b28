import ArgumentParser
import Formats
import Foundation
import Kernels
import SceneModel

/// Segments a surface into charts, projects each onto its plane and packs all at one scale into a
/// square.
///
/// Writes the chart of each triangle, then the texel coordinates of its three corners.
struct Charts: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "charts")

  @Argument(help: "A mesh, PLY.") var mesh: String
  @Argument(help: "Charts and corners.") var output: String
  @Option(help: "Side of the square in texels.") var side = 2048
  @Option(help: "Texels between charts.") var padding = 2
  @Option(help: "Threads.") var threads = 1

  struct Result: Codable {
    var charts: Int
    var clustering: Cost
    var packing: Cost
  }

  func run() throws {
    let control = KernelControl(threadCount: threads)
    let mesh = try PLY.readMesh(URL(fileURLWithPath: mesh))
    let (clusters, clustering) = try Cost.measuring { try ChartClustering().run(mesh, control) }
    let corners = planeCoordinates(mesh, clusters.charts, clusters.axes)
    let packer = ChartPacking(side: side, padding: padding, maximumScale: .greatestFiniteMagnitude)
    let (placements, packing) = try Cost.measuring {
      try packer.run(
        corners: corners, charts: clusters.charts,
        density: Array(repeating: 1, count: clusters.axes.count), control)
    }
    var numbers = clusters.charts.map(Double.init)
    for (index, corner) in corners.enumerated() {
      let texel = placements[Int(clusters.charts[index / 3])].texel(corner)
      numbers += [Double(texel.x), Double(texel.y)]
    }
    try NumberFile.write(numbers, to: output)
    try printJSON(Result(charts: clusters.axes.count, clustering: clustering, packing: packing))
  }

  /// Each triangle's three corners on the plane of its chart, which is turned so that the chart's
  /// bounding rectangle is small, as the texture stage does.
  private func planeCoordinates(
    _ mesh: Mesh, _ charts: [Int32], _ axes: [SIMD3<Float>]
  ) -> [SIMD2<Float>] {
    let frames = axes.map { axis in
      let helper: SIMD3<Float> = abs(axis.y) < 0.9 ? [0, 1, 0] : [1, 0, 0]
      let u = helper.cross(axis).normalized
      return (u: u, v: axis.cross(u))
    }
    var corners: [SIMD2<Float>] = []
    var members = [[Int]](repeating: [], count: axes.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      let frame = frames[Int(charts[face])]
      for vertex in [triangle.a, triangle.b, triangle.c].map(Int.init) {
        members[Int(charts[face])].append(corners.count)
        let position = mesh.positions[vertex]
        corners.append([position.dot(frame.u), -position.dot(frame.v)])
      }
    }
    for chart in members {
      let turn = smallestBoxRotation(of: chart.map { corners[$0] })
      for corner in chart { corners[corner] = rotate(corners[corner], turn) }
    }
    return corners
  }

  /// The rotation, of 30 in a quarter turn, that makes the bounding rectangle smallest.
  private func smallestBoxRotation(of points: [SIMD2<Float>]) -> Float {
    func area(_ angle: Float) -> Float {
      let turned = points.map { rotate($0, angle) }
      let (low, high) = turned.dropFirst().reduce((turned[0], turned[0])) {
        (pointwiseMin($0.0, $1), pointwiseMax($0.1, $1))
      }
      return (high.x - low.x) * (high.y - low.y)
    }
    let angles = (0..<30).map { Float($0) / 30 * Float.pi / 2 }
    return angles.map { (area($0), $0) }.min { $0.0 < $1.0 }?.1 ?? 0
  }

  private func rotate(_ p: SIMD2<Float>, _ angle: Float) -> SIMD2<Float> {
    [cos(angle) * p.x - sin(angle) * p.y, sin(angle) * p.x + cos(angle) * p.y]
  }
}

/// Simplifies a mesh.
struct Simplify: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "simplify")

  @Argument(help: "A mesh, PLY.") var mesh: String
  @Argument(help: "The simplified mesh, PLY.") var output: String
  @Option(help: "Maximum number of triangles.") var triangles: Int
  @Option(help: "Threads.") var threads = 1

  func run() throws {
    let mesh = try PLY.readMesh(URL(fileURLWithPath: mesh))
    let (result, cost) = try Cost.measuring {
      try mesh.simplified(maximumTriangles: triangles, KernelControl(threadCount: threads))
    }
    try PLY.write(result, to: URL(fileURLWithPath: output))
    try printJSON(cost)
  }
}

/// Reconstructs the Poisson surface of a point cloud.
struct Poisson: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "poisson")

  @Argument(help: "A cloud with normals, PLY.") var cloud: String
  @Argument(help: "The surface, PLY.") var output: String
  @Option(help: "Levels of the octree.") var depth = 9
  @Option(help: "Threads.") var threads = 1

  func run() throws {
    let cloud = try PLY.readPointCloud(URL(fileURLWithPath: cloud))
    var solver = PoissonReconstruction()
    solver.depth = depth
    let (surface, cost) = try Cost.measuring {
      try solver.surface(
        positions: cloud.positions, normals: cloud.normals, KernelControl(threadCount: threads)
      ).mesh
    }
    try PLY.write(surface, to: URL(fileURLWithPath: output))
    try printJSON(cost)
  }
}
