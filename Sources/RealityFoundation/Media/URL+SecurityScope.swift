extension URL {
  /// Asks for access to what the user has chosen. There are no sandboxes here: what the process may
  /// read it can read at once, so this is true where there is something to be read or written.
  public func startAccessingSecurityScopedResource() -> Bool {
    guard isFileURL else { return false }
    let manager = FileManager.default
    return manager.isReadableFile(atPath: path)
      || manager.isWritableFile(atPath: deletingLastPathComponent().path)
  }

  /// Gives the access back; has no effect.
  public func stopAccessingSecurityScopedResource() {}
}
