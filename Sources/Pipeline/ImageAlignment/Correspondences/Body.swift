/// One of the two rigid bodies of a scene, between which there are two motions; nil instead of one
/// stands for an open assignment.
enum Body: Sendable {
  case first, second

  /// The body that a vote favors: the second one if it is positive, none if it is zero.
  init?(vote: Int) {
    guard vote != 0 else { return nil }
    self = vote > 0 ? .second : .first
  }

  var other: Body { self == .first ? .second : .first }
}
