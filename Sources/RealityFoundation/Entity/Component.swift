/// A part of an entity's description.
public protocol Component {}
