/// The material of a surface.
public protocol Material: Sendable {}
