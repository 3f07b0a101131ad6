"""The bounds of the numbers in exercise files, in the file's units, for the schema and the checks."""

# A desktop device moves a needle by at most 0.4 m, so values beyond these bounds are typing errors.
FARTHEST_START_MM = 500.0  # from the scene's origin
DEEPEST_MM = 200.0  # for every depth and distance in tissue; the longest spinal needles have 180 mm

# Two encoder steps of a desktop device: shorter lengths are lost in the encoder noise.
LEAST_MM = 0.1  # for every depth and distance, the width of a space, and the distance from the start to a membrane

LEAST_S, MOST_S = 0.01, 3600.0  # for every time
LEAST_N, MOST_N = 0.001, 1000.0  # for a force
MOST_ENTRIES = 1000
LEAST_DEG, MOST_DEG = 1.0, 45.0  # for a tolerance of an angle
LEAST_MM_PER_S, MOST_MM_PER_S = 0.5, 1000.0  # for a speed; a slower needle stands still
LEAST_PUSH_N, MOST_PUSH_N = 0.1, 15.0  # of a thumb; the simulated thumb pushes with at most 15 N
LEAST_ML, MOST_ML = 0.01, 100.0  # for a volume; the largest syringes have 60 mL

# Bounds of a heading vector's length. Beyond them, computing with it loses digits or overflows.
LEAST_HEADING, MOST_HEADING = 1e-3, 1e3
