import Foundation
import RealityKit

typealias Session = PhotogrammetrySession
typealias Custom = Session.Configuration.CustomDetailSpecification

/// A configuration with every property set.
func makeConfiguration(checkpoint: URL) -> Session.Configuration {
  var configuration = Session.Configuration(checkpointDirectory: checkpoint)
  configuration.checkpointDirectory = nil
  configuration.isObjectMaskingEnabled = true
  configuration.sampleOrdering = .sequential
  configuration.featureSensitivity = .normal
  configuration.meshPrimitive = .quad
  configuration.ignoreBoundingBox = true
  configuration.customDetailSpecification = makeSpecification()
  check(configuration != Session.Configuration(), "configurations differ")
  let orderings: Set<Session.Configuration.SampleOrdering> = [.unordered, .sequential]
  let sensitivities: Set<Session.Configuration.FeatureSensitivity> = [.normal, .high]
  let primitives: Set<Session.Configuration.MeshPrimitive> = [.triangle, .quad]
  check(orderings.count + sensitivities.count + primitives.count == 6, "cases differ")
  return configuration
}

private func makeSpecification() -> Custom {
  var custom = Custom()
  custom.maximumPolygonCount = 6_000
  let dimensions: [Custom.TextureDimension] = [.oneK, .twoK, .fourK, .eightK, .sixteenK]
  custom.maximumTextureDimension = dimensions.first { $0.rawValue == 1024 } ?? .twoK
  let maps: Custom.TextureMapOutputs = [
    .diffuseColor, .normal, .roughness, .displacement, .ambientOcclusion,
  ]
  check(maps == .all && Custom.TextureMapOutputs(rawValue: maps.rawValue) == maps, "all maps")
  custom.outputTextureMaps = [.diffuseColor, .normal]
  custom.textureFormat = Custom.TextureFormat.jpeg(compressionQuality: 0.7)
  check(custom.textureFormat != .png && custom != Custom(), "formats differ")
  return custom
}

/// Requests of all kinds; the first is for a model.
func makeRequests(file: URL) -> [Session.Request] {
  let details: [Session.Request.Detail] = [.preview, .reduced, .medium, .full, .raw, .custom]
  check(details.map(\.rawValue) == [0, 1, 2, 3, 4, 5], "levels are numbered")
  check(Session.Request(modelFile: file) == .modelFile(url: file), "reduced is the default")
  var geometry = Session.Request.Geometry(
    orientedBounds: OrientedBoundingBox(
      orientation: simd_quatf(angle: 0.5, axis: [0, 1, 0]),
      boundingBox: BoundingBox(min: [-9, -9, -9], max: [9, 9, 9])))
  geometry.transform = Transform(scale: [2, 2, 2], rotation: geometry.orientedBounds.orientation)
  check(geometry.bounds == geometry.orientedBounds.boundingBox, "bounds are the box's")
  check(Session.Request.Geometry(bounds: .empty, transform: .identity) == .init(), "defaults")
  return [
    .modelFile(url: file, detail: .custom, geometry: geometry),
    .modelEntity(detail: .preview, geometry: geometry), .bounds, .pointCloud, .poses,
  ]
}
