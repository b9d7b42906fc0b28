import SceneModel

/// A model in memory: the result of `Request.modelEntity`.
///
/// There is no renderer here, so an entity is its content: the mesh with textures in `model`, and
/// its transform. It has no parent and no children. It may be used from any thread.
public final class ModelEntity: Identifiable, Sendable {
  private struct State {
    var name = ""
    var isEnabled = true
    var transform = Transform.identity
    var model: ModelComponent?
  }

  private let state: Locked<State>

  /// Creates an entity at the origin without a model.
  public init() { state = Locked(State()) }

  /// Creates an entity at the origin with a model.
  public init(mesh: MeshResource, materials: [any Material] = []) {
    state = Locked(State(model: ModelComponent(mesh: mesh, materials: materials)))
  }

  /// The identity of the entity.
  public var id: UInt64 { UInt64(UInt(bitPattern: ObjectIdentifier(self))) }

  /// The name of the entity.
  public var name: String {
    get { state.withLock { $0.name } }
    set { state.withLock { $0.name = newValue } }
  }

  /// Whether the entity is visible.
  public var isEnabled: Bool {
    get { state.withLock { $0.isEnabled } }
    set { state.withLock { $0.isEnabled = newValue } }
  }

  /// The transform from the entity to the world.
  public var transform: Transform {
    get { state.withLock { $0.transform } }
    set { state.withLock { $0.transform = newValue } }
  }

  /// The mesh of the entity and its materials.
  public var model: ModelComponent? {
    get { state.withLock { $0.model } }
    set { state.withLock { $0.model = newValue } }
  }
}

extension ModelEntity {
  /// The translation of the entity.
  public var position: SIMD3<Float> {
    get { transform.translation }
    set { transform.translation = newValue }
  }

  /// The rotation of the entity.
  public var orientation: simd_quatf {
    get { transform.rotation }
    set { transform.rotation = newValue }
  }

  /// The scale along the entity's axes.
  public var scale: SIMD3<Float> {
    get { transform.scale }
    set { transform.scale = newValue }
  }

  /// The transform of the entity as a matrix, relative to another entity or to the world.
  public func transformMatrix(relativeTo referenceEntity: ModelEntity?) -> float4x4 {
    if referenceEntity === self { return matrix_identity_float4x4 }
    guard let reference = referenceEntity?.transform.matrix else { return transform.matrix }
    return reference.inverse * transform.matrix
  }

  /// The bounding box of the model, relative to another entity or to the world.
  ///
  /// - Parameters:
  ///   - recursive: Has no effect: there are no children.
  ///   - referenceEntity: The entity that defines the frame; nil for the world.
  ///   - excludeInactive: Whether a disabled entity counts as empty.
  public func visualBounds(
    recursive: Bool = true, relativeTo referenceEntity: ModelEntity?, excludeInactive: Bool = false
  ) -> BoundingBox {
    guard let model, isEnabled || !excludeInactive else { return .empty }
    return model.mesh.bounds.transformed(by: transformMatrix(relativeTo: referenceEntity))
  }
}

extension ModelEntity: Hashable {
  /// Whether both are the same entity.
  public static func == (lhs: ModelEntity, rhs: ModelEntity) -> Bool { lhs === rhs }

  /// Hashes the identity of the entity.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}
