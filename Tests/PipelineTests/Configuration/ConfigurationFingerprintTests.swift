import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ConfigurationFingerprintTests {
  /// A configuration whose optional members are all present.
  private static var complete: PipelineConfiguration {
    var configuration = PipelineConfiguration()
    let (file, folder) = (URL(filePath: "/tmp/a.png"), URL(filePath: "/tmp/a/"))
    configuration.photoRefinement = PhotoRefinement.Options()
    configuration.checkpointDirectory = folder
    configuration.maskOutput = folder
    configuration.previewFile = file
    configuration.tiles = TileOutput(folder: folder, fileExtension: "glb")
    configuration.ingestion.maskFolder = folder
    configuration.alignment.worldAlignment.knownDistances = [
      KnownDistance(from: .camera("a.jpg"), to: .camera("b.jpg"), meters: 0.4)
    ]
    return configuration
  }

  private static func fingerprint(
    _ encoded: JSONValue, through stage: PipelineStage
  ) throws -> Data {
    try ConfigurationFingerprint.content(of: encoded, through: stage)
  }

  /// A new or changed option counts for alignment and surface without being listed anywhere.
  @Test func everyOptionCountsUnlessItIsExcluded() throws {
    let encoded = try JSONValue(encoding: Self.complete)
    let changes = encoded.changes()
    #expect(changes.count > 200)
    let stages: [PipelineStage] = [
      .imageAlignment, .objectMasking, .meshGeneration, .optimization,
    ]
    for stage in stages {
      let before = try Self.fingerprint(encoded, through: stage)
      for (path, changed) in changes {
        let counts = Self.counts(path, through: stage)
        let isEqual = try Self.fingerprint(changed, through: stage) == before
        #expect(isEqual == !counts, "\(path.joined(separator: ".")) through \(stage)")
      }
    }
  }

  private static func counts(_ path: [String], through stage: PipelineStage) -> Bool {
    if ConfigurationFingerprint.exclusions.contains(where: { path.starts(with: $0.path) }) {
      return false
    }
    guard let first = path.first, let own = ConfigurationFingerprint.stages[first],
      let ownIndex = PipelineStage.allCases.firstIndex(of: own),
      let index = PipelineStage.allCases.firstIndex(of: stage)
    else { return true }
    return ownIndex <= index
  }

  /// A member that is not listed counts from the first stage on.
  @Test func newMembersCountForAllStages() throws {
    let encoded = try JSONValue(encoding: PipelineConfiguration())
    guard case .object(var members) = encoded else {
      Issue.record("the configuration is not an object")
      return
    }
    members["newOption"] = .bool(true)
    let before = try Self.fingerprint(encoded, through: .imageAlignment)
    #expect(try Self.fingerprint(.object(members), through: .imageAlignment) != before)
  }

  @Test func listsNameMembersThatExist() throws {
    let encoded = try JSONValue(encoding: Self.complete)
    guard case .object(let members) = encoded else {
      Issue.record("the configuration is not an object")
      return
    }
    for member in ConfigurationFingerprint.stages.keys { #expect(members[member] != nil) }
    for exclusion in ConfigurationFingerprint.exclusions {
      var changed = encoded
      changed.remove(exclusion.path)
      #expect(changed != encoded, "\(exclusion.path.joined(separator: "."))")
      #expect(!exclusion.reason.isEmpty)
    }
  }

  @Test func equalConfigurationsHaveEqualBytes() throws {
    let contents = try (0..<10).map { _ in
      try ConfigurationFingerprint.content(of: Self.complete, through: .optimization)
    }
    #expect(Set(contents).count == 1)
  }
}

extension JSONValue {
  /// All documents that differ from this one in a single leaf, with the path of the leaf.
  fileprivate func changes() -> [(path: [String], value: JSONValue)] {
    switch self {
    case .object(let members):
      return members.flatMap { key, member in
        member.changes().map { change in
          var changed = members
          changed[key] = change.value
          return ([key] + change.path, .object(changed))
        }
      }
    case .array(let elements):
      return elements.indices.flatMap { index in
        elements[index].changes().map { change in
          var changed = elements
          changed[index] = change.value
          return (["\(index)"] + change.path, .array(changed))
        }
      }
    case .string(let text): return [([], .string(text + "?"))]
    case .number(let number): return [([], .number(number + 1))]
    case .bool(let value): return [([], .bool(!value))]
    case .null: return [([], .bool(true))]
    }
  }
}
