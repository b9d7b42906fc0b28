import CKernels
import Foundation
import SceneModel

/// The cosine of an angle in degrees.
func cosine(degrees: Float) -> Float { cos(degrees * .pi / 180) }

extension PointCloud {
  /// Converts fused patches to a cloud.
  init(_ fused: ArraySlice<ck_fused_patch>) {
    self.init()
    positions.reserveCapacity(fused.count)
    for patch in fused {
      positions.append([patch.position.0, patch.position.1, patch.position.2])
      normals.append([patch.normal.0, patch.normal.1, patch.normal.2])
      colors.append([patch.color.0, patch.color.1, patch.color.2])
      consistency.append(patch.consistency)
      footprints.append(patch.footprint)
      withUnsafeBytes(of: patch.photos) { bytes in
        photoIndices += bytes.bindMemory(to: UInt16.self).prefix(Int(patch.photo_count))
      }
      photoOffsets.append(UInt32(photoIndices.count))
    }
  }
}
