// The Swift module `os` declares what `import os.lock` provides.
