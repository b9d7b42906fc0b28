import Testing

@testable import EngineCommands

@Suite struct JobArgumentTests {
  @Test(arguments: [("1/1", 0, 1), ("2/8", 1, 8), ("8/8", 7, 8)])
  func jobsCountFromOne(_ text: String, _ index: Int, _ count: Int) throws {
    let share = try #require(JobArgument(argument: text)).share
    #expect(share.index == index && share.count == count)
  }

  @Test(arguments: ["", "1", "0/3", "4/3", "1/0", "-1/3", "a/b", "1/2/3", "1/", "/2", "1.5/2"])
  func otherTextIsRejected(_ text: String) {
    #expect(JobArgument(argument: text) == nil)
  }
}
