import Kernels
import SceneModel

/// The objects of the photo sets of a publication, in place of which sets of the same kind are
/// rendered: another object of the kind for each seed.
///
/// Their frame has +y up and its origin below the middle of the object, which stands on y = 0.
package enum TwinObject: String, CaseIterable, Sendable {
  /// A figure of about 15 cm with rich texture.
  case statuette
  /// A figure of about 1 m, of pale marble with veins of low contrast, outdoors.
  case marbleStatue = "marble-statue"
  /// A car of about 12 cm with sharp edges and thin parts. Its photos are one continuous walk.
  case toyCar = "toy-car"
  /// A surface of revolution of about 25 cm, whose glaze has hardly more contrast than the noise.
  case paleVase = "pale-vase"
  /// About 8 cm, with speckles, a gradient of its color, a dimple and a stem.
  case apple

  /// Shape and colors; the shape is inside of a box.
  struct Model: Sendable {
    var solid: Solid
    var texture: any SurfaceTexture
    var low: SIMD3<Float>
    var high: SIMD3<Float>
    /// Width of the cells of the mesh in meters.
    var cell: Float

    /// The surface on y = 0; its texture is moved with it.
    func surface(fineness: Float, _ control: KernelControl) throws -> RenderedScene.Surface {
      var mesh = try solid.mesh(from: low, to: high, cell: cell / fineness, control)
      let lowest = mesh.positions.map(\.y).min() ?? 0
      for index in mesh.positions.indices { mesh.positions[index].y -= lowest }
      return RenderedScene.Surface(
        mesh: mesh, texture: texture,
        textureFromWorld: RigidTransform(
          rotation: .identity, translation: [0, Double(lowest), 0]))
    }
  }

  func model(seed: UInt64) -> Model {
    var random = TwinRandom(seed: seed &* 1_013 &+ number)
    return switch self {
    case .statuette: Statuette(&random).model
    case .marbleStatue: MarbleStatue(&random).model
    case .toyCar: ToyCar(&random).model
    case .paleVase: PaleVase(&random).model
    case .apple: Apple(&random).model
    }
  }

  /// Distinguishes the seeds of the objects.
  var number: UInt64 { UInt64(Self.allCases.firstIndex(of: self) ?? 0) }

  /// Number of photos, with those that are held out.
  package var photoCount: Int {
    switch self {
    case .statuette, .marbleStatue: 150
    case .toyCar: 80
    case .paleVase: 120
    case .apple: 200
    }
  }
}
