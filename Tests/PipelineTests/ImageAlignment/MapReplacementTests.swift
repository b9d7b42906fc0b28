import Foundation
import SceneModel
import Testing

@testable import Pipeline

/// When a second map of the same photos replaces a first one that may be wrong.
@Suite struct MapReplacementTests {
  private func map(
    _ verdict: SceneAmbiguityCheck.Verdict?, registered count: Int
  ) -> ImageAlignment.Map {
    let photos = (0..<20).map { index in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg",
        url: URL(fileURLWithPath: "/\(index).jpg"), width: 4, height: 3, orientation: 1,
        camera: ID(0))
    }
    let poses = photos.indices.map { $0 < count ? RigidTransform.identity : nil }
    let findings = verdict.map { verdict in
      var findings = SceneAmbiguityCheck.Findings()
      findings.verdict = verdict
      return findings
    }
    return ImageAlignment.Map(
      reconstruction: Reconstruction(cameras: [], photos: photos, poses: poses, points: []),
      findings: findings)
  }

  @Test func onlySignsMakeAMapQuestionable() {
    #expect(!map(.consistent, registered: 20).mayBeWrong)
    #expect(map(.ambiguous, registered: 20).mayBeWrong)
    #expect(map(.inconsistent, registered: 20).mayBeWrong)
    // The check failed.
    #expect(!map(nil, registered: 20).mayBeWrong)
  }

  @Test(arguments: [(20, true), (18, true), (17, false)])
  func mostPhotosMustBeRegistered(_ count: Int, isReplacing: Bool) {
    let (first, other) = (map(.ambiguous, registered: 20), map(.consistent, registered: count))
    #expect(other.replaces(first, minimumShare: 0.9) == isReplacing)
  }

  @Test func anyConsistentMapReplacesAnInconsistentOne() {
    let first = map(.inconsistent, registered: 20)
    #expect(map(.consistent, registered: 5).replaces(first, minimumShare: 0.9))
  }

  @Test(arguments: [SceneAmbiguityCheck.Verdict.ambiguous, .inconsistent, nil])
  func aMapThatMayBeWrongReplacesNone(_ verdict: SceneAmbiguityCheck.Verdict?) {
    let first = map(.ambiguous, registered: 12)
    #expect(!map(verdict, registered: 20).replaces(first, minimumShare: 0.9))
  }
}
