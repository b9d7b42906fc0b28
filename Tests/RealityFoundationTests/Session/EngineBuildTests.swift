import Testing

@testable import RealityFoundation

@Suite struct EngineBuildTests {
  @Test func onlyBuildsWithoutOptimizationAreWarnedAbout() throws {
    #expect(EngineBuild(isOptimized: true).warning == nil)
    let warning = try #require(EngineBuild(isOptimized: false).warning)
    #expect(warning.contains("-c release"))
  }

  /// Assertions are checked in builds without optimization only.
  @Test func thisBuildIsRecognized() {
    var isChecked = false
    assert(
      {
        isChecked = true
        return true
      }())
    #expect(EngineBuild.current.isOptimized == !isChecked)
  }
}
