import Formats
import Foundation
import Kernels

/// The 3-D library of the page: three.js (MIT), which is found when a page is written, and becomes
/// a part of it.
///
/// Either the bundle of NiceGUI's wheel (three.js r180), which the packages of this program contain
/// and `scripts/setup` downloads, or Debian's package `libjs-three` (r111).
package struct ViewerLibrary: Sendable {
  /// For the page's list of what it contains.
  package var name: String
  package var license: String
  /// Script elements that set `THREE_LIBRARY`.
  var scripts: [Data]

  /// The SHA-256 of the bundle that the page was tested with.
  static let bundleHash = "f55227d12dac0eb037cae13b1992091746fc017a275748e4a1bebd0f6244e7e5"
  /// The bundle's name in the folders that are searched.
  static let bundleName = "three-r180.js"

  /// The first one that is found; nil if there is none.
  package static var installed: ViewerLibrary? {
    if let bundle = NativeLibraries.viewerBundle, let library = ViewerLibrary(bundle: bundle) {
      return library
    }
    for folder in folders {
      if let bytes = try? Data(contentsOf: folder.appendingPathComponent(bundleName)),
        let library = ViewerLibrary(bundle: bytes)
      {
        return library
      }
    }
    return ViewerLibrary(debian: URL(fileURLWithPath: "/usr/share/javascript/three"))
  }

  /// Where the bundle may be: beside an installed program, and where `scripts/setup` puts it.
  private static var folders: [URL] {
    let environment = ProcessInfo.processInfo.environment
    let program = URL(fileURLWithPath: "/proc/self/exe").resolvingSymlinksInPath()
    let home = environment["XDG_CACHE_HOME"] ?? environment["HOME"].map { "\($0)/.cache" }
    return [
      program.deletingLastPathComponent().deletingLastPathComponent()
        .appendingPathComponent("share/photogrammetry-cli")
    ] + (home.map { [URL(fileURLWithPath: "\($0)/photogrammetry-cli/viewer")] } ?? [])
  }

  /// The bundle as a module that sets `THREE_LIBRARY`; nil if it isn't the one that was tested.
  init?(bundle: Data) {
    guard SHA256.hash(bundle) == Self.bundleHash else { return nil }
    self.init(module: String(decoding: bundle, as: UTF8.self))
  }

  /// A module whose last statement exports names as `export{a as B,…}`; nil without it, or if a
  /// text in it would end the script element.
  init?(module: String) {
    guard let export = module.range(of: "export{", options: .backwards),
      let end = module[export.upperBound...].firstIndex(of: "}"), Self.isSafe(module)
    else { return nil }
    let names = module[export.upperBound..<end].split(separator: ",").map { item in
      let words = item.components(separatedBy: " as ")
      return words.count == 2 ? "\(words[1]):\(words[0])" : "\(item)"
    }
    // Without the line that names a source map, which a browser would look for.
    let text =
      module[..<export.lowerBound] + "globalThis.THREE_LIBRARY={\(names.joined(separator: ","))};"
    scripts = [Data("<script type=\"module\">\n\(text)\n</script>\n".utf8)]
    name = "three.js r180"
    license = Self.mit("2010-2025 three.js authors, 2021 Zauberzeug GmbH (NiceGUI)")
  }

  /// A classic script that sets `THREE`; nil if it is missing.
  private init?(debian folder: URL) {
    let file = folder.appendingPathComponent("three.min.js")
    guard let text = try? String(contentsOf: file, encoding: .utf8), Self.isSafe(text) else {
      return nil
    }
    scripts = [Data("<script>\n\(text)\nglobalThis.THREE_LIBRARY=THREE;\n</script>\n".utf8)]
    (name, license) = ("three.js of Debian", Self.mit("2010-2019 three.js authors"))
  }

  /// Whether no text would end or hide the element.
  private static func isSafe(_ script: String) -> Bool {
    !script.contains("<!--") && !script.lowercased().contains("</script")
  }

  /// The license, whose text must accompany copies.
  private static func mit(_ holders: String) -> String {
    """
    Copyright \(holders)

    Permission is hereby granted, free of charge, to any person obtaining a copy of this software \
    and associated documentation files (the "Software"), to deal in the Software without \
    restriction, including without limitation the rights to use, copy, modify, merge, publish, \
    distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the \
    Software is furnished to do so, subject to the following conditions:

    The above copyright notice and this permission notice shall be included in all copies or \
    substantial portions of the Software.

    THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING \
    BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND \
    NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, \
    DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, \
    OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
    """
  }
}
