// A program that imports RealityKit on a Mac sees these modules as well.
@_exported import CoreMotion
@_exported import CoreVideo
@_exported import Foundation
@_exported import ImageIO
@_exported import simd
