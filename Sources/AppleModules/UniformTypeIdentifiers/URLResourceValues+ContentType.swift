import Foundation

// File systems on Linux don't store content types, so the type is derived from the file extension,
// as macOS does for files without type metadata. The key is an alias of `nameKey`, so that the
// values contain the name.

extension URLResourceKey {
  /// The content type of a file; an alias of `nameKey`.
  public static let contentTypeKey = nameKey
}

extension URLResourceValues {
  /// The type derived from the file extension; `folder` if the values mark a directory.
  public var contentType: UTType? {
    if isDirectory == true { return .folder }
    guard let name else { return nil }
    return UTType(filenameExtension: (name as NSString).pathExtension)
  }
}
