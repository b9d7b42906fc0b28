// The Swift module `os` declares what `import os.log` provides.
