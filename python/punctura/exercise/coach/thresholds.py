"""The numbers from which the coach says something. All are illustrative: they were chosen for a desktop device."""

MOST_REMARKS = 3  # of each sort

REACTION_S = 0.2  # time in which a hand goes on before it can react to a pop
BEFORE_S = 0.1  # length of the window before a pop, or before the decision, in which speed and force are measured

FIRM_STOP = 0.5  # share of the allowed overshoot: up to here the stop went well
NEAR_STOP = 0.8  # share of the allowed overshoot: from here it was close

ANGLE_GOOD_DEG, ANGLE_OFF_DEG = 2.0, 5.0  # difference to the angle of the start
ASIDE_GOOD_M, ASIDE_OFF_M = 0.5e-3, 1.0e-3  # distance from the line of entry
CROOKED = 1.1  # path length through straight distance

PAUSE_S = 1.0  # a shorter stop is not a pause
PAUSES_S = 2.0  # all pauses together, from which the coach speaks

HOLD_S = 1.0  # a shorter stay says nothing about holding still
HOLD_SETTLE_S = 0.3  # the beginning of a stay, in which the needle still arrives
SMOOTH_S = 0.25  # what is slower is drift, what is faster is tremor (8 to 12 Hz in a healthy hand)
TREMOR_GOOD_M, TREMOR_OFF_M = 0.08e-3, 0.15e-3  # rms, of all directions
DRIFT_GOOD_M, DRIFT_OFF_M = 0.5e-3, 1.5e-3
RESTING_N = 0.5  # a thumb with less rests on the plunger
PRESSED_S = 0.5  # time behind the end of the space
