import Foundation
import Testing

@testable import ReportPages

@Suite struct ReportPageTests {
  private func page(
    title: String = "Chair", report: String = "{}", material: String = "{}"
  ) -> String {
    String(
      decoding: ReportPage(
        title: title, report: Data(report.utf8), material: Data(material.utf8), library: nil
      ).encoded, as: UTF8.self)
  }

  /// The text of the script element with an ID.
  private func script(_ id: String, in page: String) throws -> String {
    let start = try #require(page.range(of: "id=\"\(id)\">"))
    let end = try #require(page[start.upperBound...].range(of: "</script>"))
    return String(page[start.upperBound..<end.lowerBound])
  }

  @Test func allPlaceholdersAreFilled() {
    let page = page()
    for name in ["TITLE", "STYLE", "REPORT", "MATERIAL", "LIBRARY", "SCRIPT"] {
      #expect(!page.contains("{{\(name)}}"))
    }
    #expect(page.contains("<title>Chair</title>"))
  }

  @Test func theReportIsInThePageAsItIs() throws {
    let names = [
      "</script><script>alert(1)</script>", "<!--", "a\"b'c.jpg", "\u{202E}gpj.exe", "{{TITLE}}",
    ]
    let json = try JSONEncoder().encode(["names": names])
    let text = try script("report", in: page(report: String(decoding: json, as: UTF8.self)))
    let found = try JSONDecoder().decode([String: [String]].self, from: Data(text.utf8))
    #expect(found["names"] == names)
    #expect(!text.contains("<"))
  }

  @Test func titlesAreEscaped() {
    #expect(
      page(title: "<b>&\"").contains("<title>&lt;b&gt;&amp;&quot;</title>"))
  }

  @Test func nothingIsLoadedFromElsewhere() {
    let page = page()
    #expect(page.contains("default-src 'none'"))
    for attribute in ["src=\"http", "href=\"http", "url(http", "src=\"//", "@import"] {
      #expect(!page.contains(attribute))
    }
  }

  @Test func scriptsOfThePageCannotEndTheirElement() {
    let script = String(decoding: PageResources.script, as: UTF8.self)
    #expect(!script.lowercased().contains("</script") && !script.contains("<!--"))
  }
}
