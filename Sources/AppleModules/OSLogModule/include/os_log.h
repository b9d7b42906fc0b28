// What `import os.log` gives is in the Swift module `os`.
