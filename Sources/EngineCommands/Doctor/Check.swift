/// What `doctor` found out about one subject.
struct Check: Codable, Equatable {
  /// What is checked. The raw values are part of the output of `--json`.
  enum Subject: String, Codable, CaseIterable {
    case version, memory, threads, instructions, imageFormats, video
    case temporaryFolder, currentFolder, scheduler, terminal

    /// The subject in the table.
    var title: String {
      switch self {
      case .imageFormats: "image formats"
      case .temporaryFolder: "temporary folder"
      case .currentFolder: "current folder"
      default: rawValue
      }
    }
  }

  /// How well the machine suits a run.
  enum Status: String, Codable, CaseIterable {
    /// Nothing to do.
    case ok
    /// A run works, but something limits it or is worth knowing.
    case note
    /// A run can't be expected to work.
    case problem
  }

  var name: Subject
  var status: Status
  /// What was found, as a sentence.
  var text: String
  /// What to do about it, as a sentence; nil if there is nothing to do.
  var remedy: String?

  init(_ name: Subject, _ status: Status, _ text: String, remedy: String? = nil) {
    (self.name, self.status, self.text, self.remedy) = (name, status, text, remedy)
  }

  /// A size for people: `2.1 GB`.
  static func gigabytes(_ bytes: Int) -> String {
    let tenths = (Double(bytes) / 100_000_000).rounded(.down)
    return tenths >= 1000 ? "\(Int(tenths / 10)) GB" : "\(tenths / 10) GB"
  }
}
