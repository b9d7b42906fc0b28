import Logging

/// The logger of all sessions.
let sessionLogger = Logger(label: "photogrammetry.session")
