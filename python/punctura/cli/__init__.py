"""The command line. Each verb is a file in this folder: `simulate.py` holds `command`, which is `punctura simulate`.

A new verb is a new file; nothing is registered anywhere else. A file whose name begins with an underscore is no verb.
"""

from punctura.cli._app import main

__all__ = ["main"]
