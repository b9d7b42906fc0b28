// What `import os.lock` gives is in the Swift module `os`.
