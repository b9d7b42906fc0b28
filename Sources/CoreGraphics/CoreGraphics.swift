// Foundation has what of Core Graphics there is on this system: CGFloat, CGPoint, CGSize, CGRect.
// RealityKit doesn't import this module: Swift Testing looks for an overlay wherever it sees the name.
@_exported import Foundation
