import SceneModel
import Testing
import VideoFiles

@Suite struct FrameSelectionTests {
  /// A walk at a speed of its own per frame, with random sharpness.
  private func walk(frames: Int = 450, length: Double = 3, seed: UInt64 = 1) -> [FrameReading] {
    var random = SplitMix64(seed: seed)
    let steps = (0..<frames).map { _ in 0.3 + random.uniform() }
    let total = steps.reduce(0, +)
    var position = 0.0
    return steps.enumerated().map { index, step in
      defer { position += step / total * length }
      return FrameReading(
        index: 2 * index, seconds: Double(index) / 15, position: position,
        sharpness: random.uniform())
    }
  }

  @Test(arguments: 1...5) func framesAreAtEvenDistances(seed: UInt64) throws {
    let readings = walk(seed: seed)
    let selected = FrameSelection().run(readings)
    #expect(selected.count == 100)
    let steps = zip(selected, selected.dropFirst()).map { $1.position - $0.position }
    let longest = try #require(
      zip(readings, readings.dropFirst()).map { $1.position - $0.position }.max())
    for step in steps { #expect((0.2 * 0.03 - longest...1.8 * 0.03 + longest).contains(step)) }
  }

  @Test(arguments: 1...5) func selectedFramesAreSharperThanTheirNeighbors(seed: UInt64) {
    let readings = walk(seed: seed)
    let selected = FrameSelection().run(readings)
    let step = (readings.last?.position ?? 0) / 100
    for (number, frame) in selected.enumerated() {
      let place = (Double(number) + 0.5) * step
      let near = readings.filter { abs($0.position - place) < 0.4 * step - 1e-9 }
      #expect(near.allSatisfy { $0.sharpness <= frame.sharpness })
    }
    let mean = { (list: [FrameReading]) in list.map(\.sharpness).reduce(0, +) / Double(list.count) }
    #expect(mean(selected) > mean(readings) + 0.1)
  }

  @Test func orderIsStrict() {
    for length in [0, 1e-9, 0.1, 2, 50] {
      let selected = FrameSelection().run(walk(length: length))
      #expect(zip(selected, selected.dropFirst()).allSatisfy { $0.index < $1.index })
      #expect((30...250).contains(selected.count))
    }
  }

  @Test func pausesGiveNoFrames() {
    // The camera moves for ten seconds, stands for ten, and moves again.
    let readings = (0..<450).map { index in
      let position = index < 150 ? index : index < 300 ? 150 : index - 150
      return FrameReading(
        index: index, seconds: Double(index) / 15, position: Double(position) / 100, sharpness: 1)
    }
    let selected = FrameSelection().run(readings)
    #expect(selected.count { (151..<300).contains($0.index) } <= 1)
    #expect(selected.count == 100)
  }

  @Test func theNumberIsThatRequested() {
    #expect(FrameSelection().run(walk(), count: 7).count == 7)
    #expect(FrameSelection().run(walk(frames: 12), count: 120).count == 12)
  }

  @Test func stillCamerasGiveFramesAtEvenTimes() {
    let readings = (0..<400).map {
      FrameReading(index: $0, seconds: Double($0), position: 0, sharpness: 1)
    }
    let selected = FrameSelection().run(readings).map(\.index)
    #expect(selected == (0..<40).map { 10 * $0 + 5 })
  }

  @Test func emptyVideosGiveNothing() { #expect(FrameSelection().run([]).isEmpty) }
}
