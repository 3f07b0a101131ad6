// The part of the tests that is written in C99.
#pragma once

#include "punctura.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A scene with one membrane, from structs. Returns NULL after an error.
punctura_scene* c99_scene(void);
/// Pushes the needle 10 mm in at 10 mm/s with the servo. Returns the number of ticks with force, or -1.
int c99_push(const punctura_scene* scene, double* largest);

#ifdef __cplusplus
}
#endif
