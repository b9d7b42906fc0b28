import Foundation

/// A camera whose lens distortion `Camera` can't represent.
package struct UnsupportedCameraModel: LocalizedError, Equatable, Sendable {
  /// The path of the file.
  package var path: String
  /// COLMAP's name of the model.
  package var model: String

  package var errorDescription: String? {
    "\(path) has a camera of the model \(model), whose lens distortion isn't supported."
  }

  package var recoverySuggestion: String? {
    "Undistort the photos with 'colmap image_undistorter', convert the resulting "
      + "model with 'colmap model_converter --output_type TXT', and specify its folders."
  }
}
