@_exported import RealityFoundation
