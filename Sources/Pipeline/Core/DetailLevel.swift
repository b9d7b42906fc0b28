/// The detail levels of a model, coarse to fine.
package enum DetailLevel: String, CaseIterable, Codable, Sendable {
  case preview, reduced, medium, full, raw
}
