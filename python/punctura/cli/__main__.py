"""`python -m punctura.cli` is `punctura`."""

from punctura.cli import main

main()
