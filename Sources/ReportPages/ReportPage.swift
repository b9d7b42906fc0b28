import Formats
import Foundation

/// A page of one file that shows a report or a model in a browser, without a network.
package struct ReportPage: Sendable {
  package var title: String
  /// The content of `report.json`, or `{}`.
  package var report: Data
  /// Pictures, the model and points as JSON.
  package var material: Data
  /// Draws the model; without it, the page shows pictures.
  package var library: ViewerLibrary?

  package init(title: String, report: Data, material: Data, library: ViewerLibrary?) {
    (self.title, self.report, self.material) = (title, report, material)
    self.library = library
  }

  /// The page as HTML in UTF-8.
  package var encoded: Data {
    let values: [String: [Data]] = [
      "TITLE": [Data(Self.escaped(title).utf8)],
      "STYLE": [Data(PageResources.style)],
      "REPORT": [Self.embedded(report)],
      "MATERIAL": [Self.embedded(material)],
      "LIBRARY": library?.scripts ?? [],
      "SCRIPT": [Data(PageResources.script)],
    ]
    var page = Data()
    for piece in PageTemplate(PageResources.template).pieces {
      switch piece {
      case .text(let text): page.append(contentsOf: text.utf8)
      case .placeholder(let name): values[name]?.forEach { page.append($0) }
      }
    }
    return page
  }

  /// Text for the content of an element.
  package static func escaped(_ text: String) -> String {
    text.replacingOccurrences(of: "&", with: "&amp;")
      .replacingOccurrences(of: "<", with: "&lt;")
      .replacingOccurrences(of: ">", with: "&gt;")
      .replacingOccurrences(of: "\"", with: "&quot;")
  }

  /// JSON for the content of a script element: no text in it can end the element.
  static func embedded(_ json: Data) -> Data {
    guard json.contains(UInt8(ascii: "<")) else { return json }
    var result = Data(capacity: json.count + 64)
    for byte in json {
      if byte == UInt8(ascii: "<") {
        result.append(contentsOf: "\\u003c".utf8)
      } else {
        result.append(byte)
      }
    }
    return result
  }
}
