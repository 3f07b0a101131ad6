"""The command line. Each verb is a file in this folder: `simulate.py` holds `command`, which is `punctura simulate`.

A new verb is a new file; nothing is registered anywhere else. A file whose name begins with an underscore is no verb.
"""

import os

# Before pyarrow is imported: its own allocator reserves a gigabyte, and a run locks what is reserved into memory.
os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")

from punctura.cli._app import main

__all__ = ["main"]
