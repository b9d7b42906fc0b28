import SceneModel
import Testing

@Suite struct SensorReadingTests {
  /// A phone that is held upright stores photos turned by a quarter (orientation 6), and gravity
  /// points to the bottom of its screen: down in the upright photo.
  @Test func uprightPhonesHaveGravityDown() {
    #expect(SensorReading.gravity(ofPhone: [0, -1, 0], orientation: 6) == [0, 1, 0])
    #expect(SensorReading.gravity(ofPhone: [0, 1, 0], orientation: 8) == [0, 1, 0])
    #expect(SensorReading.gravity(ofPhone: [-1, 0, 0], orientation: 1) == [0, 1, 0])
    #expect(SensorReading.gravity(ofPhone: [1, 0, 0], orientation: 3) == [0, 1, 0])
  }

  /// The screen faces up: its camera, on the back, looks along gravity.
  @Test(arguments: 1...8) func phonesOnATableLookDown(orientation: Int) {
    #expect(SensorReading.gravity(ofPhone: [0, 0, -1], orientation: orientation) == [0, 0, 1])
  }

  @Test(arguments: 1...8) func lengthsAreKept(orientation: Int) throws {
    let phone = SIMD3<Double>(1, -2, 3)
    let gravity = try #require(SensorReading.gravity(ofPhone: phone, orientation: orientation))
    #expect(gravity.squaredLength == 14 && gravity.z == -3)
  }

  @Test func withoutGravityThereIsNone() {
    for vector in [SIMD3<Double>.zero, [.nan, 0, 0], [.infinity, 0, 0]] {
      #expect(SensorReading.gravity(ofPhone: vector, orientation: 1) == nil)
    }
  }
}
