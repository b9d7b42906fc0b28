// On macOS, Foundation itself has what FoundationNetworking has here. `RealityFoundation` does not
// export it, because it loads 30 libraries, which the command line does without.
@_exported import FoundationNetworking
@_exported import RealityFoundation
