import Testing

@testable import Evaluation

@Suite struct PhotoTableTests {
  @Test func namesOfOtherProgramsAreRecognized() {
    let table = PhotoTable([("IMG_1.JPG", 1), ("sub/IMG_2.jpg", 2), ("IMG_3.jpg", 3)])
    #expect(table["IMG_1.JPG"] == 1)
    #expect(table["img_1"] == 1)
    #expect(table["photos/IMG_2.png"] == 2)
    #expect(table["IMG_4.jpg"] == nil)
  }

  @Test func ambiguousStemsHaveNoValue() {
    let table = PhotoTable([("a.jpg", 1), ("a.png", 2), ("a.jpg", 3)])
    #expect(table["a.jpg"] == 1)
    #expect(table["a.png"] == 2)
    #expect(table["a"] == nil)
  }
}
