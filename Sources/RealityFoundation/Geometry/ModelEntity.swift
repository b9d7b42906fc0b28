/// A model in memory: what `Request.modelEntity` asks for.
///
/// There is no renderer here, so that it carries a name and its place, and no resources.
public struct ModelEntity: Sendable {
  /// The name of the entity.
  public var name: String
  /// The place of the entity in its parent's space.
  public var transform: Transform

  /// Creates an entity at the origin.
  public init() {
    name = ""
    transform = .identity
  }
}
