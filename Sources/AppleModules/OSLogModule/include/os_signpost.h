// The Swift module `os` declares what `import os.signpost` provides.
