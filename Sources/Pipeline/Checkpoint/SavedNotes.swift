/// The notes of a stage in stored form.
struct SavedNotes: Codable {
  var counts: [String: Double]
  /// Without the concerns, which are warnings, too.
  var warnings: [String]
  var concerns: [String]
  var details: [String]
  var matches: MatchRecord?

  init(_ notes: StageNotes) {
    (counts, concerns, details) = (notes.counts, notes.concerns, notes.details)
    matches = notes.matches
    warnings = notes.warnings.filter { !notes.concerns.contains($0) }
  }

  /// The notes without the counts, which belong to another stage.
  var sentencesOnly: SavedNotes {
    var result = self
    result.counts = [:]
    return result
  }

  /// Records the notes again.
  func replay(to notes: StageNotes) {
    for (name, value) in counts { notes.record(name, value) }
    warnings.forEach(notes.warn)
    concerns.forEach(notes.flagAsSuspect)
    details.forEach(notes.log)
    if let matches { notes.record(matches) }
  }
}
