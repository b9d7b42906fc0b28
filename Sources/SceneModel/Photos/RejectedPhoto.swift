/// A rejected input file and the reason.
package struct RejectedPhoto: Hashable, Codable, Sendable {
  /// The kind of fault.
  package enum Fault: String, Hashable, Codable, Sendable {
    case unreadable, unsupportedFormat, tooSmall, tooLarge, blank, blurred, duplicate, tooMany
    case notRegistered
  }

  package var sampleID: Int
  package var name: String
  package var fault: Fault
  /// A message for the user with the reason and, if there is one, the remedy.
  package var reason: String

  package init(sampleID: Int, name: String, fault: Fault, reason: String) {
    self.sampleID = sampleID
    self.name = name
    self.fault = fault
    self.reason = reason
  }
}
