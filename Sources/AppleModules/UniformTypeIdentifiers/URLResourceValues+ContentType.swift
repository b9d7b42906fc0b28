import Foundation

// No file system here keeps kinds of files, so a kind goes by the suffix of the name, as it does on a
// Mac for files from elsewhere. Values hold the name if they are asked for the kind.

extension URLResourceKey {
  /// The kind of a file: another name of the key for its name.
  public static let contentTypeKey = nameKey
}

extension URLResourceValues {
  /// The kind of a file by its suffix; `folder` for folders where the values tell that it is one.
  public var contentType: UTType? {
    if isDirectory == true { return .folder }
    guard let name else { return nil }
    return UTType(filenameExtension: (name as NSString).pathExtension)
  }
}
