import Logging
import os

/// The logger of all sessions.
let sessionLogger = Logging.Logger(standardErrorLabel: "photogrammetry.session")

/// The source of log messages about what a session tells as an output too.
package let sessionOutputSource = "photogrammetry.session.output"
