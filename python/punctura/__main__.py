"""`python -m punctura` is `punctura`."""

from punctura.cli import main

if __name__ == "__main__":
    main()
