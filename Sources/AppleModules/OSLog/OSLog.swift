// Some programs import their log by this name.
@_exported import os
