/// Operations on the texts of paths: of prims, and of files.
enum USDPath {
  /// The absolute path of `path`, which may be relative to the prim at `prim`.
  static func absolute(_ path: String, from prim: String) -> String {
    guard !path.hasPrefix("/") else { return path }
    var elements = prim.split(separator: "/")
    var rest = Substring(path)
    while rest.hasPrefix("..") {
      _ = elements.popLast()
      rest = rest.dropFirst(2)
      if rest.hasPrefix("/") { rest = rest.dropFirst() }
    }
    let start = elements.map { "/" + $0 }.joined()
    return rest.isEmpty || rest.hasPrefix(".") ? start + rest : start + "/" + rest
  }

  /// The path with the prefix `source`, if it has it, replaced by `target`.
  static func moved(_ path: String, from source: String, to target: String) -> String {
    guard path.hasPrefix(source) else { return path }
    let rest = path.dropFirst(source.count)
    return rest.isEmpty || rest.hasPrefix("/") || rest.hasPrefix(".") ? target + rest : path
  }

  /// Splits the path of a property into the paths of its prim and its name.
  static func property(_ path: String) -> (prim: String, name: String)? {
    guard let slash = path.lastIndex(of: "/"), let dot = path[slash...].firstIndex(of: ".") else {
      return nil
    }
    return (String(path[..<dot]), String(path[path.index(after: dot)...]))
  }

  /// The path of the file `file` that a layer in the folder `folder` refers to.
  static func file(_ file: String, from folder: String) -> String {
    guard !file.hasPrefix("/"), !folder.isEmpty || file.hasPrefix(".") || file.contains("/.") else {
      return file
    }
    var elements: [Substring] = []
    for element in (folder + "/" + file).split(separator: "/") where element != "." {
      if element == "..", let last = elements.last, last != ".." {
        elements.removeLast()
      } else {
        elements.append(element)
      }
    }
    return (folder.hasPrefix("/") ? "/" : "") + elements.joined(separator: "/")
  }

  /// The folder of a file; empty for a file without one.
  static func folder(of file: String) -> String {
    file.lastIndex(of: "/").map { String(file[..<$0]) } ?? ""
  }
}
