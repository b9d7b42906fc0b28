// Points and rectangles are Foundation's; images and contexts are in a module of another name,
// which RealityKit exports. It doesn't import this one: Swift Testing looks for an overlay wherever
// it sees the name.
@_exported import BitmapGraphics
@_exported import Foundation
