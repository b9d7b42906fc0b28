import ArgumentParser

/// The side of a texture in texels.
package enum TextureSideArgument: String, ExpressibleByArgument, CaseIterable, Sendable {
  case oneK = "1024"
  case twoK = "2048"
  case fourK = "4096"
  case eightK = "8192"
  case sixteenK = "16384"

  /// The side in a session's configuration.
  var dimension: CustomDetail.TextureDimension {
    switch self {
    case .oneK: .oneK
    case .twoK: .twoK
    case .fourK: .fourK
    case .eightK: .eightK
    case .sixteenK: .sixteenK
    }
  }
}
