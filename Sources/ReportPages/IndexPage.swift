import Foundation

/// A page with a row for each report of a batch, beside the reports.
package struct IndexPage: Sendable {
  package struct Row: Sendable {
    package var name: String
    /// The file of the report, and that of a picture, beside the page; nil if there is none.
    package var report: String?
    package var picture: String?
    /// Whether there is a model, in a word, and a sentence about it.
    package var isGood: Bool
    package var result: String
    package var sentence: String?
    package var photos: String
    package var triangles: String
    package var time: String

    package init(
      name: String, report: String?, picture: String?, isGood: Bool, result: String,
      sentence: String?, photos: String, triangles: String, time: String
    ) {
      (self.name, self.report, self.picture) = (name, report, picture)
      (self.isGood, self.result, self.sentence) = (isGood, result, sentence)
      (self.photos, self.triangles, self.time) = (photos, triangles, time)
    }
  }

  package var title: String
  package var summary: String
  package var rows: [Row]

  package init(title: String, summary: String, rows: [Row]) {
    (self.title, self.summary, self.rows) = (title, summary, rows)
  }

  /// The page as HTML in UTF-8.
  package var encoded: Data {
    let values = [
      "TITLE": ReportPage.escaped(title), "SUMMARY": ReportPage.escaped(summary),
      "STYLE": String(decoding: PageResources.style, as: UTF8.self),
      "ROWS": rows.map(\.html).joined(separator: "\n"),
    ]
    let pieces = PageTemplate(PageResources.index).pieces.map { piece in
      switch piece {
      case .text(let text): text
      case .placeholder(let name): values[name] ?? ""
      }
    }
    return Data(pieces.joined().utf8)
  }
}

extension IndexPage.Row {
  fileprivate var html: String {
    let name = "<bdi>\(ReportPage.escaped(name))</bdi>"
    let link = report.map { "<a href=\"\(Self.address($0))\">\(name)</a>" } ?? name
    let image = picture.map { "<img src=\"\(Self.address($0))\" alt=\"\" loading=\"lazy\">" } ?? ""
    let sentence = sentence.map { "<br>\(ReportPage.escaped($0))" } ?? ""
    let cells = [photos, triangles, time].map { "<td>\(ReportPage.escaped($0))</td>" }.joined()
    return """
      <tr><th scope="row">\(image)\(link)</th>\
      <td><span class="result \(isGood ? "good" : "failed")">\(ReportPage.escaped(result))</span>\
      \(sentence)</td>\(cells)</tr>
      """
  }

  /// The address of a file beside the page.
  private static func address(_ file: String) -> String {
    "./" + (file.addingPercentEncoding(withAllowedCharacters: .alphanumerics) ?? "")
  }
}
