// Points and rectangles are Foundation's; images and contexts are in a module of another name,
// BitmapGraphics, which RealityKit exports. RealityKit doesn't import this module: where a module
// named CoreGraphics is visible, Swift Testing expects its CoreGraphics overlay.
@_exported import BitmapGraphics
@_exported import Foundation
