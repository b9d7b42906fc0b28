/// How a run uses its checkpoint directory.
package enum CheckpointAccess: Sendable {
  case exclusive
  /// Together with other jobs of the same dense stage.
  case shared
}
