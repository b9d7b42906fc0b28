// On macOS, a program that imports RealityKit sees these modules as well. There Foundation itself
// has what FoundationNetworking has here.
@_exported import BitmapGraphics
@_exported import CoreMotion
@_exported import CoreVideo
@_exported import Foundation
@_exported import FoundationNetworking
@_exported import ImageIO
@_exported import Observation
@_exported import simd
