/// A component of an entity.
public protocol Component {}

extension Transform: Component {}
