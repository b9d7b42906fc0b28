import RealityKit
import Testing

// Imports only RealityKit: what compiles here compiles in a program for macOS.

/// Handles every case of an output, as a client program does.
private func summary(of output: PhotogrammetrySession.Output) -> String {
  switch output {
  case .inputComplete: "inputComplete"
  case .requestError(let request, let error): "requestError \(request) \(error)"
  case .requestComplete(let request, let result): "complete \(request) \(summary(of: result))"
  case .requestProgress(let request, fractionComplete: let fraction): "\(request) \(fraction)"
  case .requestProgressInfo(let request, let info):
    "\(request) \(info.estimatedRemainingTime ?? -1) \(String(describing: info.processingStage))"
  case .processingComplete: "processingComplete"
  case .processingCancelled: "processingCancelled"
  case .invalidSample(id: let id, reason: let reason): "invalid \(id) \(reason)"
  case .skippedSample(id: let id): "skipped \(id)"
  case .automaticDownsampling: "automaticDownsampling"
  case .stitchingIncomplete: "stitchingIncomplete"
  @unknown default: "unknown"
  }
}

private func summary(of result: PhotogrammetrySession.Result) -> String {
  switch result {
  case .modelFile(let url): url.path
  case .modelEntity(let entity): entity.name
  case .bounds(let bounds): "\(bounds.center)"
  case .pointCloud(let cloud): cloud.points.map { "\($0.position) \($0.color.w)" }.joined()
  case .poses(let poses):
    poses.posesBySample.map { "\($0) \($1.translation) \($1.rotation) \($1.transform.scale)" }
      .joined() + "\(poses.urlsBySample[0]?.path ?? "")"
  }
}

@Suite struct PublicAPITests {
  typealias Session = PhotogrammetrySession
  typealias Custom = Session.Configuration.CustomDetailSpecification

  @Test func configurationHasApplesDefaults() {
    var configuration = Session.Configuration()
    #expect(configuration.isObjectMaskingEnabled)
    #expect(configuration.sampleOrdering == .unordered)
    #expect(configuration.featureSensitivity == .normal)
    #expect(configuration.meshPrimitive == .triangle)
    #expect(configuration.checkpointDirectory == nil && !configuration.ignoreBoundingBox)
    let other = configuration
    configuration.sampleOrdering = .sequential
    configuration.featureSensitivity = .high
    configuration.meshPrimitive = .quad
    #expect(configuration != other)
    let url = URL(fileURLWithPath: "/tmp", isDirectory: true)
    #expect(Session.Configuration(checkpointDirectory: url).checkpointDirectory == url)
  }

  @Test func customSpecificationCanBeBuilt() {
    var custom = Custom()
    custom.maximumPolygonCount = 12_345
    custom.maximumTextureDimension = .sixteenK
    custom.outputTextureMaps = [.diffuseColor, .roughness]
    custom.textureFormat = .jpeg()
    #expect(custom.textureFormat == .jpeg(compressionQuality: 0.8) && custom != Custom())
    #expect(Custom.TextureDimension(rawValue: 4096) == .fourK)
    let all: Custom.TextureMapOutputs = [
      .diffuseColor, .normal, .roughness, .displacement, .ambientOcclusion,
    ]
    #expect(all == .all && all.rawValue.nonzeroBitCount == 5)
    let dimensions: [Custom.TextureDimension] = [.oneK, .twoK, .fourK, .eightK, .sixteenK]
    #expect(dimensions.map(\.rawValue) == [1024, 2048, 4096, 8192, 16384])
  }

  @Test func requestsHaveApplesDefaultsAndRawValues() {
    let url = URL(fileURLWithPath: "/tmp/model.usdz")
    #expect(Session.Request(modelFile: url) == .modelFile(url: url, detail: .reduced))
    #expect(Session.Request.modelEntity() == .modelEntity(detail: .reduced, geometry: nil))
    let details: [Session.Request.Detail] = [.preview, .reduced, .medium, .full, .raw, .custom]
    #expect(details.map(\.rawValue) == Array(0..<6))
    #expect(Set<Session.Request>([.bounds, .pointCloud, .poses, .bounds]).count == 3)
    #expect("\(Session.Request.pointCloud)" == "pointCloud")
  }

  @Test func geometryKeepsBoundsAndOrientationTogether() {
    let box = BoundingBox(min: .zero, max: .one)
    var geometry = Session.Request.Geometry(bounds: box)
    #expect(geometry.orientedBounds == OrientedBoundingBox(boundingBox: box))
    geometry.orientedBounds = OrientedBoundingBox(
      orientation: simd_quatf(angle: 1, axis: [0, 1, 0]), boundingBox: box)
    #expect(geometry.bounds == box)
    geometry.bounds = .empty
    #expect(geometry == Session.Request.Geometry() && geometry.transform == .identity)
  }

  @Test func errorsCarryApplesDomainAndCodes() {
    let url = URL(fileURLWithPath: "/nowhere/at/all", isDirectory: true)
    let errors: [Session.Error] = [
      .invalidImages(url), .invalidOutput(url), .insufficientStorage(requiredBytes: 5_000_000),
    ]
    #expect(errors.map { ($0 as NSError).code } == [0, 1, 2])
    for error in errors {
      #expect((error as NSError).domain == "RealityFoundation.PhotogrammetrySession.Error")
      #expect((error as any Error).localizedDescription == error.localizedDescription)
    }
    #expect(errors[0].localizedDescription.contains("/nowhere/at/all"))
    #expect(errors[2].localizedDescription.contains("5 MB"))
  }

  @Test func outputsCanBeHandledAndDescribed() {
    let outputs: [Session.Output] = [
      .inputComplete, .processingComplete, .processingCancelled, .automaticDownsampling,
      .stitchingIncomplete, .skippedSample(id: 3), .invalidSample(id: 2, reason: "It is blurred."),
      .requestProgress(.poses, fractionComplete: 0.5),
      .requestComplete(.bounds, .bounds(.empty)),
      .requestError(.pointCloud, Session.Error.invalidImages(URL(fileURLWithPath: "/x"))),
    ]
    for output in outputs {
      #expect(!output.localizedDescription.isEmpty && !summary(of: output).isEmpty)
    }
  }

  @Test func samplesKeepTheirProperties() throws {
    var buffer: CVPixelBuffer?
    #expect(
      CVPixelBufferCreate(kCFAllocatorDefault, 30, 20, kCVPixelFormatType_32BGRA, nil, &buffer)
        == kCVReturnSuccess)
    let image = try #require(buffer)
    #expect(CVPixelBufferGetWidth(image) == 30 && CVPixelBufferGetHeight(image) == 20)
    #expect(CVPixelBufferGetBytesPerRow(image) >= 120)
    CVPixelBufferLockBaseAddress(image, [])
    let base = try #require(CVPixelBufferGetBaseAddress(image))
    base.storeBytes(
      of: 7, toByteOffset: 20 * CVPixelBufferGetBytesPerRow(image) - 1, as: UInt8.self)
    CVPixelBufferUnlockBaseAddress(image, [])
    var sample = PhotogrammetrySample(id: 4, image: image)
    sample.gravity = CMAcceleration(x: 0, y: -1, z: 0)
    sample.metadata["Make"] = "Test"
    sample.objectMask = nil
    sample.depthDataMap = nil
    #expect(sample.id == 4 && sample.camera == nil && sample.orientation == .up)
    #expect("\(sample)" == "PhotogrammetrySample(id: 4, 30×20, gravity)")
    CVPixelBufferCreate(nil, 0, 20, kCVPixelFormatType_32BGRA, nil, &buffer)
    #expect(buffer == nil)
  }

  @Test func pixelBuffersCopyBytes() throws {
    // Two rows of two BGRA pixels, with four bytes of padding between them.
    var bytes: [UInt8] = [1, 2, 3, 255, 4, 5, 6, 255, 0, 0, 0, 0, 7, 8, 9, 255, 1, 1, 1, 255, 0, 0]
    bytes += [0, 0]
    let attributes =
      [
        kCVPixelBufferCGImageCompatibilityKey: kCFBooleanTrue!,
        kCVPixelBufferCGBitmapContextCompatibilityKey: kCFBooleanTrue!,
      ] as CFDictionary
    var calls = 0
    var buffer: CVPixelBuffer?
    try bytes.withUnsafeMutableBytes { source in
      let base = try #require(source.baseAddress)
      let status = CVPixelBufferCreateWithBytes(
        kCFAllocatorDefault, 2, 2, kCVPixelFormatType_32BGRA, base, 12,
        { counter, _ in counter?.assumingMemoryBound(to: Int.self).pointee += 1 }, &calls,
        attributes, &buffer)
      #expect(status == kCVReturnSuccess)
    }
    let image = try #require(buffer)
    let base = try #require(CVPixelBufferGetBaseAddress(image))
    let second = CVPixelBufferGetBytesPerRow(image)
    #expect(calls == 1 && base.load(fromByteOffset: 5, as: UInt8.self) == 5)
    #expect(base.load(fromByteOffset: second + 2, as: UInt8.self) == 9)
    #expect(!CVPixelBufferIsPlanar(image) && CVPixelBufferGetPlaneCount(image) == 0)
  }

  @Test func lensEntityAndLimitTypesExist() {
    let lens = LensDistortionData(center: [1, 2], radialLookupTable: [0, 0.1])
    #expect(lens.center == [1, 2] && lens.radialLookupTable.count == 2)
    let component: any Component = Transform.identity
    #expect(component is Transform && ModelEntity().name.isEmpty)
    #expect(Session.limits.maximumInputImageDimension >= 8192)
    #expect((100...65_535).contains(Session.limits.maximumNumberOfInputImages))
    #expect(CGImagePropertyOrientation(rawValue: 6) == .right)
  }
}
