import SceneModel

/// The up direction that the user chose.
package enum ChosenUp: Hashable, Codable, Sendable {
  /// A side of the upright photos.
  package enum PhotoSide: String, CaseIterable, Hashable, Codable, Sendable {
    case top, bottom, left, right

    /// The angle about the optical axis, whose x is right and y down, from the top to this side.
    package var angle: Double {
      switch self {
      case .top: 0
      case .right: .pi / 2
      case .bottom: .pi
      case .left: -.pi / 2
      }
    }
  }

  /// An axis of a frame.
  package enum Axis: String, CaseIterable, Hashable, Codable, Sendable {
    case x, y, z
    case minusX = "-x"
    case minusY = "-y"
    case minusZ = "-z"

    package var direction: SIMD3<Double> {
      switch self {
      case .x: [1, 0, 0]
      case .y: [0, 1, 0]
      case .z: [0, 0, 1]
      case .minusX: [-1, 0, 0]
      case .minusY: [0, -1, 0]
      case .minusZ: [0, 0, -1]
      }
    }
  }

  /// The photos were taken with this side up.
  case photos(PhotoSide)
  /// An axis of the world frame that results without a choice: the object is turned.
  case model(Axis)

  /// The names of all choices.
  package static var names: [String] {
    PhotoSide.allCases.map(\.rawValue) + Axis.allCases.map(\.rawValue)
  }

  /// The name of the choice.
  package var name: String {
    switch self {
    case .photos(let side): side.rawValue
    case .model(let axis): axis.rawValue
    }
  }

  /// The choice with a name; nil for other names.
  package init?(name: String) {
    if let side = PhotoSide(rawValue: name) {
      self = .photos(side)
    } else if let axis = Axis(rawValue: name) {
      self = .model(axis)
    } else {
      return nil
    }
  }
}
