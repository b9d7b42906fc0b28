import ArgumentParser

/// The unit of the lengths of a reference.
enum LengthUnit: String, ExpressibleByArgument, CaseIterable {
  case m, cm, mm
  case inch = "in"
  case ft, none

  /// Nil if the unit is arbitrary.
  var meters: Double? {
    switch self {
    case .m: 1
    case .cm: 0.01
    case .mm: 0.001
    case .inch: 0.0254
    case .ft: 0.3048
    case .none: nil
    }
  }
}
