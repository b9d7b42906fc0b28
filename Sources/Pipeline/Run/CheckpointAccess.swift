/// How a run uses its checkpoint directory.
package enum CheckpointAccess: Sendable {
  case exclusive
  /// Shared with other jobs of the same dense stage, or with those that make tiles.
  case shared
  /// Shared with other parts of the same run.
  case parts
}
