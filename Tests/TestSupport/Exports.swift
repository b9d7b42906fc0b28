// `TemporaryFolder` has its own module, because tests that run on every platform use it, too.
@_exported import TestFiles
// Scenes for tests are built from the renderer of the program's demo.
@_exported import SceneRendering
