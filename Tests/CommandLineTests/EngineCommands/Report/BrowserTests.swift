import Foundation
import TestLevels
import TestSupport
import Testing

/// Why the tests in a browser are left out.
private let missing: String? = Chromium.program == nil ? "chromium is not installed" : nil

/// The pages of runs in a real browser.
@Suite(.serialized, .endToEnd, .enabled(if: missing == nil, "\(missing ?? "")"))
struct BrowserTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  /// Makes a page and opens it. It must be complete, and have loaded nothing else.
  private func open(
    _ arguments: [String], page: String, code: Int32 = 0, in browser: Chromium
  ) throws {
    let run = try CommandProcess.run(arguments, in: folder)
    #expect(run.exitCode == code, "\(run.errors)")
    let file = folder.appendingPathComponent(page)
    let seconds = try browser.open(file)
    #expect(browser.requests == [file.absoluteString], "after \(seconds) s")
    try expectNoComplaints(browser)
  }

  private func expectNoComplaints(
    _ browser: Chromium, sourceLocation: SourceLocation = #_sourceLocation
  ) throws {
    #expect(browser.complaints == [], sourceLocation: sourceLocation)
    #expect(
      try browser.evaluate("document.documentElement.dataset.error ?? ''") as? String == "",
      sourceLocation: sourceLocation)
  }

  /// A hash and the number of different colors of what the view shows.
  private func view(_ browser: Chromium) throws -> (hash: String, colors: Int) {
    let result = try browser.evaluate(
      """
      (() => {
        photogrammetryReport.draw();
        const copy = Object.assign(document.createElement('canvas'), { width: 64, height: 36 });
        const context = copy.getContext('2d');
        context.drawImage(document.getElementById('view'), 0, 0, 64, 36);
        const pixels = new Uint32Array(context.getImageData(0, 0, 64, 36).data.buffer);
        let hash = 0;
        for (const pixel of pixels) hash = (Math.imul(hash, 31) + pixel) | 0;
        return [String(hash), new Set(pixels).size];
      })()
      """)
    let values = try #require(result as? [Any])
    return (try #require(values[0] as? String), try #require(values[1] as? Int))
  }

  private func choose(_ id: String, _ value: String, in browser: Chromium) throws {
    try browser.evaluate(
      """
      (() => {
        const control = document.getElementById('\(id)');
        control.value = '\(value)';
        control.dispatchEvent(new Event('change', { bubbles: true }));
      })()
      """)
  }

  private func text(_ id: String, in browser: Chromium) throws -> String {
    try #require(
      try browser.evaluate("document.getElementById('\(id)').innerText") as? String)
  }

  @Test func aReportShowsTheRun() throws {
    let browser = try Chromium()
    let photos = Fixtures.images(of: "orbit").path
    try open(
      [photos, "model.glb", "-d", "preview", "--report", "report.html"], page: "report.html",
      in: browser)
    #expect(try text("verdict", in: browser).contains("All 20 photos were used"))
    #expect(try text("advice", in: browser).contains("underside"))

    // The model, its heat maps, and turning it.
    let textured = try view(browser)
    #expect(textured.colors > 50)
    var hashes = [textured.hash]
    for map in ["photos", "reprojection", "photometric", "uncertainty", "closed"] {
      try choose("color-by", map, in: browser)
      hashes.append(try view(browser).hash)
      #expect(try text("legend", in: browser).isEmpty == false)
    }
    try browser.evaluate("document.getElementById('view').focus()")
    try browser.press("ArrowLeft")
    hashes.append(try view(browser).hash)
    try browser.evaluate("document.getElementById('layer-sparse').click()")
    hashes.append(try view(browser).hash)
    #expect(Set(hashes).count == hashes.count)

    // The photos.
    let name = try text("picture-name", in: browser)
    try browser.evaluate("document.getElementById('photo-next').click()")
    #expect(try text("picture-name", in: browser) != name)
    #expect(
      try browser.evaluate("document.querySelectorAll('#photo-table tbody tr').length") as? Int
        == 20)
    try expectNoComplaints(browser)
    try expectAccessible(browser)
  }

  @Test func aFailedRunShowsWhatIsMissing() throws {
    let browser = try Chromium()
    let files = FileManager.default
    let images = Fixtures.images(of: "orbit")
    for number in 0..<2 {
      let name = "view_0\(number).jpg"
      try files.createDirectory(
        at: folder.appendingPathComponent("photos"), withIntermediateDirectories: true)
      try files.copyItem(
        at: images.appendingPathComponent(name),
        to: folder.appendingPathComponent("photos/\(name)"))
    }
    let hostile = "<img src=x onerror=alert(1)>\"'&\u{202E}{{SCRIPT}}.jpg"
    try temporary.write("This is no photo.", as: "photos/\(hostile)")
    try open(
      ["photos", "model.glb", "--report", "report.html"], page: "report.html", code: 1,
      in: browser)
    #expect(try text("verdict", in: browser).contains("Only 2 usable photos"))
    #expect(try text("photos", in: browser).contains(hostile))
    #expect(
      try browser.evaluate("document.querySelectorAll('img[src=x]').length") as? Int == 0)
    try expectAccessible(browser)
  }

  @Test func withoutDrawingPicturesAreShown() throws {
    let browser = try Chromium(flags: ["--disable-3d-apis"])
    try open(
      [
        Fixtures.images(of: "orbit").path, "model.glb", "-d", "preview", "--report", "report.html",
      ], page: "report.html", in: browser)
    #expect(
      try browser.evaluate("document.querySelector('#pictures img, img#pictures').naturalWidth")
        as? Int ?? 0 > 500)
  }

  @Test(arguments: ["model.glb", "model.usdz", "model.ply", "model"])
  func modelsAreViewed(model: String) throws {
    let browser = try Chromium()
    let output = model == "model" ? "model/" : model
    let run = try CommandProcess.run(
      [Fixtures.images(of: "orbit").path, output, "-d", "preview"], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    try open(["view", model, "page.html", "--no-open"], page: "page.html", in: browser)
    #expect(try view(browser).colors > 50)
    try expectAccessible(browser)
  }

  /// Runs axe-core in both color schemes, if `scripts/setup --tests` has downloaded it.
  private func expectAccessible(
    _ browser: Chromium, sourceLocation: SourceLocation = #_sourceLocation
  ) throws {
    let environment = ProcessInfo.processInfo.environment
    let cache = environment["XDG_CACHE_HOME"] ?? "\(environment["HOME"] ?? "")/.cache"
    guard
      let axe = try? String(
        contentsOfFile: "\(cache)/photogrammetry-cli/viewer/axe.js", encoding: .utf8)
    else { return }
    try browser.evaluate("\(axe)\n;0")
    try browser.evaluate("document.querySelectorAll('details').forEach(d => { d.open = true })")
    for scheme in ["light", "dark"] {
      try browser.prefer(scheme)
      let found = try browser.evaluate(
        "axe.run().then(r => r.violations.map(v => v.id + ': ' + v.nodes[0].html))")
      #expect(found as? [String] == [], "\(scheme)", sourceLocation: sourceLocation)
    }
  }
}
