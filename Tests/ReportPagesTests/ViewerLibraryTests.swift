import Foundation
import Testing

@testable import ReportPages

@Suite struct ViewerLibraryTests {
  private func script(_ module: String) -> String? {
    ViewerLibrary(module: module)?.scripts.map { String(decoding: $0, as: UTF8.self) }.joined()
  }

  @Test func exportsBecomeAnObject() {
    #expect(
      script("const a=1,b=2;export{a as Scene,b as Mesh,c};\n//# sourceMappingURL=x.map\n")
        == "<script type=\"module\">\nconst a=1,b=2;"
        + "globalThis.THREE_LIBRARY={Scene:a,Mesh:b,c};\n</script>\n")
  }

  @Test(arguments: [
    "const a=1;", "x='</SCRIPT>';export{x};", "x='<!--';export{x};", "export{x as Y",
  ])
  func unsuitableModulesAreRefused(module: String) {
    #expect(script(module) == nil)
  }

  @Test func anotherBundleIsRefused() {
    #expect(ViewerLibrary(bundle: Data("export{a as Scene};".utf8)) == nil)
  }
}
