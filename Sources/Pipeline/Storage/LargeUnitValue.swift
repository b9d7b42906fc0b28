import Foundation

/// A result with much `Data`, which a property list holds as it is.
protocol LargeUnitValue: UnitValue, Codable {}

extension LargeUnitValue {
  init?(unit: Data) {
    guard let value = try? PropertyListDecoder().decode(Self.self, from: unit) else { return nil }
    self = value
  }

  func unitData() throws -> Data {
    let encoder = PropertyListEncoder()
    encoder.outputFormat = .binary
    return try encoder.encode(self)
  }
}
