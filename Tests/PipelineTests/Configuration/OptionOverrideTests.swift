import Testing

@testable import Pipeline

@Suite struct OptionOverrideTests {
  private func changed(_ texts: String...) throws -> PipelineConfiguration {
    try PipelineConfiguration().applying(texts.map { try #require(OptionOverride($0)) })
  }

  @Test func onlyTheOptionChanges() throws {
    var expected = PipelineConfiguration()
    expected.meshGeneration.closesObject = false
    expected.ingestion.maximumPhotos = 17
    #expect(
      try changed("meshGeneration.closesObject=false", "ingestion.maximumPhotos=17") == expected)
  }

  /// All other values survive the encoding, among them numbers of 64 bits.
  @Test func otherOptionsKeepTheirValues() throws {
    let value = PipelineConfiguration().ingestion.maximumPhotos
    #expect(try changed("ingestion.maximumPhotos=\(value)") == PipelineConfiguration())
  }

  @Test func unknownOptionsAreRefusedWithTheChoices() {
    #expect {
      try changed("ingestion.photos=1")
    } throws: {
      guard case .unknownOption("ingestion.photos", let choices)? = $0 as? OptionOverrideError
      else { return false }
      return choices.contains("maximumPhotos")
    }
    #expect(throws: OptionOverrideError.self) { try changed("ingestion=1") }
  }

  @Test(arguments: [
    "meshGeneration.closesObject=1", "ingestion.maximumPhotos=many", "ingestion.maximumPhotos=1.5",
    "ingestion.maximumPhotos=inf", "alignment.ordering=sideways",
  ])
  func valuesOfAnotherKindAreRefused(_ text: String) {
    #expect(throws: OptionOverrideError.self) { try changed(text) }
  }

  @Test(arguments: ["", "a", "a=", "=1", "a..b=1"]) func otherTextsAreNoOverride(_ text: String) {
    #expect(OptionOverride(text) == nil)
  }
}
