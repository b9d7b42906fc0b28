import DamagedInput
import SceneModel
import Testing

@testable import Formats

@Suite struct MetashapeCamerasTests {
  /// Two cameras with poses, one of them in a group, and one without; the chunk is scaled by 2.
  private static func document(calibration: String) -> String {
    """
    <document version="1.4.0"><chunk>
      <sensors><sensor id="0" type="frame"><resolution width="1000" height="600"/>
        <calibration class="initial"><f>1</f></calibration>
        <calibration class="adjusted"><resolution width="1000" height="600"/>\(calibration)
        </calibration></sensor></sensors>
      <cameras>
        <camera id="0" sensor_id="0" label="a"><transform>0 -1 0 3 1 0 0 4 0 0 1 5 0 0 0 1
          </transform></camera>
        <camera id="1" sensor_id="0" label="b"/>
        <group><camera id="2" sensor_id="0" label="c.jpg">
          <transform>1 0 0 0 0 1 0 0 0 0 1 -1 0 0 0 1</transform></camera></group>
      </cameras>
      <transform><rotation>1 0 0 0 1 0 0 0 1</rotation><translation>10 0 0</translation>
        <scale>2</scale></transform>
    </chunk></document>
    """
  }

  private static let current =
    "<f>900</f><cx>5</cx><cy>-7</cy><b1>2</b1><k1>-0.1</k1><p1>0.003</p1>"

  @Test func camerasAreInTheFrameOfTheChunksTransform() throws {
    let model = try MetashapeCameras.decode(Array(Self.document(calibration: Self.current).utf8))
    #expect(model.photos.map(\.name) == ["a", "c.jpg"])
    let centers = model.poses.compactMap { $0?.center }
    #expect((centers[0] - [16, 8, 10]).length < 1e-12)
    #expect((centers[1] - [10, 0, -2]).length < 1e-12)
    // The camera's x axis is the chunk's y axis.
    let pose = try #require(model.poses[0])
    #expect((pose.rotation * SIMD3(0, 1, 0) - [1, 0, 0]).length < 1e-12)
  }

  @Test func calibrationsOfBothKindsAreRead() throws {
    let camera = try MetashapeCameras.decode(
      Array(Self.document(calibration: Self.current).utf8)
    ).cameras[0]
    #expect(camera.focalLength == [902, 900])
    #expect(camera.principalPoint == [505, 293])
    #expect(camera.distortion == [-0.1, 0, 0, 0.003])
    let old = try MetashapeCameras.decode(
      Array(
        Self.document(calibration: "<fx>900</fx><fy>901</fy><cx>490</cx><cy>310</cy>").utf8)
    ).cameras[0]
    #expect(old.focalLength == [900, 901])
    #expect(old.principalPoint == [490, 310])
  }

  @Test(arguments: [
    ("1 0 0 0 1 0 0 0 1</rotation>", "1 0 0 0 1 0 0 0 2</rotation>"), ("<scale>2", "<scale>-2"),
    ("<f>900</f>", ""), ("sensor_id=\"0\" label=\"a\"", "sensor_id=\"9\" label=\"a\""),
    ("<chunk>", "<chunks>"), ("width=\"1000\"", "width=\"1e3\""), ("0 -1 0 3", "0 -1 0"),
  ])
  func wrongDocumentsAreRefused(_ part: String, _ replacement: String) {
    let text = Self.document(calibration: Self.current)
      .replacingOccurrences(of: part, with: replacement)
    #expect(throws: FormatFault.self) { try MetashapeCameras.decode(Array(text.utf8)) }
  }

  @Test func damagedDocumentsGiveAValueOrAnError() {
    let whole = DamagedInput(Array(Self.document(calibration: Self.current).utf8))
    let mutations = Array(whole.mutations(2000, seed: 9, header: whole.bytes.count))
    for copy in Array(whole.truncations()) + mutations {
      guard let model = try? MetashapeCameras.decode(copy) else { continue }
      #expect(model.poses.count == model.photos.count)
    }
  }
}
