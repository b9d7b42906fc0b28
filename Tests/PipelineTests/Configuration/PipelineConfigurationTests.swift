import Foundation
import SceneModel
import Testing

@testable import Pipeline

@Suite struct PipelineConfigurationTests {
  @Test func optionsFollowTheDetailLevel() {
    var configuration = PipelineConfiguration()
    configuration.photoRefinement = PhotoRefinement.Options()
    var specification = DetailSpecification(.full)
    specification.textureFormat = .jpeg(quality: 0.5)
    let special = configuration.specialized(for: specification, viewPixels: 3_000_000)
    #expect(special.pointCloudGeneration.maximumPixelsPerView == 3_000_000)
    #expect(special.meshGeneration.maximumDepth == 10)
    #expect(special.photoRefinement?.maximumPixels == 8_000_000)
    #expect(special.simplification.maximumTriangles == 249_999)
    #expect(special.textureMapping.textureSide == 8192)
    #expect(special.textureMapping.maps == Set(TextureMap.allCases))
    #expect(special.export.textureFormat == .jpeg(quality: 0.5))
    // Earlier stages do not depend on it.
    #expect(special.ingestion == configuration.ingestion)
    #expect(special.alignment == configuration.alignment)
    // Specialization is idempotent.
    #expect(special.specialized(for: specification, viewPixels: 3_000_000) == special)
  }

  @Test func maskingIsOneOptionForIngestionAndMesh() {
    var configuration = PipelineConfiguration()
    configuration.isObjectMaskingEnabled = false
    #expect(!configuration.ingestion.inspection.usesMasks)
    #expect(!configuration.meshGeneration.isolatesObject)
  }

  @Test func theEncodedConfigurationComesBack() throws {
    var configuration = PipelineConfiguration()
    configuration.alignment.ordering = .sequential
    configuration.alignment.features.sensitivity = .high
    configuration.textureMapping.maps = [.roughness, .diffuseColor]
    let encoded = try JSONEncoder().encode(configuration)
    #expect(try JSONDecoder().decode(PipelineConfiguration.self, from: encoded) == configuration)
  }
}
