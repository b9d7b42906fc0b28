import SceneModel

/// The random number generator of tests.
package typealias SeededGenerator = SplitMix64
