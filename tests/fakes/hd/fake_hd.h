/* A fake of the HD library of OpenHaptics with a simulated device inside: what tests tell it, and what it tells them.
   It also exports the real library's functions, under their real names, with the real numbers
   (fake_hd_interface.cpp). */
#ifndef PUNCTURA_TESTS_FAKE_HD_H
#define PUNCTURA_TESTS_FAKE_HD_H

#ifdef __cplusplus
extern "C" {
#endif

struct fake_hd_settings {
  const char* name;        /* the only name that opens it besides nullptr; see null_opens */
  int null_opens;          /* nullptr opens it too */
  unsigned init_error;     /* 0, or what opening gives */
  unsigned long only_rate; /* Hz; 0: every floor(8000/N + 0.5) */
  unsigned rate_error;     /* what a refused rate gives */
  double real_rate;        /* Hz at which the scheduler calls, whatever it says; 0: what it says */
  unsigned long long
      fast_ticks; /* as many ticks come as fast as possible, on a clock of their own; then at the real pace */
  int ideal;      /* the stylus is exactly where the hand wants it */
  double from_mm[3], to_mm[3]; /* one stroke there and back, after 0.6 s of rest */
  double duration;             /* of one way, s */
  unsigned long long seed;
  double axis[3]; /* where the stylus points, of length 1 */
  double stretch; /* of the rotation's columns: 1 is a rotation */
  int buttons;
  double temperature;          /* of the hottest motor */
  unsigned calibration, style; /* as the library says them */
  int renewing_works;          /* hdUpdateCalibration makes it right */
};

enum fake_hd_fault {
  FAKE_HD_ERROR_AT_BEGIN, /* value: the error's code */
  FAKE_HD_ERROR_AT_END,   /* value: the error's code; the frame's force is not sent */
  FAKE_HD_JUMP,           /* the position moves by `value` mm at once */
  FAKE_HD_UNPLUG,
  FAKE_HD_FREEZE,       /* the scheduler calls nobody any more */
  FAKE_HD_NOT_A_NUMBER, /* the position is NaN */
  FAKE_HD_CALIBRATION   /* value: what checking it gives from now on */
};

struct fake_hd_record {
  double time;        /* s, since fake_hd_restart */
  double position[3]; /* mm, as told in this tick */
  double force[3];    /* N, that the motors hold when the tick is over */
};

void fake_hd_defaults(struct fake_hd_settings*);
/* Stops it, forgets everything, and takes these settings; nullptr: the default ones. */
void fake_hd_reset(const struct fake_hd_settings*);
/* Tick 0 again, the hand at the begin of its motion, no record, no fault to come. With the scheduler stopped. */
void fake_hd_restart(void);
/* In so many ticks after tick `first`, counted from fake_hd_restart. */
void fake_hd_inject(int fault, unsigned value, unsigned long long first, unsigned long long ticks);
unsigned long long fake_hd_ticks(void);
long long fake_hd_now_ns(void);
/* How many were copied. Of the first 65536 ticks. */
unsigned long long fake_hd_records(struct fake_hd_record* to, unsigned long long most);
void fake_hd_held_force(double force[3]);
int fake_hd_scheduler_runs(void);
int fake_hd_operations(void); /* scheduled and not yet done or unscheduled */
int fake_hd_devices_open(void);
unsigned long long fake_hd_misuses(void); /* calls that broke the library's rules */

#ifdef __cplusplus
}
#endif
#endif
