import SceneModel

extension PhotogrammetrySession.Poses {
  /// The registered photos of a reconstruction. `sampleIDs` maps files to sample ids if the input
  /// was not a folder.
  init(_ reconstruction: Reconstruction, sampleIDs: [Int]?) {
    var poses: [Int: PhotogrammetrySession.Pose] = [:]
    var urls: [Int: URL] = [:]
    for id in reconstruction.registered {
      guard let cameraFromWorld = reconstruction.poses[id.index] else { continue }
      let photo = reconstruction.photos[id.index]
      var sample = photo.sampleID
      if let sampleIDs {
        guard sampleIDs.indices.contains(sample) else { continue }
        sample = sampleIDs[sample]
      } else {
        urls[sample] = photo.url
      }
      poses[sample] = PhotogrammetrySession.Pose(
        cameraFromWorld: cameraFromWorld, camera: reconstruction.camera(of: id))
    }
    posesBySample = poses
    urlsBySample = urls
  }
}

extension PhotogrammetrySession.Pose {
  /// Converts a computer-vision pose (world to camera; looking along +z, y down) to RealityKit's.
  init(cameraFromWorld: RigidTransform, camera: Camera) {
    let worldFromCamera = cameraFromWorld.inverse
    // Half a turn about x converts between the two camera frames.
    let rotation = worldFromCamera.rotation * Quaternion(x: 1, y: 0, z: 0, w: 0)
    self.rotation = simd_quatf(
      ix: Float(rotation.x), iy: Float(rotation.y), iz: Float(rotation.z), r: Float(rotation.w))
    translation = SIMD3<Float>(worldFromCamera.translation)
    let (focal, center) = (SIMD2<Float>(camera.focalLength), SIMD2<Float>(camera.principalPoint))
    intrinsics = simd_float3x3([focal.x, 0, 0], [0, focal.y, 0], [center.x, center.y, 1])
    lensDistortionData = LensDistortionData(camera)
  }
}

extension LensDistortionData {
  /// The radial distortion of a camera; nil for a plain pinhole.
  init?(_ camera: Camera) {
    let (k1, k2) = (camera.distortion.x, camera.distortion.y)
    guard k1 != 0 || k2 != 0 else { return nil }
    let size = SIMD2(Double(camera.width), Double(camera.height))
    let reach = pointwiseMax(camera.principalPoint, size - camera.principalPoint)
    let farthest = (reach / camera.focalLength).squaredLength
    let steps = 64  // Entries of the table. Chosen.
    self.init(
      center: SIMD2<Float>(camera.principalPoint),
      radialLookupTable: (0..<steps).map { step in
        let radius = Double(step) / Double(steps - 1)
        let r2 = farthest * radius * radius
        return Float(r2 * (k1 + r2 * k2))
      })
  }
}
