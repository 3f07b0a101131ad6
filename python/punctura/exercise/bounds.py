"""The bounds of an exercise file's numbers, in the file's units. The schema and the checks take them from here."""

# A desktop device moves a needle by 0.4 m at most, so a start or a depth beyond these is a slip of the keyboard.
FARTHEST_START_MM = 500.0  # from the scene's origin
DEEPEST_MM = 200.0  # of every depth and distance in tissue; the longest spinal needles have 180 mm

# Two steps of the encoders of a desktop device: what is shorter cannot be told from their noise.
LEAST_MM = 0.1  # of every depth and distance, of the width of a space, and between the start and a membrane

LEAST_S, MOST_S = 0.01, 3600.0  # of every time
LEAST_N, MOST_N = 0.001, 1000.0  # of a force
MOST_ENTRIES = 1000

# A heading is a direction. Outside these lengths, computing with it loses digits or overflows.
LEAST_HEADING, MOST_HEADING = 1e-3, 1e3
