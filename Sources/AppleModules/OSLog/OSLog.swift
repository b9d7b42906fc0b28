// Programs may import `Logger` under this module name.
@_exported import os
