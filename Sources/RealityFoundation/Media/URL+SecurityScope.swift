extension URL {
  /// Requests access to a resource that the user has chosen. There is no sandbox here, so this
  /// returns whether there is something to read or write.
  public func startAccessingSecurityScopedResource() -> Bool {
    guard isFileURL else { return false }
    let manager = FileManager.default
    return manager.isReadableFile(atPath: path)
      || manager.isWritableFile(atPath: deletingLastPathComponent().path)
  }

  /// Ends the access; has no effect.
  public func stopAccessingSecurityScopedResource() {}
}
