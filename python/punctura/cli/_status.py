"""Exit statuses, the same for every verb. README.md shows them."""

DONE = 0
FAILED = 1  # the run failed or found a difference: the device stopped, the disk is full, a replay differs
CALLED_WRONGLY = 2  # usage, a wrong scene or device, a file or folder of the command line that is not there
DEFECT = 70  # of Punctura itself; EX_SOFTWARE of sysexits.h
SIGNAL = 128  # plus the signal's number: ended by that signal
