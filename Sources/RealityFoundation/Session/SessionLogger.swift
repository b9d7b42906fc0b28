import Logging
import os

/// The logger of all sessions.
let sessionLogger = Logging.Logger(standardErrorLabel: "photogrammetry.session")

/// The source of log messages that repeat outputs of a session.
package let sessionOutputSource = "photogrammetry.session.output"
