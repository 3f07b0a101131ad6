"""Exit statuses, the same for every verb. README.md shows them."""

DONE = 0
FAILED = 1  # the run failed, or found what it looks for: a device that stopped, a full disk, a replay that differs
CALLED_WRONGLY = 2  # usage, scene, device
SIGNAL = 128  # and the signal's number: ended by that signal
