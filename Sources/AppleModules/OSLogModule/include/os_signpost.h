// What `import os.signpost` gives is in the Swift module `os`.
