// On macOS, a program that imports RealityKit sees these modules as well.
@_exported import BitmapGraphics
@_exported import CoreMotion
@_exported import CoreVideo
@_exported import Foundation
@_exported import ImageIO
@_exported import Observation
@_exported import simd
