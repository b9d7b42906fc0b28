/// How a result is brought to the frame of the reference.
package enum AlignmentMethod: String, Codable, Sendable, CaseIterable {
  /// By the centers of the photos' cameras.
  case cameras
  /// By the surfaces, with rotation, translation and scale.
  case icp
  /// By the surfaces, with rotation and translation.
  case icpRigid = "icp-rigid"
  /// The result is in the frame of the reference.
  case none
}
