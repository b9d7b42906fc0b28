/// The limits of `--detail custom`.
package typealias CustomDetail =
  PhotogrammetrySession.Configuration.CustomDetailSpecification
