/// Three vertex indices, counterclockwise when viewed from outside; 12 bytes.
package struct Triangle: Hashable, Sendable, BitwiseCopyable {
  package var a: UInt32
  package var b: UInt32
  package var c: UInt32

  package init(_ a: UInt32, _ b: UInt32, _ c: UInt32) {
    (self.a, self.b, self.c) = (a, b, c)
  }

  /// The corners of the quad formed by (a, b, c) and `other` = (a, c, d).
  package func quad(with other: Triangle) -> [UInt32] { [a, b, c, other.c] }

  /// The triangle with reversed winding.
  package var flipped: Triangle { Triangle(a, c, b) }
}
