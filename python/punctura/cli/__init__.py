"""The command line. Each verb is a file in this folder: `simulate.py` holds `command`, which is `punctura simulate`.

A new verb needs only a new file. Files whose names begin with an underscore are not verbs.
"""

from punctura.cli._app import main

__all__ = ["main"]
