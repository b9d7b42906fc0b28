/// A component of an entity.
public protocol Component {}
