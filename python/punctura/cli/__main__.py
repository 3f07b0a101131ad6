"""`python -m punctura.cli` is `punctura`."""

from punctura.cli._app import main

main()
