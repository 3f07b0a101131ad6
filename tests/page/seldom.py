"""`punctura` that sends its ticks to the pages 12 times a second and not 60.

A browser that draws in software has more time for the tests then. No tick is left out: each message has more of them.
"""

from punctura.cli._app import main
from punctura.studio import session

session.PUMP_S = 1 / 12
main()
