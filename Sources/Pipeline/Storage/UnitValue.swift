import Foundation
import Kernels

/// The bytes of a result that another process reads.
protocol UnitValue {
  init?(unit: Data)
  func unitData() throws -> Data
}

extension UnitValue where Self: Codable {
  init?(unit: Data) {
    guard let value = try? JSONDecoder().decode(Self.self, from: unit) else { return nil }
    self = value
  }

  func unitData() throws -> Data { try Fingerprint.content(of: self) }
}
