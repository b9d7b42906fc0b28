// Swift Testing looks for an overlay of each module that a file imports next to it, and there is
// none of Core Image on Linux. So this file, which doesn't import Testing, names the types for the
// tests.
import CoreImage
import Metal

typealias RenderedImage = CoreImage.CIImage
typealias ImageRenderer = CoreImage.CIContext
typealias ImageFormat = CoreImage.CIFormat
typealias ImageOption = CoreImage.CIImageOption
typealias RepresentationOption = CoreImage.CIImageRepresentationOption
