// `TemporaryFolder` has its own module, because tests that run on every platform use it, too.
@_exported import TestFiles
