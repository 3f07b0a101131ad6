"""`python -m punctura` is `punctura`."""

from punctura.cli import main

main()
