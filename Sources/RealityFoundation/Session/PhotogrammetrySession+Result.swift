extension PhotogrammetrySession {
  /// The result of a request.
  public enum Result: Sendable {
    /// The file or folder that was written.
    case modelFile(URL)
    /// The model in memory.
    case modelEntity(ModelEntity)
    /// The bounding box of the object in the model's frame.
    case bounds(BoundingBox)
    /// Points on the surface, in the model's frame.
    case pointCloud(PointCloud)
    /// The poses of the photos, in the model's frame.
    case poses(Poses)
  }
}
