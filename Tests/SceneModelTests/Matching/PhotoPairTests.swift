import Foundation
import SceneModel
import Testing

@Suite struct PhotoPairTests {
  @Test func pairsAreUnordered() {
    let pair = PhotoPair(ID(5), ID(2))
    #expect(pair == PhotoPair(ID(2), ID(5)) && pair.first == ID(2) && pair.second == ID(5))
    #expect(Set([pair, PhotoPair(ID(2), ID(5))]).count == 1)
  }

  @Test func pairsSortByFirstThenSecond() {
    let pairs = [PhotoPair(ID(1), ID(2)), PhotoPair(ID(0), ID(9)), PhotoPair(ID(0), ID(3))]
    #expect(pairs.sorted() == [pairs[2], pairs[1], pairs[0]])
  }

  @Test func identifiersAreIndices() throws {
    let id = ID<Photo>(7)
    #expect(id.index == 7 && id.rawValue == 7 && id < ID(8) && !(id < id))
    let data = try JSONEncoder().encode([id])
    #expect(try JSONDecoder().decode([ID<Photo>].self, from: data) == [id])
  }
}
