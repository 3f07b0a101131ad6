/* Punctura in C: the force of a needle that goes through tissue membranes and comes out again.
 *
 * C99, SI units. docs/c-abi.md explains it, with an example.
 *
 * Results: a function returns a punctura_status. PUNCTURA_OK is 0. If a function outside a tick fails,
 * punctura_last_error() says what is wrong, where, and what to do.
 *
 * Ticks: a function whose comment says "Tick" allocates no memory, takes no lock and writes no text. If a tick cannot
 * give a force, the force is NaN.
 *
 * Threads: different objects are independent. One object must not be used by two threads at the same time, with one
 * exception: several threads may read a scene that no thread changes. Errors are kept for each thread.
 *
 * Versions: PUNCTURA_ABI increases when a program that was compiled with an older header would no longer run. A
 * struct begins with struct_size, so that a later version can add fields at its end. Call punctura_check_abi() once.
 */
#ifndef PUNCTURA_H
#define PUNCTURA_H

#include <stddef.h>
#include <stdint.h>

#define PUNCTURA_ABI 1

#if defined(PUNCTURA_STATIC)
#define PUNCTURA_API
#elif defined(_WIN32) && defined(PUNCTURA_BUILDING)
#define PUNCTURA_API __declspec(dllexport)
#elif defined(_WIN32)
#define PUNCTURA_API __declspec(dllimport)
#else
#define PUNCTURA_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t punctura_status;
enum {
  PUNCTURA_OK = 0,
  PUNCTURA_BAD_ARGUMENT = 1, /* a null pointer, an index out of range, a struct_size too small or over 4096 */
  PUNCTURA_BAD_SCENE = 2,    /* the text or the values of a scene, or the limits, have problems */
  PUNCTURA_BAD_STATE = 3,    /* the bytes are no state of this object */
  PUNCTURA_NO_PEEK = 4,      /* commit without peek */
  PUNCTURA_NO_NUMBER = 5,    /* Tick: the position or the axis is not finite, or the axis is 0. The force is NaN */
  PUNCTURA_NO_MEMORY = 6,
  PUNCTURA_NOT_BUILT = 7, /* this library was built without the TOML reader */
  PUNCTURA_INTERNAL = 8   /* a defect of Punctura: please report it */
};

/* ---- Library ---- */

/* The version, for example "0.1.0". */
PUNCTURA_API const char* punctura_version(void);
/* Whether the library can serve a program that was compiled with this ABI number: 1 or 0. */
PUNCTURA_API int32_t punctura_supports_abi(int32_t abi);
#define punctura_check_abi() punctura_supports_abi(PUNCTURA_ABI)
/* The meaning of a status. The text is constant. */
PUNCTURA_API const char* punctura_status_text(punctura_status status);

/* The last error of this thread: one line, or one line for each problem. "" if there was none. Valid until the next
 * error of this thread. */
PUNCTURA_API const char* punctura_last_error(void);
/* The problems of the last error of this thread that was PUNCTURA_BAD_SCENE. Each has the path of a value, for example
 * "membrane[1].friction", the value in SI units (NaN if it is no number), and the reason. The texts are valid until
 * the next error of this thread. Each of the pointers may be NULL. */
PUNCTURA_API int32_t punctura_problem_count(void);
PUNCTURA_API punctura_status punctura_problem(int32_t index, const char** path, double* value, const char** reason);

/* ---- Scene: the description of a run ---- */

typedef struct punctura_scene punctura_scene;

/* From the text of a scene file, of `size` bytes without a NUL, at most 256 KiB. docs/scene-file.md. A size that is
 * larger than the text is refused if a NUL ends the text or if the size is above this limit. Otherwise the bytes behind
 * the text are read as well. */
PUNCTURA_API punctura_status punctura_scene_from_toml(const char* text, size_t size, punctura_scene** scene);

/* From lines PATH = NUMBER and PATH = "WORD", in SI units, with the paths of punctura_scene_set() and
 * punctura_scene_set_word(). Needs no TOML reader. A membrane and the syringe appear with their first line. `size` as
 * above, but at most 4 MiB. */
PUNCTURA_API punctura_status punctura_scene_from_values(const char* text, size_t size, punctura_scene** scene);

/* From structs. The _init functions set the numbers without default to NaN and all others to their default. Call them
 * as punctura_setup_init(&setup, sizeof setup). */
typedef struct punctura_setup {
  size_t struct_size;
  const char* name;
  double diameter, tip_angle; /* m, rad */
  double stiffness, damping;  /* of the virtual coupling, N/m, N s/m */
  double rate;                /* Hz */
  double low_pass;            /* Hz; 0 is off */
} punctura_setup;
typedef struct punctura_membrane {
  size_t struct_size;
  const char* name;
  double stiffness, precompression, friction, thickness; /* N/m, N, -, m */
  double point[3], inward_normal[3];                     /* m, a direction of any length but 0 */
} punctura_membrane;
PUNCTURA_API punctura_status punctura_setup_init(punctura_setup* setup, size_t size);
PUNCTURA_API punctura_status punctura_membrane_init(punctura_membrane* membrane, size_t size);
/* Makes a scene without membranes. */
PUNCTURA_API punctura_status punctura_scene_new(const punctura_setup* setup, punctura_scene** scene);
PUNCTURA_API punctura_status punctura_scene_add_membrane(punctura_scene* scene, const punctura_membrane* membrane);
/* Puts a syringe on the needle. Its numbers are NaN until they are set. */
PUNCTURA_API punctura_status punctura_scene_add_syringe(punctura_scene* scene);
/* Gives a list at least `count` rows: "coupling.relaxation", "membrane[i].grip_table" or "membrane[i].profile"
 * (docs/measured-tissue.md). The numbers of new rows are NaN until they are set, for example
 * "membrane[0].profile[2].depth". */
PUNCTURA_API punctura_status punctura_scene_make_rows(punctura_scene* scene, const char* list, size_t count);
PUNCTURA_API punctura_status punctura_scene_copy(const punctura_scene* scene, punctura_scene** copy);
PUNCTURA_API void punctura_scene_free(punctura_scene* scene);

/* The numbers of a scene by their path, in SI units. */
PUNCTURA_API punctura_status punctura_scene_set(punctura_scene* scene, const char* path, double value);
PUNCTURA_API punctura_status punctura_scene_get(const punctura_scene* scene, const char* path, double* value);
/* The words: name, needle.direction, servo.solver, servo.conditioning, display.force_scale ("automatic"),
 * membrane[i].name, membrane[i].look, membrane[i].behind, membrane[i].grip. UTF-8 without control characters. */
PUNCTURA_API punctura_status punctura_scene_set_word(punctura_scene* scene, const char* path, const char* word);

typedef struct punctura_field {
  size_t struct_size;
  char path[64];
  char symbol[16]; /* in K06; "" if it has none */
  char unit[16];
  double value, min, max;
  int32_t min_open, max_open; /* 1: the bound itself is not allowed */
} punctura_field;
PUNCTURA_API int32_t punctura_scene_field_count(const punctura_scene* scene);
PUNCTURA_API punctura_status punctura_scene_field(const punctura_scene* scene, int32_t index, punctura_field* field);
PUNCTURA_API int32_t punctura_scene_membrane_count(const punctura_scene* scene);
/* Finds all problems of the scene. */
PUNCTURA_API punctura_status punctura_scene_check(const punctura_scene* scene);
/* Numbers that are allowed but probably in a wrong unit, one line each, for example a needle of 1.08 m. "" if there are
 * none, and for NULL. Valid until the next call of this function by this thread. */
PUNCTURA_API const char* punctura_scene_unusual(const punctura_scene* scene);

/* ---- What all steps have in common ----
 *
 * _peek computes the tick that _step would make, without making it. _commit then makes it: afterwards everything is as
 * after _step. A solver that tries several positions for one time calls _peek for each of them and _commit once. A
 * _peek replaces the previous one; _step, _reset and _restore discard it.
 *
 * _save writes the complete state into a buffer of _state_size bytes. _restore continues from it with the same bits.
 * Bytes of another size, of another scene, of another version and damaged bytes are refused and change nothing. The
 * bytes are in the byte order of the machine. They are no defence against a forger. */

/* One membrane in a tick. */
typedef struct punctura_membrane_tick {
  size_t struct_size;
  int32_t phase;            /* PUNCTURA_OUTSIDE ... */
  double depth;             /* m, of the band */
  double axial_force;       /* N, along the needle */
  double lower, upper;      /* the band, N */
  double proxy[3];          /* m */
  double direction[3];      /* of the needle at entry, valid while inside */
} punctura_membrane_tick;
enum {
  PUNCTURA_OUTSIDE = 0,
  PUNCTURA_STICKING = 1,
  PUNCTURA_SLIDING_IN = 2,
  PUNCTURA_SLIDING_OUT = 3,
  PUNCTURA_BARRED = 4
};

/* ---- Insertion: the model of a scene, without limits ----
 *
 * The force is the force of the model. Do not send it to a device: for that, use punctura_servo. */

typedef struct punctura_insertion punctura_insertion;

PUNCTURA_API punctura_status punctura_insertion_new(const punctura_scene* scene, punctura_insertion** insertion);
PUNCTURA_API void punctura_insertion_free(punctura_insertion* insertion);
PUNCTURA_API punctura_status punctura_insertion_reset(punctura_insertion* insertion);
/* Tick. position: of the tip, m. axis: direction of the needle, of any length but 0. force: on the needle, N. */
PUNCTURA_API punctura_status punctura_insertion_step(punctura_insertion* insertion, const double position[3],
                                                     const double axis[3], double force[3]);
PUNCTURA_API punctura_status punctura_insertion_peek(punctura_insertion* insertion, const double position[3],
                                                     const double axis[3], double force[3]);  /* Tick */
PUNCTURA_API punctura_status punctura_insertion_commit(punctura_insertion* insertion);        /* Tick */
/* Makes `count` ticks. positions, axes, forces: 3 numbers a tick. axes may be one axis: axis_stride is then 0,
 * otherwise 3. Allocates no memory, except for the text of a wrong argument. Ends at the first tick that is not
 * PUNCTURA_OK: all forces from there on are NaN. */
PUNCTURA_API punctura_status punctura_insertion_run(punctura_insertion* insertion, size_t count,
                                                    const double* positions, const double* axes, size_t axis_stride,
                                                    double* forces);
PUNCTURA_API int32_t punctura_insertion_membrane_count(const punctura_insertion* insertion);
/* Tick. The result of the last step for one membrane. tick->struct_size must be set. */
PUNCTURA_API punctura_status punctura_insertion_membrane(const punctura_insertion* insertion, int32_t membrane,
                                                         punctura_membrane_tick* tick);
PUNCTURA_API size_t punctura_insertion_state_size(const punctura_insertion* insertion);
PUNCTURA_API punctura_status punctura_insertion_save(const punctura_insertion* insertion, void* state, size_t size);
PUNCTURA_API punctura_status punctura_insertion_restore(punctura_insertion* insertion, const void* state, size_t size);

/* ---- Proxy: one membrane, without conditioning ---- */

/* On a line: K06 section 3.1. */
typedef struct punctura_proxy1d punctura_proxy1d;
PUNCTURA_API punctura_status punctura_proxy1d_new(const punctura_scene* scene, int32_t membrane,
                                                  punctura_proxy1d** proxy);
PUNCTURA_API void punctura_proxy1d_free(punctura_proxy1d* proxy);
PUNCTURA_API punctura_status punctura_proxy1d_reset(punctura_proxy1d* proxy);
/* Tick. depth: of the device, m. Returns the force, N; NaN if proxy is NULL or depth is no place. */
PUNCTURA_API double punctura_proxy1d_step(punctura_proxy1d* proxy, double depth);
PUNCTURA_API double punctura_proxy1d_peek(punctura_proxy1d* proxy, double depth);  /* Tick */
PUNCTURA_API punctura_status punctura_proxy1d_commit(punctura_proxy1d* proxy);     /* Tick */
PUNCTURA_API punctura_status punctura_proxy1d_membrane(const punctura_proxy1d* proxy, punctura_membrane_tick* tick);
PUNCTURA_API size_t punctura_proxy1d_state_size(const punctura_proxy1d* proxy);
PUNCTURA_API punctura_status punctura_proxy1d_save(const punctura_proxy1d* proxy, void* state, size_t size);
PUNCTURA_API punctura_status punctura_proxy1d_restore(punctura_proxy1d* proxy, const void* state, size_t size);

/* In space: K06 section 3.2. The calls are those of an insertion. */
typedef struct punctura_proxy3d punctura_proxy3d;
PUNCTURA_API punctura_status punctura_proxy3d_new(const punctura_scene* scene, int32_t membrane,
                                                  punctura_proxy3d** proxy);
PUNCTURA_API void punctura_proxy3d_free(punctura_proxy3d* proxy);
PUNCTURA_API punctura_status punctura_proxy3d_reset(punctura_proxy3d* proxy);
PUNCTURA_API punctura_status punctura_proxy3d_step(punctura_proxy3d* proxy, const double position[3],
                                                   const double axis[3], double force[3]);   /* Tick */
PUNCTURA_API punctura_status punctura_proxy3d_peek(punctura_proxy3d* proxy, const double position[3],
                                                   const double axis[3], double force[3]);   /* Tick */
PUNCTURA_API punctura_status punctura_proxy3d_commit(punctura_proxy3d* proxy);               /* Tick */
PUNCTURA_API punctura_status punctura_proxy3d_membrane(const punctura_proxy3d* proxy, punctura_membrane_tick* tick);
PUNCTURA_API size_t punctura_proxy3d_state_size(const punctura_proxy3d* proxy);
PUNCTURA_API punctura_status punctura_proxy3d_save(const punctura_proxy3d* proxy, void* state, size_t size);
PUNCTURA_API punctura_status punctura_proxy3d_restore(punctura_proxy3d* proxy, const void* state, size_t size);

/* ---- Servo: the whole tick for a device: input gate, model, force scale, force limits ---- */

typedef struct punctura_servo punctura_servo;

/* docs/safety.md. The defaults are for a PHANTOM Omni. */
typedef struct punctura_limits {
  size_t struct_size;
  double max_force, continuous_force; /* N */
  double continuous_time, ramp_time;  /* s */
  double warm_motor;                  /* 0 to 1 */
  double max_speed;                   /* m/s */
  double stale, deadline;             /* s */
  double axis_tolerance;
  uint32_t dead_man; /* bits of the dead-man buttons; 0 needs none */
} punctura_limits;
PUNCTURA_API punctura_status punctura_limits_init(punctura_limits* limits, size_t size);

/* The reading of the device in a tick. punctura_sample_init() gives a healthy sample with the axis (0, -1, 0). */
typedef struct punctura_sample {
  size_t struct_size;
  uint64_t sequence;  /* number of the reading: an equal number is the same reading */
  double time;        /* start of the tick, s, on a clock that never goes back, and goes on while the computer sleeps:
                       * on Linux CLOCK_BOOTTIME */
  double position[3]; /* of the tip, m */
  double axis[3];     /* direction of the needle, of length 1 */
  uint32_t buttons;   /* one bit for each button */
  int32_t healthy;    /* 0: the device reports a fault */
  double motor_temperature; /* 1 is the maker's danger limit; 0 if it is not reported */
  double thumb;             /* depth of the thumb on the plunger, m */
} punctura_sample;
PUNCTURA_API punctura_status punctura_sample_init(punctura_sample* sample, size_t size);

/* The record of a tick. */
typedef struct punctura_record {
  size_t struct_size;
  uint64_t tick;
  int32_t state; /* PUNCTURA_DISARMED ... */
  int32_t fault; /* 0: none. punctura_fault_text() says what to do */
  int32_t limit; /* PUNCTURA_LIMIT_NONE ...: what made the force smaller */
  uint32_t membrane_count;
  double tip[3];         /* the conditioned position, m */
  double model_force[3]; /* N, without scale and limits */
  double force[3];       /* N, for the device */
  double force_scale;
  double ceiling;     /* the largest force that all limits permit in this tick, N */
  double thumb_force; /* N, for the device under the thumb, before its own limits */
  double plunger, plunger_force, pressure, left; /* m, N, Pa, m^3; NaN without a syringe */
} punctura_record;
enum { PUNCTURA_DISARMED = 0, PUNCTURA_WAITING = 1, PUNCTURA_ACTIVE = 2, PUNCTURA_FAULTED = 3 };
enum {
  PUNCTURA_LIMIT_NONE = 0,
  PUNCTURA_LIMIT_RAMP = 1,
  PUNCTURA_LIMIT_PEAK = 2,
  PUNCTURA_LIMIT_CONTINUOUS = 3,
  PUNCTURA_LIMIT_TEMPERATURE = 4
};
PUNCTURA_API const char* punctura_fault_text(int32_t fault);

/* limits: NULL for the defaults. */
PUNCTURA_API punctura_status punctura_servo_new(const punctura_scene* scene, const punctura_limits* limits,
                                                punctura_servo** servo);
PUNCTURA_API void punctura_servo_free(punctura_servo* servo);
/* Requests force. It starts, with a ramp, when the tip is in front of every membrane. */
PUNCTURA_API punctura_status punctura_servo_arm(punctura_servo* servo);    /* Tick */
PUNCTURA_API punctura_status punctura_servo_disarm(punctura_servo* servo); /* Tick */
/* Clears a fault and the state of the model. The servo is then disarmed. */
PUNCTURA_API punctura_status punctura_servo_reset(punctura_servo* servo); /* Tick */
/* Tick. record->force is the force for the device. It is 0 unless the state is PUNCTURA_ACTIVE. A sample that is no
 * number is a fault, not an error: the status is PUNCTURA_OK. record->struct_size must be set. If the status is not
 * PUNCTURA_OK, no tick was made, and the forces of the record are 0, also if its struct_size is wrong: `record` is
 * NULL or a whole punctura_record. */
PUNCTURA_API punctura_status punctura_servo_step(punctura_servo* servo, const punctura_sample* sample,
                                                 punctura_record* record);
PUNCTURA_API punctura_status punctura_servo_peek(punctura_servo* servo, const punctura_sample* sample,
                                                 punctura_record* record); /* Tick */
PUNCTURA_API punctura_status punctura_servo_commit(punctura_servo* servo); /* Tick */
PUNCTURA_API punctura_status punctura_servo_membrane(const punctura_servo* servo, int32_t membrane,
                                                     punctura_membrane_tick* tick); /* Tick */
PUNCTURA_API size_t punctura_servo_state_size(const punctura_servo* servo);
PUNCTURA_API punctura_status punctura_servo_save(const punctura_servo* servo, void* state, size_t size);
/* A servo that was active gives force in its first tick after this. */
PUNCTURA_API punctura_status punctura_servo_restore(punctura_servo* servo, const void* state, size_t size);

#ifdef __cplusplus
}
#endif
#endif
