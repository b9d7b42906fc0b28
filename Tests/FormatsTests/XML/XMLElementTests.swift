import DamagedInput
import Testing

@testable import Formats

@Suite struct XMLElementTests {
  private static let text = """
    <?xml version="1.0" encoding="UTF-8"?>
    <!-- a <comment> -->
    <document version='1.2'>
      <a id="1" name="x &lt; &#x41;&#66; &quot;y&quot;"/>
      <a id="2">text &amp; <![CDATA[<raw> & ]]><!-- no -->more<b/></a>
      <numbers>1 -2.5
        3e-2</numbers>
    </document>
    """

  @Test func elementsAttributesAndTextAreRead() throws {
    let root = try XMLElement.parse(Array(Self.text.utf8))
    #expect(root.name == "document")
    #expect(root.attributes == ["version": "1.2"])
    #expect(root.children("a").map(\.attributes["id"]) == ["1", "2"])
    #expect(root.child("a")?.attributes["name"] == "x < AB \"y\"")
    #expect(root.children("a")[1].text == "text & <raw> & more")
    #expect(root.children("a")[1].children.map(\.name) == ["b"])
    #expect(root.child("numbers")?.numbers == [1, -2.5, 0.03])
  }

  @Test(arguments: [
    "", "text", "<a>", "<a></b>", "<a b></a>", "<a b=c/>", "<a>&unknown;</a>", "<a>&#xD800;</a>",
    "<a><!-- </a>", "<!DOCTYPE a [<!ENTITY b \"cc\">]><a>&b;</a>",
    String(repeating: "<a>", count: 100_000),
  ])
  func otherTextsAreRefused(_ text: String) {
    #expect(throws: FormatFault.self) { try XMLElement.parse(Array(text.utf8)) }
  }

  @Test func damagedTextsGiveAValueOrAnError() {
    let whole = DamagedInput(Array(Self.text.utf8))
    var errors = 0
    let mutations = Array(whole.mutations(2000, seed: 5, header: whole.bytes.count))
    for copy in Array(whole.truncations()) + mutations {
      do { _ = try XMLElement.parse(copy) } catch { errors += 1 }
    }
    #expect(errors > 300)
  }
}
