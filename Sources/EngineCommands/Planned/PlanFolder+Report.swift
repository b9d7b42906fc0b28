import SharedCommands

extension PlanFolder {
  /// Reports the end of the work, of a batch or of a single set. Returns the failure of a batch,
  /// which has been reported; throws a `CommandFailure` that has not.
  func report(_ reporter: RunReporter) throws -> CommandFailure? {
    if let record = BatchRecord(of: url) { return try record.conclude(self).report(reporter) }
    try conclude(reporter)
    return nil
  }
}
