// A program that imports RealityKit on a Mac sees these modules as well.
@_exported import Foundation
@_exported import simd
